"""Failure of a slope in sensitive clay: Cao et al., section 3.5, and Zhao, Jiang and Choo (2023), in 3D, on tetrahedra and boxes.

TALUS_SLOPE_EDGE and TALUS_SLOPE_WIDTH in the environment are the mesh's edge and the slope's width: .2 and 5 are the papers'
size, 311 250 particles; the default is .5 and 1.

With the papers' strengths the slope stands, as its stability number says; with half of them, `weak`, it fails, and runs out
until it rests or 12 s have passed, on a floor of twice the length.
"""
import math
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshes
import numpy as np
import report
from runs import Run

TITLE = "slope in sensitive clay (3D): displacement, run-out, F-bar; UMLS on tetrahedra and quadratic B-splines"

EDGE, WIDTH = float(os.environ.get("TALUS_SLOPE_EDGE", 0.5)), float(os.environ.get("TALUS_SLOPE_WIDTH", 1))
TOE, G, DENSITY = 15., 9.81, 2150.
FIELDS = "velocity, equivalent plastic strain, pressure, displacement, volume ratio, volume, mass"
GRIDS = {"UMLS": "prm/umls_slope.prm", "B-splines": "prm/clay_slope_3d.prm"}
EARLY = 1.  # the pressure of runs without F-bar is looked at here [s]
LENGTH, LONG = 30, 60  # of the floor [m]
WEAK = 0.5  # share of the strengths with which the slope fails


def run(grid, kind="whole"):
    settings = {"Grid/Spacing": EDGE, "Output/Grid": "false", "Output/Particle fields": FIELDS}
    if grid == "B-splines":
        settings["Grid/Upper corner"] = f"{LONG if kind == 'weak' else LENGTH}, 6, {WIDTH}"
    elif kind == "weak":
        settings["Grid/File"] = "prm/meshes/slope_long.msh"
    if kind == "without F-bar":
        settings.update({"Run/F-bar": "false", "Run/End time": EARLY})
    if kind == "weak":
        settings.update({"Materials/clay/Yield stress": 40820 * WEAK, "Materials/clay/Residual yield stress": 2450 * WEAK,
                         "Run/End time": 12, "Output/Time interval": 0.5})
    if kind == "momentum":
        settings.update({"Run/Number of steps": 300, "Output/Statistics interval": 1})
    return Run(GRIDS[grid], settings, {"grid": grid, "run": kind})


def runs():
    meshes.make("slope", 3, h=EDGE, width=WIDTH)
    meshes.make("slope", 3, "slope_long", h=EDGE, width=WIDTH, length=LONG)
    return [run(grid, kind) for kind in ("whole", "without F-bar", "weak", "momentum")
            for grid in GRIDS]


def run_out(particles):
    """Beyond the toe; a thousandth of the mass, what has come loose, may lie farther out."""
    order = np.argsort(particles["x"])
    mass = np.cumsum(particles["mass"][order])
    return particles["x"][order][np.searchsorted(mass, 0.999 * mass[-1])] - TOE


def moved(particles):
    """The largest displacement."""
    return np.max(np.sqrt(sum(particles[f"displacement_{axis}"]**2 for axis in "xyz")))


def roughness(particles):
    """
    What is left of the mean stress after a plane has been fitted in each block of two edges, root mean square over all
    particles in blocks of at least 12, over the pressure of the slope's height.
    """
    x = np.column_stack([particles[axis] for axis in "xyz"])
    block = np.floor(x / (2 * EDGE)).astype(int)
    _, number = np.unique(block, axis=0, return_inverse=True)
    squares, n = 0., 0
    for k in range(number.max() + 1):
        here = np.flatnonzero(number == k)
        if len(here) < 12:
            continue
        basis = np.column_stack([np.ones(len(here)), x[here] - np.mean(x[here], axis=0)])
        pressure = particles["pressure"][here]
        rest = pressure - basis @ np.linalg.lstsq(basis, pressure, rcond=None)[0]
        squares, n = squares + np.sum(rest**2), n + len(here)
    return math.sqrt(squares / n) / (DENSITY * G * 5)


def J_range(particles):
    """Of the volumes, with F-bar those of its averages."""
    J = DENSITY * particles["volume"] / particles["mass"]
    return np.min(J), np.max(J)


def energies(result):
    """Of the last table's time: what is not accounted for over the work of gravity, and kinetic energy over its peak."""
    columns = result.statistics()
    return (columns["unaccounted energy"][-1] / columns["body force work"][-1],
            columns["kinetic energy"][-1] / np.max(columns["kinetic energy"]))


def momentum(result):
    return meshes.impulses(result.statistics(), (0, -G, 0), "xyz", (("reaction sides", -1), ("reaction floor", -1)))


def table(results):
    rows = []
    for result in results:
        values = {name: math.nan for name in ("particles", "moved", "run-out", "J least", "J greatest", "rough", "rough early", "energy",
                                              "kinetic", "momentum")}
        if result.status == 0:
            particles = result.particles()
            values.update({"particles": len(particles["id"]), "moved": moved(particles), "run-out": run_out(particles),
                           "rough": roughness(particles), "rough early": roughness(result.particles(EARLY))})
            values["J least"], values["J greatest"] = J_range(particles)
            if result.run.label["run"] == "momentum":
                values["momentum"] = momentum(result)
            else:
                values["energy"], values["kinetic"] = energies(result)
        rows.append({**result.run.label, **values, "steps": result.statistics()["step"][-1] if result.status == 0 else 0,
                     "seconds": result.seconds})
    return rows


