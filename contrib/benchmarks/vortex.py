"""Generalised vortex, Tran et al. (2019), section 4.4, after Kamojjala et al. (2013)."""
import math

import convergence
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from convergence import METHODS
from runs import Run

TITLE = "manufactured solution, a vortex in a ring (2D): orders of linear, uGIMP, CPDI, CPLS, TPIC"

LEVELS = (8, 16, 32, 64)  # 1/h
FINE, COARSE = 0.04, 0.1  # step over h / c


def run(n, method, step=FINE):
    # The grid's edge lies beyond the ring by 3 cells or more, a multiple of the spacing.
    settings = {**METHODS[method], "Grid/Spacing": repr(1 / n), "Run/Step size": repr(step / n),
                "Bodies/ring/Particles": f"{n}, {round(45 / 4 * n)}", "Output/Statistics interval": max(1, n // 8)}
    return Run("prm/vortex.prm", settings, {"method": method, "step": str(step), "1/h": str(n)})


def runs():
    return [run(n, method) for method in METHODS for n in LEVELS] + [run(64, "CPDI", COARSE)]


def level(result):
    return int(result.run.label["1/h"])


def case(result):
    return result.run.label["method"], result.run.label["step"]


def table(results):
    return convergence.table(results, case, level)


def figures(results):
    by = {(*case(result), level(result)): result for result in results}
    get = lambda method, n, step=FINE: by[method, str(step), n]
    error = lambda method, n, field: convergence.errors(get(method, n))["T"][field]
    found = [report.Figure(f"CPLS, 1/64, {field} at T", error("CPLS", 64, field), upper=upper)
             for field, upper in (("U", 0.006), ("V", 0.03), ("S", 50))]
    # CPDI finishes at 1/64, but no longer converges: its errors are larger than at 1/32.
    found.append(report.Figure("CPDI, 1/64, exit status", get("CPDI", 64).status, 0, 0))
    for field in "VS":
        found.append(report.Figure(f"CPDI, {field} at 1/64 over 1/32 at T",
                                   error("CPDI", 64, field) / error("CPDI", 32, field), lower=1))
    for field in "UVS":
        found.append(report.Figure(f"1/32, {field} of CPDI over CPLS at T", error("CPDI", 32, field) / error("CPLS", 32, field),
                                   0.5, 2))
    coarse = get("CPDI", 64, COARSE)
    found.append(report.Figure("CPDI, 1/64, dt = .1 h/c, J < 0 (time)",
                               coarse.failure_time() if "volume ratio J" in coarse.message else math.nan, 0, 1, "s"))
    for n in (8, 16):
        found.append(report.Figure(f"linear, 1/{n}, fails (time)", get("linear", n).failure_time(), 0, 1, "s"))
    return found


def draw(results, path):
    by = {(*case(result), level(result)): result for result in results}
    lines = {}
    for method in METHODS:
        shown = [by[method, str(FINE), n] for n in LEVELS]
        lines[method] = ([1 / n for n in LEVELS], [convergence.errors(result) for result in shown], convergence.style(method))
    for when, target in (("T", path), ("T/4", path.parent / "vortex_quarter.png")):
        convergence.curves(target, [("errors", lines)], "Generalised vortex", when)
    draw_maps(by, path.parent / "vortex_maps.png")


def draw_maps(by, path, n=16):
    """Errors of the particles' displacements at the end, where the exact one is zero, at the places where they are."""
    methods = list(METHODS)
    figure, axes = plt.subplots(1, len(methods), figsize=(2.4 * len(methods), 2.9), layout="constrained")
    drawn = None
    for axis, method in zip(axes, methods):
        result = by[method, str(FINE), n]
        axis.set_aspect("equal")
        axis.set_title(method if result.status == 0 else f"{method}, fails at t = {result.failure_time():.2g}", fontsize=9)
        axis.set_xticks([])
        axis.set_yticks([])
        if result.status == 0:
            particles = result.particles()
            error = np.hypot(particles["displacement_x"], particles["displacement_y"])
            drawn = axis.scatter(particles["x"], particles["y"], c=error, s=2, vmin=0, vmax=0.1, cmap="magma", linewidths=0)
    if drawn is not None:
        figure.colorbar(drawn, ax=axes, label="|error of u| [m]", extend="max")
    figure.suptitle(f"The vortex at t = T, h = 1/{n}: where particles are that should be back", fontsize=10)
    figure.savefig(path, dpi=110)
    plt.close(figure)
