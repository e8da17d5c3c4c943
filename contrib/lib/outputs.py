"""What a run has left in its directory, read from its .vtu files and tables."""
import csv
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

import numpy as np

AXES = "xyz"
TENSORS = {6: ("xx", "yy", "zz", "xy", "yz", "xz"), 9: tuple(a + b for a in AXES for b in AXES)}  # by number of components


class Particles:
    """Places (n, 3) and fields of the particles at a time. Vectors are (n, 3), components of tensors are fields of their own."""

    def __init__(self, path, time):
        import meshio  # here, as tables need no reader of .vtu files
        mesh = meshio.read(path)
        self.directory = pathlib.Path(path).resolve().parent
        self.time, self.places, self.fields = time, mesh.points, {}
        for name, values in mesh.point_data.items():
            components = TENSORS.get(values.shape[1] if values.ndim == 2 else 1)
            self.fields.update({f"{name}_{c}": values[:, k] for k, c in enumerate(components)} if components else {name: values})
        self.dim = 2 if np.all(self.places[:, 2] == 0) else 3

    def field(self, name):
        """One number a particle: a scalar, `velocity_x`, or the length of a vector."""
        key = name.strip().replace(" ", "_")
        if key in self.fields:
            values = self.fields[key]
            return np.linalg.norm(values, axis=1) if values.ndim == 2 else values
        vector, _, axis = key.rpartition("_")
        if vector in self.fields and axis in AXES[:self.dim]:
            return self.fields[vector][:, AXES.index(axis)]
        known = sorted(self.fields)
        sys.exit(f"contrib/plot: particles have no field '{name}'. They have: {', '.join(known)}; 'Output/Particle fields' chooses.")

    def side(self):
        """Edge of a particle's box: from its volume, or the distance of neighbours at the start."""
        if "volume" in self.fields:
            return np.abs(self.fields["volume"])**(1 / self.dim)
        start = self.places - self.fields["displacement"] if "displacement" in self.fields else self.places
        some = start[np.linspace(0, len(start) - 1, min(300, len(start))).astype(int)]
        near = [np.sort(np.sum((start - x)**2, axis=1))[1:2] for x in some]
        distance = np.sqrt(np.median(np.concatenate(near))) if len(start) > 1 else 1.
        return np.full(len(start), distance)

    def start_side(self):
        """The same at the start, where F has been written with the volume."""
        F = self.deformation(AXES[:self.dim])
        side = self.side()
        return side / np.abs(np.linalg.det(F))**(1 / self.dim) if "volume" in self.fields and F is not None else side

    def deformation(self, axes):
        """F's components along some axes (n, k, k), or nothing."""
        names = [f"deformation_gradient_{a}{b}" for a in axes for b in axes]
        if any(name not in self.fields for name in names):
            return None
        return np.stack([self.fields[name] for name in names], axis=1).reshape(-1, len(axes), len(axes))

    def domains(self, axes=(0, 1)):
        """Corners (n, 4, 2) of the particles' parallelograms in a plane; squares where F has not been written."""
        F, x = self.deformation([AXES[k] for k in axes]), self.places[:, axes]
        if F is None:
            return parallelograms(x, np.eye(2) * self.side()[:, None, None])
        return parallelograms(x, np.transpose(F, (0, 2, 1)) * self.start_side()[:, None, None])


def parallelograms(centres, edges):
    """Corners (n, 4, 2), one after the other around; edges (n, 2, 2): one edge a row."""
    corners = [centres + s * edges[:, 0] + t * edges[:, 1] for s, t in ((-.5, -.5), (.5, -.5), (.5, .5), (-.5, .5))]
    return np.stack(corners, axis=1)


def series(directory):
    """Times and paths of the particle outputs."""
    path = pathlib.Path(directory) / "particles.pvd"
    if not path.exists():
        sys.exit(f"contrib/plot: there is no '{path}': no run has written particles there.")
    found = [(float(entry.get("timestep")), path.parent / entry.get("file")) for entry in xml.parse(path).iter("DataSet")]
    if not found:
        sys.exit(f"contrib/plot: '{path}' names no output.")
    return found


def table(directory, name):
    """Columns of a table by name, and their units. Columns that hold no numbers are left out."""
    path = pathlib.Path(directory) / name
    if not path.exists():
        sys.exit(f"contrib/plot: there is no '{path}'.")
    with open(path, newline="") as file:
        lines = [line for line in file if not line.startswith("#")]
    heads, *rows = list(csv.reader(lines))
    columns, units = {}, {}
    for c, head in enumerate(heads):
        key = head.split(" [")[0].replace("_", " ")
        try:
            columns[key] = np.array([float(row[c]) for row in rows])
        except ValueError:
            continue
        units[key] = head.partition("[")[2].rstrip("]")
    return columns, units


def column(columns, name, path):
    key = name.strip().replace("_", " ")
    if key not in columns:
        sys.exit(f"contrib/plot: '{path}' has no column '{name}'. It has: {', '.join(columns)}.")
    return columns[key]


def spacing(directory):
    """Of the grid, as the run's own parameters say."""
    text = (pathlib.Path(directory) / "parameters.prm").read_text()
    found = re.search(r"^subsection Grid$.*?^\s*set Spacing\s*=\s*([0-9.eE+-]+)", text, re.M | re.S)
    if not found:
        sys.exit(f"contrib/plot: '{directory}/parameters.prm' has no 'Spacing' of the grid: runs that give 'Cells' cannot be put in order.")
    return float(found[1])
