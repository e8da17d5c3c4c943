"""Factors of safety by strength reduction: a drained and an undrained slope, by one criterion of failure.

Strengths are divided by a factor. A slope stands when its crest moves less than .02 H within 60 H/c_s after gravity has grown
to its whole; the greatest such factor is interpolated between runs. What it is compared with is not of this program: finite
elements and Bishop's method for the drained slope (Griffiths & Lane 1999, example 1), the critical circle for the undrained one.
"""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import report
from runs import Run

TITLE = "factors of safety of a drained and an undrained slope (2D) by strength reduction"

H, G, DENSITY, YOUNG = 10., 9.81, 2000., 100e6
RAMP = 1.5  # until gravity is whole [s]
COHESION = {"drained": 0.05 * DENSITY * G * H, "undrained": 45e3}
FRICTION = 20.
POISSON = {"drained": 0.3, "undrained": 0.49}
FACTORS = {("drained", 0.5): (1, 1.3, 1.34, 1.36, 1.38, 1.4, 1.42, 1.44, 1.46, 1.5),
           ("drained", 0.25): (1.36, 1.38, 1.4, 1.42, 1.44),
           ("undrained", 0.5): (1, 1.34, 1.38, 1.4, 1.42, 1.44, 1.46, 1.5),
           ("undrained", 0.25): (1.36, 1.38, 1.4, 1.42, 1.44)}
LIMIT = 0.02 * H


def watched(kind):
    """60 H / c_s."""
    return 60 * H / math.sqrt(YOUNG / (2 * (1 + POISSON[kind])) / DENSITY)


def run(kind, h, factor):
    strengths = ({"Materials/ground/Cohesion": COHESION[kind] / factor,
                  "Materials/ground/Friction angle": math.degrees(math.atan(math.tan(math.radians(FRICTION)) / factor))}
                 if kind == "drained" else {"Materials/ground/Yield stress": math.sqrt(3) * COHESION[kind] / factor})
    return Run(f"prm/{kind}_slope.prm",
               {**strengths, "Grid/Spacing": h, "Run/End time": RAMP + 2 * watched(kind), "Output/Grid": "false",
                "Output/Time interval": 0}, {"slope": kind, "h": h, "factor": float(factor)})


def runs():
    return [run(kind, h, factor) for (kind, h), factors in FACTORS.items() for factor in factors]


def moved(result, time):
    """How far the crest has moved since gravity is whole, after `time` [m]."""
    if result.status:
        return math.inf  # a slope whose material is torn has failed
    columns = result.columns("probes.csv")
    u = np.stack([columns[f"crest_displacement_{axis}"] for axis in "xy"])
    now, start = (np.argmin(np.abs(columns["time"] - t)) for t in (RAMP + time, RAMP))
    return float(np.linalg.norm(u[:, now] - u[:, start]))


def safety(results, kind, h, times=1):
    """The factor at which the crest moves by the limit, interpolated in the logarithm of its motion."""
    found = sorted((result.run.label["factor"], moved(result, times * watched(kind))) for result in results
                   if (result.run.label["slope"], result.run.label["h"]) == (kind, h))
    for (low, before), (high, after) in zip(found, found[1:]):
        if before < LIMIT <= after:
            share = math.log(LIMIT / before) / math.log(after / before) if math.isfinite(after) else 0.5
            return low + share * (high - low)
    return math.nan


def stability_number(beta, n=4000):
    """c/(rho g H) of the critical circle above a firm base at the toe's level, phi = 0: moments about its centre, by search."""
    x = np.linspace(-4, 6, n)
    top = np.clip(1 - x * math.tan(beta), 0, 1)  # crest at x = 0

    def number(centre, height, radius):
        low = height - np.sqrt(np.maximum(radius**2 - (x - centre)**2, 0))
        cut = np.flatnonzero((np.abs(x - centre) < radius) & (low < top))
        if len(cut) == 0 or cut[0] == 0 or cut[-1] == n - 1:
            return 0.
        moment = np.sum((top[cut] - low[cut]) * (centre - x[cut])) * (x[1] - x[0])
        begin, end = (math.atan2(low[k] - height, x[k] - centre) for k in (cut[0], cut[-1]))
        return moment / (radius**2 * (end - begin))

    return max(number(centre, height, height - depth) for centre in np.linspace(0, 1.5, 31)
               for height in np.linspace(1, 2.5, 31) for depth in (0, 0.02, 0.1))


def reference(kind):
    if kind == "drained":
        return 1.40
    return COHESION[kind] / (DENSITY * G * H) / stability_number(math.pi / 4)


def table(results):
    return [{**result.run.label, "moved": moved(result, watched(result.run.label["slope"])),
             "moved in twice the time": moved(result, 2 * watched(result.run.label["slope"])), "seconds": result.seconds}
            for result in results]


def figures(results):
    found = []
    for kind, tolerance, source in (("drained", 0.04, "finite elements 1.40 (Bishop 1.38)"), ("undrained", 0.03, "the critical circle")):
        coarse, fine = safety(results, kind, 0.5), safety(results, kind, 0.25)
        found += [report.near(f"{kind}, h = .5: factor of safety over {source}", coarse / reference(kind), 1, tolerance),
                  report.near(f"{kind}, h = .25", fine / reference(kind), 1, tolerance),
                  report.near(f"{kind}: h = .25 over h = .5", fine / coarse, 1, 0.01),
                  report.near(f"{kind}, h = .25: twice the time", safety(results, kind, 0.25, 2) / fine, 1, 0.01)]
    return found


def draw_curves(axis, results, kind):
    for h, colour in ((0.5, "tab:orange"), (0.25, "tab:blue")):
        for times, style in ((1, "o-"), (2, "s:")):
            rows = sorted((result.run.label["factor"], moved(result, times * watched(kind)) / H) for result in results
                          if (result.run.label["slope"], result.run.label["h"]) == (kind, h))
            axis.plot(*zip(*rows), style, color=colour, markersize=4,
                      label=f"h = {h:g} m" + (", twice the time" if times == 2 else ""))
    axis.axhline(LIMIT / H, color="k", linewidth=0.8, label="criterion: .02 H")
    axis.axvline(reference(kind), color="0.6", linewidth=3, zorder=0,
                 label="finite elements (Griffiths & Lane)" if kind == "drained" else "critical circle")
    axis.set(title=f"{kind} slope", xlabel="strengths divided by", ylabel="crest moved in 60 H/c_s, over H", yscale="log")
    axis.legend(fontsize=7)


def draw_strain(axis, results, kind):
    """Where it yields, at the first factor with which it fails."""
    factor = next(f for f in FACTORS[kind, 0.25] if f > safety(results, kind, 0.25))
    result = next(r for r in results if (r.run.label["slope"], r.run.label["h"], r.run.label["factor"]) == (kind, 0.25, factor))
    particles = result.particles()
    drawn = axis.scatter(particles["x"], particles["y"], c=particles["equivalent_plastic_strain"], s=1.2, vmin=0, vmax=0.2,
                         cmap="inferno", linewidths=0)
    axis.set(title=f"{kind}, factor {factor:g}: equivalent plastic strain", aspect="equal")
    return drawn


def draw(results, path):
    figure, axes = plt.subplots(2, 2, figsize=(10, 7), layout="constrained")
    for kind, line in zip(COHESION, axes.T):
        draw_curves(line[0], results, kind)
        if math.isfinite(safety(results, kind, 0.25)):
            drawn = draw_strain(line[1], results, kind)
            figure.colorbar(drawn, ax=line[1], shrink=0.6)
    figure.savefig(path, dpi=110)
    plt.close(figure)
