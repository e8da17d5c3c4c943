"""A bar swings along its axis on a strip of triangles: Cao et al., the convergence of UMLS; P1 and C1 UMLS beside it."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "Bar on triangles: displacement, stress and energy of P1, UMLS and C1 UMLS, uniform and graded meshes"

E, LENGTH, MESH = 100, 25, 28
B = math.pi / (2 * LENGTH)
W = B * math.sqrt(E)
SPACINGS = (1, 0.5, 0.25, 0.125)
SMALLEST = {"UMLS": 0.125, "C1 UMLS": 0.25}
RATIOS = (1.2, 1.5, 2)


def run(kernel, h, ratio=1, v0=0.75, transfer="TPIC"):
    n = round(MESH / h)
    # True gradients need the wall's nodes held, and more points of quadrature.
    c1 = {"Grid/Held boundaries": "lower x", "Bodies/bar/Particles per cell and direction": 8} if kernel == "C1 UMLS" else {}
    return Run("prm/umls_bar.prm",
               {**c1, "Kernel/Type": kernel, "Transfer/Type": transfer, "Grid/Cells": f"{n}, 1", "Grid/Upper corner": f"{MESH}, {h}",
                "Grid/Ratio": ratio, "Bodies/bar/Upper corner": f"{LENGTH}, {h}",
                "Bodies/bar/Velocity": f"{v0} * sin(pi/50 * x); 0", "Run/Step size": 1e-3 * min(1, h / 0.25)},
               {"kernel": kernel, "ratio": ratio, "v0": v0, "transfer": transfer, "h": h})


def runs():
    kernels = [(kernel, h) for kernel in ("UMLS", "C1 UMLS") for h in SPACINGS if h >= SMALLEST[kernel]]
    uniform = [run(kernel, h) for kernel, h in kernels]
    small = [run("UMLS", h, v0=0.1) for h in SPACINGS]
    p1 = [run("P1", h) for h in SPACINGS[1:3]]
    graded = [run(kernel, h, ratio) for ratio in RATIOS for kernel, h in kernels if h < 1]
    others = [run("UMLS", 0.25, transfer=transfer) for transfer in ("APIC", "FLIP")]
    return uniform + small + p1 + graded + others


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
             "variation of stress": stress_variation(result), "energy": energy_error(result), "seconds": result.seconds}
            for result in results]


def figures(results):
    by = {tuple(result.run.label.values()): result for result in results}
    uniform = lambda kernel, h, transfer="TPIC": by[kernel, 1, 0.75, transfer, h]
    graded = lambda kernel, ratio, h: by[kernel, ratio, 0.75, "TPIC", h]
    return [report.Figure("UMLS, h = .25: error of u", displacement_error(uniform("UMLS", 0.25)), upper=2e-4),
            *[report.Figure(f"UMLS, order at h = {h}", order(uniform("UMLS", h), results), 1.8, 2.2) for h in SPACINGS[1:]],
            report.Figure("P1, h = .25: error of u", displacement_error(uniform("P1", 0.25)), lower=0.1),
            report.Figure("UMLS, h = .25: variation of stress over exact", stress_variation(uniform("UMLS", 0.25)), upper=1.05),
            report.Figure("UMLS, h = .25: energy over a period", energy_error(uniform("UMLS", 0.25)), upper=1e-3),
            *[report.Figure(f"C1 UMLS, order at h = {h}", order(uniform("C1 UMLS", h), results), lower=1.9) for h in (0.5, 0.25)],
            report.Figure("C1 UMLS, h = .25: variation of stress over exact", stress_variation(uniform("C1 UMLS", 0.25)), upper=1.05),
            *[report.Figure(f"C1 UMLS, {ratio} : 1, order at h = .25", order(graded("C1 UMLS", ratio, 0.25), results), lower=1.9)
              for ratio in RATIOS]]


def draw(results, path):
    figure, axes = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
    lines = {}
    for result in results:
        label = result.run.label
        if label["v0"] == 0.75 and label["transfer"] == "TPIC":
            lines.setdefault((label["kernel"], label["ratio"]), []).append((label["h"], displacement_error(result)))
    styles = {"P1": ":", "UMLS": "-", "C1 UMLS": "--"}
    for k, ((kernel, ratio), points) in enumerate(lines.items()):
        axes[0].loglog(*zip(*sorted(points)), styles[kernel] + "o", ms=3, label=f"{kernel}, {ratio} : 1")
    axes[0].loglog((0.125, 1), (5e-5, 3.2e-3), "k", lw=0.6)
    axes[0].set(xlabel="mean spacing h", ylabel="rms error of u over the greatest u", title="Displacement over a period")
    axes[0].legend(fontsize=7)
    for kernel in ("P1", "UMLS"):
        for result in results:
            if tuple(result.run.label.values()) == (kernel, 1, 0.75, "TPIC", 0.25) and result.status == 0:
                particles = result.particles(2.5)
                axes[1].plot(particles["initial_position_x"], particles["stress_xx"], ".", ms=2, label=kernel)
    x = np.linspace(0, LENGTH)
    axes[1].plot(x, E * 0.75 / W * B * np.cos(B * x), "k", lw=0.8, label="exact")
    axes[1].set(xlabel="X", ylabel="stress", title="A quarter of the period, h = .25", ylim=(-4, 16))
    axes[1].legend()
    figure.savefig(path, dpi=130)
    plt.close(figure)
