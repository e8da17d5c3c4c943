"""contrib/reproduce: a benchmark is a module of contrib/benchmarks with

    TITLE             one line for --list
    runs()            the list of runs.Run
    table(results)    a list of dictionaries, one per row of table.csv
    figures(results)  the acceptance figures, a list of report.Figure
    draw(results, path)   writes a figure, or nothing if too many runs have failed

where `results` has a runs.Result for each run, failed ones too. A file shear_3d.py is the benchmark shear-3d.

result.json holds the acceptance figures, with what contrib/report says of where they come from.
"""
import argparse
import dataclasses
import importlib
import json
import pathlib
import platform
import re
import subprocess
import sys
import time

import report
import runs
from PIL import Image

BENCHMARKS = runs.ROOT / "contrib" / "benchmarks"
FIGURES = runs.ROOT / "doc" / "figures"
RESULTS = runs.ROOT / "doc" / "results"
LARGEST = 80000  # bytes of a figure in doc/


def names():
    return sorted(path.stem.replace("_", "-") for path in BENCHMARKS.glob("[a-z]*.py"))


def load(name):
    sys.path.insert(0, str(BENCHMARKS))
    return importlib.import_module(name.replace("-", "_"))


def write_rendition(source, target):
    """A figure for doc/, with as many pixels as its size allows; all colours if they fit, or a palette."""
    figure = Image.open(source).convert("RGB")
    for width in range(min(1000, figure.width), 200, -50):
        small = figure.resize((width, round(figure.height * width / figure.width)), Image.LANCZOS)
        for image in (small, small.quantize(256, kmeans=1)):
            image.save(target, optimize=True)
            if target.stat().st_size <= LARGEST:
                return


def origin():
    """Version of the program, date and machine."""
    version = subprocess.run([str(runs.TALUS), "--version"], stdout=subprocess.PIPE, text=True).stdout.strip()
    try:
        found = re.search(r"^model name\s*:\s*(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M)
    except OSError:
        found = None
    return {"version": version, "date": time.strftime("%Y-%m-%d"), "machine": found[1] if found else platform.processor()}


def make_runs(benchmark, directory, arguments):
    planned = benchmark.runs()  # none where a benchmark only evaluates formulas
    if arguments.evaluate:
        return [runs.recall(run, directory) for run in planned]
    return runs.execute_all(planned, directory, arguments.jobs, arguments.ranks) if planned else []


def write_result(directory, name, title, results, figures, is_for_doc):
    text = json.dumps(
        {"name": name, "title": title, **origin(), "runs": len(results), "seconds": sum(result.seconds for result in results),
         "figures": [dataclasses.asdict(figure) for figure in figures]}, indent=1, default=float) + "\n"
    (directory / "result.json").write_text(text)
    if is_for_doc:
        RESULTS.mkdir(exist_ok=True)
        (RESULTS / f"{name}.json").write_text(text)


def reproduce(name, arguments):
    """Makes the runs of a benchmark, or takes those that are there; prints, draws, and returns 1 where a figure fails."""
    benchmark = load(name)
    directory = pathlib.Path(arguments.output or runs.ROOT / "reproduce" / name)
    directory.mkdir(parents=True, exist_ok=True)
    for old in (directory / "table.csv", directory / "result.json", *directory.glob("*.png")):
        old.unlink(missing_ok=True)
    results = make_runs(benchmark, directory / "runs", arguments)
    rows = benchmark.table(results)
    report.write_csv(directory / "table.csv", rows)
    print("\n" + report.format_table(rows) + "\n")
    figures = benchmark.figures(results)
    for figure in figures:
        print(figure.line())
    write_result(directory, name, benchmark.TITLE, results, figures, arguments.doc)
    benchmark.draw(results, directory / "figure.png")
    if arguments.doc:
        for source in directory.glob("*.png"):  # figure.png, and what a benchmark has drawn beside it
            write_rendition(source, FIGURES / (f"{name}.png" if source.stem == "figure" else source.name))
    failed = sum(not figure.passes for figure in figures)
    print(f"\n{len(figures) - failed} of {len(figures)} acceptance figures pass. "
          f"See {', '.join(str(path) for path in sorted(directory.glob('*.*')))}.")
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(prog="contrib/reproduce", description="Runs a benchmark of a paper.")
    parser.add_argument("name", nargs="?", help="one of those that --list prints")
    parser.add_argument("--list", action="store_true", help="print the benchmarks")
    parser.add_argument("--jobs", type=int, default=runs.default_jobs(), help="runs at a time (%(default)s)")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of each run (%(default)s)")
    parser.add_argument("--output", help="directory for the results (reproduce/NAME)")
    parser.add_argument("--evaluate", action="store_true", help="make no run: take those that an earlier call has left")
    parser.add_argument("--doc", action="store_true", help="also write the figures, reduced, to doc/figures, and the result to "
                        "doc/results")
    arguments = parser.parse_args()
    if arguments.list:
        for name in names():
            print(f"{name:12} {load(name).TITLE}")
        return 0
    if arguments.name not in names():
        parser.error(f"give the name of a benchmark: {', '.join(names())}")
    return reproduce(arguments.name, arguments)


if __name__ == "__main__":
    sys.exit(main())
