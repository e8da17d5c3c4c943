"""A grid of 1024 x 1024 cells with 400 particles: processor time and memory of a run of 17 steps with two outputs, over
those of deal.II's triangulation and degrees of freedom alone (contrib/lib/bare_grid.cc). Medians of alternating pairs."""
import argparse
import os
import pathlib
import statistics
import subprocess
import tempfile

import runs

PRM = """set Dimension = 2
subsection Grid
  set Upper corner = 1024, 1024
  set Cells        = 1024, 1024
end
subsection Materials
  set Names = rubber
end
subsection Bodies
  set Names = block
  subsection block
    set Lower corner = 500, 500
    set Upper corner = 510, 510
    set Velocity     = 1; 2
  end
end
subsection Run
  set End time        = 1e9
  set Number of steps = 17
end
subsection Output
  set Step interval = 17
  set Overwrite     = true
end
"""


def measure(command, directory):
    """Processor time [s] and greatest memory [MB] of a command."""
    with open(directory / "output.txt", "w") as output:
        process = subprocess.Popen(command, cwd=directory, stdout=output, stderr=subprocess.STDOUT)
        _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise SystemExit(f"{command[0]} failed:\n{(directory / 'output.txt').read_text()}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=int, default=3, help="number of alternating pairs")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        (directory / "domain.prm").write_text(PRM)
        commands = {"run": [runs.TALUS, "domain.prm"], "bare grid": [runs.TALUS.parent / "bare_grid"]}
        figures = {what: [] for what in commands}
        for _ in range(options.pairs):
            for what, command in commands.items():
                figures[what].append(measure(command, directory))
        size = sum(path.stat().st_size for path in (directory / "output").glob("grid_*.vtu")) / 2e6
    time, memory = ({what: statistics.median(pair[k] for pair in pairs) for what, pairs in figures.items()} for k in (0, 1))
    for what in commands:
        print(f"{what:10} {time[what]:6.2f} s {memory[what]:7.0f} MB")
    print(f"ratio      {time['run'] / time['bare grid']:6.2f}   {memory['run'] / memory['bare grid']:7.2f}")
    print(f"grid_*.vtu {size:6.2f} MB each")


main()
