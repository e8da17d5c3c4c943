"""An elastic disk rebounds from walls, Tran et al. (2019), section 4.6: energy."""
import math

import disks
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from convergence import COLOURS, METHODS
from runs import Run

TITLE = "an elastic disk rebounds from walls (2D): energy of linear, uGIMP, CPDI, CPLS, TPIC"


def run(method):
    # Walls inside the grid serve all methods: kernels are complete there.
    return Run("prm/disk_wall.prm", METHODS[method], {"method": method})


def runs():
    return [run(method) for method in METHODS]


def rebounds(result):
    """How often the velocity of the disk's centre changes its sign."""
    if result.status != 0:
        return math.nan
    momentum = result.statistics()["momentum x"]
    return int(np.sum(np.diff(np.sign(momentum)) != 0))


def table(results):
    return [{**result.run.label, "K0": disks.first(result),
             "E end / K0": disks.relative(result, disks.end), "E max / K0": disks.relative(result, np.max),
             "rebounds": rebounds(result), "failed at": result.failure_time(), "seconds": result.seconds}
            for result in results]


def figures(results):
    get = {result.run.label["method"]: result for result in results}
    count = lambda result: len(result.particles()["id"]) if result.status == 0 else math.nan
    found = [report.Figure("particles", count(get["CPDI"]), 208, 208),
             report.near("K0", disks.first(get["CPDI"]), 0.65, 5e-5, " J")]
    found += [report.near(f"{method}, E end / K0", disks.relative(get[method], disks.end), expected, 0.01)
              for method, expected in (("CPDI", 0.789), ("CPLS", 0.845))]
    found += [report.Figure(f"{method}, rebounds", rebounds(get[method]), lower=2) for method in ("CPDI", "CPLS")]
    return found


def draw(results, path):
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), layout="constrained")
    for result in results:
        if result.status != 0:
            continue
        method, columns = result.run.label["method"], result.statistics()
        axes[0].plot(columns["time"], columns["kinetic energy"], color=COLOURS[method], label=method)
        axes[1].plot(columns["time"], columns["strain energy"], color=COLOURS[method])
        axes[2].plot(columns["time"], disks.energy(result) / disks.energy(result)[0], color=COLOURS[method])
    for axis, title in zip(axes, ("kinetic energy [J]", "strain energy [J]", "total energy / K0")):
        axis.set(title=title, xlabel="t [s]")
    axes[0].legend(fontsize=7)
    figure.savefig(path, dpi=110)
    plt.close(figure)
    shown = {result.run.label["method"]: result for result in results}
    disks.draw_shapes(path.parent / "wall_shapes.png", {method: shown[method] for method in ("CPDI", "CPLS")},
                      (0, 1.5, 3.5, 9.0), (0, 0.8), {"x": (0.05, 0.75), "y": (0.05, 0.75)})
