"""
The slope in sensitive clay of slope.py in plane strain, half the strengths: whether triangles and boxes come to the
same as they get finer. FLIP, two seconds.

TALUS_SLOPE_FINEST in the environment is the least spacing, .25 by default; each halving takes eight times as long.
"""
import math
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "slope in sensitive clay (plane strain): UMLS on triangles and quadratic B-splines on boxes as they get finer"

FINEST = float(os.environ.get("TALUS_SLOPE_FINEST", 0.25))
SPACINGS = tuple(0.5 / 2**k for k in range(round(math.log2(0.5 / FINEST)) + 1))
GRIDS = ("UMLS", "B-splines")
TOE, END = 15., 2.
TIMES = (0.5, 1., 1.5, 2.)
WEAK = 0.5  # share of the papers' strengths
BOUND = 0.05
MEASURES = ("moved", "mean", "run-out")


def run(grid, h):
    settings = {"Transfer/Type": "FLIP", "Grid/Spacing": h, "Run/End time": END, "Run/Energy account": "true",
                "Materials/clay/Yield stress": 40820 * WEAK, "Materials/clay/Residual yield stress": 2450 * WEAK,
                "Output/Grid": "false", "Output/Time interval": 0.25, "Output/Statistics interval": 20,
                "Output/Particle fields": "velocity, equivalent plastic strain, pressure, displacement, mass"}
    if grid == "UMLS":
        # Without a cutoff a node of next to no mass gains energy at t = .51; the default step then ends the run.
        settings.update({"Run/Courant number": 0.6, "Run/Mass cutoff": 1e-4, "Grid/Type": "mesh", "Kernel/Type": "UMLS",
                         "Grid/Cells": f"{round(30 / h)}, {round(6 / h)}",
                         "Conditions/floor/Boundary ids": "", "Conditions/floor/Boundaries": "lower y",
                         "Conditions/sides/Boundary ids": "", "Conditions/sides/Boundaries": "lower x, upper x"})
    return Run("prm/clay_slope.prm", settings, {"grid": grid, "h": h})


def runs():
    return [run(grid, h) for h in SPACINGS for grid in GRIDS]


def distances(particles):
    """The largest displacement, the mean one, and how far beyond the toe all but a thousandth of the mass lie."""
    moved = np.hypot(particles["displacement_x"], particles["displacement_y"])
    order = np.argsort(particles["x"])
    mass = np.cumsum(particles["mass"][order])
    return {"moved": np.max(moved), "mean": np.average(moved, weights=particles["mass"]),
            "run-out": particles["x"][order][np.searchsorted(mass, 0.999 * mass[-1])] - TOE}


def strained(particles):
    """Area of what has lost half of the strength that it can lose."""
    return np.sum(particles["mass"][particles["equivalent_plastic_strain"] > math.log(2) / 5]) / 2150


def table(results):
    rows = []
    for result in results:
        early = [f"moved at {time:g}" for time in TIMES[:-1]]
        values = dict.fromkeys((*MEASURES, *early, "softened area", "energy", "steps"), math.nan)
        if result.status == 0:
            columns, particles = result.statistics(), result.particles(END)
            values.update({**distances(particles), "softened area": strained(particles), "steps": columns["step"][-1],
                           "energy": columns["unaccounted energy"][-1] / columns["body force work"][-1],
                           **{name: distances(result.particles(time))["moved"] for name, time in zip(early, TIMES)}})
        rows.append({**result.run.label, **values, "seconds": result.seconds})
    return rows


def figures(results):
    rows = {(row["grid"], row["h"]): row for row in table(results)}
    return [report.Figure(f"h = {h:g}: {name} at {END:g} s, UMLS over B-splines",
                          rows["UMLS", h][name] / rows["B-splines", h][name], 1 - BOUND, 1 + BOUND)
            for h in SPACINGS for name in MEASURES] + [
        report.Figure(f"{grid}, h = {h:g}: energy less all work and plastic dissipation, over that of gravity",
                      rows[grid, h]["energy"], -0.01, 0.01) for h in SPACINGS for grid in GRIDS]


def draw(results, path):
    by = {(result.run.label["grid"], result.run.label["h"]): result for result in results}
    rows = {(row["grid"], row["h"]): row for row in table(results)}
    figure = plt.figure(figsize=(12, 6.5), layout="constrained")
    space = figure.add_gridspec(2, 3)
    shown = [h for h in SPACINGS if all(by[grid, h].status == 0 for grid in GRIDS)]
    for row, grid in enumerate(GRIDS):
        axis = figure.add_subplot(space[row, :2])
        if shown:
            h = shown[-1]
            particles = by[grid, h].particles(END)
            drawn = axis.scatter(particles["x"], particles["y"], c=particles["equivalent_plastic_strain"], s=300 * h**2,
                                 vmin=0, vmax=2, linewidths=0)
            axis.set_title(f"{grid}, h = {h:g} m, t = {END:g} s", fontsize=10)
            figure.colorbar(drawn, ax=axis, label="equivalent plastic strain", shrink=0.8, extend="max")
        axis.set(xlim=(0, 20), ylim=(0, 5.5), aspect="equal", xlabel="x [m]", ylabel="y [m]")
    axis = figure.add_subplot(space[0, 2])
    for h, colour in zip(SPACINGS, ("tab:green", "tab:orange", "tab:blue", "tab:red")):
        for grid, dash in zip(GRIDS, ("-", "--")):
            if by[grid, h].status == 0:
                times = np.arange(0, END + 1e-9, 0.25)
                moved = [distances(by[grid, h].particles(time))["moved"] for time in times]
                axis.plot(times, moved, dash, color=colour, label=f"{grid}, h = {h:g}")
    axis.set(xlabel="t [s]", ylabel="largest displacement [m]")
    axis.legend(fontsize=8)
    axis = figure.add_subplot(space[1, 2])
    for name in MEASURES:
        ratios = [rows["UMLS", h][name] / rows["B-splines", h][name] for h in SPACINGS]
        axis.plot(SPACINGS, ratios, "o-", label={"moved": "largest displacement", "mean": "mean displacement"}.get(name, name))
    axis.axhspan(1 - BOUND, 1 + BOUND, color="0.9", zorder=0, label="bound")
    axis.set(xlabel="h [m]", ylabel="UMLS over B-splines, t = 2 s", xlim=(0, None))
    axis.legend(fontsize=8)
    figure.savefig(path, dpi=120)
    plt.close(figure)
