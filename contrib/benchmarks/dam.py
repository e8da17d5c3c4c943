"""A dam breaks, Nakamura et al. (2023), section 5.4: noise of the pressure, arrival at the far wall, still water.

Further runs have the cures of the noisy rows at the floor: doc/quiet_floor.md, whose figure is quiet_floor.png.
"""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "dam break (2D): noise of the pressure in the water and at the floor, arrival, still water"

G, DEPTH, RHO = 9.81, 0.6, 1e3
SCALE = RHO * G * DEPTH
COARSE, FINE = 0.04, 0.02
WIDTH = {COARSE: 3.24, FINE: 3.22}  # the tank is 3.22 wide, rounded up to whole cells

PAPER = {"Kernel/Boundary treatment": "WLS", "Run/Courant number": 0.1}
PROJECTION = {"Kernel/Boundary treatment": "WLS separable", "Transfer/Slip projection": "true"}
MIRROR = {"Kernel/Boundary treatment": "mirror"}
SMOOTHING = {"Materials/water/J smoothing": 0.1}
CURES = {"none": {}, "J": SMOOTHING, "projection": PROJECTION, "projection + J": {**PROJECTION, **SMOOTHING},
         "mirror": MIRROR, "mirror + J": {**MIRROR, **SMOOTHING}}
CURED = [("TPIC", cure) for cure in CURES if cure != "none"] + [("APIC", "projection + J"), ("FLIP", "J")]
STILL = [("TPIC", "projection + J"), ("TPIC", "mirror + J"), ("APIC", "projection + J")]
LONG = [("FLIP", "none"), ("TPIC", "none"), ("TPIC", "mirror + J")]
FLOOR_ROWS = {"rms y < h/2": (0, 0.5), "rms h/2..h": (0.5, 1), "rms h..2h": (1, 2)}  # in cells


def run(case, kernel, transfer, settings, cure="none", h=COARSE):
    return Run("prm/dam_break.prm",
               {"Kernel/Type": kernel, "Transfer/Type": transfer, **PAPER, **settings, **CURES[cure]},
               {"case": case, "kernel": kernel, "transfer": transfer, "cure": cure, "h": h})


def runs():
    still = {"Grid/Upper corner": "1.2, 1", "Output/Time interval": 0.5}
    # A probe in each step would be large; the front is read from tables .005 s apart.
    dam = {"Output/Time interval": 0.005, "Output/Grid": "false"}
    fine = {**dam, "Grid/Spacing": FINE, "Grid/Upper corner": f"{WIDTH[FINE]}, 2", "Run/End time": 3.4}
    return ([run("long dam", "quadratic B-spline", transfer, fine, cure, FINE) for transfer, cure in LONG]
            + [run("dam", "quadratic B-spline", transfer, dam) for transfer in ("FLIP", "APIC", "TPIC")]
            + [run("dam", "uGIMP", transfer, dam) for transfer in ("FLIP", "TPIC")]
            + [run("still water", "quadratic B-spline", transfer, still) for transfer in ("APIC", "TPIC")]
            + [run("dam", "quadratic B-spline", transfer, dam, cure) for transfer, cure in CURED]
            + [run("still water", "quadratic B-spline", transfer, still, cure) for transfer, cure in STILL])


def residuals(particles, h):
    """Height in cells, and residual of a plane through the pressures of each block of 2h x 2h with 8 particles or more,
    over rho g H, of the particles there."""
    x, y, p = particles["x"], particles["y"], particles["pressure"] / SCALE
    is_here = (x < 1.2) & (y < 0.3)
    blocks = np.floor(x / (2 * h)).astype(int) + 1000 * np.floor(y / (2 * h)).astype(int)
    heights, values = [np.empty(0)], [np.empty(0)]
    for block in np.unique(blocks[is_here]):
        inside = is_here & (blocks == block)
        if np.count_nonzero(inside) < 8:
            continue
        A = np.stack([np.ones(np.count_nonzero(inside)), x[inside], y[inside]], axis=1)
        heights.append(y[inside] / h)
        values.append(p[inside] - A @ np.linalg.lstsq(A, p[inside], rcond=None)[0])
    return np.concatenate(heights), np.concatenate(values)


