"""Two elastic disks collide, Tran et al. (2019), section 4.5: energy and momentum."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from convergence import COLOURS, METHODS
from runs import Run

TITLE = "two elastic disks collide (2D): energy and momentum of linear, uGIMP, CPDI, CPLS, TPIC"

STEPS = (0.01, 0.005, 0.0025)  # [s]
STEP = 0.005
SULSKY = {"Grid/Lower corner": "-0.1, -0.1", "Grid/Upper corner": "1.1, 1.1",
          "Bodies/lower/Centre": "0.2, 0.2", "Bodies/lower/Velocity": "0.1; 0.1", "Bodies/upper/Velocity": "-0.1; -0.1"}


def run(method, step=STEP, variant="paper"):
    settings = {**METHODS[method], "Run/Step size": repr(step), **(SULSKY if variant == "Sulsky" else {})}
    if method == "uGIMP":
        settings["Kernel/Half length"] = repr(1 / 6)
    return Run("prm/two_disks.prm", settings, {"variant": variant, "method": method, "dt": str(step)})


def runs():
    return ([run(method) for method in METHODS]
            + [run(method, step) for method in ("CPDI", "CPLS", "TPIC") for step in STEPS if step != STEP]
            + [run(method, variant="Sulsky") for method in METHODS])


def energy(result):
    columns = result.statistics()
    return columns["kinetic energy"] + columns["strain energy"]


def relative(result, pick):
    """A number of the energy over its first value."""
    if result.status != 0:
        return math.nan
    values = energy(result)
    return pick(values) / values[0]


def first(result):
    return energy(result)[0] if result.status == 0 else math.nan


def end(values):
    return values[-1]


def drift(result):
    """Largest change of the momentum over the momentum of one disk."""
    if result.status != 0:
        return math.nan
    columns = result.statistics()
    change = np.hypot(columns["momentum x"] - columns["momentum x"][0], columns["momentum y"] - columns["momentum y"][0])
    speed = math.sqrt(2 * columns["kinetic energy"][0] / columns["mass"][0])
    return np.max(change) / (columns["mass"][0] / 2 * speed)


def table(results):
    return [{**result.run.label, "K0": first(result), "E end / K0": relative(result, end),
             "E max / K0": relative(result, np.max), "drift": drift(result), "failed at": result.failure_time(),
             "seconds": result.seconds} for result in results]


def figures(results):
    by = {tuple(result.run.label.values()): result for result in results}
    get = lambda method, step=STEP, variant="paper": by[variant, method, str(step)]
    count = lambda result: len(result.particles()["id"]) if result.status == 0 else math.nan
    found = [report.Figure("particles", count(get("CPDI")), 896, 896)]
    found += [report.near(f"K0, {variant}", first(get("CPDI", variant=variant)), K0, 5e-5,
                          " J") for variant, K0 in (("paper", 1.24444), ("Sulsky", 2.48889))]
    found += [report.Figure(f"{method}, drift of momentum", drift(get(method)), upper=1e-12) for method in METHODS]
    found += [report.near(f"{method}, E end / K0", relative(get(method), end), expected, 0.01)
              for method, expected in (("CPDI", 0.961), ("CPLS", 0.980))]
    found.append(report.near("CPLS, E max / K0", relative(get("CPLS"), np.max), 1.012, 0.01))
    return found


def draw(results, path):
    by = {tuple(result.run.label.values()): result for result in results}
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), layout="constrained")
    for method in METHODS:
        result = by["paper", method, str(STEP)]
        if result.status != 0:
            continue
        columns = result.statistics()
        axes[0].plot(columns["time"], columns["kinetic energy"], color=COLOURS[method], label=method)
        axes[0].plot(columns["time"], columns["strain energy"], "--", color=COLOURS[method])
        axes[1].plot(columns["time"], energy(result) / energy(result)[0], color=COLOURS[method])
    for method in ("CPDI", "CPLS", "TPIC"):
        for step, dash in zip(STEPS, (":", "-", "--")):
            result = by["paper", method, str(step)]
            if result.status == 0:
                axes[2].plot(result.statistics()["time"], energy(result) / energy(result)[0], dash, color=COLOURS[method],
                             label=f"{method}, dt = {step}")
    axes[0].set(title="kinetic (full) and strain energy (dashed) [J]", xlabel="t [s]")
    axes[1].set(title=f"total energy / K0, dt = {STEP}", xlabel="t [s]", ylim=(0.85, 1.05))
    axes[2].set(title="total energy / K0", xlabel="t [s]", ylim=(0.85, 1.05))
    axes[0].legend(fontsize=7)
    axes[2].legend(fontsize=6)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    draw_shapes(by, path.parent / "disks_shapes.png")


def draw_shapes(by, path, times=(1.5, 2.0, 3.5)):
    """Particles and their speeds, as the paper's Figs. 49 to 51."""
    figure, axes = plt.subplots(2, len(times), figsize=(2.9 * len(times), 5.6), layout="constrained")
    for row, method in zip(axes, ("CPDI", "CPLS")):
        for axis, time in zip(row, times):
            result = by["paper", method, str(STEP)]
            axis.set(xlim=(0, 1.2), ylim=(0, 1.2), aspect="equal", xticks=[], yticks=[], title=f"{method}, t = {time}")
            if result.status != 0:
                continue
            particles = result.particles(time)
            drawn = axis.scatter(particles["x"], particles["y"], c=np.hypot(particles["velocity_x"], particles["velocity_y"]),
                                 s=2, vmin=0, vmax=0.12, cmap="viridis", linewidths=0)
            figure.colorbar(drawn, ax=axis, shrink=0.7)
    figure.suptitle("Speed [m/s]", fontsize=10)
    figure.savefig(path, dpi=110)
    plt.close(figure)
