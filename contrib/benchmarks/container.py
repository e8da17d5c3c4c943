"""A compressed body expands in a ball: Cao et al., section 3.6, scaled down; first with a ball for a body, which stays centred.

TALUS_CONTAINER_EDGE in the environment is the mesh's edge; the default is .05, and .03 has some 100 000 particles.
"""
import math
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import meshes
import numpy as np
import report
import runs as program
from runs import Run

TITLE = "compressed body in a spherical container (3D, UMLS): barrier contact with friction"

EDGE = float(os.environ.get("TALUS_CONTAINER_EDGE", 0.05))
RADIUS, BALL = 0.5, 0.45
FREE = BALL / 0.8


def run(body):
    settings = {"Grid/Spacing": EDGE, "Contacts/wall/Distance": EDGE / 4, "Output/Grid": "false",
                "Output/Statistics interval": 1}
    if body == "ball":
        settings.update({"Bodies/Names": "ball", "Bodies/ball/Shape": "ball", "Bodies/ball/Radius": BALL,
                         "Bodies/ball/Centre": "0, 0, 0",
                         "Bodies/ball/Deformation gradient": "0.8, 0, 0, 0, 0.8, 0, 0, 0, 0.8"})
    return Run("prm/container.prm", settings, {"body": body})


def runs():
    meshes.make("container", 3, h=EDGE)
    return [run(body) for body in ("ball", "star")]


def position(particles):
    return np.column_stack([particles[axis] for axis in "xyz"])


def off_centre(result):
    """Greatest distance of the centre of mass from the middle in all outputs, over the container's radius."""
    worst = 0.
    for path in sorted(result.directory.glob("particles_*.csv")):
        particles = result.particles(program.table_time(path))
        worst = max(worst, np.linalg.norm(np.average(position(particles), axis=0, weights=particles["mass"])))
    return worst / RADIUS


def farthest(result):
    """Of all particles in all outputs, from the middle."""
    return max(np.max(np.linalg.norm(position(result.particles(program.table_time(path))), axis=1))
               for path in sorted(result.directory.glob("particles_*.csv")))


def row(result):
    values = {name: math.nan for name in ("particles", "off centre", "farthest", "nearness", "energy", "kinetic", "momentum",
                                          "friction")}
    if result.status == 0:
        columns = result.statistics()
        first = columns["strain energy"][0] + columns["kinetic energy"][0]
        scale = math.sqrt(2 * np.max(columns["kinetic energy"]) * columns["mass"][0])
        error = 0.
        for axis in "xyz":
            force = columns[f"contact wall {axis}"][1:]
            p = columns[f"momentum {axis}"] + columns[f"lost momentum {axis}"]
            error = max(error, np.max(np.abs(p[1:] - p[0] - np.cumsum(force * columns["step size"][1:]))))
        values.update({"particles": len(result.particles()["id"]), "off centre": off_centre(result), "farthest": farthest(result),
                       "nearness": np.max(columns["contact nearness wall"]),
                       "energy": np.max(np.abs(columns["unaccounted energy"])) / first,
                       "kinetic": columns["kinetic energy"][-1] / np.max(columns["kinetic energy"]),
                       "momentum": error / scale, "friction": columns["contact work"][-1] / first})
    return values


def table(results):
    return [{**result.run.label, **row(result), "seconds": result.seconds} for result in results]


def figures(results):
    found = []
    for result in results:
        values, name = row(result), result.run.label["body"]
        if name == "ball":
            found.append(report.Figure("ball: greatest distance from the middle over the radius", values["off centre"], upper=1e-3))
        found += [report.Figure(f"{name}: farthest particle", values["farthest"], upper=RADIUS, unit="m"),
                  report.Figure(f"{name}: nearness, 1 at the wall", values["nearness"], upper=1),
                  report.Figure(f"{name}: momentum less all impulses", values["momentum"], upper=1e-9),
                  report.Figure(f"{name}: energy less all work, over that at the start", values["energy"], upper=0.01),
                  report.Figure(f"{name}: kinetic energy at the end over its peak", values["kinetic"], upper=1e-3)]
    return found


def draw(results, path):
    times = (0, 0.005, 0.01, 0.02, 0.1)
    figure, axes = plt.subplots(len(results), len(times), figsize=(11, 2.4 * len(results)), layout="constrained", squeeze=False)
    for line, result in zip(axes, results):
        if result.status != 0:
            continue
        for axis, time in zip(line, times):
            particles = result.particles(time)
            # Half of it, from behind: the nearest to the eye come last.
            half = np.flatnonzero(particles["z"] < 0.05)
            order = half[np.argsort(particles["z"][half])]
            drawn = axis.scatter(particles["x"][order], particles["y"][order], c=particles["pressure"][order] / 1e6,
                                 s=40 * EDGE, vmin=-1, vmax=4, cmap="viridis", linewidths=0)
            axis.add_patch(plt.Circle((0, 0), RADIUS, fill=False, lw=0.8))
            axis.set(xlim=(-0.53, 0.53), ylim=(-0.53, 0.53), aspect="equal", xticks=[], yticks=[])
            axis.set_title(f"{result.run.label['body']}, t = {time} s", fontsize=9)
    figure.colorbar(drawn, ax=axes, shrink=0.7, label="pressure [MPa]", extend="both")
    figure.savefig(path, dpi=120)
    plt.close(figure)
