#!/usr/bin/env python3
"""An installed program starts from its prefix, runs, is stopped and goes on. Usage: install.py CMAKE BUILD PREFIX RANKS [MPIRUN ...]"""
import csv
import os
import re
import shutil
import subprocess
import sys

PRM = """\
set Dimension = 2
subsection Run
  set Number of steps = 6
end
subsection Grid
  set Cells = 8, 8
end
subsection Materials
  set Names = rubber
end
subsection Bodies
  set Names = block
  subsection block
    set Lower corner = 0.25, 0.25
    set Upper corner = 0.75, 0.75
    set Velocity = 1; 0
  end
end
subsection Checkpoints
  set Step interval = 3
end
"""


def run(command, directory, environment):
    result = subprocess.run(command, cwd=directory, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if result.returncode:
        sys.exit(f"FAIL {' '.join(command)}: exit status {result.returncode}\n{result.stdout}")
    return result.stdout


def read(*path):
    with open(os.path.join(*path)) as file:
        return file.read()


def check_extension(cmake, prefix, talus, work, environment):
    """A law of one's own, compiled against what was installed: its stress, and the message where it is missing."""
    source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "extension")
    place = os.path.join(work, "extension")
    shutil.copytree(source, place)
    run([talus, "--version"], place, environment)
    missing = subprocess.run([talus, "--element", "sheared.prm"], cwd=place, env=environment, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, text=True)
    run([cmake, "-S", ".", "-B", "build", f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release"], place, environment)
    run([cmake, "--build", "build"], place, environment)
    run([talus, "--element", "sheared.prm"], place, environment)
    with open(os.path.join(place, "output", "element.csv"), newline="") as file:
        row = list(csv.DictReader(line for line in file if not line.startswith("#")))[-1]
    row = {key.split(" [")[0]: float(value) for key, value in row.items()}
    stress = {name: row[f"stress {name}"] for name in ("xx", "yy", "xy")}
    wanted = {"xx": 40800, "yy": 20000, "xy": 104000}
    return {f"stress of a law of one's own: {stress}": any(abs(stress[k] - wanted[k]) > 1e-6 * wanted[k] for k in wanted),
            f"a library that is not there: {missing.stdout}":
                missing.returncode != 1 or "sheared.prm:3: entry 'Additional shared libraries'" not in missing.stdout}


def main():
    cmake, build, prefix, ranks = sys.argv[1:5]
    mpirun = sys.argv[5:] + ["-n", ranks] if ranks != "1" else []
    shutil.rmtree(prefix, ignore_errors=True)
    run([cmake, "--install", build, "--prefix", prefix], build, os.environ)
    # Nothing of the build may be needed: the libraries are found from where the program lies.
    environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}
    environment.update(OMP_NUM_THREADS="1", DEAL_II_NUM_THREADS="1")
    talus = os.path.join(prefix, "bin", "talus")
    libraries = run(["ldd", talus], prefix, environment)
    library = re.search(r"libtalus\.so\S* => (\S+)", libraries)[1]
    work = os.path.join(prefix, "work")
    os.makedirs(work)
    with open(os.path.join(work, "case.prm"), "w") as file:
        file.write(PRM)
    whole = run(mpirun + [talus, "case.prm", "--set", "Output/Directory = whole"], work, environment)
    run(mpirun + [talus, "case.prm", "--set", "Output/Directory = parts", "--set", "Run/Number of steps = 3"], work, environment)
    parts = run(mpirun + [talus, "--resume", "parts", "--set", "Run/Number of steps = 6"], work, environment)
    problems = {f"the library is {library}": not os.path.realpath(library).startswith(os.path.realpath(prefix)),
                "the version": not run([talus, "--version"], work, environment).startswith("talus "),
                "examples": not os.path.exists(os.path.join(prefix, "share", "talus", "prm", "shear.prm")),
                "it did not go on": "Going on from" not in parts or "step 6" not in whole,
                "the table of the resumed run": read(work, "whole", "statistics.csv") != read(work, "parts", "statistics.csv")}
    if ranks == "1":
        problems.update(check_extension(cmake, prefix, talus, work, environment))
    for name, is_wrong in problems.items():
        print(f"{'FAIL' if is_wrong else 'pass'} {name}")
    return any(problems.values())


if __name__ == "__main__":
    sys.exit(main())
