#!/usr/bin/env python3
"""Runs load_curve.prm and compares load_curve.csv with the closed form of uniaxial strain.

Usage: load_curve.py TALUS LOAD_CURVE_PRM WORK_DIRECTORY RANKS [MPIRUN ...]

With e the strain and q the von Mises stress: q = 2 G e below yield and Y + H a above, where the equivalent plastic
strain is a = (2 G e - Y)/(3 G + H); the stress is K e + 2/3 q.
"""
import csv
import os
import shutil
import subprocess
import sys

E, NU, Y, H = 1e3, .25, 10., 100.
K, G = E / 3 / (1 - 2 * NU), E / 2 / (1 + NU)


def stress(strain):
    q = 2 * G * strain
    if q > Y:
        q = Y + H * (q - Y) / (3 * G + H)
    return K * strain + 2 / 3 * q


def main():
    talus, prm, directory, ranks = sys.argv[1:5]
    mpirun = sys.argv[5:] + ["-n", ranks] if ranks != "1" else []
    shutil.rmtree(directory, ignore_errors=True)
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    result = subprocess.run(mpirun + [talus, prm, "--set", f"Output/Directory = {directory}"], env=environment,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        sys.exit(f"FAIL exit status {result.returncode}\n{result.stdout}")
    with open(os.path.join(directory, "load_curve.csv")) as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    n_failed = 0

    def check(name, error, bound):
        nonlocal n_failed
        n_failed += not abs(error) <= bound
        print(f"{'pass' if abs(error) <= bound else 'FAIL'} {name}: error / bound = {abs(error) / bound:.3g}")

    check("number of rows", len(rows) - 9, 0.5)
    check("end time", rows[-1]["time [time]"] - 2, 1e-12)
    for row in rows:
        shift = 0.05 * row["time [time]"]
        exact = stress(shift / 2)  # the block is 2 high and 1 wide
        check(f"displacement at t = {row['time [time]']:g}", row["displacement top y [length]"] + shift, 1e-12)
        check("  force on the top", (row["force top y [force]"] - exact) / Y, 1e-8)
        check("  force on the bottom", (row["force bottom y [force]"] + exact) / Y, 1e-8)
    check("summary", 0 if "force on top" in result.stdout else 1, 0.5)
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
