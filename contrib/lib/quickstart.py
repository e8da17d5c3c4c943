"""contrib/quickstart: simple shear with all transfers beside the finite element solution."""
import argparse
import pathlib
import sys
import time

import report
import runs

sys.path.insert(0, str(runs.ROOT / "contrib" / "benchmarks"))
import shear  # noqa: E402


def main():
    parser = argparse.ArgumentParser(prog="contrib/quickstart", description=__doc__)
    parser.add_argument("--jobs", type=int, default=runs.default_jobs(), help="runs at a time (%(default)s)")
    parser.add_argument("--output", default=runs.ROOT / "quickstart", help="directory for the results (quickstart)")
    arguments = parser.parse_args()
    directory = pathlib.Path(arguments.output)
    start = time.perf_counter()

    print("\nSimple shear of an elastic block, h = 1/20, beside its finite element solution")
    results = runs.execute_all(shear.runs(["1/20"]), directory / "runs", arguments.jobs)
    rows = shear.table(results)
    report.write_csv(directory / "table.csv", rows)
    print("\n" + report.format_table(rows))
    print("\nPlate: within 2h of a plate, away from the corners. Core: the middle. Errors are relative to the finite\n"
          "element stress. Uncorrected kernels are wrong by a fifth near the plates; WLS corrects them.")
    shear.draw(results, directory / "figure.png")
    print(f"\n{directory}/figure.png shows the stress fields. ({time.perf_counter() - start:.0f} s)")
    return max(result.status for result in results)


if __name__ == "__main__":
    sys.exit(main())
