#!/usr/bin/env python3
"""
Every registered object has a row in doc/index.md, and every entry of the files in prm a help text, with its unit where it is a
quantity. Usage: help.py TALUS ROOT
"""
import os
import pathlib
import re
import subprocess
import sys

# Numbers that count, choose or name something have no unit.
COUNTS = {"Cells", "Degree", "Dimension", "F-bar averages", "Layers", "Number of steps", "Particles", "Particles per cell and direction",
          "Points per cell edge", "Rows", "Seed", "Steps", "Where"}
IN_SECONDS = {"Clock interval"}  # its help says so in words


def run(talus, *arguments):
    found = subprocess.run([talus, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                           env={**os.environ, "OMP_NUM_THREADS": "1"})
    if found.returncode:
        sys.exit(f"FAIL talus {' '.join(arguments)}: exit status {found.returncode}\n{found.stdout}")
    return found.stdout


def without_page(talus, root):
    """Objects of --list that doc/index.md does not name."""
    index = (root / "doc" / "index.md").read_text()
    rows = [re.match(r"(.{20})(\S.*?)  ", line).groups() for line in run(talus, "--list").splitlines() if line.strip()]
    return [f"{kind.strip()} '{name}' has no row in doc/index.md" for kind, name in rows if f"`{name}`" not in index]


def entries(text):
    """Section/entry, value and help of what --parameters prints."""
    path, comment = [], []
    for line in text.splitlines():
        words = line.strip()
        if words.startswith("#"):
            comment.append(words[1:].strip())
            continue
        found = re.match(r"set (.*?)\s*= ?(.*?)(\s+# default: (.*))?$", words)
        if words.startswith("subsection "):
            path.append(words[11:])
        elif words == "end":
            path.pop()
        elif found:
            yield "/".join(path + [found[1]]), found[4] if found[3] else found[2].strip(), " ".join(comment)
        comment = []


def is_quantity(value):
    return re.fullmatch(r"[-+]?[0-9.]+(e[-+]?\d+)?(\s*,\s*[-+]?[0-9.]+(e[-+]?\d+)?)*", value) is not None


def main():
    talus, root = sys.argv[1], pathlib.Path(sys.argv[2])
    faults, seen = without_page(talus, root), set()
    os.chdir(root)
    for path in sorted([*root.glob("prm/*.prm"), *root.glob("prm/element/*.prm")]):
        text = path.read_text()
        mode = ["--element"] if "subsection Element" in text else []
        if path.parent.name == "element" and not mode:
            continue  # included by others
        if path.name.endswith("_common.prm") or "prm/meshes/" in text:
            continue  # included by others; needs a mesh that is not in the repository
        for name, value, text in entries(run(talus, "--parameters", *mode, str(path.relative_to(root)))):
            key = (name.split("/")[-1], text)
            if key in seen:
                continue
            seen.add(key)
            if not text:
                faults.append(f"{path.name}: '{name}' has no help")
            elif is_quantity(value) and "[" not in text and name.split("/")[-1] not in COUNTS | IN_SECONDS:
                faults.append(f"{path.name}: '{name}' = {value} has no unit: {text}")
    for fault in faults:
        print("  FAIL", fault)
    print(f"  {len(seen)} different entries")
    sys.exit(1 if faults or len(seen) < 100 else 0)


if __name__ == "__main__":
    main()
