#!/usr/bin/env python3
"""Runs prm/dam_break.prm with a viscous liquid, whose viscosity limits the step size.

Usage: viscous.py TALUS DAM_BREAK_PRM WORK_DIRECTORY RANKS [MPIRUN ...]

nu = 100, h = .04, c = 50: at Courant number 1 the first step is 1 / (c/h + 4 nu/h^2), near the explicit limit
h^2 / (4 nu) = 4e-6 of viscous stress. The run is stable with it; with 1.5 times the limit as a fixed step it is not.
"""
import csv
import os
import shutil
import subprocess
import sys

VISCOUS = ("Kernel/Boundary treatment = WLS", "Materials/water/Viscosity = 1e5", "Run/Courant number = 1",
           "Run/End time = 4e-3", "Output/Time interval = 0")


def run(talus, prm, directory, mpirun, *more):
    """Exit status, text, and the rows of statistics.csv."""
    shutil.rmtree(directory, ignore_errors=True)
    settings = VISCOUS + (f"Output/Directory = {directory}",) + more
    command = mpirun + [talus, prm] + [word for text in settings for word in ("--set", text)]
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    result = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    with open(os.path.join(directory, "statistics.csv")) as file:
        return result.returncode, result.stdout, list(csv.reader(file))


def main():
    talus, prm, work, ranks = sys.argv[1:5]
    mpirun = sys.argv[5:] + ["-n", ranks] if ranks != "1" else []
    n_failed = 0

    def check(name, holds, text):
        nonlocal n_failed
        n_failed += not holds
        print(f"{'pass' if holds else 'FAIL'} {name}: {text}")

    status, text, rows = run(talus, prm, os.path.join(work, "chosen"), mpirun)
    check("step by the Courant number: exit status 0", status == 0, status if status == 0 else text)
    error = float(rows[2][2]) * (50 / 0.04 + 4 * 100 / 0.04**2) - 1
    check("first step", abs(error) <= 1e-12, f"error / bound = {abs(error) / 1e-12:.3g}")
    status, text, rows = run(talus, prm, os.path.join(work, "fixed"), mpirun, "Run/Step size = 6e-6")
    check("1.5 times the limit: exit status 2", status == 2 and "unstable" in text, status)
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