def noise(particles, h, lower=0, upper=math.inf):
    """The residuals of the particles at these heights in cells."""
    heights, values = residuals(particles, h)
    is_here = (heights >= lower) & (heights < upper)
    return values[is_here] if np.any(is_here) else np.array([math.nan])


def rms(values):
    return math.sqrt(np.mean(values**2))


def median(values):
    return np.median(np.abs(values))


def arrival(result):
    """t sqrt(g/H) when the foremost particle is within h of the far wall, from tables .005 s apart."""
    if result.status != 0:
        return math.nan
    h = result.run.label["h"]
    for time in np.arange(0.5, 0.8, 0.005):
        if np.max(result.particles(time)["x"]) > WIDTH[h] - h:
            return time * math.sqrt(G / DEPTH)
    return math.nan


def bottom_pressure(particles):
    return np.mean(particles["pressure"][particles["y"] < COARSE / 2]) / SCALE


def at(result, time, function, *arguments):
    """A function of the noise between heights in cells."""
    if result.status != 0:
        return math.nan
    return function(noise(result.particles(time), result.run.label["h"], *arguments))


def lowest(result, time):
    return np.min(result.particles(time)["pressure"]) / SCALE if result.status == 0 else math.nan


def front(result, time):
    return np.max(result.particles(time)["x"]) if result.status == 0 else math.nan


def table(results):
    rows = []
    for result in results:
        is_dam = result.run.label["case"] != "still water"
        early = 0.3 if is_dam else 1
        rows.append({**result.run.label, "rms above, early": at(result, early, rms, 2),
                     "rms above, 1 s": at(result, 1, rms, 2),
                     **{name: at(result, early, rms, *heights) for name, heights in FLOOR_ROWS.items()},
                     "median, early": at(result, early, median), "median, 1 s": at(result, 1, median),
                     "lowest p": lowest(result, early), "front": front(result, early),
                     "arrival T": arrival(result) if is_dam else math.nan,
                     "failed at": result.failure_time()})
    return rows


def figures(results):
    by = {tuple(result.run.label[key] for key in ("case", "kernel", "transfer", "cure")): result for result in results}
    flip, tpic = (by["dam", "quadratic B-spline", transfer, "none"] for transfer in ("FLIP", "TPIC"))
    values = []
    for time, least_rms, least_median in ((0.3, 5, 5), (1, 10, 10)):
        values.append(report.Figure(f"noise for y > 2h at t = {time}, rms, FLIP over TPIC",
                                    at(flip, time, rms, 2) / at(tpic, time, rms, 2), lower=least_rms))
        values.append(report.Figure(f"noise at t = {time}, median, FLIP over TPIC",
                                    at(flip, time, median) / at(tpic, time, median), lower=least_median))
    for transfer in ("FLIP", "TPIC"):
        values.append(report.Figure(f"{transfer}, arrival, t sqrt(g/H)",
                                    arrival(by["dam", "quadratic B-spline", transfer, "none"]), 2.30, 2.55))
    for transfer in ("APIC", "TPIC"):
        result = by["still water", "quadratic B-spline", transfer, "none"]
        values.append(report.Figure(f"still water, {transfer}, median noise", at(result, 1, median), upper=1e-3))
        pressure = bottom_pressure(result.particles()) if result.status == 0 else math.nan
        values.append(report.Figure(f"still water, {transfer}, pressure at the floor", pressure, 0.97, 1.01))
    return values + cured_figures(by)


