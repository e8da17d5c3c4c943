"""Nanoseconds per particle per step of the whole program: the run of 2N steps minus that of N, so that set-up cancels.

Without a file it times a table of kernels, transfers and materials on an elastic block under gravity, alternating."""
import argparse
import csv
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import runs
from throughput_rows import FILES, Row, TABLE, table_row

# Nothing is written while steps are timed; the last step's row is in both runs.
SILENT = {"Output/Final state": "false", "Output/Time interval": 0, "Output/Step interval": 0,
          "Output/Statistics interval": 2147483647, "Output/Overwrite": "true"}

NOT_STEPS = {"set-up", "output", "finite element reference", "total"}


def without_elasticity(prm, directory):
    """A copy of a file without the entries that a fluid does not know."""
    path = pathlib.Path(directory) / ("fluid_" + pathlib.Path(prm).name)
    lines = (runs.ROOT / prm).read_text().splitlines(keepends=True)
    path.write_text("".join(line for line in lines if "Young's modulus" not in line and "Poisson's ratio" not in line))
    return str(path)


class Counter:
    """Counts the instructions of a run, with what can: perf, or valgrind on request; one rank."""
    PERF = ["perf", "stat", "--field-separator", ",", "--event", "instructions:u"]

    def __init__(self, ranks, wants_callgrind):
        self.command, self.pattern = [], None
        if wants_callgrind:
            self.command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
            self.pattern = r"Collected : (\d+)"
        elif ranks == 1 and self.perf_counts():
            self.command, self.pattern = self.PERF + ["--"], r"^(\d+),[^,]*,instructions:u"

    def perf_counts(self):
        try:
            text = subprocess.run(self.PERF + ["true"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True).stderr
        except FileNotFoundError:
            return False
        return re.search(r"^\d+,", text, re.M) is not None

    def read(self, output):
        found = re.search(self.pattern, output, re.M) if self.pattern else None
        return float(found[1]) if found else None


def timed_run(row, settings, n_steps, ranks, counter):
    """Wall and processor time, that of the busiest rank, the steps by the program's own clock [s], and instructions."""
    start = time.perf_counter()
    process = subprocess.Popen(
        counter.command + runs.command(row.prm, {**row.settings, **settings, "Run/Number of steps": n_steps}, ranks),
        text=True, cwd=runs.ROOT, env={**os.environ, "OMP_NUM_THREADS": "1"}, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        if "unhandled instruction" in output:
            runs.stop("valgrind does not know this processor's instructions. Build with -D TALUS_NATIVE=OFF, in a "
                      "directory of its own, and name that in TALUS_BUILD.")
        runs.stop(f"the run '{row.name}' of {n_steps} steps failed:\n{output[-2000:]}")
    particles = re.search(r"^ *particles +(\d+)", output, re.M)
    taken = re.findall(r"step (\d+), time", output)
    if particles is None or not taken:
        runs.stop("cannot find the numbers of particles and steps in what the program printed.")
    if int(taken[-1]) != n_steps:
        runs.stop(f"the run ended after {taken[-1]} steps instead of {n_steps}, at its end time. "
                  "Give a smaller --steps, or --set \"Run/End time = ...\".")
    row.particles = int(particles[1])
    memory = re.search(r"bytes per particle: (\S+) now, (\S+) at most", output)
    if memory:
        row.bytes_per_particle, row.peak_bytes = float(memory[1]), float(memory[2])
    table = re.findall(r"^  (\S.*?) +([\d.]+) s +([\d.]+) %$", output, re.M)
    row.phases = {name.strip(): float(share) for name, _, share in table}
    parts = sum(float(seconds) for name, seconds, _ in table if name.strip() not in NOT_STEPS)
    processor = usage.ru_utime + usage.ru_stime
    busiest = re.search(r"busiest rank: (\S+) s", output)
    sent = re.search(r"a rank sends (\S+) messages and (\S+) kB", output)
    if sent:
        row.messages, row.sent = float(sent[1]), float(sent[2])
    return wall, processor, float(busiest[1]) if busiest else processor, parts, counter.read(output)


def measure(rows, arguments, settings):
    counter = Counter(arguments.ranks, arguments.callgrind)
    for repeat in range(arguments.repeats):
        # All rows in turn, and long and short runs in turn, so that a machine that slows down does so for all.
        for row in rows:
            short = timed_run(row, settings, row.steps, arguments.ranks, counter)
            long = timed_run(row, settings, 2 * row.steps, arguments.ranks, counter)
            work = row.steps * row.particles
            row.wall.append(1e9 * (long[0] - short[0]) / work)
            row.processor.append(1e9 * (long[1] - short[1]) / work)
            row.busiest.append(1e9 * (long[2] - short[2]) / work)
            row.parts.append(1e9 * long[3] / (2 * work))
            if long[4]:
                row.instructions.append((long[4] - short[4]) / work)
            if not arguments.csv:
                print(f"  repeat {repeat + 1} of {arguments.repeats}, {row.name} {row.dim}D: {row.wall[-1]:.1f} ns "
                      f"wall, {row.processor[-1]:.1f} ns processor", flush=True)


def bandwidth():
    """Bytes per second that one core moves: the sum of two long vectors into a third, the best of a few."""
    n = 8_000_000
    a, b, c = np.ones(n), np.ones(n), np.zeros(n)
    best = 0.
    for _ in range(5):
        start = time.perf_counter()
        np.add(a, b, out=c)
        best = max(best, 4 * 8 * n / (time.perf_counter() - start))  # c is read before it is written
    return best


def traffic(dim):
    """Bytes of a particle that a step of TPIC and an elastic law cannot avoid to move: each field once a pass."""
    stress, tensor = (4, 4) if dim == 2 else (6, 9)
    scattered = 2 * dim + tensor + stress + 2           # x, v, grad v, stress, m, V
    read = dim + tensor + stress + 2                    # x, F, stress, m, V
    written = 2 * dim + 2 * tensor + stress + 1         # x, v, grad v, F, stress, V
    allocated = dim + tensor                            # v, grad v are overwritten, but fetched first
    return 8 * (scattered + read + written + allocated)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="contrib/throughput", description=__doc__)
    parser.add_argument("prm", type=pathlib.Path, nargs="?", metavar="FILE.prm", help="this file instead of the table")
    parser.add_argument("--rows", help="rows of the table, with commas; KERNEL-TRANSFER-TREATMENT-MATERIAL; all: "
                        + ", ".join(TABLE))
    parser.add_argument("--dim", type=int, choices=(2, 3), help="this dimension of the table alone")
    parser.add_argument("--steps", type=int, default=0, metavar="N", help="N (200, in 3D 40)")
    parser.add_argument("--repeats", type=int, default=5, help="repeats, of which the median counts (%(default)s)")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks (%(default)s)")
    parser.add_argument("--csv", action="store_true",
                        help="print name,dim,ranks,particles,ns_median,ns_min,ns_max,bytes_per_particle,instructions and "
                        "no more; the last is empty where nothing counts them")
    parser.add_argument("--callgrind", action="store_true",
                        help="count instructions with valgrind, some fifty times as slow: times mean nothing, --repeats "
                        "is 1, and few steps do (--steps 5). Without it perf counts them where it can, on one rank")
    parser.add_argument("--set", action="append", default=[], metavar='"Section/Entry = value"', help="as for talus")
    arguments = parser.parse_args()
    if arguments.prm and not arguments.prm.is_file():
        parser.error(f"there is no file '{arguments.prm}'.")
    if arguments.prm and arguments.rows:
        parser.error("give a file or rows of the table, not both.")
    if arguments.callgrind and arguments.ranks > 1:
        parser.error("--callgrind counts on one rank.")
    arguments.repeats = 1 if arguments.callgrind else arguments.repeats
    if arguments.steps < 0 or min(arguments.repeats, arguments.ranks) < 1:
        parser.error("--steps, --repeats and --ranks must be positive.")
    if any("=" not in text for text in arguments.set):
        parser.error('--set expects "Section/Entry = value".')
    return arguments


def choose_rows(arguments):
    if arguments.prm:
        text = arguments.prm.read_text()
        dim = int((re.search(r"^\s*set\s+Dimension\s*=\s*(\d)", text, re.M) or [None, "2"])[1])
        return [Row(arguments.prm.stem, dim, str(arguments.prm.resolve()), arguments.steps or FILES[dim][1], {})]
    names = TABLE if arguments.rows in (None, "all") else arguments.rows.split(",")
    return [table_row(name, dim, arguments.steps) for name in names for dim in (2, 3)
            if arguments.dim in (None, dim)]


def report(rows, arguments):
    print(f"\n{'row':32} dim   ns median    min    max  processor   in steps   B/particle   peak   ns by bandwidth")
    speed = bandwidth()
    for row in rows:
        print(f"{row.name:32} {row.dim}D   {statistics.median(row.wall):9.1f} {min(row.wall):6.1f} {max(row.wall):6.1f}"
              f" {statistics.median(row.processor):10.1f} {statistics.median(row.parts):10.1f}"
              f" {row.bytes_per_particle:12.0f} {row.peak_bytes:6.0f} {1e9 * traffic(row.dim) / speed:17.1f}")
    print("In steps: the sum of the parts of a step by the program's own clock, free of the noise of set-up.")
    print(f"\nMedian of {arguments.repeats}, {arguments.ranks} rank(s). One core moves {speed / 1e9:.1f} GB/s.")
    if any(row.instructions for row in rows):
        print("Instructions per particle and step:")
        for row in rows:
            print(f"  {row.name} {row.dim}D: {statistics.median(row.instructions):.1f}")
    if arguments.ranks > 1:
        print("Busiest rank's processor time outside waiting, per particle of all ranks [ns]; what a rank sends in a step:")
        for row in rows:
            print(f"  {row.name} {row.dim}D: {statistics.median(row.busiest):.1f} ({min(row.busiest):.1f} to "
                  f"{max(row.busiest):.1f}); {row.messages:.1f} messages, {row.sent:.1f} kB")
    print("Shares of the longer run's wall time [%]:")
    for row in rows:
        print(f"  {row.name} {row.dim}D: " + ", ".join(f"{name} {share:.0f}" for name, share in row.phases.items()
                                                     if name != "total" and share >= 0.5))
    if any(max(row.wall) - min(row.wall) > 0.2 * statistics.median(row.wall) for row in rows):
        print("The repeats differ by more than a fifth: the machine is busy, or the runs are too short (--steps).")


def main():
    arguments = parse_arguments()
    rows = choose_rows(arguments)
    cache = runs.TALUS.parent / "CMakeCache.txt"
    if "CMAKE_BUILD_TYPE:STRING=Release" not in cache.read_text():
        print("Warning: this is not a Release build.", file=sys.stderr)
    with tempfile.TemporaryDirectory() as directory:
        settings = {**SILENT, "Output/Directory": directory}
        for text in arguments.set:
            entry, value = text.split("=", 1)
            settings[entry.strip()] = value.strip()
        for row in rows:
            if row.name.endswith("-fluid"):
                row.prm = without_elasticity(row.prm, directory)
        if not arguments.csv:
            print(f"2N minus N steps, {arguments.ranks} rank(s), load of the machine before: {os.getloadavg()[0]:.1f}",
                  flush=True)
        measure(rows, arguments, settings)
    if arguments.csv:
        writer = csv.writer(sys.stdout)
        for row in rows:
            writer.writerow([row.name, row.dim, arguments.ranks, row.particles, f"{statistics.median(row.wall):.2f}",
                             f"{min(row.wall):.2f}", f"{max(row.wall):.2f}", f"{row.bytes_per_particle:.0f}",
                             f"{statistics.median(row.instructions):.2f}" if row.instructions else ""])
    else:
        report(rows, arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
