"""Meshes of benchmarks, made by gmsh (Debian's package of that name), and what figures need of them."""
import subprocess

import numpy as np
import runs


def make(name, dim, **numbers):
    """prm/meshes/NAME.msh from NAME.geo, with other values of its numbers where given."""
    command = ["gmsh", f"-{dim}", "-format", "msh41", f"{name}.geo", "-o", f"{name}.msh"]
    for key, value in numbers.items():
        command += ["-setnumber", key, str(value)]
    finished = subprocess.run(command, cwd=runs.ROOT / "prm" / "meshes", text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
    if finished.returncode != 0:
        runs.stop(f"gmsh has failed:\n{finished.stdout[-2000:]}")


def points(path, name, positions, volume):
    """A file of points for a body of shape `points`."""
    with open(path, "w") as file:
        file.write(f"# {name}\n")
        for x in positions:
            file.write(" ".join(repr(float(c)) for c in x) + f" {volume!r}\n")


def impulses(columns, g, axes="xy", surfaces=()):
    """
    Largest change of the momentum that neither weight nor the reactions of conditions and contacts explain, over the
    greatest momentum; `columns`: statistics of every step, `surfaces`: their columns with the sign of the force on the body.
    """
    error, scale = 0., 0.
    steps = columns["step size"][1:]
    for k, axis in enumerate(axes):
        force = columns["mass"][1:] * g[k]
        for name, sign in surfaces:
            force = force + sign * columns[f"{name} {axis}"][1:]
        p = columns[f"momentum {axis}"]
        lost = columns[f"lost momentum {axis}"]
        error = max(error, np.max(np.abs(p[1:] + lost[1:] - p[0] - np.cumsum(force * steps))))
        scale = max(scale, np.max(np.abs(p)))
    return error / scale
