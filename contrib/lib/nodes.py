"""Fields of the nodes from the files that a run writes of its grid."""
import base64
import re
import zlib

import numpy as np

TYPES = {"Float32": np.float32, "Float64": np.float64}


def array(text, pattern):
    """The numbers of the first DataArray whose head matches, a row for each point: one compressed block in base64."""
    found = re.search(rf'<DataArray type="(\w+)"([^>]*{pattern}[^>]*)>\s*([^<]*?)\s*</DataArray>', text)
    values = np.frombuffer(zlib.decompress(base64.b64decode(found[3][24:])), TYPES[found[1]]).astype(float)
    columns = re.search(r'NumberOfComponents="(\d+)"', found[2])
    return values.reshape(-1, int(columns[1]) if columns else 1)


def read(path):
    """Places, masses and velocities of all nodes, each once: the file has them for each of their cells."""
    text = path.read_text()
    points = array(text[text.index("<Points>"):], "")
    _, kept = np.unique(np.round(points, 9), axis=0, return_index=True)
    return points[kept], array(text, 'Name="mass"')[kept, 0], array(text, 'Name="velocity"')[kept]


def momenta(result):
    """
    Times, the sums m_i v_i, and about the z axis m_i x_i x v_i, of all states that the run has written but the first,
    before which nodes have no velocity.
    """
    states = re.findall(r'timestep="([^"]+)"[^>]*file="([^"]+)"', (result.directory / "grid.pvd").read_text())
    times, linear, angular = [], [], []
    for time, name in states[1:]:
        x, m, v = read(result.directory / name)
        times.append(float(time))
        linear.append(m @ v)
        angular.append(m @ (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0]))
    return np.array(times), np.array(linear), np.array(angular)
