"""Discharge of a silo through slots of four widths, at two spacings, beside Beverloo's law in 2D."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run, table_time

TITLE = "silo (2D): discharge through a slot between rigid shelves, beside Beverloo's exponent"

WIDTHS, SPACINGS = (0.16, 0.2, 0.24, 0.3), (0.02, 0.01)
TOP, BOTTOM, DENSITY, G = 0.8, 0.7, 1500., 9.81  # of the shelves [m], of the sand


def run(width, h):
    left, right = 0.5 - width / 2, 0.5 + width / 2
    return Run("prm/silo.prm",
               {"Grid/Spacing": h, "Output/CSV": "true",
                "Obstacles/left/Corners": f"-0.2, {BOTTOM}; {left}, {BOTTOM}; {left}, {TOP}; -0.2, {TOP}",
                "Obstacles/right/Corners": f"{right}, {BOTTOM}; 1.2, {BOTTOM}; 1.2, {TOP}; {right}, {TOP}"},
               {"width": width, "h": h})


def runs():
    return [run(width, h) for h in SPACINGS for width in WIDTHS]


def outflow(result):
    """Times, and the mass below the middle of the shelves [kg/m]."""
    times, masses = [], []
    for path in sorted(result.directory.glob("particles_*.csv")):
        time = table_time(path)
        columns = result.particles(time)
        density = DENSITY / columns["volume_ratio"]
        times.append(time)
        masses.append(float(np.sum((density * columns["volume"])[columns["y"] < (TOP + BOTTOM) / 2])))
    return np.array(times), np.array(masses)


def rate(result):
    """Slope of the mass over time while it runs evenly: from .3 to .9 s."""
    if result.status != 0:
        return math.nan
    times, masses = outflow(result)
    part = (times > 0.3 - 1e-9) & (times < 0.9 + 1e-9)
    return float(np.polyfit(times[part], masses[part], 1)[0])


def passed(result):
    """Particles within a shelf by more than a spacing."""
    h, width = result.run.label["h"], result.run.label["width"]
    columns = result.particles()
    inside = (columns["y"] > BOTTOM + h) & (columns["y"] < TOP - h) & (np.abs(columns["x"] - 0.5) > width / 2 + h)
    return int(np.sum(inside))


def exponent(results, h):
    """Of the rate over the width of the slot."""
    found = [(r.run.label["width"], rate(r)) for r in results if r.run.label["h"] == h]
    widths, rates = np.array(found).T
    return float(np.polyfit(np.log(widths), np.log(rates), 1)[0])


def table(results):
    rows = []
    for result in results:
        q, width = rate(result), result.run.label["width"]
        rows.append({**result.run.label, "rate": q, "over rho sqrt(g) D^1.5": q / (DENSITY * math.sqrt(G) * width**1.5),
                     "in the shelves": passed(result), "J of the heap": heap(result), "seconds": result.seconds})
    return rows


def heap(result):
    """99th percentile of J of what lies below the shelves and has come to rest."""
    columns = result.particles()
    speed = np.hypot(columns["velocity_x"], columns["velocity_y"])
    at_rest = (columns["y"] < 0.5 * BOTTOM) & (speed < 0.05)
    return float(np.percentile(columns["volume_ratio"][at_rest], 99)) if np.any(at_rest) else math.nan


def figures(results):
    found = [report.near(f"exponent at h = {h:g} over 3/2", exponent(results, h) / 1.5, 1, 0.08) for h in SPACINGS]
    for width in WIDTHS:
        coarse, fine = (next(rate(r) for r in results if r.run.label == {"width": width, "h": h}) for h in SPACINGS)
        found.append(report.near(f"D = {width:g}: rate at h = {SPACINGS[0]:g} over {SPACINGS[1]:g}", coarse / fine, 1, 0.08))
    found.append(report.Figure("particles in the shelves", sum(passed(r) for r in results), 0, 0))
    found.append(report.Figure("J of the heap", max(heap(r) for r in results), upper=1.05))
    return found


def draw(results, path):
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    for result in results:
        if result.status == 0:
            times, masses = outflow(result)
            label = result.run.label
            axes[0].plot(times, masses, lw=1, ls="-" if label["h"] == SPACINGS[1] else "--", label=f"D = {label['width']:g}, h = {label['h']:g}")
    axes[0].set(xlabel="time [s]", ylabel="mass below the shelves [kg/m]", title="Discharge")
    axes[0].legend(fontsize=7)
    widths = np.array(WIDTHS)
    for h, mark in zip(SPACINGS, "os"):
        rates = [next(rate(r) for r in results if r.run.label == {"width": width, "h": h}) for width in WIDTHS]
        axes[1].loglog(widths, rates, mark, ms=5, label=f"h = {h:g}: exponent {exponent(results, h):.2f}")
    axes[1].loglog(widths, rates[-1] * (widths / widths[-1])**1.5, "k-", lw=0.8, label="3/2")
    axes[1].set(xlabel="D [m]", ylabel="rate [kg/(m s)]", title="Beverloo")
    axes[1].legend(fontsize=8)
    last = next(r for r in results if r.run.label == {"width": 0.2, "h": SPACINGS[1]})
    particles = last.particles(0.8)
    drawn = axes[2].scatter(particles["x"], particles["y"], c=np.hypot(particles["velocity_x"], particles["velocity_y"]), s=0.8, cmap="viridis",
                            linewidths=0)
    axes[2].set(title="D = .2, speed at .8 s [m/s]", aspect="equal", xlim=(0, 1), ylim=(0, 2))
    figure.colorbar(drawn, ax=axes[2], shrink=0.7)
    figure.savefig(path, dpi=110)
    plt.close(figure)
