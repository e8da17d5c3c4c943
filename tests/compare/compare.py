#!/usr/bin/env python3
"""Runs one .prm in several variants and compares their statistics.csv column by column.

Usage: compare.py TALUS PRM WORK_DIRECTORY MPIRUN VARIANT VARIANT... [--set "Section/Entry = value"]...

A variant is a number of ranks, and entries that it alone sets: "4" or "2, Output/Step interval = 1".
--set is for all variants. MPIRUN is one word, to be split at blanks.

The difference is that of a column's values over the column's largest magnitude, at most 1e-10. A column that is
zero up to round-off has no magnitude of its own: below 1e-6 of the largest magnitude among the columns of its
unit, which the header names in brackets, that one is its scale. Exact integers and the step size are compared alike.

Every variant on several ranks must have sent particles from rank to rank: the log counts the migrations.
"""
import argparse
import csv
import os
import re
import shutil
import subprocess
import sys

BOUND = 1e-10
ROUND_OFF = 1e-6


def run(talus, prm, directory, mpirun, variant, settings):
    ranks, *own = [part.strip() for part in variant.split(",")]
    settings = settings + own + [f"Output/Directory = {directory}"]
    shutil.rmtree(directory, ignore_errors=True)
    command = mpirun.split() + ["-n", ranks, talus, prm] + [word for text in settings for word in ("--set", text)]
    environment = dict(os.environ, OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    result = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        sys.exit(f"FAIL variant '{variant}': exit status {result.returncode}\n{result.stdout}")
    with open(os.path.join(directory, "log.txt")) as file:
        migrations = re.search(r"(\d+) migrations between ranks", file.read())
    n_migrations = int(migrations.group(1)) if migrations else 0
    with open(os.path.join(directory, "statistics.csv")) as file:
        header, *rows = csv.reader(file)
    return int(ranks), n_migrations, header, [[float(value) for value in row] for row in rows]


def scales(header, columns):
    """What each column's differences are divided by."""
    magnitudes = [max(abs(value) for value in column) for column in columns]
    of_unit = {}
    for name, magnitude in zip(header, magnitudes):
        unit = name[name.find("["):]
        of_unit[unit] = max(of_unit.get(unit, 0), magnitude)
    result = []
    for name, magnitude in zip(header, magnitudes):
        unit_magnitude = of_unit[name[name.find("["):]]
        # A residual is a difference of columns: it has their round-off, however small it is itself.
        is_small = magnitude < ROUND_OFF * unit_magnitude or "residual" in name
        result.append(unit_magnitude if is_small else magnitude)
    return result


def largest_difference(header, columns, others):
    """The largest scaled difference and the name of its column."""
    worst = (0., "none")
    for name, scale, column, other in zip(header, scales(header, columns), columns, others):
        difference = max(abs(a - b) for a, b in zip(column, other))
        if difference > 0:
            worst = max(worst, (difference / scale if scale > 0 else float("inf"), name))
    return worst


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("talus")
    parser.add_argument("prm")
    parser.add_argument("work")
    parser.add_argument("mpirun")
    parser.add_argument("variants", nargs="+")
    parser.add_argument("--set", action="append", default=[])
    arguments = parser.parse_args()

    first, n_failed = None, 0
    for number, variant in enumerate(arguments.variants):
        directory = os.path.join(arguments.work, str(number))
        ranks, n_migrations, header, rows = run(arguments.talus, arguments.prm, directory, arguments.mpirun,
                                                      variant, arguments.set)
        problems = []
        text = f"variant '{variant}': {len(rows)} rows, {n_migrations} migrations"
        if ranks > 1 and n_migrations == 0:
            problems.append("no particle has crossed the ranks' borders")
        if first is None:
            first = (header, list(zip(*rows)))
        elif (header, len(rows)) != (first[0], len(first[1][0])):
            problems.append(f"other columns, or other rows than {len(first[1][0])}")
        else:
            difference, name = largest_difference(header, first[1], list(zip(*rows)))
            text += f"; difference / bound = {difference / BOUND:.3g} in '{name}'"
            if not difference <= BOUND:
                problems.append("the difference is too large")
        print(("FAIL " if problems else "pass ") + text + "".join("\n    " + problem for problem in problems))
        n_failed += bool(problems)
    return n_failed > 0


if __name__ == "__main__":
    sys.exit(main())
