"""A cantilever falls under its weight on turned meshes of triangles: Cao et al., beside dynamic finite elements."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshes
import numpy as np
import report
from matplotlib.tri import Triangulation
from runs import Run

TITLE = "cantilever on turned structured and Delaunay meshes: UMLS, C1 UMLS and P1 beside dynamic finite elements"

ANGLES = (0, 15, 30, 45)
LOWER, UPPER = (0, -3), (5, 2)
SMOOTH = (("structured", 0, 0.1), ("Delaunay", 0, 0.1), ("Delaunay", 45, 0.1), ("Delaunay", 0, 0.05))  # with C1 UMLS
# True gradients need a better quadrature, and no damping of what is then left of noise.
SCHEME = {"C1 UMLS": ("FLIP", 4)}  # transfer, particles per cell and direction; all others: TPIC, 2
SPACINGS = (0.1, 0.05, 0.025, 0.0125)  # of particles
MIRROR = {"Grid/No-slip mirrors": "wall"}


def tip(spacing):
    """The two particles nearest to the middle of the end."""
    return [(4 - spacing / 2, 0.5 + sign * spacing / 2) for sign in (-1, 1)]


def numbers(point):
    return ", ".join(f"{value!r}" for value in point)


def make(kind, h, angle):
    name = f"cantilever_{kind}_{h}_{angle}"
    if kind == "structured":
        return meshes.turned_lattice(name, LOWER, UPPER, h, angle)
    path = meshes.make("cantilever", 2, name, h=h, angle=angle)
    meshes.turn(path, -angle)
    return path


def run(kernel, kind, angle, h=0.1):
    path = make(kind, h, angle)
    transfer, n = SCHEME.get(kernel, ("TPIC", 2))
    lower, upper = tip(h / n)
    return Run("prm/umls_cantilever.prm",
               {"Kernel/Type": kernel, "Transfer/Type": transfer, "Bodies/beam/Particles per cell and direction": n,
                "Grid/Cells": "", "Grid/File": path, "Grid/Spacing": h, **({} if kernel == "P1" else MIRROR),
                "Conditions/wall/Boundaries": "wall", "FEM reference/Compare": "no",
                "Output/Probes/lower/Position": numbers(lower), "Output/Probes/upper/Position": numbers(upper)},
               {"kernel": kernel, "mesh": kind, "angle": angle, "h": h})


def reference():
    """At the tips of all spacings."""
    points = [point for spacing in SPACINGS for point in tip(spacing)]
    return Run("prm/umls_cantilever.prm",
               {"Run/Number of steps": 1, "FEM reference/Points": "; ".join(map(numbers, points))},
               {"kernel": "FEM", "mesh": "squares", "angle": 0, "h": 0.1})


def runs():
    found = [reference()]
    found += [run("UMLS", kind, angle) for kind in ("structured", "Delaunay") for angle in ANGLES]
    found += [run("C1 UMLS", *where) for where in SMOOTH]
    return found + [run("UMLS", kind, 0, 0.2) for kind in ("structured", "Delaunay")] + [run("P1", "structured", 0)]


def motion(result):
    """Times, and mean vertical displacement of the two points."""
    columns = result.columns("probes.csv")
    return columns["time"], (columns["lower_displacement_y"] + columns["upper_displacement_y"]) / 2


def exact_motion(fem, spacing):
    """The same of the elements at the tip of particles with that spacing."""
    columns, k = fem.columns("fem_motion.csv"), 2 * SPACINGS.index(spacing)
    return columns["time"], (columns[f"displacement {k} y"] + columns[f"displacement {k + 1} y"]) / 2


def compare(result, results):
    """Root mean square of the difference from the elements over the greatest displacement; the lowest; change of energy."""
    fem = results[0]
    if result.status != 0 or fem.status != 0:
        return {"rmse": math.nan, "lowest": math.nan, "residual": math.nan}
    h, (_, n) = result.run.label["h"], SCHEME.get(result.run.label["kernel"], ("TPIC", 2))
    times, exact = exact_motion(fem, 0.05 if result is fem else h / n)
    if result is fem:
        return {"rmse": 0., "lowest": float(exact.min()), "residual": 0.}
    t, u = motion(result)
    columns = result.statistics()
    scale = np.max(np.abs(columns["body force work"]))
    return {"rmse": math.sqrt(np.mean((np.interp(times, t, u) - exact)**2)) / np.max(np.abs(exact)), "lowest": u.min(),
            "residual": np.max(np.abs(columns["energy residual"])) / scale}


def table(results):
    return [{**result.run.label, **compare(result, results), "seconds": result.seconds} for result in results]


def figures(results):
    by = {tuple(result.run.label.values()): compare(result, results) for result in results}
    found = [report.Figure("UMLS, structured, h = .1: rmse over FEM's lowest", by["UMLS", "structured", 0, 0.1]["rmse"], upper=0.01)]
    for kind in ("structured", "Delaunay"):
        lowest = [by["UMLS", kind, angle, 0.1]["lowest"] for angle in ANGLES]
        found.append(report.Figure(f"UMLS, {kind}: spread of the lowest over angles",
                                   (max(lowest) - min(lowest)) / abs(np.mean(lowest)), upper=0.03))
    found += [report.Figure(f"C1 UMLS, {kind}, {angle} degrees, h = {h:g}: rmse", by["C1 UMLS", kind, angle, h]["rmse"], upper=0.01)
              for kind, angle, h in SMOOTH]
    return found


def draw(results, path):
    by = {tuple(result.run.label.values()): result for result in results}
    figure, axes = plt.subplots(2, 4, figsize=(12, 6), layout="constrained")
    for row, kind in zip(axes, ("structured", "Delaunay")):
        for axis, angle in zip(row, (15, 45)):
            nodes, triangles = meshes.read_triangles(meshes.DIRECTORY / f"cantilever_{kind}_0.1_{angle}.msh")
            axis.triplot(Triangulation(*nodes.T, triangles), color="0.8", lw=0.3)
            result = by["UMLS", kind, angle, 0.1]
            if result.status == 0:
                particles = result.particles(0.5)
                drawn = axis.scatter(particles["x"], particles["y"], s=1, c=particles["stress_xx"] / 1e6, vmin=-1, vmax=1,
                                     cmap="coolwarm", linewidths=0)
                figure.colorbar(drawn, ax=axis, label="stress xx [MPa]", shrink=0.8)
            axis.set_title(f"UMLS, {kind}, {angle} degrees, t = .5", fontsize=8)
            axis.set(xlim=(0, 4.3), ylim=(-1.2, 1.4), aspect="equal")
        for axis, kernel in zip(row[2:], ("UMLS", "C1 UMLS")):
            axis.plot(*exact_motion(results[0], 0.05), "k", lw=1.5, label="FEM")
            for angle in ANGLES:
                if (kernel, kind, angle, 0.1) in by and by[kernel, kind, angle, 0.1].status == 0:
                    axis.plot(*motion(by[kernel, kind, angle, 0.1]), "--", lw=0.9, label=f"{angle} degrees")
            axis.set(title=f"{kernel}, {kind}", xlabel="t", ylabel="u_y of the end")
            axis.legend(fontsize=6)
    figure.savefig(path, dpi=130)
    plt.close(figure)
