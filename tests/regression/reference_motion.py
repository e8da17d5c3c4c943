#!/usr/bin/env python3
"""Runs reference_motion.prm and compares fem_motion.csv with the closed form of a column's motion.

Usage: reference_motion.py TALUS REFERENCE_MOTION_PRM WORK_DIRECTORY RANKS [MPIRUN ...]

Height, wave speed and period/4 are 1: the top falls freely until the wave from the floor arrives at t = 1, and comes to
rest at t = 2: u = -g t^2/2, then -g (1/2 + (t - 1) - (t - 1)^2/2).
"""
import csv
import os
import shutil
import subprocess
import sys

G = 1e-6


def top(t):
    return -G * t * t / 2 if t < 1 else -G * (.5 + (t - 1) - (t - 1) ** 2 / 2)


def main():
    talus, prm, directory, ranks = sys.argv[1:5]
    mpirun = sys.argv[5:] + ["-n", ranks] if ranks != "1" else []
    shutil.rmtree(directory, ignore_errors=True)
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    result = subprocess.run(mpirun + [talus, prm, "--set", f"Output/Directory = {directory}"], env=environment,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        sys.exit(f"FAIL exit status {result.returncode}\n{result.stdout}")
    with open(os.path.join(directory, "fem_motion.csv")) as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    n_failed = 0

    def check(name, error, bound):
        nonlocal n_failed
        n_failed += not abs(error) <= bound
        print(f"{'pass' if abs(error) <= bound else 'FAIL'} {name}: error / bound = {abs(error) / bound:.3g}")

    check("number of rows", len(rows) - 21, 0.5)
    check("end time", rows[-1]["time [time]"] - 2, 1e-12)
    for row in rows:
        t = row["time [time]"]
        check(f"top at t = {t:g}", (row["displacement 0 y [length]"] - top(t)) / G, 5e-3)
        check("  floor", row["displacement 1 y [length]"] / G, 1e-12)
        energy = row["kinetic energy [energy]"] + row["strain energy [energy]"]
        check("  energy over its greatest", (energy - row["work [energy]"]) / (.2 * 2 * G * G / 2), 1e-3)
    check("summary", 0 if "Dynamic finite element reference" in result.stdout else 1, 0.5)
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
