"""Runs a fixed set of short cases and prints, for each, a digest of the particles' ids and columns and one of the
statistics. With --against it runs another build's program too and prints what differs: nothing, or the largest relative
difference, over the largest magnitude of a column (of the statistics: or of its unit, where a column is round-off).

A build is a directory that holds `talus` and `libtalus.so`: a build directory, or a copy of these two files. Digests
belong to a machine and a compiler; keep a build to compare with, not a digest."""
import argparse
import concurrent.futures
import csv
import dataclasses
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
import runs
from fingerprint_cases import ALL_CONDITIONS, ALL_KERNELS, ALL_MATERIALS, ALL_TRANSFERS, TREATMENTS, all_cases

sys.path.insert(0, str(runs.ROOT / "tests" / "compare"))
import compare  # noqa: E402


class Build:
    """A program and its library. Programs know where their library was built; this one takes that beside it."""

    def __init__(self, directory):
        directory = pathlib.Path(directory).resolve()
        self.talus, self.library = directory / "talus", directory / "libtalus.so"
        for file in (self.talus, self.library):
            if not file.exists():
                runs.stop(f"there is no '{file}'. Build it, or name another directory.")
        self.unknown = set()  # entries that an older program lacks

    def command(self, ranks, *arguments):
        line = ["env", f"LD_PRELOAD={self.library}", str(self.talus), *arguments]
        if ranks == 1:
            return line
        return ["mpirun", *(["--allow-run-as-root"] if os.geteuid() == 0 else []), "--oversubscribe", "-n", str(ranks),
                *line]

    def names(self):
        """What is registered, as (kind, name)."""
        text = subprocess.run(self.command(1, "--list"), check=True, stdout=subprocess.PIPE, text=True).stdout
        return [(line[:20].strip(), line[20:42].strip()) for line in text.splitlines()]


@dataclasses.dataclass
class State:
    """What a case has left: tables by column, the particles in the order of their ids."""
    particles: dict
    statistics: dict
    migrations: int

    @staticmethod
    def digest(table):
        digest = hashlib.sha256()
        for name in sorted(table):
            digest.update(name.encode())
            digest.update(np.ascontiguousarray(table[name]).tobytes())
        return digest.hexdigest()[:16]


def read_table(path):
    with open(path) as file:
        header, *rows = csv.reader(line for line in file if not line.startswith("#"))
    values = np.array(rows, dtype=float)
    return {name: values[:, c] for c, name in enumerate(header)}


def start(build, case, prm, settings):
    arguments = [str(prm)]
    for entry, value in settings.items():
        arguments += ["--set", f"{entry} = {value}"]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1", "OMPI_MCA_pml": "ob1"}
    return subprocess.run(build.command(case.ranks, *arguments), env=environment, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)


def run(build, case, directory):
    settings = {**case.settings, "Output/Directory": directory, "Output/Overwrite": "true"}
    text = (runs.ROOT / case.prm).read_text()
    prm = pathlib.Path(f"{directory}.prm")
    without = set()
    while True:
        prm.write_text("".join(line for line in text.splitlines(keepends=True)
                               if not re.match(rf"\s*set ({'|'.join(map(re.escape, without)) or '$'})\s*=", line)))
        known = {entry: value for entry, value in settings.items() if entry.split("/")[-1] not in without}
        finished = start(build, case, prm, known)
        if finished.returncode == 0:
            break
        entry = re.search(r"unknown entry '(.*?)' in section '(.*?)'", finished.stdout)
        if entry is None or entry[1] in without:
            raise RuntimeError(next((line for line in finished.stdout.splitlines() if line.startswith("talus: ")),
                                    f"exit status {finished.returncode}"))
        without.add(entry[1])
        if entry[1] not in build.unknown:
            print(f"Left out where {build.talus} does not know it: '{entry[1]}' in '{entry[2]}'", file=sys.stderr)
        build.unknown.add(entry[1])
    directory = pathlib.Path(directory)
    particles = read_table(max(directory.glob("particles_*.csv")))
    migrations = re.search(r"(\d+) migrations", finished.stdout)
    return State(particles, read_table(directory / "statistics.csv"), int(migrations[1]))


