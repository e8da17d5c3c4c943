"""Generalised vortex, Tran et al. (2019), section 4.4, after Kamojjala et al. (2013)."""
import math

import balance
import convergence
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection
import numpy as np
import report
from convergence import METHODS
from runs import Run

TITLE = "manufactured solution, a vortex in a ring (2D): orders of linear, uGIMP, CPDI, CPLS, TPIC"

DENSITY = 1000.
LEVELS = (8, 16, 32, 64)  # 1/h
FINE, COARSE = 0.04, 0.1  # step over h / c
LABELS = "method", "step"
SHOWN = (8, 16)  # 1/h of the pictures


def run(n, method, step=FINE):
    # The grid's edge lies beyond the ring by 3 cells or more, a multiple of the spacing.
    settings = {**METHODS[method], "Grid/Spacing": repr(1 / n), "Run/Step size": repr(step / n),
                "Bodies/ring/Particles": f"{n}, {round(45 / 4 * n)}", "Output/Statistics interval": max(1, n // 8)}
    if method in balance.METHODS:
        settings["Kernel/Layers"] = 6  # how far several ranks must know the grid
    if n in SHOWN and method in balance.METHODS:
        settings.update(balance.settings(steps=n // 2))
        settings["Output/Particle fields"] = "displacement, velocity, stress, deformation gradient, half edges"
    return Run("prm/vortex.prm", settings, {"method": method, "step": str(step), "1/h": str(n)})


def runs():
    return [run(n, method) for method in METHODS for n in LEVELS] + [run(64, "CPDI", COARSE)]


def table(results):
    return convergence.table(results, LABELS)


def exact(t):
    """Angular momentum and energies of the ring, by the midpoint rule along the radius. J = 1."""
    R = 0.75 + 0.5 * (np.arange(2000) + 0.5) / 2000
    weight = 2 * np.pi * R * 0.5 / len(R)
    s = R - 1
    g, slope = (1 - 16 * s**2)**2, -64 * s + 1024 * s**3
    alpha, rate = np.sin(np.pi * t), np.pi * np.cos(np.pi * t)
    _, mu = balance.lame(1000, 0.3)
    return {"momentum": DENSITY * rate * (weight @ (R**2 * g)), "kinetic": DENSITY / 2 * rate**2 * (weight @ (R * g)**2),
            "strain": mu / 2 * alpha**2 * (weight @ (R * slope)**2)}


def figures(results):
    by = {(*convergence.case(result, LABELS), convergence.level(result)): result for result in results}
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
    # By grad v dt > .5; a volume would turn inside out soon afterwards.
    found.append(report.Figure("CPDI, 1/64, dt = .1 h/c, fails (time)", coarse.failure_time(), 0, 1, "s"))
    for n in (8, 16):
        found.append(report.Figure(f"linear, 1/{n}, fails (time)", get("linear", n).failure_time(), 0, 1, "s"))
    return found


def draw(results, path):
    by = {(*convergence.case(result, LABELS), convergence.level(result)): result for result in results}
    lines = {}
    for method in METHODS:
        shown = [by[method, str(FINE), n] for n in LEVELS]
        lines[method] = ([1 / n for n in LEVELS], [convergence.errors(result) for result in shown], convergence.style(method))
    convergence.curves(path, [("errors", when, lines) for when in ("T/4", "T")], "Generalised vortex")
    coarse = {method: by[method, str(FINE), SHOWN[0]] for method in balance.METHODS}
    balance.draw(path.parent / "vortex_balance.png", f"Generalised vortex, h = 1/{SHOWN[0]}", coarse, "angular momentum z",
                 "kg m^2/s", exact)
    draw_domains(path.parent / "vortex_domains.png", {(method, n): by[method, str(FINE), n]
                                                      for method in ("uGIMP", "CPDI", "CPLS") for n in SHOWN})
    draw_errors(path.parent / "vortex_errors.png", coarse)


def corners(particles):
    """The four corners of each domain, in order around it: x + F (+- r1 +- r2)."""
    matrix = lambda name: np.array([[particles[f"{name}_{a}{b}"] for b in "xy"] for a in "xy"])
    r1, r2 = np.einsum("abp,cbp->cap", matrix("deformation_gradient"), matrix("half_edges"))
    x = np.array([particles["x"], particles["y"]])
    return np.array([x - r1 - r2, x + r1 - r2, x + r1 + r2, x - r1 + r2]).transpose(2, 0, 1)


def draw_domains(path, results):
    """A quarter of the ring: the last state of uGIMP, whose domains are not convected, and the domains of the others."""
    panels = (("uGIMP", None), ("CPLS", 0.5), ("CPDI", 1), ("CPLS", 1))
    figure, axes = plt.subplots(len(SHOWN), len(panels), figsize=(10, 5.4), layout="constrained")
    for n, row in zip(SHOWN, axes):
        for axis, (method, time) in zip(row, panels):
            result = results[method, n]
            particles = result.particles(time)
            axis.set(xlim=(0, 1.4), ylim=(0, 1.4), aspect="equal", xticks=[], yticks=[])
            if time is None:
                axis.plot(particles["x"], particles["y"], ".k", markersize=16 / n)
                axis.set_title(f"{method}, h = 1/{n}, fails at t = {result.failure_time():.2g}", fontsize=9)
            else:
                axis.add_collection(PolyCollection(corners(particles), facecolor="none", edgecolor="k", linewidth=4 / n))
                axis.set_title(f"{method}, h = 1/{n}, t = {time}", fontsize=9)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def errors_at_end(particles):
    """Places where particles began, and their errors at T, where displacement and stress should be zero."""
    x, y, u, v = (particles[name] for name in ("x", "y", "displacement_x", "displacement_y"))
    X, Y = x - u, y - v
    rate = -np.pi * (1 - 16 * (np.hypot(X, Y) - 1)**2)**2
    stress = [particles[f"stress_{c}"] for c in ("xx", "yy", "xy", "xy")]
    return X, Y, {"|error of u| [m]": np.hypot(u, v),
                  "|error of v| [m/s]": np.hypot(particles["velocity_x"] + rate * Y, particles["velocity_y"] - rate * X),
                  "|error of stress| [Pa]": np.sqrt(np.sum(np.square(stress), axis=0))}


def draw_errors(path, results):
    """A quarter of the ring where its particles began; each column has one scale."""
    found = {method: errors_at_end(result.particles()) for method, result in results.items()}
    names = list(next(iter(found.values()))[2])
    figure, axes = plt.subplots(len(found), len(names), figsize=(9, 5.4), layout="constrained")
    for column, name in enumerate(names):
        greatest = max(np.max(fields[name]) for _, _, fields in found.values())
        for axis, (method, (X, Y, fields)) in zip(axes[:, column], found.items()):
            axis.set(xlim=(0, 1.3), ylim=(0, 1.3), aspect="equal", xticks=[], yticks=[])
            axis.set_title(f"{method}, {name}", fontsize=9)
            drawn = axis.scatter(X, Y, c=fields[name], s=22, vmin=0, vmax=greatest, cmap="magma_r", linewidths=0)
        figure.colorbar(drawn, ax=axes[:, column], orientation="horizontal", shrink=0.8, aspect=30)
    figure.suptitle(f"Errors at t = T, h = 1/{SHOWN[0]}", fontsize=10)
    figure.savefig(path, dpi=110)
    plt.close(figure)
