"""Collapse of a column of sand, Nakamura et al. (2023), section 5.5."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "collapse of a sand column (2D): run-out, height, kinetic energy; with friction; uncorrected runs must fail"

WIDTH, H = 0.1, 0.01  # half width of the column, spacing [m]
FRICTION = 0.4
FILES = {"no-slip": "prm/column.prm", "friction": "prm/column_friction.prm"}


def run(kernel, transfer, treatment, courant=1.0, floor="no-slip", h=H, gap="off"):
    return Run(FILES[floor],
               {"Kernel/Type": kernel, "Transfer/Type": transfer, "Kernel/Boundary treatment": treatment,
                "Run/Courant number": courant, "Grid/Spacing": h,
                "Materials/sand/Remember loosening": "true" if gap == "on" else "false"},
               {"floor": floor, "h": h, "kernel": kernel, "transfer": transfer, "treatment": treatment, "Cr": courant,
                "gap": gap})


def runs():
    return ([run("quadratic B-spline", transfer, "WLS") for transfer in ("FLIP", "APIC", "TPIC")]
            + [run("uGIMP", transfer, "WLS") for transfer in ("APIC", "TPIC", "FLIP")]
            + [run("uGIMP", "FLIP", "WLS", 0.7)]
            + [run("quadratic B-spline", transfer, "Steffen") for transfer in ("APIC", "TPIC")]
            + [run("quadratic B-spline", transfer, "WLS", floor="friction") for transfer in ("APIC", "TPIC")]
            # Sand that closes its gaps first, which the paper's does not.
            + [run("quadratic B-spline", transfer, "WLS", floor=floor, gap="on") for floor in FILES
               for transfer in ("FLIP", "APIC", "TPIC")]
            # How much the run-out depends on spacing and step size.
            + [run("quadratic B-spline", "TPIC", "WLS", floor=floor, h=h) for floor in FILES for h in (0.02, 0.005)]
            + [run("quadratic B-spline", "TPIC", "WLS", courant, floor) for floor in FILES for courant in (0.5, 0.2)])


def run_out(particles):
    x = np.sort(particles["x"])
    return (x[int(0.99 * (len(x) - 1))] - WIDTH) / WIDTH


def farthest(particles):
    return np.max(particles["x"])


def height(particles, h=H):
    return np.max(particles["y"][particles["x"] < 2 * h])


def end(result, function, *arguments):
    return function(result.particles(), *arguments) if result.status == 0 else math.nan


def statistic(result, function):
    return function(result.statistics()) if result.status == 0 else math.nan


def mobilised(columns):
    """The largest ratio of the floor's tangential to its normal force."""
    normal = -columns["reaction floor y"]
    return np.max(np.abs(columns["reaction floor x"][normal > 0]) / normal[normal > 0])


def gain(columns):
    """What the scheme has at most added to the energy, over the work of gravity."""
    return np.max(columns["energy residual"]) / columns["body force work"][-1]


def kinetic_energy(result):
    return result.statistics()["kinetic energy"][-1] if result.status == 0 else math.nan


def mean_J(particles):
    return np.mean(particles["volume_ratio"])


def table(results):
    return [{**result.run.label, "run-out": end(result, run_out), "farthest": end(result, farthest), "height": end(result, height, result.run.label["h"]),
             "mean J": end(result, mean_J), "kinetic energy": kinetic_energy(result),
             "friction/normal": statistic(result, mobilised), "failed at": result.failure_time()}
            for result in results]


