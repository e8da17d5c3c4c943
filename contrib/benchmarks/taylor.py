"""Taylor's impact: a copper rod hits a rigid wall. Not of the paper; a quarter of the rod and the whole of it."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "Taylor impact of a copper rod (3D): length and radius, a quarter of the rod beside the whole"

RADIUS, LENGTH, H = 3.2, 32.4, 0.4  # [mm]
WHOLE = {"Grid/Lower corner": "-8, -8, 0", "Conditions/symmetry/Boundary ids": "4"}


def run(model, transfer, h=H):
    height = math.ceil((LENGTH + H) / h) * h
    return Run("prm/taylor.prm", {"Transfer/Type": transfer, "Grid/Spacing": h, "Grid/Upper corner": f"8, 8, {height:g}",
                                  **(WHOLE if model == "whole" else {})},
               {"model": model, "h": h, "transfer": transfer})


def runs():
    return [run(model, "TPIC") for model in ("whole", "quarter")] + [
        run("quarter", "APIC"), run("quarter", "FLIP"), run("quarter", "TPIC", 0.8)]


def length(result):
    """From the wall to the rod's upper end, half a particle above the highest one."""
    if result.status != 0:
        return math.nan
    particles = result.particles()
    stretch = np.sqrt(sum(particles[f"deformation_gradient_z{axis}"]**2 for axis in "xyz"))
    return np.max(particles["z"] + result.run.label["h"] / 4 * stretch)


def foot(result):
    """
    The radius to which the rim of the foot has grown: of the lowest layer of particles, the radius now over that at the
    start is a line near the rim, whose value at the start's 3.2 mm does not depend on which particle lies farthest out.
    """
    if result.status != 0:
        return math.nan
    particles = result.particles()
    x, y, z = (particles[axis] - particles["displacement_" + axis] for axis in "xyz")
    start, end = np.hypot(x, y), np.hypot(particles["x"], particles["y"])
    rim = (z < np.min(z) + 1e-6) & (start > 0.8 * RADIUS)
    return np.polyfit(start[rim] - RADIUS, end[rim], 1)[1]


def statistic(result, function):
    return function(result.statistics()) if result.status == 0 else math.nan


def time_per_particle(result):
    """Of a step [ns], set-up and output included."""
    if result.status != 0:
        return math.nan
    return 1e9 * result.seconds / statistic(result, lambda columns: columns["step"][-1]) / len(result.particles()["id"])


def table(results):
    return [{**result.run.label, "length": length(result), "radius": foot(result),
             "plastic strain": np.max(result.particles()["equivalent_plastic_strain"]) if result.status == 0 else math.nan,
             "kinetic energy left": statistic(result, lambda c: c["kinetic energy"][-1] / c["kinetic energy"][0]),
             "steps": statistic(result, lambda c: c["step"][-1]), "ns per step and particle": time_per_particle(result)}
            for result in results]


def figures(results):
    by = {tuple(result.run.label.values()): result for result in results}
    whole, quarter = by["whole", H, "TPIC"], by["quarter", H, "TPIC"]
    ratio = lambda column: statistic(whole, lambda c: c[column][-1]) / statistic(quarter, lambda c: c[column][-1]) / 4
    return [report.Figure("quarter, TPIC, length", length(quarter), 21.4, 21.6, "mm"),
            report.Figure("quarter, TPIC, radius", foot(quarter), 7.0, 7.3, "mm"),
            report.Figure("whole, TPIC, length", length(whole), 21.4, 21.6, "mm"),
            report.Figure("whole, TPIC, radius", foot(whole), 7.0, 7.3, "mm"),
            report.near("whole over quarter, length", length(whole) / length(quarter), 1, 0.002),
            report.near("whole over quarter, radius", foot(whole) / foot(quarter), 1, 0.002),
            # Sums of 130 000 masses.
            report.near("whole over quarter, mass / 4", ratio("mass"), 1, 2e-11),
            report.near("whole over quarter, lost energy / 4", ratio("energy residual"), 1, 0.002),
            report.Figure("kinetic energy left", statistic(quarter, lambda c: c["kinetic energy"][-1] / c["kinetic energy"][0]),
                          upper=0.01),
            report.Figure("energy added / kinetic energy at the start",
                          statistic(quarter, lambda c: np.max(c["energy residual"]) / c["kinetic energy"][0]), upper=1e-3)]


def draw(results, path):
    """Plastic strain in a cut through the axis, at three times, and at the end for each run."""
    shown = [result for result in results if result.status == 0]
    panels = []
    if shown:
        panels = [(shown[0], time) for time in (20, 40)] + [(result, 80) for result in shown]
    if not panels:
        return
    figure, axes = plt.subplots(1, len(panels), figsize=(1.75 * len(panels) + 0.9, 4.4), layout="constrained", sharey=True)
    for axis, (result, time) in zip(axes, panels):
        particles, h = result.particles(time), result.run.label["h"]
        # The half plane y = 0, mirrored where the model is a quarter.
        start = particles["y"] - particles["displacement_y"]
        is_cut = (start > 0) & (start < h / 2)
        x, z, strain = (particles[name][is_cut] for name in ("x", "z", "equivalent_plastic_strain"))
        if result.run.label["model"] == "quarter":
            x, z, strain = (np.concatenate(pair) for pair in ((x, -x), (z, z), (strain, strain)))
        drawn = axis.scatter(x, z, c=strain, s=2.5 * (h / H)**2, vmin=0, vmax=2, cmap="inferno", linewidths=0)
        label = result.run.label
        axis.set_title(f"{label['model']}, {label['transfer']}\nh = {h}, {time} us", fontsize=9)
        axis.set(xlim=(-8, 8), ylim=(0, 33), aspect="equal")
        axis.axhline(21.47, lw=0.6, ls=":", color="grey")
    axes[0].set_ylabel("z [mm]")
    figure.colorbar(drawn, ax=list(axes), label="equivalent plastic strain", extend="max", shrink=0.7)
    figure.suptitle("Taylor impact of a copper rod at 227 m/s, WLS")
    figure.savefig(path, dpi=110)
    plt.close(figure)
