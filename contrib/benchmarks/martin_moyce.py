"""Front of a collapsing column of water beside the experiment of Martin & Moyce (1952)."""
import csv
import math
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "dam break (2D): the front beside the experiment of Martin and Moyce"

G, A = 9.81, 0.5  # gravity, width of the column [m]
SCALE = math.sqrt(2 * G / A)
DATA = pathlib.Path(__file__).parent / "data" / "martin_moyce_1952.csv"
END = 1.0
# Speed between the two times of the data, deviation allowed by spacing [%].
SPEED_TIMES, SPEED_BOUNDS, SHIFT = (2.547, 4.418), {0.05: 12, 0.025: 7}, 0.4


def data():
    with open(DATA, newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return np.array([[float(row["T"]), float(row["Z"])] for row in rows])


def runs():
    return [Run("prm/dam_break.prm",
                {"Grid/Upper corner": "4, 1.2", "Grid/Spacing": h, "Transfer/Type": transfer,
                 "Kernel/Boundary treatment": "WLS", "Run/Courant number": 0.1,
                 "Bodies/column/Upper corner": f"{A}, {2 * A}", "Bodies/column/Surface level": 2 * A,
                 "Run/End time": END, "Output/Time interval": 0.02, "Output/Grid": "false"},
                {"h": h, "transfer": transfer}) for h in (0.05, 0.025) for transfer in ("FLIP", "TPIC")]


def front(result):
    """T and Z: the 99.8 percentile of x among the particles near the floor."""
    times = np.arange(0, END + 1e-9, 0.02)
    places = []
    for time in times:
        particles = result.particles(time)
        x = particles["x"][particles["y"] < 4 * result.run.label["h"]]
        places.append(np.percentile(x, 99.8) / A)
    return times * SCALE, np.array(places)


def speed_deviation(result):
    """Mean speed of the front against the experiment's [%]."""
    if result.status != 0:
        return math.nan
    T, Z = front(result)
    ours = np.diff(np.interp(SPEED_TIMES, T, Z))[0]
    measured = data()
    theirs = np.diff(np.interp(SPEED_TIMES, *measured.T))[0]
    return 100 * (ours / theirs - 1)


def best_shift(result):
    """The shift of time that brings the front closest to the data."""
    if result.status != 0:
        return math.nan
    T, Z = front(result)
    measured = data()
    shifts = np.linspace(-1, 1, 401)
    misfits = [np.sum((np.interp(measured[:, 0] - shift, T, Z) - measured[:, 1])**2) for shift in shifts]
    return shifts[int(np.argmin(misfits))]


def table(results):
    return [{**result.run.label, "speed deviation %": speed_deviation(result), "best shift": best_shift(result)}
            for result in results]


def figures(results):
    values = []
    for result in results:
        if result.run.label["transfer"] != "TPIC":
            continue
        h = result.run.label["h"]
        values.append(report.near(f"TPIC, h = {h}, speed of the front over the experiment's - 1",
                                  speed_deviation(result), 0, SPEED_BOUNDS[h], "%"))
        values.append(report.near(f"TPIC, h = {h}, best shift of T", best_shift(result), 0, SHIFT))
    return values


def draw(results, path):
    figure, axis = plt.subplots(figsize=(6, 4.2), layout="constrained")
    measured = data()
    axis.plot(*measured.T, "ko", label="Martin & Moyce (1952)")
    for result in results:
        if result.status == 0:
            T, Z = front(result)
            axis.plot(T, Z, "-" if result.run.label["transfer"] == "TPIC" else "--",
                      label=f"{result.run.label['transfer']}, h = {result.run.label['h']}")
    axis.set(xlabel="T = t sqrt(2 g / a)", ylabel="front, x / a", xlim=(0, 5), ylim=(1, 6.5))
    axis.legend(fontsize=8)
    figure.savefig(path, dpi=110)
    plt.close(figure)
