#!/usr/bin/env python3
"""
Commands that a page prints in its indented blocks run in the order printed, in a directory as after cloning and building.
Usage: commands.py PAGE BUILD WORK [MPIRUN ...]. What takes minutes is only asked for its help.
"""
import os
import shlex
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SLOW = ("contrib/gallery", "contrib/manual", "contrib/quickstart", "contrib/test", "contrib/report", "contrib/throughput", "contrib/reproduce")


def commands(path):
    """Lines of indented blocks that begin with a program of this directory, without what follows a #."""
    found = []
    with open(path) as page:
        for line in page:
            if line.startswith(("    build/", "    contrib/", "    mpirun ")):
                found.append(shlex.split(line, comments=True))
    return found


def prepare(work, build):
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    for name in ("contrib", "prm", "doc"):
        os.symlink(os.path.join(ROOT, name), os.path.join(work, name))
    os.symlink(build, os.path.join(work, "build"))


def main():
    page, build, work, *mpirun = sys.argv[1:]
    prepare(work, build)
    n_failed, found = 0, commands(os.path.join(ROOT, page))
    for words in found:
        if words[0] == "mpirun":
            words = (mpirun or ["mpirun"]) + words[1:]
        elif words[0] in SLOW and "--list" not in words:
            words = [words[0], "--help"]
        result = subprocess.run(words, cwd=work, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                env={**os.environ, "OMP_NUM_THREADS": "1"})
        n_failed += result.returncode != 0
        print(f"{'  pass' if result.returncode == 0 else '  FAIL'} {shlex.join(words)}"
              + (f": exit status {result.returncode}\n{result.stdout[-2000:]}" if result.returncode else ""))
    if not found:
        n_failed = 1
        print(f"  FAIL {page} has no commands")
    sys.exit(1 if n_failed else 0)


if __name__ == "__main__":
    main()
