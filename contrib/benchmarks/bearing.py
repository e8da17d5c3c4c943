"""Bearing capacity of a rough strip footing on weightless ground with cohesion and friction, beside Prandtl's N_c."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "strip footing on ground with friction (2D): bearing capacity by Mohr-Coulomb beside Prandtl"

COHESION, FRICTION, WIDTH = 1e4, math.radians(20), 0.5  # [Pa], half of the footing [m]
N_C = (math.exp(math.pi * math.tan(FRICTION)) * math.tan(math.pi / 4 + FRICTION / 2)**2 - 1) / math.tan(FRICTION)


def half_width(h, edge):
    """As far as the footing acts: half a spacing beyond its last node, which lies before x = .5 ("open") or there ("closed")."""
    return WIDTH + (h / 2 if edge == "closed" else -h / 2)


def run(h, transfer="TPIC", edge="open", dilatancy=20):
    return Run("prm/bearing.prm",
               {"Grid/Spacing": h, "Transfer/Type": transfer, "Materials/ground/Dilatancy angle": dilatancy,
                "Conditions/footing/Where": f"x < {WIDTH + (0.25 if edge == 'closed' else -0.25) * h}"},
               {"h": h, "transfer": transfer, "edge": edge, "dilatancy": dilatancy})


def runs():
    return [run(0.1), run(0.1, edge="closed"), run(0.05), run(0.1, "FLIP"), run(0.1, "APIC"), run(0.1, dilatancy=0)]


def curve(result):
    """Settlement over the half width, and the resistance over cohesion times the width on which it acts."""
    columns, label = result.statistics(), result.run.label
    return 8e-3 * columns["time"] / WIDTH, np.abs(columns["reaction footing y"]) / (COHESION * half_width(label["h"], label["edge"]))


def late(result, begin, end):
    """Mean of the resistance in a part of the run."""
    if result.status != 0:
        return math.nan
    settlement, load = curve(result)
    part = (settlement > begin * settlement[-1]) & (settlement <= end * settlement[-1])
    return np.mean(load[part])


def table(results):
    return [{**result.run.label, "N_c": late(result, 0.9, 1), "over Prandtl": late(result, 0.9, 1) / N_C - 1,
             "still growing": late(result, 0.9, 1) / late(result, 0.6, 0.7) - 1, "seconds": result.seconds} for result in results]


def figures(results):
    found = []
    for result in results:
        label = result.run.label
        if label["dilatancy"] == 20:  # limit analysis is of associated flow
            name = f"{label['transfer']}, h = {label['h']:g}, {label['edge']}"
            found += [report.near(f"{name}: N_c over {N_C:.2f}", late(result, 0.9, 1) / N_C, 1, 0.04),
                      report.near(f"{name}: at the end over .6 to .7 of the way", late(result, 0.9, 1) / late(result, 0.6, 0.7), 1, 0.01)]
    return found


def draw(results, path):
    figure, axes = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
    for result in results:
        if result.status == 0:
            label = result.run.label
            name = f"{label['transfer']}, h = {label['h']:g}, {label['edge']}" + (", psi = 0" if label["dilatancy"] == 0 else "")
            settlement, load = curve(result)
            axes[0].plot(settlement[::10], load[::10], lw=1, label=name)
    axes[0].axhline(N_C, color="k", lw=0.8, label=f"Prandtl, {N_C:.2f}")
    axes[0].set(xlabel="settlement over half width", ylabel="resistance over c b", title="Load and settlement", ylim=(0, None))
    axes[0].legend(fontsize=7)
    particles = next(result for result in results if result.run.label["h"] == 0.05).particles()
    drawn = axes[1].scatter(particles["x"], particles["y"], c=particles["equivalent_plastic_strain"], s=3.5, vmin=0, vmax=8e-3,
                            cmap="inferno", linewidths=0)
    axes[1].set(title="h = .05: equivalent plastic strain", aspect="equal", xlim=(0, 4), ylim=(1, 3.1))
    figure.colorbar(drawn, ax=axes[1], shrink=0.7)
    figure.savefig(path, dpi=110)
    plt.close(figure)
