"""Meshes of benchmarks, by gmsh (Debian's package of that name) or point by point, and what figures need of them."""
import math
import subprocess

import numpy as np
import runs
from matplotlib.tri import Triangulation

DIRECTORY = runs.ROOT / "prm" / "meshes"


def make(name, dim, target=None, **numbers):
    """prm/meshes/TARGET.msh (NAME.msh) from NAME.geo, with other values of its numbers where given; its path."""
    command = ["gmsh", f"-{dim}", "-format", "msh41", f"{name}.geo", "-o", f"{target or name}.msh"]
    for key, value in numbers.items():
        command += ["-setnumber", key, str(value)]
    finished = subprocess.run(command, cwd=DIRECTORY, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
    if finished.returncode != 0:
        runs.stop(f"gmsh has failed:\n{finished.stdout[-2000:]}")
    return DIRECTORY / f"{target or name}.msh"


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


def read_triangles(path):
    """Nodes (n x 2) and triangles (m x 3, places in the nodes) of a file in MSH 4.1, ASCII."""
    lines = iter(path.read_text().splitlines())
    position, triangles = {}, []
    for line in lines:
        if line == "$Nodes":
            for _ in range(int(next(lines).split()[0])):
                n = int(next(lines).split()[3])
                tags = [int(next(lines)) for _ in range(n)]
                for tag in tags:
                    position[tag] = [float(word) for word in next(lines).split()[:2]]
        elif line == "$Elements":
            for _ in range(int(next(lines).split()[0])):
                _, _, kind, n = (int(word) for word in next(lines).split())
                elements = [next(lines).split() for _ in range(n)]
                if kind == 2:
                    triangles += [[int(word) for word in element[1:]] for element in elements]
    place = {tag: k for k, tag in enumerate(position)}
    return np.array(list(position.values())), np.array([[place[tag] for tag in triangle] for triangle in triangles])


def turn(path, degrees):
    """Turns the nodes of a file in MSH 4.1 about the origin, and puts those on the axes by round-off onto them."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turned, is_node = [], False
    for line in path.read_text().splitlines():
        if line.startswith("$"):
            is_node = line == "$Nodes"
        words = line.split()
        if is_node and len(words) == 3:
            x, y = float(words[0]), float(words[1])
            line = " ".join(repr(round(value, 12) + 0.) for value in (c * x - s * y, s * x + c * y)) + " 0"
        turned.append(line)
    path.write_text("\n".join(turned) + "\n")


def centroids(path):
    """Centroids and areas of its triangles."""
    nodes, triangles = read_triangles(path)
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    return (a + b + c) / 3, 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])


def write_points(path, points, volumes):
    np.savetxt(path, np.column_stack((points, volumes)), fmt="%.17g")


def turned_lattice(name, lower, upper, h, degrees):
    """
    A box with nodes at distances of h on its sides and, within, on a square lattice turned about its lower corner, joined by
    Delaunay's method. Sides are groups: "wall", the lower one in x, and "outer".
    """
    lower, upper = np.array(lower, float), np.array(upper, float)
    n = np.round((upper - lower) / h).astype(int)
    x, y = (np.linspace(lower[d], upper[d], n[d] + 1) for d in range(2))
    sides = ([(lower[0], value) for value in y] + [(upper[0], value) for value in y]
             + [(value, lower[1]) for value in x[1:-1]] + [(value, upper[1]) for value in x[1:-1]])
    reach = np.arange(-2 * max(n), 2 * max(n) + 1) * h
    u, v = (grid.ravel() for grid in np.meshgrid(reach, reach))
    # A little sheared, so that it is the same diagonal in all squares.
    u = u + 1e-5 * v
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    inner = lower + np.column_stack((c * u - s * v, s * u + c * v))
    inner = inner[np.all((inner > lower + 0.55 * h) & (inner < upper - 0.55 * h), axis=1)]
    nodes = np.vstack((sides, inner))
    triangulation = Triangulation(nodes[:, 0], nodes[:, 1])
    a, b, d = (nodes[triangulation.triangles[:, k]] for k in range(3))
    area = (b - a)[:, 0] * (d - a)[:, 1] - (b - a)[:, 1] * (d - a)[:, 0]
    path = DIRECTORY / f"{name}.msh"
    write(path, nodes, triangulation.triangles[np.abs(area) > 1e-6 * h * h], lower)
    return path


def crossed_strip(name, length, h, ratio=1):
    """
    Squares with sides of h in a row from x = 0, each cut into four triangles around its centre: the mesh is its own mirror
    image at each of its nodes. With a ratio they are long and short in turn. Groups: "wall" at x = 0, and "outer".
    """
    n = round(length / h)
    widths = np.where(np.arange(n) % 2 == 0, ratio, 1.)
    x = np.concatenate(([0], np.cumsum(widths))) * length / widths.sum()
    nodes = np.vstack([np.column_stack((x, np.zeros(n + 1))), np.column_stack((x, np.full(n + 1, h))),
                       np.column_stack(((x[1:] + x[:-1]) / 2, np.full(n, h / 2)))])
    k = np.arange(n)
    a, b, c, d, m = k, k + 1, k + n + 2, k + n + 1, k + 2 * (n + 1)
    triangles = np.vstack([np.column_stack(corners) for corners in ((a, b, m), (b, c, m), (c, d, m), (d, a, m))])
    path = DIRECTORY / f"{name}.msh"
    write(path, nodes, triangles, (0, 0))
    return path


def write(path, nodes, triangles, lower):
    """MSH 4.1; faces at the lower x are "wall", all others "outer"."""
    edges = np.sort(np.vstack([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    boundary = unique[counts == 1]
    is_wall = np.all(np.abs(nodes[boundary][:, :, 0] - lower[0]) < 1e-12, axis=1)
    groups = (boundary[is_wall], boundary[~is_wall])
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    box = f"{low[0]!r} {low[1]!r} 0 {high[0]!r} {high[1]!r} 0".replace("np.float64(", "").replace(")", "")
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", "3", '1 10 "wall"', '1 11 "outer"', '2 1 "box"',
             "$EndPhysicalNames", "$Entities", "0 2 1 0", f"1 {box} 1 10 0", f"2 {box} 1 11 0", f"1 {box} 1 1 0",
             "$EndEntities", "$Nodes", f"1 {len(nodes)} 1 {len(nodes)}", f"2 1 0 {len(nodes)}"]
    lines += [str(k + 1) for k in range(len(nodes))] + [f"{float(x)!r} {float(y)!r} 0" for x, y in nodes]
    n = sum(map(len, groups)) + len(triangles)
    lines += ["$EndNodes", "$Elements", f"3 {n} 1 {n}"]
    number = 1
    for entity, (dimension, kind, elements) in enumerate(((1, 1, groups[0]), (1, 1, groups[1]), (2, 2, triangles))):
        lines.append(f"{dimension} {entity % 2 + 1 if dimension == 1 else 1} {kind} {len(elements)}")
        for element in elements:
            lines.append(f"{number} " + " ".join(str(v + 1) for v in element))
            number += 1
    lines += ["$EndElements"]
    path.write_text("\n".join(lines) + "\n")
