"""Collapse of a cylinder of sand: the column of Nakamura et al. (2023), section 5.5, in 3D, on one and on two ranks."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "collapse of a cylinder of sand (3D): run-out on 1 and 2 ranks, axial symmetry"

RADIUS, HEIGHT, H = 0.1, 0.2, 0.01
SECTORS = 16


def runs():
    return [Run("prm/column_3d.prm", {"Output/Grid": "false"}, {"h": H, "ranks": ranks}, ranks) for ranks in (1, 2)]


def radius(particles):
    return np.hypot(particles["x"], particles["y"])


def front(r):
    """The radius that 99 % of the particles do not exceed."""
    return np.sort(r)[int(0.99 * (len(r) - 1))]


def run_out(result):
    return front(radius(result.particles())) / RADIUS - 1 if result.status == 0 else math.nan


def unevenness(result):
    """Fronts in sectors of the circle: the largest less the smallest [m]."""
    if result.status != 0:
        return math.nan
    particles = result.particles()
    turn = np.arctan2(particles["y"], particles["x"]) / (2 * math.pi)
    sector = np.floor(turn * SECTORS + 0.5).astype(int) % SECTORS
    fronts = [front(radius(particles)[sector == i]) for i in range(SECTORS)]
    return max(fronts) - min(fronts)


def centre_height(result):
    if result.status != 0:
        return math.nan
    particles = result.particles()
    return np.max(particles["z"][radius(particles) < 2 * H])


def energies(result):
    """Over the work of gravity: what the scheme has added to the energy at most, and the kinetic energy at the end."""
    if result.status != 0:
        return math.nan, math.nan
    columns = result.statistics()
    given = columns["body force work"][-1]
    return np.max(columns["energy residual"]) / given, columns["kinetic energy"][-1] / given


def mean_J(result):
    return np.mean(result.particles()["volume_ratio"]) if result.status == 0 else math.nan


def table(results):
    return [{**result.run.label, "run-out": run_out(result), "height": centre_height(result),
             "uneven front": unevenness(result), "mean J": mean_J(result), "energy added": energies(result)[0],
             "kinetic energy": energies(result)[1]} for result in results]


def figures(results):
    one, two = results
    return [report.near("run-out, 2 ranks less 1 rank", run_out(two) - run_out(one), 0, 1e-6),
            report.Figure(f"front in {SECTORS} sectors, largest less smallest, over h", unevenness(one) / H, upper=1),
            report.Figure("energy added / work of gravity", energies(one)[0], upper=1e-6),
            report.Figure("kinetic energy at the end / work of gravity", energies(one)[1], upper=1e-4)]


def draw(results, path):
    """Height of the surface from above, and the speed in a cut along the axis."""
    result = next((result for result in results if result.status == 0), None)
    if result is None:
        return
    figure, axes = plt.subplots(2, 3, figsize=(11, 5.6), layout="constrained", height_ratios=(2.2, 1))
    cell = 1.5 * H  # rows of particles end up more than h apart
    n = round(0.6 / cell)
    for (top, cut), time in zip(axes.T, (0.1, 0.2, 0.6)):
        particles = result.particles(time)
        column, row = (np.floor((particles[axis] + 0.3) / cell).astype(int) for axis in "xy")
        surface = np.zeros((n, n))
        np.maximum.at(surface, (row, column), particles["z"])
        heights = top.imshow(np.where(surface > 0, surface, np.nan), origin="lower", extent=(-0.3, 0.3, -0.3, 0.3), vmin=0,
                             vmax=HEIGHT, cmap="viridis")
        top.add_patch(plt.Circle((0, 0), front(radius(particles)), fill=False, lw=0.8, ls="--"))
        top.set_title(f"t = {time} s", fontsize=9)
        is_cut = np.abs(particles["y"]) < H / 2
        speed = np.sqrt(sum(particles[f"velocity_{axis}"][is_cut]**2 for axis in "xyz"))
        speeds = cut.scatter(particles["x"][is_cut], particles["z"][is_cut], c=speed, s=1.5, vmin=0, vmax=1, cmap="magma",
                             linewidths=0)
        cut.set(xlim=(-0.3, 0.3), ylim=(0, 0.21), aspect="equal")
        for axis in (top, cut):
            axis.set(xticks=[], yticks=[])
    figure.colorbar(heights, ax=list(axes[0]), label="height [m]", shrink=0.8)
    figure.colorbar(speeds, ax=list(axes[1]), label="speed [m/s]", extend="max")
    figure.suptitle("Cylinder of sand on a no-slip floor, h = .01, TPIC, WLS: from above (dashed: front) and cut")
    figure.savefig(path, dpi=110)
    plt.close(figure)
