"""Times one parameter file: the run of 2N steps minus that of N steps, so that set-up and the final output cancel."""
import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

import runs

# Nothing is written while steps are timed; the last step's row is in both runs.
SILENT = {"Output/Final state": "false", "Output/Time interval": 0, "Output/Step interval": 0,
          "Output/Statistics interval": 2147483647, "Output/Overwrite": "true"}


def timed_run(arguments, settings, n_steps):
    """Wall and processor time [s], and the number of particles."""
    start = time.perf_counter()
    process = subprocess.Popen(
        runs.command(arguments.prm, {**settings, "Run/Number of steps": n_steps}, arguments.ranks), text=True,
        env={**os.environ, "OMP_NUM_THREADS": "1"}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        runs.stop(f"the run of {n_steps} steps failed:\n{output[-2000:]}")
    particles = re.search(r"^ *particles +(\d+)", output, re.M)
    taken = re.findall(r"step (\d+), time", output)
    if particles is None or not taken:
        runs.stop("cannot find the numbers of particles and steps in what the program printed.")
    if int(taken[-1]) != n_steps:
        runs.stop(f"the run ended after {taken[-1]} steps instead of {n_steps}, at its end time. "
                  "Give a smaller --steps, or --set \"Run/End time = ...\".")
    return wall, usage.ru_utime + usage.ru_stime, int(particles[1])


def measure(arguments, settings):
    wall, processor = [], []
    for repeat in range(arguments.repeats):
        # Both in turn, so that a machine that slows down does so for both.
        short = timed_run(arguments, settings, arguments.steps)
        long = timed_run(arguments, settings, 2 * arguments.steps)
        work = arguments.steps * long[2]
        wall.append(1e9 * (long[0] - short[0]) / work)
        processor.append(1e9 * (long[1] - short[1]) / work)
        print(f"  repeat {repeat + 1} of {arguments.repeats}: {wall[-1]:.1f} ns wall, "
              f"{processor[-1]:.1f} ns processor", flush=True)
    return wall, processor, long[2]


def parse_arguments():
    parser = argparse.ArgumentParser(prog="contrib/throughput", description=__doc__)
    parser.add_argument("prm", type=pathlib.Path, metavar="FILE.prm")
    parser.add_argument("--steps", type=int, default=100, metavar="N", help="N (%(default)s)")
    parser.add_argument("--repeats", type=int, default=5, help="repeats, of which the median counts (%(default)s)")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks (%(default)s)")
    parser.add_argument("--set", action="append", default=[], metavar='"Section/Entry = value"', help="as for talus")
    arguments = parser.parse_args()
    if not arguments.prm.is_file():
        parser.error(f"there is no file '{arguments.prm}'.")
    if min(arguments.steps, arguments.repeats, arguments.ranks) < 1:
        parser.error("--steps, --repeats and --ranks must be positive.")
    if any("=" not in text for text in arguments.set):
        parser.error('--set expects "Section/Entry = value".')
    return arguments


def summary(name, values):
    return (f"{name:15} {statistics.median(values):8.1f} ns per particle per step "
            f"({min(values):.1f} to {max(values):.1f})")


def main():
    arguments = parse_arguments()
    cache = runs.TALUS.parent / "CMakeCache.txt"
    if "CMAKE_BUILD_TYPE:STRING=Release" not in cache.read_text():
        print("Warning: this is not a Release build.")
    with tempfile.TemporaryDirectory() as directory:
        settings = {**SILENT, "Output/Directory": directory}
        for text in arguments.set:
            entry, value = text.split("=", 1)
            settings[entry.strip()] = value.strip()
        print(f"{arguments.prm}: {2 * arguments.steps} minus {arguments.steps} steps, {arguments.ranks} rank(s), "
              f"load of the machine before: {os.getloadavg()[0]:.1f}", flush=True)
        wall, processor, n_particles = measure(arguments, settings)
    print(f"{n_particles} particles, median of {arguments.repeats} and range:")
    print(summary("wall time", wall))
    print(summary("processor time", processor) + ", all ranks together" * (arguments.ranks > 1))
    if max(wall) - min(wall) > 0.2 * statistics.median(wall):
        print("The repeats differ by more than a fifth: the machine is busy, or the runs are too short (--steps).")
    return 0


if __name__ == "__main__":
    sys.exit(main())