def difference(ours, others):
    """The largest relative difference of two particle tables in the columns that both have, and its column."""
    if not np.array_equal(ours["id"], others["id"]):
        return np.inf, "other ids"
    worst = (0., "")
    for name in [name for name in ours if name in others]:
        column = ours[name]
        largest = np.max(np.abs(column))
        change = np.max(np.abs(column - others[name]))
        if change > 0:
            worst = max(worst, (change / largest if largest > 0 else np.inf, name))
    return worst


def difference_of_statistics(ours, others):
    """The same of statistics, of columns that both builds have."""
    names = [name for name in ours if name in others]
    columns = [ours[name] for name in names]
    if len(columns[0]) != len(others[names[0]]):
        return np.inf, "other steps"
    return compare.largest_difference(names, columns, [others[name] for name in names])


def describe(case, state, other, bound):
    """The line of a case, and the larger of its two differences."""
    line = f"{case.name:58} {state.digest(state.particles)} {state.digest(state.statistics)}"
    if case.ranks > 1:
        line += f"  {state.migrations} migrations"
    if other is None:
        return line, 0.
    parts, worst = [], 0.
    for name, (value, column) in (("particles", difference(state.particles, other.particles)),
                                  ("statistics", difference_of_statistics(state.statistics, other.statistics))):
        worst = max(worst, value)
        if value > 0:
            parts.append(f"{name} {value:.1e} ({column})")
    return line + "  " + (", ".join(parts) or "same") + ("  ABOVE THE BOUND" if worst > bound else ""), worst


def warn_of_gaps(build):
    """Says what is registered and in no case."""
    covered = {"kernel": ALL_KERNELS.values(), "boundary treatment": TREATMENTS.values(),
               "transfer": ALL_TRANSFERS.values(), "material": [entries["Type"] for entries in ALL_MATERIALS.values()],
               "condition": ALL_CONDITIONS}
    for kind, name in build.names():
        if kind in covered and name not in covered[kind]:
            print(f"Warning: no case has the {kind} '{name}'; see contrib/lib/fingerprint_cases.py.", file=sys.stderr)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="contrib/fingerprint", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", default=runs.TALUS.parent, metavar="BUILD",
                        help="the build (build, or what TALUS_BUILD says); it is not built")
    parser.add_argument("--against", metavar="BUILD", help="compare with this one")
    parser.add_argument("--bound", type=float, default=0., metavar="B",
                        help="exit with 1 where a difference exceeds this (0: bit for bit)")
    parser.add_argument("--cases", default="", metavar="REGEX", help="only cases whose names contain this")
    parser.add_argument("--list", action="store_true", help="print the names of the cases")
    parser.add_argument("--jobs", type=int, default=runs.default_jobs(), help="runs at a time (%(default)s)")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    cases = [case for case in all_cases() if re.search(arguments.cases, case.name)]
    if arguments.list:
        print("\n".join(case.name for case in cases))
        return 0
    builds = [Build(directory) for directory in (arguments.build, arguments.against) if directory]
    warn_of_gaps(builds[0])
    differences, n_failed = {}, 0

    with tempfile.TemporaryDirectory() as work:
        def states(number, case):
            return [run(build, case, f"{work}/{number}.{b}") for b, build in enumerate(builds)]

        # First those of one rank, some at a time; then the others, which take several cores themselves.
        groups = [([c for c in cases if c.ranks == 1], arguments.jobs), ([c for c in cases if c.ranks > 1], 1)]
        for group, jobs in groups:
            with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
                futures = [pool.submit(states, f"{jobs}.{number}", case) for number, case in enumerate(group)]
                for case, future in zip(group, futures):
                    try:
                        ours, other = (future.result() + [None])[:2]
                    except RuntimeError as error:
                        print(f"{case.name:58} FAILED: {error}", flush=True)
                        n_failed += 1
                        continue
                    line, differences[case.name] = describe(case, ours, other, arguments.bound)
                    print(line, flush=True)

    text = f"\n{len(cases)} cases"
    if arguments.against and differences:
        name = max(differences, key=differences.get)
        n_above = sum(not value <= arguments.bound for value in differences.values())
        text += f": {sum(value == 0 for value in differences.values())} bit for bit"
        if differences[name] > 0:
            text += f", largest difference {differences[name]:.1e} in {name}, {n_above} above {arguments.bound:g}"
        n_failed += n_above
    print(text + (f", {n_failed} FAILED" if n_failed else ""))
    return 1 if n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