def cured_figures(by):
    values = []
    for case, transfer, cure in (("dam", "TPIC", "projection + J"), ("dam", "APIC", "projection + J"),
                                 ("dam", "TPIC", "mirror + J"), ("long dam", "TPIC", "mirror + J")):
        result = by[case, "quadratic B-spline", transfer, cure]
        name = f"{transfer}, {cure}, " + ("" if case == "dam" else "h = .02, ")
        values.append(report.Figure(name + "rms of the first row at t = .3",
                                    at(result, 0.3, rms, *FLOOR_ROWS["rms y < h/2"]), upper=0.10))
        values.append(report.Figure(name + "lowest p at t = .3", lowest(result, 0.3), lower=-0.15))
        values.append(report.Figure(name + "arrival, t sqrt(g/H)", arrival(result), 2.30, 2.55))
    for transfer in ("FLIP", "TPIC"):
        values.append(report.Figure(f"{transfer}, h = .02, arrival, t sqrt(g/H)",
                                    arrival(by["long dam", "quadratic B-spline", transfer, "none"]), 2.30, 2.55))
    for transfer, cure in STILL:
        result = by["still water", "quadratic B-spline", transfer, cure]
        values.append(report.Figure(f"still water, {transfer}, {cure}, median noise", at(result, 1, median),
                                    upper=1e-3))
    return values


def draw(results, path):
    """Pressure and vorticity at two times; the floor with its cures in quiet_floor.png; the long runs in long_dam.png."""
    draw_long([result for result in results if result.status == 0 and result.run.label["case"] == "long dam"],
              path.with_name("long_dam.png"))
    sound = [result for result in results if result.status == 0 and result.run.label["case"] == "dam"]
    draw_floors(sound, path.with_name("quiet_floor.png"))
    shown = [result for result in sound if result.run.label["cure"] == "none"]
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


def draw_floors(results, path):
    """Pressure near the floor at t = .3."""
    wanted = [("FLIP", "none"), ("TPIC", "none"), ("TPIC", "projection"), ("TPIC", "projection + J"),
              ("TPIC", "mirror + J")]
    by = {(result.run.label["transfer"], result.run.label["cure"]): result for result in results
          if result.run.label["kernel"] == "quadratic B-spline"}
    shown = [key for key in wanted if key in by]
    figure, axes = plt.subplots(len(shown), 1, figsize=(8, 1.2 * len(shown) + 0.4), squeeze=False, layout="constrained")
    for axis, key in zip(axes[:, 0], shown):
        particles = by[key].particles(0.3)
        drawn = axis.scatter(particles["x"], particles["y"], c=particles["pressure"] / SCALE, s=14, vmin=-0.5, vmax=1,
                             cmap="viridis", linewidths=0)
        axis.set(xlim=(0.85, 1.95), ylim=(0, 0.16), aspect="equal", xticks=[], yticks=[])
        axis.set_title(", ".join(key).replace(", none", ""), fontsize=9)
    figure.colorbar(drawn, ax=list(axes[:, 0]), label="p / (rho g H)", extend="min", aspect=30)
    figure.suptitle("Dam break, h = .04, t = .3 s: pressure of the particles near the floor")
    figure.savefig(path, dpi=90)
    plt.close(figure)


def draw_long(results, path):
    """Pressure at h = .02, from the collapse to the second wave."""
    times = (0.3, 1.0, 1.7, 3.4)
    figure, axes = plt.subplots(len(times), max(1, len(results)), figsize=(13, 7), squeeze=False, layout="constrained")
    for column, result in zip(axes.T, results):
        for axis, time in zip(column, times):
            particles = result.particles(time)
            drawn = axis.scatter(particles["x"], particles["y"], c=particles["pressure"] / SCALE, s=0.7, vmin=0, vmax=1,
                                 cmap="viridis", linewidths=0)
            axis.set(xlim=(0, WIDTH[FINE]), ylim=(0, 1.3), aspect="equal", xticks=[], yticks=[])
            axis.set_title(f"{result.run.label['transfer']}, {result.run.label['cure']}, t = {time} s".replace(", none", ""),
                           fontsize=8)
    if results:
        figure.colorbar(drawn, ax=list(axes[:, -1]), label="p / (rho g H)", shrink=0.6)
    figure.suptitle("Dam break, h = .02, WLS or mirror")
    figure.savefig(path, dpi=80)
    plt.close(figure)
