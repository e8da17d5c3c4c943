#!/usr/bin/env python3
"""Checks what a free body conserves, with every transfer, on statistics.csv.

Usage: run.py TALUS PRM WORK_DIRECTORY RANKS [MPIRUN ...] [-- "Section/Entry = value"...]

- Momentum, and what nodes of almost no mass have lost of it since the start: the largest change of the sum over M
  times the body's rms speed at the start is at most 1e-12. The body that flies without stress loses nothing.
- Angular momentum about the origin with APIC, the affine fields' share included: its largest change over its
  magnitude at the start is at most 1e-11.
- The run is a real one: at least 100 steps, and mass is kept.
"""
import csv
import math
import os
import shutil
import subprocess
import sys

TRANSFERS = ("FLIP", "PIC", "blend", "APIC", "TPIC")


def run(talus, prm, directory, mpirun, settings):
    shutil.rmtree(directory, ignore_errors=True)
    command = mpirun + [talus, prm] + [word for text in settings + [f"Output/Directory = {directory}"] for word in ("--set", text)]
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    result = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        sys.exit(f"FAIL {settings}: exit status {result.returncode}\n{result.stdout}")
    with open(os.path.join(directory, "statistics.csv")) as file:
        header, *rows = csv.reader(file)
    names = [name.split(" [")[0] for name in header]
    return {name: [float(value) for value in column] for name, column in zip(names, zip(*rows))}


def vectors(columns, name):
    """The vector of the columns "name x", "name y", "name z" that exist, for each row."""
    return list(zip(*(columns[f"{name} {axis}"] for axis in "xyz" if f"{name} {axis}" in columns)))


def drift(values):
    """Largest distance from the first value."""
    return max(math.dist(value, values[0]) for value in values)


def main():
    talus, prm, work, ranks, *others = sys.argv[1:]
    split = others.index("--") if "--" in others else len(others)
    mpirun, settings = others[:split] + ["-n", ranks] if ranks != "1" else [], others[split + 1:]
    n_failed = 0

    def check(name, error, bound):
        nonlocal n_failed
        is_good = error <= bound
        n_failed += not is_good
        print(f"{'  pass' if is_good else '  FAIL'} {name}: error / bound = {error / bound:.3g} (bound {bound:g})")

    for transfer in TRANSFERS:
        columns = run(talus, prm, os.path.join(work, transfer), mpirun, [f"Transfer/Type = {transfer}"] + settings)
        mass, energy = columns["mass"], columns["kinetic energy"]
        scale = mass[0] * math.sqrt(2 * energy[0] / mass[0])
        total = vectors(columns, "total angular momentum")
        spin_drift = drift(total) / math.hypot(*total[0])
        orbital_drift = drift(vectors(columns, "angular momentum")) / math.hypot(*total[0])
        momentum, lost = vectors(columns, "momentum"), list(zip(*(columns[name] for name in columns
                                                                  if name.startswith("lost momentum"))))
        balance = [tuple(map(sum, zip(*pair))) for pair in zip(momentum, lost)]
        print(f"{transfer}: {len(mass) - 1} steps; drift of momentum {drift(momentum) / scale:.2g}, "
              f"with the loss {drift(balance) / scale:.2g}, "
              f"of angular momentum {orbital_drift:.2g}, with affine part {spin_drift:.2g}; "
              f"kinetic energy at the end {energy[-1] / energy[0]:.4f} of that at the start")
        check("momentum and loss", drift(balance) / scale, 1e-12)
        if "flight" in os.path.basename(prm):
            check("momentum", drift(momentum) / scale, 1e-12)
        check("mass", max(abs(m - mass[0]) for m in mass) / mass[0], 1e-14 * len(mass))
        check("at least 100 steps", 100 / (len(mass) - 1), 1)
        if transfer == "APIC":
            check("total angular momentum", spin_drift, 1e-11)
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
