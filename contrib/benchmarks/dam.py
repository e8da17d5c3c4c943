"""A dam breaks, Nakamura et al. (2023), section 5.4: noise of the pressure, arrival at the far wall, still water."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "dam break (2D): noise of the pressure in the water and at the floor, arrival, still water"

G, DEPTH, RHO, WIDTH = 9.81, 0.6, 1e3, 3.24  # the tank is 3.22 wide, rounded up to whole cells
SCALE = RHO * G * DEPTH
H = 0.04


def run(case, kernel, transfer, settings):
    return Run("prm/dam_break.prm", {"Kernel/Type": kernel, "Transfer/Type": transfer, **settings},
               {"case": case, "kernel": kernel, "transfer": transfer})


def runs():
    still = {"Grid/Upper corner": "1.2, 1", "Output/Time interval": 0.5}
    # A probe in each step would be large; the front is read from tables .005 s apart.
    dam = {"Output/Time interval": 0.005, "Output/Grid": "false"}
    return ([run("dam", "quadratic B-spline", transfer, dam) for transfer in ("FLIP", "APIC", "TPIC")]
            + [run("dam", "uGIMP", transfer, dam) for transfer in ("FLIP", "TPIC")]
            + [run("still water", "quadratic B-spline", transfer, still) for transfer in ("APIC", "TPIC")])


def noise(particles, floor=None):
    """Residuals of a plane through the pressures of each block of 2h x 2h with 8 particles or more, over rho g H."""
    x, y, p = particles["x"], particles["y"], particles["pressure"] / SCALE
    is_here = (x < 1.2) & (y < 0.3)
    blocks = np.floor(x / (2 * H)).astype(int) + 1000 * np.floor(y / (2 * H)).astype(int)
    residuals = []
    for block in np.unique(blocks[is_here]):
        inside = is_here & (blocks == block)
        if np.count_nonzero(inside) < 8:
            continue
        if floor is not None and (block < 1000) != floor:
            continue
        A = np.stack([np.ones(np.count_nonzero(inside)), x[inside], y[inside]], axis=1)
        residuals.append(p[inside] - A @ np.linalg.lstsq(A, p[inside], rcond=None)[0])
    return np.concatenate(residuals) if residuals else np.array([math.nan])


def rms(values):
    return math.sqrt(np.mean(values**2))


def median(values):
    return np.median(np.abs(values))


def arrival(result):
    """t sqrt(g/H) when the foremost particle is within h of the far wall, from tables .005 s apart."""
    if result.status != 0:
        return math.nan
    for time in np.arange(0.5, 0.8, 0.005):
        if np.max(result.particles(time)["x"]) > WIDTH - H:
            return time * math.sqrt(G / DEPTH)
    return math.nan


def bottom_pressure(particles):
    return np.mean(particles["pressure"][particles["y"] < H / 2]) / SCALE


def at(result, time, function, *arguments):
    return function(noise(result.particles(time), *arguments)) if result.status == 0 else math.nan


def lowest(result, time):
    return np.min(result.particles(time)["pressure"]) / SCALE if result.status == 0 else math.nan


def table(results):
    rows = []
    for result in results:
        is_dam = result.run.label["case"] == "dam"
        early = 0.3 if is_dam else 1
        rows.append({**result.run.label, "rms above, early": at(result, early, rms, False),
                     "rms above, 1 s": at(result, 1, rms, False), "rms floor, early": at(result, early, rms, True),
                     "median, early": at(result, early, median), "median, 1 s": at(result, 1, median),
                     "lowest p": lowest(result, early), "arrival T": arrival(result) if is_dam else math.nan,
                     "failed at": result.failure_time()})
    return rows


def figures(results):
    by = {tuple(result.run.label.values()): result for result in results}
    flip, tpic = (by["dam", "quadratic B-spline", transfer] for transfer in ("FLIP", "TPIC"))
    values = []
    for time, least_rms, least_median in ((0.3, 5, 5), (1, 10, 10)):
        values.append(report.Figure(f"noise for y > 2h at t = {time}, rms, FLIP over TPIC",
                                    at(flip, time, rms, False) / at(tpic, time, rms, False), lower=least_rms))
        values.append(report.Figure(f"noise at t = {time}, median, FLIP over TPIC",
                                    at(flip, time, median) / at(tpic, time, median), lower=least_median))
    for transfer in ("FLIP", "TPIC"):
        values.append(report.Figure(f"{transfer}, arrival, t sqrt(g/H)",
                                    arrival(by["dam", "quadratic B-spline", transfer]), 2.30, 2.55))
    for transfer in ("APIC", "TPIC"):
        result = by["still water", "quadratic B-spline", transfer]
        values.append(report.Figure(f"still water, {transfer}, median noise", at(result, 1, median), upper=1e-3))
        pressure = bottom_pressure(result.particles()) if result.status == 0 else math.nan
        values.append(report.Figure(f"still water, {transfer}, pressure at the floor", pressure, 0.97, 1.01))
    return values


def draw(results, path):
    """Pressure and vorticity at two times."""
    shown = [result for result in results if result.status == 0 and result.run.label["case"] == "dam"]
    panels = [("pressure", 0.3), ("pressure", 1.0), ("vorticity", 1.0)]
    figure, axes = plt.subplots(len(shown), len(panels), figsize=(13, 2.2 * len(shown) + 0.5), squeeze=False,
                                layout="constrained")
    for line, result in zip(axes, shown):
        for axis, (field, time) in zip(line, panels):
            particles = result.particles(time)
            values, limits, colours = ((particles["pressure"] / SCALE, (0, 1), "viridis") if field == "pressure" else
                                       (particles["vorticity"], (-15, 15), "coolwarm"))
            drawn = axis.scatter(particles["x"], particles["y"], c=values, s=1.5, vmin=limits[0], vmax=limits[1],
                                 cmap=colours, linewidths=0)
            axis.set(xlim=(0, 3.24), ylim=(0, 1.3), aspect="equal", xticks=[], yticks=[])
            axis.set_title(f"{result.run.label['kernel'].split()[0]}, {result.run.label['transfer']}, t = {time} s", fontsize=8)
            figure.colorbar(drawn, ax=axis, label="p / (rho g H)" if field == "pressure" else "vorticity [1/s]", shrink=0.8)
    figure.suptitle("Dam break, h = .04, WLS")
    figure.savefig(path, dpi=110)
    plt.close(figure)
