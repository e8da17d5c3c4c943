#!/usr/bin/env python3
"""When outputs and rows are written, and what a run says of itself before it runs. Usage: see main() of program.py."""
import csv
import json
import os
import re
import shutil
import sys
from xml.etree import ElementTree

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(ROOT, "tests"))
from program import columns_of, main  # noqa: E402

PRM = os.path.join(ROOT, "tests/compare/disk_2d.prm")


def case_times(runs):
    """Runs of different steps have rows and outputs at the same times, to the last digit, and no step is tiny."""
    times = {}
    for courant in (0.4, 0.23):
        directory = runs.run(PRM, f"exact {courant}", f"Run/Courant number = {courant}", "Run/End time = 0.1", "Output/Exact times = true",
                             "Output/Time interval = 0.03", "Output/Statistics time interval = 0.02",
                             "Output/Statistics interval = 1000000")
        s = columns_of(os.path.join(directory, "statistics.csv"))
        with open(os.path.join(directory, "particles.pvd")) as file:
            outputs = [float(t) for t in re.findall(r'timestep="([^"]+)"', file.read())]
        times[courant] = (s["time"], outputs)
        runs.check(f"{courant}: rows at {s['time']}", max(abs(t - 0.02 * k) for k, t in enumerate(s["time"])) or len(s["time"]) - 6, 1e-15)
        runs.check(f"{courant}: outputs at {outputs}", max(abs(t - e) for t, e in zip(outputs, (0, 0.03, 0.06, 0.09, 0.1))) or
                   len(outputs) - 5, 1e-15)
        every = runs.statistics(PRM, f"every {courant}", f"Run/Courant number = {courant}", "Run/End time = 0.1",
                                "Output/Exact times = true", "Output/Time interval = 0.03", "Output/Statistics time interval = 0.02")
        steps = every["step size"][1:-1]
        runs.check(f"{courant}: the shortest step is {min(steps) / max(steps):.3f} of the longest", 0.45 - min(steps) / max(steps), 0.45)
    runs.check("the same times", times[0.4] != times[0.23], 0.5)
    still = runs.statistics(PRM, "still", "Run/Courant number = 0.4", "Run/End time = 0.1")
    other = runs.statistics(PRM, "other", "Run/Courant number = 0.4", "Run/End time = 0.1", "Output/Time interval = 0.03")
    runs.check("without 'Exact times' outputs change no step", still["step size"] != other["step size"], 0.5)


def case_expected(runs):
    """--check says how many steps a run has, and leaves nothing behind."""
    directory = os.path.join(runs.work, "checked")
    arguments = [PRM, "--set", f"Output/Directory = {directory}", "--set", "Run/Courant number = 0.2"]
    status, text = runs.start(["--check"] + arguments)
    expected = float(re.search(r"steps +about ([\d.e+]+) of", text)[1]) if status == 0 else 0
    runs.check("nothing was written", os.path.exists(directory), 0.5)
    run = runs.statistics(PRM, "run", "Run/Courant number = 0.2")
    runs.check(f"{expected:g} steps, {run['step'][-1]:g} in the run", expected / run["step"][-1] - 1, 0.2)
    for word in ("particles +\\d+", "time +about \\d", "memory +[\\d.]+ GB", "Nothing was written"):
        runs.check(word, not re.search(word, text), 0.5)
    status, text = runs.start(["--check"] + arguments + ["--set", "Run/Number of steps = 7"])
    runs.check("seven steps", status or "steps      about 7 of" not in text, 0.5)
    status, text = runs.start(["--check", PRM, "--set", "Output/Particle fields = colour"])
    runs.check(f"a wrong field: {text.strip().splitlines()[-1]}", status != 1 or "colour" not in text, 0.5)
    status, text = runs.start(["--check", "--resume", directory])
    runs.check(f"no run: {text.strip().splitlines()[-1]}", status != 1 or "--check looks at the file of a run" not in text, 0.5)


def case_summary(runs):
    """summary.json says how a run has ended, whatever the end."""
    directory = runs.run(PRM, "done", "Run/Number of steps = 7", "Output/Statistics interval = 1")
    with open(os.path.join(directory, "summary.json")) as file:
        found = json.load(file)
    s = columns_of(os.path.join(directory, "statistics.csv"), with_units=True)
    runs.check("done", found["ended"] != "done" or found["steps"] != 7 or found["message"] != "" or found["particles"] <= 0, 0.5)
    runs.check("the last row", max(abs(found["statistics"][name] - column[-1]) for name, column in s.items()) or
               len(s) - len(found["statistics"]), 1e-300)
    directory, status, text = runs.execute(PRM, "failed", "Run/Courant number = 20")
    with open(os.path.join(directory, "summary.json")) as file:
        found = json.load(file)
    runs.check(f"failed: {found['message']}", status != 2 or found["ended"] != "failed" or found["message"] not in text, 0.5)