def figures(results):
    rows = {(row["grid"], row["run"]): row for row in table(results)}
    umls, box = (rows[grid, "whole"] for grid in GRIDS)
    weak = [rows[grid, "weak"] for grid in GRIDS]
    found = [report.Figure("largest displacement, UMLS over B-splines", umls["moved"] / box["moved"], 0.95, 1.05),
             report.Figure("half the strength: run-out at 12 s, UMLS over B-splines", weak[0]["run-out"] / weak[1]["run-out"],
                           0.95, 1.05)]
    for grid in GRIDS:
        whole, early = rows[grid, "whole"], rows[grid, "without F-bar"]
        found += [report.Figure(f"{grid}: least J that the clay sees", whole["J least"], lower=0.97),
                  report.Figure(f"{grid}: greatest J that the clay sees", whole["J greatest"], upper=1.03),
                  report.Figure(f"{grid}: mean stress off planes, with F-bar over without, t = {EARLY:g}",
                                whole["rough early"] / early["rough early"], upper=0.3),
                  report.Figure(f"{grid}: energy less all work and plastic dissipation, over that of gravity",
                                whole["energy"], -0.01, 0.01),
                  report.Figure(f"{grid}: the same, half the strength", rows[grid, "weak"]["energy"], -0.01, 0.01),
                  report.Figure(f"{grid}: kinetic energy at the end over its peak", whole["kinetic"], upper=1e-3),
                  report.Figure(f"{grid}: momentum less all impulses", rows[grid, "momentum"]["momentum"], upper=1e-9)]
    return found


def scatter(axis, particles, values, **more):
    order = np.argsort(-particles["z"])
    return axis.scatter(particles["x"][order], particles["y"][order], c=values[order], s=30 * EDGE, linewidths=0, **more)


def draw(results, path):
    by = {(result.run.label["grid"], result.run.label["run"]): result for result in results if result.status == 0}
    draw_motion(by, path)
    for name, label, field, limits in (("strain", "equivalent plastic strain", "equivalent_plastic_strain", (0, 2)),
                                       ("pressure", "pressure [kPa]", "pressure", (0, 100))):
        draw_states(by, path.parent / f"slope_{name}.png", label, field, limits)
    pairs = [(grid, kind) for grid in GRIDS for kind in ("without F-bar", "whole") if (grid, kind) in by]
    figure, axes = plt.subplots(2, 2, figsize=(10, 4.6), layout="constrained")
    for axis, key in zip(axes.flat, pairs):
        particles = by[key].particles(EARLY)
        drawn = scatter(axis, particles, particles["pressure"] / 1e3, vmin=-50, vmax=150)
        axis.set(xlim=(0, 16), ylim=(0, 5.5), aspect="equal")
        axis.set_title(f"{key[0]}, {'with' if key[1] == 'whole' else 'without'} F-bar, t = {EARLY:g} s", fontsize=10)
    label_outer(axes)
    figure.colorbar(drawn, ax=axes, shrink=0.8, label="pressure [kPa]", extend="both")
    figure.savefig(path.parent / "slope_f_bar.png", dpi=110)
    plt.close(figure)


def draw_motion(by, path):
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), layout="constrained")
    for axis, (kind, of, label, title) in zip(axes, (
            ("whole", moved, "largest displacement [m]", "strengths of the paper: it stands"),
            ("weak", moved, "largest displacement [m]", "half the strengths, the first 2 s"),
            ("weak", run_out, "run-out [m]", "half the strengths"))):
        values = {}
        for grid in GRIDS:
            if (grid, kind) in by:
                result = by[grid, kind]
                end = result.statistics()["time"][-1]
                times = np.arange(0, min(end, 2 if of is moved else end) + 1e-9, 0.5)
                values[grid] = [of(result.particles(time)) for time in times]
                axis.plot(times, values[grid], "-" if grid == "UMLS" else "--", label=grid)
        axis.set(xlabel="t [s]", ylabel=label, title=title, ylim=(0, None))
        axis.legend()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def draw_states(by, path, label, field, limits):
    """Side by side, on as much of the floor as they reach."""
    if any((grid, "weak") not in by for grid in GRIDS):
        return
    last = min(by[grid, "weak"].statistics()["time"][-1] for grid in GRIDS)
    times = [time for time in (1, 2, 4, 12) if time < last + 1e-3]
    shown = [[by[grid, "weak"].particles(time) for grid in GRIDS] for time in times]
    reach = [math.ceil(max(np.max(particles["x"]) for particles in row)) for row in shown]
    figure, axes = plt.subplots(len(times), 2, figsize=(11, 2.1 * len(times)), layout="constrained", squeeze=False)
    for line, row, time, end in zip(axes, shown, times, reach):
        for axis, particles, grid in zip(line, row, GRIDS):
            values = particles[field] / 1e3 if "kPa" in label else particles[field]
            drawn = scatter(axis, particles, values, vmin=limits[0], vmax=limits[1])
            axis.set(xlim=(0, end), ylim=(0, 5.5))
            axis.set_title(f"{grid}, half the strengths, t = {time} s", fontsize=10)
    label_outer(axes)
    figure.colorbar(drawn, ax=axes, shrink=0.6, label=label, extend="max")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def label_outer(axes):
    for axis in axes[-1]:
        axis.set_xlabel("x [m]")
    for axis in axes[:, 0]:
        axis.set_ylabel("y [m]")
