#!/usr/bin/env python3
"""Runs prm/shear.prm on a coarse grid, h = 1/10, and checks comparison.csv.

Usage: shear.py TALUS SHEAR_PRM WORK_DIRECTORY RANKS [MPIRUN ...]

The error of the corrected scheme falls with h: at 1/20 and 1/40 the plate region's rms may be 1.3 and 0.7 %, so
that 2.6 % is its bound here. Without correction it is 17 to 23 % at every spacing. The core's error is of second
order, at most 0.3 % at 1/20 and four times that here. The force on a plate agrees within 0.6 % at 1/20.
The plate region is two spacings high. The reference on 40 x 40 cells is within .1 % of the finest.
"""
import csv
import os
import shutil
import subprocess
import sys

COARSE = ("Grid/Lower corner = -0.55, 0", "Grid/Upper corner = 1.55, 1", "Grid/Spacing = 0.1",
          "FEM reference/Cells = 40, 40",
          "FEM reference/Regions/plate/Where = (y < 0.2 || y > 0.8) && x > 0.25 && x < 0.75")


def run(talus, prm, directory, mpirun, treatment):
    shutil.rmtree(directory, ignore_errors=True)
    settings = COARSE + (f"Kernel/Boundary treatment = {treatment}", f"Output/Directory = {directory}")
    command = mpirun + [talus, prm] + [word for text in settings for word in ("--set", text)]
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    result = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        sys.exit(f"FAIL {treatment}: exit status {result.returncode}\n{result.stdout}")
    with open(os.path.join(directory, "comparison.csv")) as file:
        return {(row["quantity"], row["name"]): float(row["value"]) for row in csv.DictReader(file)}


def main():
    talus, prm, work, ranks = sys.argv[1:5]
    mpirun = sys.argv[5:] + ["-n", ranks] if ranks != "1" else []
    n_failed = 0

    def check(name, value, low, high):
        nonlocal n_failed
        error = abs(value - (low + high) / 2) / ((high - low) / 2)
        n_failed += not error <= 1
        print(f"{'pass' if error <= 1 else 'FAIL'} {name} = {value:.5g}, in {low:g} .. {high:g}: "
              f"error / bound = {error:.3g}")

    corrected = run(talus, prm, os.path.join(work, "WLS"), mpirun, "WLS")
    uncorrected = run(talus, prm, os.path.join(work, "Steffen"), mpirun, "Steffen")
    check("corrected plate rms [%]", corrected["stress error rms", "plate"], 0, 2.6)
    check("corrected core rms [%]", corrected["stress error rms", "core"], 0, 1.2)
    check("uncorrected plate rms [%]", uncorrected["stress error rms", "plate"], 17, 23)
    force = corrected["force x", "top"] / corrected["reference force x", "top"]
    check("corrected force over reference", force, 1 - 0.012, 1 + 0.012)
    check("reference force [N/m]", abs(corrected["reference force x", "top"]), 25914 * (1 - 2e-3), 25914 * (1 + 2e-3))
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