def case_sweep(runs):
    """All combinations run, also beside one that fails; the table has their values and their last rows."""
    directory = os.path.join(runs.work, "sweep")
    shutil.rmtree(directory, ignore_errors=True)
    status, text = runs.start([os.path.join(HERE, PRM), "--sweep", "Run/Courant number = 0.3 | 20",
                               "--sweep", "Transfer/Type = APIC | FLIP", "--set", f"Output/Directory = {directory}",
                               "--set", "Run/Body force = 0; -9 * (1 > 2 || 2 > 1)"])
    with open(os.path.join(directory, "sweep.csv"), newline="") as file:
        head, *rows = list(csv.reader(file))
    runs.check(f"status {status}", status != 2, 0.5)
    runs.check("combinations", [row[:4] for row in rows] != [[str(n + 1), c, t, s] for n, (c, t, s) in enumerate(
        (("0.3", "APIC", "0"), ("0.3", "FLIP", "0"), ("20", "APIC", "2"), ("20", "FLIP", "2")))], 0.5)
    for n in (0, 1):
        s = columns_of(os.path.join(directory, str(n + 1), "statistics.csv"), with_units=True)
        runs.check(f"run {n + 1}: last row", head[4:] != list(s) or [float(x) for x in rows[n][4:]] != [c[-1] for c in s.values()], 0.5)
    runs.check("each says which it is", "Run 3 of 4, Run/Courant number = 20, Transfer/Type = APIC" not in text, 0.5)
    for sweep, message in (("Transfer", "needs \"Section/Entry"), ("Run/Stepper = " + "|".join("x" * 20000), "more than 10000")):
        status, text = runs.start([os.path.join(HERE, PRM), "--sweep", sweep])
        runs.check(f"{sweep[:20]}: {text.strip()[:80]}", status != 1 or message not in text, 0.5)


def case_hdf5(runs):
    """The HDF5 files have what the tables have, tensors row by row; the list names what lies in them."""
    import h5py
    import numpy as np
    components = {"velocity": "x y z", "velocity_gradient": "xx xy xz yx yy yz zx zy zz", "stress": "xx xy xz xy yy yz xz yz zz",
                  "affine_moment": "xx xy xz yx yy yz zx zy zz"}
    for prm, dim in ((PRM, 2), (os.path.join(ROOT, "tests/compare/balls_3d.prm"), 3)):
        directory = runs.run(prm, f"hdf5 {dim}", "Run/Number of steps = 4", "Output/Step interval = 2", "Output/HDF5 = true", "Output/CSV = true",
                             "Transfer/Type = APIC", "Output/Particle fields = velocity, velocity gradient, stress, pressure, affine moment")
        files = sorted(name for name in os.listdir(directory) if re.fullmatch(r"particles_\d+\.h5", name))
        runs.check(f"{dim}D: {files}", len(files) != 3, 0.5)
        root = ElementTree.parse(os.path.join(directory, "particles.xdmf")).getroot()
        grids = root.findall("./Domain/Grid/Grid")
        runs.check(f"{dim}D: as many in the list", len(grids) != 3, 0.5)
        for grid, name in zip(grids, files):
            table = columns_of(os.path.join(directory, name.replace(".h5", ".csv")))
            with h5py.File(os.path.join(directory, name)) as file:
                order, seen = np.argsort(file["id"][:]), set()
                for item in grid.iter("DataItem"):
                    path, data = item.text.split(":/")
                    size = tuple(int(n) for n in item.get("Dimensions").split())
                    runs.check(f"{name}: {data} {size}", path != name or file[data].shape != size or
                               file[data].dtype.itemsize != int(item.get("Precision", 4)), 0.5)
                    seen.add(data)
                runs.check("all are named", seen != set(file), 0.5)
                points = file["points"][:][order]
                wrong = max(np.abs(points[:, d] - table["xyz"[d]]).max() for d in range(dim))
                for data in sorted(seen - {"points", "vertices", "id"}):
                    numbers = file[data][:][order].reshape(len(order), -1)
                    names = [data + (f"_{c}" if c else "") for c in components.get(data, "").split(" ")]
                    for column, of_table in zip(numbers.T, names):
                        expected = np.float32(table[of_table]) if of_table in table else np.zeros(len(order))
                        wrong = max(wrong, np.abs(column - expected).max())
                runs.check(f"{name}: as in the table", wrong, 1e-300)


def case_topics(runs):
    """Help on all sections, and on all objects that there are; what is printed without a file is a file."""
    status, text = runs.start(["--parameters"])
    for word in ("set Density", "set Surface ", "set Boundary ids", "subsection probe", "# Kernel function."):
        runs.check(f"without a file: {word}", status or word not in text, 0.5)
    for section in ("Run", "Grid", "Kernel", "Transfer", "Materials", "Bodies", "Conditions", "Tractions", "Contacts", "Obstacles", "Output", "Output/Probes",
                    "Checkpoints", "Verification", "FEM reference", "Stages"):
        status, text = runs.start(["--help", section])
        runs.check(f"{section}: {len(text.splitlines())} lines", status or not re.match(r" *subsection " + section.split("/")[-1], text) or
                   len(text.splitlines()) < 4, 0.5)
    kinds = {"kernel": "Kernel", "transfer": "Transfer", "material": "Materials", "shape": "Bodies", "condition": "Conditions",
             "surface": "Contacts", "solution": "Verification"}
    for line in runs.start(["--list"])[1].splitlines():
        kind, name = re.match(r"(\S+(?: \S+)?)\s{2,}(\S+(?: \S+)*)\s{2,}", line).groups()
        if kind in kinds:
            status, text = runs.start(["--help", f"{kinds[kind]}/{name}"])
            runs.check(f"{kinds[kind]}/{name}: {len(text.splitlines())} lines", status or f" = {name}" not in text, 0.5)
    status, text = runs.start(["--help", "Materials/Drucker-Prager"])
    runs.check("entries with units", "set Cohesion" not in text or "[stress]" not in text, 0.5)
    for topic, message in (("Materials/chalk", "there is no 'chalk'"), ("Colours", "There is no help on 'Colours'")):
        status, text = runs.start(["--help", topic])
        runs.check(f"{topic}: {text.strip().splitlines()[-1][:100]}", status != 1 or message not in text, 0.5)


if __name__ == "__main__":
    sys.exit(main(globals(), HERE))
