"""A soft ball falls through a channel with wavy walls: Cao et al., section 3.4, on triangles that fit the walls."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshes
import numpy as np
import report
import runs as program
from runs import Run

TITLE = "ball in a wavy channel (2D, UMLS): particles at random, walls that the mesh fits"

A, K1, K2, WIDTH, BOTTOM, TOP = 0.35, 1.2, 0.5, 2., -19., 1.5
RADIUS, G, N = 0.7, 9.81, 4735
TIMES = (0, 1.4, 3.0, 6.5)
WALLS = {"no-slip": "walls", "friction": "rough"}  # conditions
POINTS = program.ROOT / "prm" / "meshes" / "wavy.txt"


def left(y):
    return A * (np.sin(K1 * y) + np.sin(K2 * y))


def make_points():
    """Uniform in the ball around (1, 0)."""
    random = np.random.default_rng(4735)
    r, phi = RADIUS * np.sqrt(random.random(N)), 2 * np.pi * random.random(N)
    meshes.points(POINTS, "ball of wavy_channel.prm, at random: contrib/reproduce wavy",
                  np.column_stack((1 + r * np.cos(phi), r * np.sin(phi))), math.pi * RADIUS**2 / N)


def run(walls, places):
    settings = {"Output/Grid": "false"}
    if places == "at random":
        settings.update({"Bodies/Names": "random", "Bodies/random/Shape": "points", "Bodies/random/File": POINTS})
    if walls == "friction":
        settings.update({"Conditions/Names": "rough", "Conditions/rough/Type": "friction",
                         "Conditions/rough/Friction coefficient": 1, "Conditions/rough/Boundaries": "walls, floor, top"})
    return Run("prm/wavy_channel.prm", settings, {"walls": walls, "particles": places})


def runs():
    meshes.make("wavy", 2)
    make_points()
    return [run("no-slip", "jittered"), run("no-slip", "at random"), run("friction", "jittered")]


def gap(particles):
    """Least distance from a wall along x."""
    x, y = particles["x"], particles["y"]
    return min(np.min(x - left(y)), np.min(left(y) + WIDTH - x), np.min(y) - BOTTOM)


def outputs(result):
    """Tables of all outputs with their times."""
    for path in sorted(result.directory.glob("particles_*.csv")):
        time = program.table_time(path)
        yield time, result.particles(time)


def balance(result):
    """Energy that is not accounted for, over the work of gravity; momentum over the greatest one."""
    columns = result.statistics()
    energy = np.max(np.abs(columns["unaccounted energy"])) / np.max(columns["body force work"])
    return energy, meshes.impulses(columns, (0, -G), surfaces=((f"reaction {WALLS[result.run.label['walls']]}", -1),))


def row(result):
    if result.status != 0:
        return {"outputs": 0, "least gap": math.nan, "energy": math.nan, "momentum": math.nan, "friction": math.nan,
                "end y": math.nan, "J least": math.nan}
    columns = result.statistics()
    tables = [table for _, table in outputs(result)]
    energy, momentum = balance(result)
    return {"outputs": len(tables), "least gap": min(gap(table) for table in tables), "energy": energy, "momentum": momentum,
            "friction": columns["condition work"][-1] / columns["body force work"][-1],
            "end y": np.mean(tables[-1]["y"]), "J least": min(np.min(table["volume_ratio"]) for table in tables)}


def table(results):
    return [{**result.run.label, **row(result), "seconds": result.seconds} for result in results]


def figures(results):
    found = []
    for result in results:
        values, name = row(result), ", ".join(result.run.label.values())
        found += [report.Figure(f"{name}: outputs to 6.5 s, all particles inside", values["outputs"], 66, 66),
                  # The mesh's chords cut the walls' bulges by h^2 k^2 a/8.
                  report.Figure(f"{name}: least distance from a wall", values["least gap"], lower=-2e-4, unit="m"),
                  report.Figure(f"{name}: momentum less all impulses", values["momentum"], upper=1e-9),
                  report.Figure(f"{name}: energy less all work, over that of gravity", values["energy"], upper=0.01)]
    return found


def draw(results, path):
    figure, axes = plt.subplots(len(results), len(TIMES) + 1, figsize=(10, 4.2 * len(results)), layout="constrained",
                                squeeze=False)
    for line, result in zip(axes, results):
        if result.status != 0:
            continue
        y = np.linspace(BOTTOM, TOP, 600)
        line[0].fill_betweenx(y, left(y), left(y) + WIDTH, color="0.92")
        for axis in line:
            axis.plot(left(y), y, "k", lw=0.8)
            axis.plot(left(y) + WIDTH, y, "k", lw=0.8)
            axis.set(aspect="equal", xticks=[], yticks=[])
        for axis, time in zip(line[1:], TIMES):
            particles = result.particles(time)
            for a, size in ((line[0], 0.3), (axis, 2.5)):
                drawn = a.scatter(particles["x"], particles["y"], c=particles["pressure"] / 1e3, s=size, vmin=-5, vmax=20,
                                  cmap="coolwarm", linewidths=0)
            centre = np.mean(particles["x"]), np.mean(particles["y"])
            axis.set(xlim=(centre[0] - 1.3, centre[0] + 1.3), ylim=(centre[1] - 2, centre[1] + 2))
            axis.set_title(f"{', '.join(result.run.label.values())}, t = {time} s", fontsize=7)
        line[0].set(xlim=(-1, 3), ylim=(BOTTOM, TOP))
        figure.colorbar(drawn, ax=line, shrink=0.7, label="pressure [kPa]", extend="both")
    figure.savefig(path, dpi=120)
    plt.close(figure)
