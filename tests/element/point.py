"""Points of materials: what the drivers here share."""
import math
import os
import sys

from program import columns_of

SOIL = {"Type": "Mohr-Coulomb", "Density": 1600, "Young's modulus": 2e7, "Poisson's ratio": 0.3}


def section(name, entries):
    """Of a parameter file; an entry that is a dict is a section within."""
    lines = [f"subsection {name}"]
    for entry, value in entries.items():
        lines += [section(entry, value)] if isinstance(value, dict) else [f"set {entry} = {value}"]
    return "\n".join(lines + ["end"])


def write(name, law, element, interval=1):
    """The file `name`.prm of a point, with its output in the directory `name`."""
    os.makedirs(os.path.dirname(name), exist_ok=True)
    output = {"Directory": name, "Overwrite": "true", "Statistics interval": interval}
    with open(name + ".prm", "w") as file:
        file.write("\n".join([section("Materials", {"Names": "soil", "soil": law}), section("Element", element),
                              section("Output", output)]))


def point(runs, name, law, element, interval=1):
    """The table of a point by columns, with a row after each so many steps."""
    name = os.path.join(runs.work, name)
    write(name, law, element, interval)
    status, text = runs.start(["--element", name + ".prm"])
    if status != 0:
        sys.exit(f"FAIL {name}: exit status {status}\n{text}")
    return columns_of(os.path.join(name, "element.csv"))


def surface(angle, c):
    """sin phi and 2 c cos phi."""
    return math.sin(math.radians(angle)), 2 * c * math.cos(math.radians(angle))
