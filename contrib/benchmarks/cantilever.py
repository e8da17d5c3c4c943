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
KERNELS = ("P1", "UMLS", "C1 UMLS")
SIZES = (0.2, 0.1, 0.05)
SMOOTH = (("structured", 0, 0.1), ("structured", 45, 0.1), ("Delaunay", 0, 0.1), ("Delaunay", 45, 0.1),
          ("structured", 0, 0.05), ("Delaunay", 0, 0.05))  # with C1 UMLS
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
    asked = {(one.label["kernel"], one.label["mesh"], one.label["angle"], one.label["h"]) for one in found}
    return found + [run(kernel, kind, 0, h) for kernel in KERNELS for kind in ("structured", "Delaunay") for h in SIZES
                    if (kernel, kind, 0, h) not in asked]


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
    found = [report.Figure("UMLS, structured, h = .1: rmse over FEM's lowest", by["UMLS", "structured", 0, 0.1]["rmse"],
                           upper=0.01)]
    for kind in ("structured", "Delaunay"):
        lowest = [by["UMLS", kind, angle, 0.1]["lowest"] for angle in ANGLES]
        found.append(report.Figure(f"UMLS, {kind}: spread of the lowest over angles",
                                   (max(lowest) - min(lowest)) / abs(np.mean(lowest)), upper=0.03))
    found += [report.Figure(f"C1 UMLS, {kind}, {angle} degrees, h = {h:g}: rmse", by["C1 UMLS", kind, angle, h]["rmse"],
                            upper=0.01) for kind, angle, h in SMOOTH]
    return found


def draw(results, path):
    by = {tuple(result.run.label.values()): result for result in results}
    figure, axes = plt.subplots(2, 4, figsize=(13, 6.5), layout="constrained")
    shown = [(kernel, *mesh, 0.1) for kernel in KERNELS[1:] for mesh in (("structured", 45), ("Delaunay", 0))]
    for axis, key in zip(axes[0], shown):
        nodes, triangles = meshes.read_triangles(meshes.DIRECTORY / f"cantilever_{key[1]}_0.1_{key[2]}.msh")
        axis.triplot(Triangulation(*nodes.T, triangles), color="0.85", lw=0.3)
        if by[key].status == 0:
            particles = by[key].particles(0.5)
            drawn = axis.scatter(particles["x"], particles["y"], s=4 if key[0] == "UMLS" else 1.5,
                                 c=particles["stress_xx"] / 1e6, vmin=-0.6, vmax=0.6, cmap="coolwarm", linewidths=0)
        axis.set_title(f"{key[0]}, {key[1]}, {key[2]} degrees", fontsize=10)
        axis.set(xlim=(0, 4.2), ylim=(-1.2, 1.6), aspect="equal", xlabel="x [m]")
    axes[0, 0].set_ylabel("y [m]")
    figure.colorbar(drawn, ax=axes[0], label="stress xx [MPa], t = .5 s", shrink=0.8, extend="both")
    colours = dict(zip(ANGLES, ("tab:blue", "tab:orange", "tab:green", "tab:red")))
    axes[1, 0].plot(*exact_motion(results[0], 0.05), "k", lw=1.5, label="finite elements")
    axes[1, 0].plot(*motion(by["UMLS", "Delaunay", 0, 0.1]), "--", label="UMLS, Delaunay")
    axes[1, 0].set(xlabel="t [s]", ylabel="u_y of the end [m]", title="Particles and elements")
    axes[1, 0].legend(fontsize=8)
    for axis, kernel in zip(axes[1, 1:], KERNELS[1:]):
        for (name, kind, angle, h), result in by.items():
            if (name, h) == (kernel, 0.1) and result.status == 0:
                t, exact = exact_motion(results[0], h / SCHEME.get(kernel, ("TPIC", 2))[1])
                axis.plot(t, 100 * (np.interp(t, *motion(result)) - exact) / np.max(np.abs(exact)),
                          "-" if kind == "structured" else "--", color=colours[angle], lw=1, label=f"{kind}, {angle}")
        axis.set(xlabel="t [s]", ylabel="less elements, % of the lowest", title=f"{kernel}, h = .1", ylim=(-6, 6))
        axis.legend(fontsize=7, ncol=2)
    for kernel, colour in zip(KERNELS, ("0.5", "tab:blue", "tab:red")):
        for kind, dash in (("structured", "-"), ("Delaunay", "--")):
            errors = [100 * compare(by[kernel, kind, 0, h], results)["rmse"] for h in SIZES]
            if not all(map(math.isnan, errors)):
                axes[1, 3].loglog(SIZES, errors, dash, marker="o", ms=4, color=colour, label=f"{kernel}, {kind}")
    axes[1, 3].axhline(1, color="k", lw=0.8, ls=":", label="bound, h = .1")
    axes[1, 3].set(xlabel="h [m]", ylabel="rms error, % of the lowest", title="0 degrees", ylim=(0.1, 4))
    axes[1, 3].set_xticks(SIZES, [f"{h:g}" for h in SIZES])
    axes[1, 3].set_yticks((0.1, 0.2, 0.5, 1, 2, 4), ("0.1", "0.2", "0.5", "1", "2", "4"))
    axes[1, 3].minorticks_off()
    axes[1, 3].legend(fontsize=7, loc="lower right")
    figure.savefig(path, dpi=130)
    plt.close(figure)
