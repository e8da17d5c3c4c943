"""One turn of a free elastic disk, Nakamura et al. (2023), section 5.3: what is conserved."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "free rotation of an elastic disk (2D): momentum, angular momentum and energy over one turn"

RADIUS, OMEGA = 0.5, 2 * math.pi
# Half a spacing below the disk, and far away: without a pseudo wall.
WALLS = {"near": "-0.8, -0.525", "far": "-0.8, -0.725"}


def run(transfer, treatment, courant=0.8, wall="near"):
    return Run("prm/disk.prm",
               {"Transfer/Type": transfer, "Kernel/Boundary treatment": treatment, "Run/Courant number": courant,
                "Grid/Lower corner": WALLS[wall]},
               {"transfer": transfer, "treatment": treatment, "Cr": courant, "wall": wall})


def runs():
    return ([run(transfer, "WLS") for transfer in ("FLIP", "PIC", "APIC", "TPIC")]
            + [run("TPIC", "WLS", 0.4)]
            + [run(transfer, "WLS", wall="far") for transfer in ("APIC", "TPIC")]
            + [run(transfer, "Steffen") for transfer in ("FLIP", "APIC", "TPIC")])


def relative(result, column):
    """A column over its value at the start."""
    values = result.statistics()[column]
    return values / values[0]


def final(result, column):
    return relative(result, column)[-1] if result.status == 0 else math.nan


def momentum(result):
    """Largest momentum over M w R."""
    if result.status != 0:
        return math.nan
    columns = result.statistics()
    return np.max(np.hypot(columns["momentum x"], columns["momentum y"])) / (columns["mass"][0] * OMEGA * RADIUS)


def mean_J(result):
    return np.mean(result.particles()["volume_ratio"]) if result.status == 0 else math.nan


def table(results):
    return [{**result.run.label, "momentum": momentum(result), "L/L0": final(result, "angular momentum z"),
             "total L/L0 - 1": final(result, "total angular momentum z") - 1,
             "1 - K/K0": 1 - final(result, "kinetic energy"), "mean J": mean_J(result),
             "failed at": result.failure_time()} for result in results]


def figures(results):
    by = {tuple(result.run.label.values()): result for result in results}
    get = lambda transfer, treatment="WLS", courant=0.8, wall="near": by[transfer, treatment, courant, wall]
    values = [report.Figure(f"{transfer}, momentum / (M w R)", momentum(get(transfer)), upper=1e-12)
              for transfer in ("FLIP", "PIC", "APIC", "TPIC")]
    total = get("APIC")
    drift = np.max(np.abs(relative(total, "total angular momentum z") - 1)) if total.status == 0 else math.nan
    values.append(report.Figure("APIC, total angular momentum, largest change", drift, upper=1e-10))
    tpic = get("TPIC")
    values.append(report.near("TPIC, L/L0", final(tpic, "angular momentum z"), 1, 5e-4))
    for transfer in ("APIC", "TPIC"):
        result = get(transfer)
        # Rigid rotation: K = L^2 / (2 I), both of the particles' velocities, and I grows with the disk's area.
        balance = final(result, "kinetic energy") * mean_J(result) - final(result, "angular momentum z") ** 2
        values.append(report.near(f"{transfer}, (K/K0) mean J - (L/L0)^2", balance, 0, 5e-5))
    loss = 1 - final(tpic, "kinetic energy")
    values.append(report.near("TPIC, loss of energy at half the Courant number over that",
                              (1 - final(get("TPIC", courant=0.4), "kinetic energy")) / loss, 0.5, 0.05))
    for transfer in ("APIC", "TPIC"):
        difference = final(get(transfer), "kinetic energy") - final(get(transfer, wall="far"), "kinetic energy")
        values.append(report.near(f"{transfer}, K/K0 with and without the pseudo wall", difference, 0, 1e-4))
    values.append(report.near("FLIP, L/L0", final(get("FLIP"), "angular momentum z"), 0.984, 0.005))
    values.append(report.near("FLIP, K/K0", final(get("FLIP"), "kinetic energy"), 0.963, 0.005))
    for transfer in ("APIC", "TPIC"):
        values.append(report.Figure(f"{transfer}, uncorrected, fails (time)", get(transfer, "Steffen").failure_time(), 0, 1,
                                    "s"))
    return values


def draw(results, path):
    """Angular momentum and kinetic energy, and the angular velocity's error at the end."""
    shown = [result for result in results if result.status == 0 and result.run.label["wall"] == "near"
             and result.run.label["Cr"] == 0.8]
    n = max(2, len(shown))
    figure = plt.figure(figsize=(2.6 * n, 6), layout="constrained")
    grid = figure.add_gridspec(2, 2 * n)
    curves = [figure.add_subplot(grid[0, :n]), figure.add_subplot(grid[0, n:])]
    maps = [figure.add_subplot(grid[1, 2 * i:2 * i + 2]) for i in range(n)]
    for axis, column in zip(curves, ("angular momentum", "kinetic energy")):
        for result in shown:
            name = f"{result.run.label['transfer']}, {result.run.label['treatment']}"
            style = "--" if result.run.label["transfer"] == "TPIC" else "-"
            axis.plot(result.statistics()["time"], relative(result, column + (" z" if column[0] == "a" else "")), style, label=name)
        axis.set(title=column + " / initial", xlabel="t [s]", ylim=(0.88, 1.01))
    curves[0].legend(fontsize=7, loc="lower left")
    for axis in maps:
        axis.set_axis_off()
    for axis, result in zip(maps, shown):
        particles = result.particles()
        error = 100 * np.abs(particles["vorticity"] / 2 / OMEGA - 1)
        drawn = axis.scatter(particles["x"], particles["y"], c=error, s=4, vmin=0, vmax=5, cmap="magma", linewidths=0)
        axis.set_aspect("equal")
        axis.set_title(f"{result.run.label['transfer']}, {result.run.label['treatment']}", fontsize=9)
    figure.colorbar(drawn, ax=maps, label="error of angular velocity [%]", extend="max")
    figure.suptitle("A disk turns once, h = .05, cubic B-splines")
    figure.savefig(path, dpi=110)
    plt.close(figure)
