"""Runs the files of prm/gallery and draws each as its first lines say."""
import argparse
import pathlib
import re
import shlex
import subprocess
import sys

import reproduce
import runs

FILES = runs.ROOT / "prm" / "gallery"


def plot_arguments(path):
    """Those of the command `contrib/plot output-NAME ...` in the file's head, without the directory."""
    found = re.search(r"^# contrib/plot \S+ (.*)$", path.read_text(), re.M)
    return shlex.split(found[1])


def show(name, target, is_for_doc):
    path = FILES / f"{name}.prm"
    result = runs.execute(runs.Run(f"prm/gallery/{name}.prm", {}, {"name": name}), target)
    if result.status:
        print(f"{name}: {result.message}")
        return 1
    picture = target / f"{name}.png"
    subprocess.run([sys.executable, "-B", str(runs.ROOT / "contrib/lib/plot.py"), str(target / name), *plot_arguments(path),
                    "--panels", "6", "--output", str(picture)], check=True, stdout=subprocess.DEVNULL)
    print(f"{picture} ({result.seconds:.0f} s)", flush=True)
    if is_for_doc:
        reproduce.write_rendition(picture, reproduce.FIGURES / f"gallery_{name}.png")
    return 0


def main():
    known = sorted(path.stem for path in FILES.glob("*.prm"))
    parser = argparse.ArgumentParser(prog="contrib/gallery", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"these alone: {', '.join(known)}")
    parser.add_argument("--doc", action="store_true", help="also write the pictures, reduced, to doc/figures")
    arguments = parser.parse_args()
    for name in arguments.names:
        if name not in known:
            parser.error(f"there is no '{name}': {', '.join(known)}")
    return max(show(name, runs.ROOT / "gallery", arguments.doc) for name in arguments.names or known)


if __name__ == "__main__":
    sys.exit(main())
