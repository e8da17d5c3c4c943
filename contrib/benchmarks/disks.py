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

STEPS = (0.01, 0.005, 0.0025, 0.00125, 0.000625)  # [s]; TPIC, which dissipates, runs with the first three
STEP = 0.005
STUDIED = ("CPDI", "CPLS", "TPIC")
SULSKY = {"Grid/Lower corner": "-0.1, -0.1", "Grid/Upper corner": "1.1, 1.1",
          "Bodies/lower/Centre": "0.2, 0.2", "Bodies/lower/Velocity": "0.1; 0.1", "Bodies/upper/Velocity": "-0.1; -0.1"}


def run(method, step=STEP, variant="paper"):
    settings = {**METHODS[method], "Run/Step size": repr(step), **(SULSKY if variant == "Sulsky" else {})}
    if method == "uGIMP":
        settings["Kernel/Half length"] = repr(1 / 6)
    if step < STEPS[2]:
        settings["Output/Statistics interval"] = round(STEPS[2] / step)
    return Run("prm/two_disks.prm", settings, {"variant": variant, "method": method, "dt": str(step)})


def steps(method):
    return STEPS[:3] if method == "TPIC" else STEPS


def runs():
    return ([run(method) for method in METHODS]
            + [run(method, step) for method in STUDIED for step in steps(method) if step != STEP]
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
    found += [report.Figure(f"{method}, drift of momentum", drift(get(method)), upper=1e-12)
              for method in METHODS if method != "linear"]  # which does not outlast the contact
    found += [report.near(f"{method}, E end / K0", relative(get(method), end), expected, 0.01)
              for method, expected in (("CPDI", 0.961), ("CPLS", 0.980))]
    found.append(report.near("CPLS, E max / K0", relative(get("CPLS"), np.max), 1.012, 0.01))
    return found


def draw(results, path):
    by = {tuple(result.run.label.values()): result for result in results}
    figure, ((parts, total), (gain, ends)) = plt.subplots(2, 2, figsize=(9, 6.4), layout="constrained")
    for method in METHODS:
        result = by["paper", method, str(STEP)]
        if result.status != 0:
            continue
        columns = result.statistics()
        parts.plot(columns["time"], columns["kinetic energy"], color=COLOURS[method], label=method)
        parts.plot(columns["time"], columns["strain energy"], "--", color=COLOURS[method])
        total.plot(columns["time"], energy(result) / energy(result)[0], color=COLOURS[method])
    shades = dict(zip(STEPS, np.linspace(0.25, 1, len(STEPS))))
    for step in STEPS:
        for method, dash in (("CPDI", "--"), ("CPLS", "-")):
            result = by["paper", method, str(step)]
            gain.plot(result.statistics()["time"], energy(result) / energy(result)[0], dash, color=COLOURS[method],
                      alpha=shades[step], linewidth=1, label=f"CPLS, dt = {step}" if method == "CPLS" else None)
    for method in STUDIED:
        shown = [by["paper", method, str(step)] for step in steps(method)]
        for pick, dash, name in ((end, "o-", "end"), (np.max, "^:", "greatest")):
            ends.semilogx(steps(method), [relative(result, pick) for result in shown], dash, color=COLOURS[method],
                          markersize=4, linewidth=1, label=f"{method}, {name}")
    parts.set(title="kinetic (full) and strain energy (dashed) [J]", xlabel="t [s]")
    total.set(title=f"total energy / K0, dt = {STEP} s", xlabel="t [s]", ylim=(0.85, 1.05))
    gain.set(title="total energy / K0 (CPDI: dashed)", xlabel="t [s]")
    ends.set(title="total energy / K0 over the step", xlabel="dt [s]", ylim=(0.94, None))
    for axis in (parts, gain, ends):
        axis.legend(fontsize=7)
    for axis in (total, gain, ends):
        axis.grid(alpha=0.3)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    draw_shapes(path.parent / "disks_shapes.png", {method: by["paper", method, str(STEP)] for method in ("CPDI", "CPLS")},
                (0, 1.5, 2.0, 3.5), (0, 1.2), {})


def draw_shapes(path, results, times, limits, lines):
    """Particles and their speeds, as the paper's Figs. 49 to 51; `lines`: what draws walls, {"x": ..., "y": ...}."""
    figure, axes = plt.subplots(len(results), len(times), figsize=(2.3 * len(times) + 0.6, 2.45 * len(results)),
                                layout="constrained")
    for row, (method, result) in zip(axes, results.items()):
        for axis, time in zip(row, times):
            axis.set(xlim=limits, ylim=limits, aspect="equal", xticks=[], yticks=[])
            axis.set_title(f"{method}, t = {time} s", fontsize=9)
            for place in lines.get("x", ()):
                axis.axvline(place, color="k", linewidth=0.7)
            for place in lines.get("y", ()):
                axis.axhline(place, color="k", linewidth=0.7)
            if result.status != 0:
                continue
            particles = result.particles(time)
            drawn = axis.scatter(particles["x"], particles["y"], c=np.hypot(particles["velocity_x"], particles["velocity_y"]),
                                 s=3, vmin=0, vmax=0.12, cmap="viridis", linewidths=0)
    figure.colorbar(drawn, ax=axes, shrink=0.7, label="speed [m/s]")
    figure.savefig(path, dpi=110)
    plt.close(figure)
