"""Two halves of a square set off in opposite directions: Cao et al., what APIC conserves on triangles."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshes
import numpy as np
import report
from runs import Run

TITLE = "APIC on triangles: momentum and angular momentum of P1, UMLS and C1 UMLS"


def runs():
    meshes.make("square", 2)
    return [Run("prm/umls_apic.prm", {"Kernel/Type": kernel}, {"kernel": kernel}) for kernel in ("P1", "UMLS", "C1 UMLS")]


def drifts(result):
    """
    Largest changes of angular momentum, the affine fields' share included, over its start; of momentum over M v, and of it
    with what nodes of almost no mass have lost.
    """
    if result.status != 0:
        return math.nan, math.nan, math.nan
    columns = result.statistics()
    L, change = columns["total angular momentum z"], lambda x: np.max(np.abs(x - x[0])) / (columns["mass"][0] * 0.1)
    return (np.max(np.abs(L - L[0])) / abs(L[0]), max(change(columns[f"momentum {axis}"]) for axis in "xy"),
            max(change(columns[f"momentum {axis}"] + columns[f"lost momentum {axis}"]) for axis in "xy"))


def table(results):
    return [{**result.run.label, **dict(zip(("angular momentum", "momentum", "momentum and loss"), drifts(result)))}
            for result in results]


def figures(results):
    return [figure for result in results for figure in (
        report.Figure(f"{result.run.label['kernel']}: change of angular momentum", drifts(result)[0], upper=1e-12),
        report.Figure(f"{result.run.label['kernel']}: change of momentum and loss", drifts(result)[2], upper=1e-14))]


def draw(results, path):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained", sharey=True)
    for result in results:
        if result.status == 0:
            columns = result.statistics()
            L, momentum = columns["total angular momentum z"], columns["momentum y"] + columns["lost momentum y"]
            changes = L / L[0] - 1, (momentum - momentum[0]) / (columns["mass"][0] * 0.1)
            for axis, change in zip(axes, changes):
                axis.semilogy(columns["time"], np.abs(change) + 1e-17, lw=0.8, label=result.run.label["kernel"])
    for axis, title, bound in zip(axes, ("angular momentum / first", "momentum y / mass times speed"), (1e-12, 1e-14)):
        axis.axhline(bound, color="k", ls="--", lw=1, label="bound")
        axis.set(xlabel="t [s]", title=title, ylim=(5e-18, 1e-11))
        axis.grid(alpha=0.3)
        axis.legend(ncol=4, fontsize=8, loc="upper center")
    axes[0].set_ylabel("change")
    figure.savefig(path, dpi=130)
    plt.close(figure)