def figures(results):
    by = {tuple(result.run.label.values()): result for result in results}
    get = lambda kernel, transfer, treatment="WLS", courant=1.0, floor="no-slip", gap="off": by[
        floor, H, kernel, transfer, treatment, courant, gap]
    quadratic, gimp = "quadratic B-spline", "uGIMP"
    values = []
    for transfer in ("APIC", "TPIC"):
        result = get(quadratic, transfer)
        values += [report.Figure(f"quadratic, {transfer}, run-out", end(result, run_out), 3.1, 3.5),
                   report.Figure(f"quadratic, {transfer}, height", end(result, height), 0.13, 0.145, "m"),
                   report.Figure(f"quadratic, {transfer}, mean J", end(result, mean_J), upper=1.05)]
        result = get(gimp, transfer)
        values += [report.Figure(f"uGIMP, {transfer}, run-out", end(result, run_out), 3.5, 3.9),
                   report.Figure(f"uGIMP, {transfer}, mean J", end(result, mean_J), upper=1.10)]
    values.append(report.Figure("kinetic energy at the end, FLIP over TPIC",
                                kinetic_energy(get(quadratic, "FLIP")) / kinetic_energy(get(quadratic, "TPIC")), lower=100))
    values.append(report.Figure("uGIMP, FLIP, Cr = 1, fails (time)", get(gimp, "FLIP").failure_time(), 0, 0.6, "s"))
    values.append(report.Figure("uGIMP, FLIP, Cr = .7, runs (exit status)", get(gimp, "FLIP", "WLS", 0.7).status, 0, 0))
    for transfer in ("APIC", "TPIC"):
        values.append(report.Figure(f"quadratic, {transfer}, uncorrected, fails (time)",
                                    get(quadratic, transfer, "Steffen").failure_time(), 0, 0.6, "s"))
    for transfer in ("APIC", "TPIC"):
        result = get(quadratic, transfer, floor="friction")
        values.append(report.Figure(f"friction, {transfer}, tangential over normal force, largest",
                                    statistic(result, mobilised), upper=FRICTION))
        values.append(report.Figure(f"friction, {transfer}, run-out over that of no-slip",
                                    end(result, run_out) / end(get(quadratic, transfer), run_out), lower=1))
        values.append(report.Figure(f"friction, {transfer}, energy added / work of gravity", statistic(result, gain), upper=1e-6))
        values.append(report.Figure(f"friction, {transfer}, mean J", end(result, mean_J), upper=1.05))
    for floor in FILES:
        for transfer in ("APIC", "TPIC"):
            result, without = (get(quadratic, transfer, floor=floor, gap=gap) for gap in ("on", "off"))
            values.append(report.near(f"gap, {floor}, {transfer}, farthest grain over that without",
                                      end(result, farthest) / end(without, farthest), 1, 0.02))
            values.append(report.Figure(f"gap, {floor}, {transfer}, mean J", end(result, mean_J), 0.98, 1.05))
    values.append(report.Figure("gap, FLIP, mean J", end(get(quadratic, "FLIP", gap="on"), mean_J), 0.98, 1.05))
    return values


def draw(results, path):
    """The velocity's norm at three times."""
    shown = [result for result in results if result.status == 0 and result.run.label["h"] == H
             and (result.run.label["floor"] == "no-slip" or result.run.label["transfer"] == "TPIC")
             and (result.run.label["Cr"] == 1 or result.run.label["transfer"] == "FLIP")
             and (result.run.label["gap"] == "off" or result.run.label["transfer"] != "APIC")]
    times = (0.15, 0.3, 0.6)
    figure, axes = plt.subplots(len(shown), len(times), figsize=(11, 1.6 * len(shown) + 0.6), squeeze=False,
                                layout="constrained")
    for line, result in zip(axes, shown):
        for axis, time in zip(line, times):
            particles = result.particles(time)
            speed = np.hypot(particles["velocity_x"], particles["velocity_y"])
            drawn = axis.scatter(particles["x"], particles["y"], c=speed, s=1.5, vmin=0, vmax=1.5, cmap="viridis", linewidths=0)
            axis.set(xlim=(0, 0.8), ylim=(0, 0.31), aspect="equal", xticks=[], yticks=[])
            label = result.run.label
            axis.set_title(f"{label['kernel'].split()[0]}, {label['transfer']}, {label['floor']}, Cr {label['Cr']}, "
                           f"{'gap, ' if label['gap'] == 'on' else ''}t = {time} s", fontsize=8)
    figure.colorbar(drawn, ax=list(axes.flat), label="speed [m/s]", extend="max", shrink=0.5)
    figure.suptitle("Column of sand, h = .01, WLS")
    figure.savefig(path, dpi=110)
    plt.close(figure)
