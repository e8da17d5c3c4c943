"""A bar swings along its axis on a strip of triangles: Cao et al., the convergence of UMLS; P1 and C1 UMLS beside it."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshes
import numpy as np
import report
from runs import Run

TITLE = "Bar on triangles: displacement, stress and energy of P1, UMLS and C1 UMLS, uniform and graded meshes"

E, LENGTH, MESH = 100, 25, 28
B = math.pi / (2 * LENGTH)
W = B * math.sqrt(E)
SPACINGS = (1, 0.5, 0.25, 0.125)
RATIOS = (1.2, 1.5, 2)
NO_GAMMA = "UMLS, no gamma"
KERNELS = ("P1", NO_GAMMA, "UMLS", "C1 UMLS")


def mesh_settings(mesh, wall, h, ratio):
    """Halves of squares, or squares cut into four; how the mesh goes on at the wall: not, as its image, its nodes held."""
    if mesh == "crossed":
        found = {"Grid/File": meshes.crossed_strip(f"bar_{h}_{ratio}", MESH, h, ratio), "Grid/Spacing": h, "Grid/Cells": "",
                 "Conditions/wall/Boundaries": "wall", "Conditions/sides/Boundaries": "outer"}
    else:
        found = {"Grid/Cells": f"{round(MESH / h)}, 1", "Grid/Upper corner": f"{MESH}, {h}", "Grid/Ratio": ratio}
    entry = {"mirror": "Grid/Slip mirrors", "held": "Grid/Held boundaries"}.get(wall)
    return {**found, **({entry: "wall" if mesh == "crossed" else "lower x"} if entry else {})}


def run(kernel, h, ratio=1, v0=0.75, transfer="TPIC", mesh="halves", wall=None, per_axis=None):
    # True gradients need the wall's nodes held, and more points of quadrature.
    wall = wall or ("mirror" if mesh == "crossed" else "held" if kernel == "C1 UMLS" else "end")
    per_axis = per_axis or (8 if kernel == "C1 UMLS" else 6 if mesh == "crossed" else 4)
    return Run("prm/umls_bar.prm",
               {**mesh_settings(mesh, wall, h, ratio), "Kernel/Type": kernel.split(",")[0],
                **({"Kernel/Gamma": "false"} if kernel == NO_GAMMA else {}), "Transfer/Type": transfer,
                "Bodies/bar/Upper corner": f"{LENGTH}, {h}", "Bodies/bar/Particles per cell and direction": per_axis,
                "Bodies/bar/Velocity": f"{v0} * sin(pi/50 * x); 0", "Run/Step size": 1e-3 * min(1, h / 0.25)},
               {"kernel": kernel, "mesh": mesh, "wall": wall, "ratio": str(ratio), "v0": v0, "transfer": transfer,
                "per axis": str(per_axis), "h": h})


def runs():
    found = [run("UMLS", h, mesh="crossed") for h in reversed(SPACINGS)] + [run("UMLS", h) for h in SPACINGS[1:]]
    found += [run("UMLS", 0.25, mesh="crossed", wall="end"), run("UMLS", 0.25, wall="mirror"), run("UMLS", 0.25, v0=0.1)]
    found += [run("C1 UMLS", h) for h in SPACINGS[1:]]
    found += [run(kernel, h) for kernel in ("P1", NO_GAMMA) for h in SPACINGS[1:3]] + [run("P1", 0.25, v0=0.1)]
    found += [run("UMLS", 0.25, transfer=transfer) for transfer in ("APIC", "FLIP")]
    # P1 fails, and gets no better without gamma, on the finer ones.
    return found + [run(kernel, h, ratio) for ratio in RATIOS for kernel in KERNELS
                    for h in SPACINGS[1:3 if kernel in KERNELS[:2] else 4]]


def exact(result, x, time):
    v0 = result.run.label["v0"]
    return v0 / W * np.sin(B * x) * math.sin(W * time), E * v0 / W * B * np.cos(B * x) * math.sin(W * time)


def displacement_error(result):
    """Root mean square over particles and quarters of the period, over the greatest displacement."""
    if result.status != 0:
        return math.nan
    squares = []
    for time in (2.5, 5, 7.5, 10):
        particles = result.particles(time)
        u, _ = exact(result, particles["initial_position_x"], time)
        squares.append(np.mean((particles["displacement_x"] - u)**2))
    return math.sqrt(np.mean(squares)) / (result.run.label["v0"] / W)


def stress_variation(result):
    """Total variation of the stress along rows of particles, over the exact one, at a quarter of the period."""
    if result.status != 0:
        return math.nan
    particles = result.particles(2.5)
    x, y, stress = (particles[name] for name in ("initial_position_x", "initial_position_y", "stress_xx"))
    _, sigma = exact(result, x, 2.5)
    variations = []
    for row in np.unique(np.round(y, 9)):
        order = np.flatnonzero(np.abs(y - row) < 1e-9)
        order = order[np.argsort(x[order])]
        variations.append(np.sum(np.abs(np.diff(stress[order]))) / np.sum(np.abs(np.diff(sigma[order]))))
    return max(variations)


def stress_error(result, lower, upper):
    """Root mean square of its error in a part of the bar, over the greatest stress, at a quarter of the period."""
    if result.status != 0:
        return math.nan
    particles = result.particles(2.5)
    x = particles["initial_position_x"]
    _, sigma = exact(result, x, 2.5)
    part = (x >= lower) & (x < upper)
    return math.sqrt(np.mean((particles["stress_xx"] - sigma)[part]**2)) / np.max(sigma)


def energy_error(result):
    """Change of kinetic and strain energy over a period, over that at the start."""
    if result.status != 0:
        return math.nan
    columns = result.statistics()
    total = columns["kinetic energy"] + columns["strain energy"]
    return abs(total[-1] / total[0] - 1)


def order(result, results):
    """From the run with twice the spacing."""
    label = result.run.label
    for other in results:
        if other.run.label == {**label, "h": 2 * label["h"]}:
            return math.log2(displacement_error(other) / displacement_error(result))
    return math.nan


def table(results):
    return [{**result.run.label, "error u": displacement_error(result), "order": order(result, results),
             "variation of stress": stress_variation(result), "near wall": stress_error(result, 0, 2 * result.run.label["h"]),
             "middle": stress_error(result, 5, 20), "energy": energy_error(result), "fails at": result.failure_time(),
             "seconds": result.seconds} for result in results]


def pick(results, *arguments, **more):
    label = run(*arguments, **more).label
    return next(result for result in results if result.run.label == label)


def figures(results):
    get = lambda *arguments, **more: pick(results, *arguments, **more)
    umls = lambda h: get("UMLS", h, mesh="crossed")
    found = [report.Figure("UMLS, h = .25: error of u", displacement_error(umls(0.25)), upper=2e-4),
             *[report.Figure(f"UMLS, order at h = {h}", order(umls(h), results), 1.8, 2.2) for h in SPACINGS[1:]],
             *[report.Figure(f"UMLS, h = {h}: variation of stress over exact", stress_variation(umls(h)), upper=1.05)
               for h in SPACINGS],
             report.Figure("UMLS, h = .25: energy over a period", energy_error(umls(0.25)), upper=1e-3),
             report.Figure("P1, h = .25, fails (time)", get("P1", 0.25).failure_time(), 0, 10),
             *[report.Figure(f"C1 UMLS, order at h = {h}", order(get("C1 UMLS", h), results), lower=1.9)
               for h in SPACINGS[2:]],
             report.Figure("C1 UMLS, h = .25: variation of stress over exact", stress_variation(get("C1 UMLS", 0.25)),
                           upper=1.05)]
    for ratio in RATIOS:
        for h in SPACINGS[2:]:
            found.append(report.Figure(f"C1 UMLS, {ratio} : 1, order at h = {h}", order(get("C1 UMLS", h, ratio), results),
                                       lower=1.9))
            # What refinement does not lower is the floor of the paper's kernel.
            found.append(report.Figure(f"UMLS, {ratio} : 1, order at h = {h}", order(get("UMLS", h, ratio), results),
                                       upper=1.5))
    return found


def draw(results, path):
    figure, axes = plt.subplots(1, 3, figsize=(13, 5), layout="constrained")
    draw_errors(axes[0], results)
    x = np.linspace(0, LENGTH)
    sigma = lambda x: E * 0.75 / W * B * np.cos(B * x)
    # What is noisy lies below.
    for name, result, size in (("UMLS without gamma, 2 : 1", pick(results, NO_GAMMA, 0.25, 2), 3),
                               ("UMLS, 2 : 1", pick(results, "UMLS", 0.25, 2), 2),
                               ("C1 UMLS, 2 : 1", pick(results, "C1 UMLS", 0.25, 2), 1)):
        if result.status == 0:
            particles = result.particles(2.5)
            axes[1].plot(particles["initial_position_x"], particles["stress_xx"], ".", ms=size, label=name)
    axes[1].plot(x, sigma(x), "k", lw=0.8, label="exact")
    axes[1].set(xlabel="X", ylabel="stress xx", title="Stress at T/4, graded, h = .25", ylim=(-2, 12))
    axes[1].legend(fontsize=8, markerscale=4)
    for name, result in (("crossed, end", pick(results, "UMLS", 0.25, mesh="crossed", wall="end")),
                         ("halves, mirror", pick(results, "UMLS", 0.25, wall="mirror")),
                         ("halves, end", pick(results, "UMLS", 0.25)),
                         ("crossed, mirror", pick(results, "UMLS", 0.25, mesh="crossed"))):
        if result.status == 0:
            particles = result.particles(2.5)
            near = particles["initial_position_x"] < 1.5
            X = particles["initial_position_x"][near]
            axes[2].plot(X, particles["stress_xx"][near] / sigma(X) - 1, ".", ms=3, label=name)
    axes[2].set(xlabel="X", ylabel="relative error of stress xx", title="UMLS at the wall, uniform, h = .25")
    axes[2].legend(fontsize=8, markerscale=2)
    figure.savefig(path, dpi=130)
    plt.close(figure)


def draw_errors(axis, results):
    """Over the spacing: kernels by colour, ratios by dash, meshes by mark."""
    lines, ratios = {}, {str(ratio): ratio for ratio in (1, *RATIOS)}
    for result in results:
        label = result.run.label
        if (label["v0"], label["transfer"]) == (0.75, "TPIC") and result.run.name == run(
                label["kernel"], label["h"], ratios[label["ratio"]], mesh=label["mesh"]).name:
            line = lines.setdefault((label["kernel"], label["mesh"], label["ratio"]), [])
            line.append((label["h"], displacement_error(result)))
    colours = dict(zip(KERNELS, ("0.5", "tab:orange", "tab:blue", "tab:red")))
    dashes = dict(zip(ratios, ("-", "--", "-.", ":")))
    marks = {"halves": "o", "crossed": "s"}
    for (kernel, mesh, ratio), points in lines.items():
        axis.loglog(*zip(*sorted(points)), dashes[ratio], marker=marks[mesh], color=colours[kernel], ms=4, lw=1.2)
    axis.loglog((0.125, 1), (2e-5, 1.28e-3), "0.85", lw=6, zorder=0)
    axis.plot(0.25, 2e-4, "kv", ms=6, zorder=5)
    entries = [axis.plot([], [], color=colour, label=kernel)[0] for kernel, colour in colours.items()]
    entries += [axis.plot([], [], "k" + dash, label="uniform" if ratio == "1" else f"{ratio} : 1")[0]
                for ratio, dash in dashes.items()]
    entries += [axis.plot([], [], "k" + mark, ls="", ms=4, label=mesh)[0] for mesh, mark in marks.items()]
    entries += [axis.plot([], [], "0.85", lw=6, label="order 2")[0],
                axis.plot([], [], "kv", ls="", ms=6, label="bound of UMLS")[0]]
    axis.set(xlabel="mean spacing h", ylabel="rms error of u over the greatest u", title="Displacement over a period")
    axis.set_xticks(SPACINGS, [f"{h:g}" for h in SPACINGS])
    axis.minorticks_off()
    axis.legend(handles=entries, fontsize=7.5, ncol=3, loc="upper center", bbox_to_anchor=(0.5, -0.14))
