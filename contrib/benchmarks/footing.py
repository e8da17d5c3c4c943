"""Rough strip footing on clay, Nakamura et al. (2023), section 5.2, beside the J2 finite elements of the same program."""
import csv
import math

import matplotlib

matplotlib.use("Agg")
import maps
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "strip footing on clay (2D): load-displacement and slip lines, corrected and not"

C, B = 1e4, 0.5  # cohesion [Pa], half width [m]: forces are those of half the footing
CORRECTED = ["FLIP", "PIC", "APIC", "TPIC"]


def run(h, transfer, treatment, edge):
    width = B + (0.25 if edge == "closed" else -0.25) * h
    return Run("prm/footing.prm",
               {"Grid/Spacing": h, "Transfer/Type": transfer, "Kernel/Boundary treatment": treatment,
                "Conditions/footing/Upper corner": f"{width}, 5.01"},
               {"h": h, "transfer": transfer, "treatment": treatment, "edge": edge})


def runs():
    return ([run(0.05, transfer, "WLS", "open") for transfer in CORRECTED]
            + [run(0.05, "TPIC", "WLS everywhere", "open")]
            + [run(0.05, transfer, "Steffen", "open") for transfer in ("FLIP", "APIC", "TPIC")]
            + [run(h, "TPIC", "WLS", "closed") for h in (0.1, 0.05, 0.025)]
            + [finite_elements()])


def finite_elements():
    """Q2 elements as large as the cells; the run of particles beside them ends after a step."""
    h = 0.05
    return Run("prm/footing_fem.prm", {"FEM reference/Cells": f"{round(5 / h)}, {round(5 / h)}", "Run/Number of steps": 1},
               {"h": h, "transfer": "FEM", "treatment": "Q2", "edge": "x <= B/2"})


def curve(result):
    """Time and Q/(cB)."""
    if result.run.label["transfer"] == "FEM":
        with open(result.directory / "load_curve.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        return (np.array([float(row["time [time]"]) for row in rows]),
                np.array([float(row["force footing y [force]"]) for row in rows]) / (C * B))
    columns = result.statistics()
    return columns["time"], np.abs(columns["reaction footing y"]) / (C * B)


def late(result, fraction):
    """Mean of Q/(cB) over t > fraction T."""
    if result.status != 0:
        return math.nan
    time, load = curve(result)
    return np.mean(load[time > (fraction + 1e-9) * time[-1]])


def slope(result):
    return late(result, 0.9) - late(result, 0.5)


def by_internal_forces(result):
    """Mean of the internal forces of the footing's nodes over the mean reaction, t > .9 T."""
    if result.status != 0:
        return math.nan
    columns = result.statistics()
    end = columns["time"] > 0.9 * columns["time"][-1]
    return np.mean(columns["nodal force footing y"][end]) / np.mean(columns["reaction footing y"][end])


def area_of_half(result):
    """Area that holds half of the deviatoric strain [m^2]."""
    if result.status != 0 or result.run.label["transfer"] == "FEM":
        return math.nan
    particles = result.particles()
    strain = np.sort(particles["deviatoric_strain"])[::-1]
    n = np.searchsorted(np.cumsum(strain), strain.sum() / 2) + 1
    return 25 * n / len(strain)


def table(results):
    return [{**result.run.label, "Q/(cB)": late(result, 0.9), "slope": slope(result), "half strain area": area_of_half(result),
             "failed at": result.failure_time()} for result in results]


def figures(results):
    by = {tuple(result.run.label.values()): result for result in results}
    fem = next(result for result in results if result.run.label["transfer"] == "FEM")
    here = lambda transfer, treatment: by[0.05, transfer, treatment, "open"]
    load = lambda transfer, treatment: late(here(transfer, treatment), 0.9)
    values = []
    for transfer in ("FLIP", "APIC", "TPIC"):
        values.append(report.Figure(f"{transfer}, corrected, Q/(cB)", load(transfer, "WLS"), 5.04, 5.14))
        values.append(report.Figure(f"{transfer}, corrected, slope", slope(here(transfer, "WLS")), upper=0.10))
        values.append(report.Figure(f"{transfer}, corrected, area of half the strain",
                                    area_of_half(here(transfer, "WLS")), 0.53, 0.56, "m2"))
    for transfer in ("FLIP", "APIC", "TPIC"):
        values.append(report.near(f"{transfer}, corrected, force by internal forces over reaction",
                                  by_internal_forces(here(transfer, "WLS")), 1, 2e-3))
    corrected = [load(transfer, "WLS") for transfer in ("FLIP", "APIC", "TPIC")]
    values.append(report.Figure("FLIP, APIC, TPIC, corrected, spread", max(corrected) - min(corrected), upper=0.03))
    values.append(report.near("PIC, corrected, Q/(cB)", load("PIC", "WLS"), 5.192, 0.03))
    values.append(report.Figure("MLS-MPM, Q/(cB)", load("TPIC", "WLS everywhere"), 5.20, 5.34))
    for transfer in ("FLIP", "TPIC"):
        values.append(report.Figure(f"{transfer}, uncorrected, Q/(cB)", load(transfer, "Steffen"), lower=5.38))
        values.append(report.Figure(f"{transfer}, uncorrected, slope", slope(here(transfer, "Steffen")), lower=0.15))
        values.append(report.Figure(f"{transfer}, uncorrected, area of half the strain",
                                    area_of_half(here(transfer, "Steffen")), lower=0.70, unit="m2"))
    values.append(report.Figure("APIC, uncorrected, fails (time)", here("APIC", "Steffen").failure_time(), 0, 0.1, "s"))
    for h, expected in ((0.1, 5.92), (0.05, 5.61), (0.025, 5.42)):
        values.append(report.near(f"TPIC, corrected, closed, h = {h}, Q/(cB)",
                                  late(by[h, "TPIC", "WLS", "closed"], 0.9), expected, 0.01 * expected))
    values.append(report.near("FEM, h = 0.05, Q/(cB) at the end", curve(fem)[1][-1] if fem.status == 0 else math.nan,
                              5.218, 0.005 * 5.218))
    return values


def draw(results, path):
    """Load against displacement, and the deviatoric strain near the footing."""
    opened = [result for result in results if result.run.label["edge"] != "closed"]
    shown = [result for result in opened if result.status == 0 and result.run.label["transfer"] not in ("PIC", "FEM")]
    figure = plt.figure(figsize=(13, 6.2), layout="constrained")
    grid = figure.add_gridspec(2, 4)
    axis = figure.add_subplot(grid[0, :2])
    for result in opened:
        if result.status == 0:
            time, load = curve(result)
            label = result.run.label
            style = {"WLS": "-", "Q2": "ko-"}.get(label["treatment"], "--")
            axis.plot(4 * time, load, style, lw=1, ms=3, label=f"{label['transfer']}, {label['treatment']}")
    axis.axhline(2 + math.pi, color="k", lw=0.7)
    axis.text(0.01, 2 + math.pi + 0.05, "Prandtl, 2 + pi", fontsize=8)
    axis.set_xlabel("displacement [mm]")
    axis.set_ylabel("Q / (c B)")
    axis.set_ylim(0, 7)
    axis.legend(fontsize=7, loc="lower right")
    places = [grid[0, 2], grid[0, 3], grid[1, 0], grid[1, 1], grid[1, 2], grid[1, 3]]
    for place, result in zip(places, shown):
        axis = figure.add_subplot(place)
        particles = result.particles()
        picture = maps.image(particles, 1e4 * particles["deviatoric_strain"])
        drawn = axis.imshow(picture, origin="lower", extent=(0, 5, 0, 5), vmin=0, vmax=15, cmap="magma", interpolation="nearest")
        axis.set(xlim=(0, 2.5), ylim=(3, 5), xticks=[], yticks=[])
        axis.set_title(f"{result.run.label['transfer']}, {result.run.label['treatment']}", fontsize=9)
    figure.colorbar(drawn, ax=figure.axes[1:], label="deviatoric strain [1e-4]", extend="max", shrink=0.6)
    figure.suptitle("Footing, h = .05: load and deviatoric strain at the end")
    figure.savefig(path, dpi=110)
    plt.close(figure)
