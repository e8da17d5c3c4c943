#!/usr/bin/env python3
"""Runs in stages, against closed forms and against runs without. Usage: see main() of program.py."""
import os
import re
import shutil
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "tests"), os.path.join(ROOT, "tests", "compare"), os.path.join(ROOT, "tests", "checkpoint")]
import compare  # noqa: E402
import program  # noqa: E402
from cases import all_of  # noqa: E402
from program import differences, files  # noqa: E402

G, HEIGHT, DENSITY, LOAD, FILL = 10, 3, 2000, 3e4, 0.5 * 1600
MODULUS = 1e8 * 0.7 / (1.3 * 0.4)  # of a column that cannot widen


def particles_of(directory, number):
    columns = program.columns_of(os.path.join(directory, f"particles_{number:05d}.csv"))
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def log_of(directory):
    with open(os.path.join(directory, "log.txt")) as file:
        return file.read()


def case_column(runs):
    """Stress under the weight of what is above and the load; displacements by the change of it, since each begin."""
    directory = runs.run("column.prm", "column")
    log = log_of(directory)
    times = [float(time) for time in re.findall(r"ended at rest in step \d+, t = ([\d.e+-]+)", log)]
    runs.check(f"stages ended at rest at t = {times}", len(times) - 4, 0.5)
    runs.check("the last one says so too", "ended: done" not in log, 0.5)
    above = [DENSITY * G * 1, 0, LOAD, FILL * G]  # the pressure on top of the lower body in each stage
    for stage, pressure in enumerate(above):
        lower = [p for p in particles_of(directory, stage) if p["initial_position_y"] < HEIGHT or stage == 0]
        lower = [p for p in lower if p["position_y"] < HEIGHT]
        n = len(lower)
        scale = DENSITY * G * HEIGHT
        errors = [p["stress_yy"] + DENSITY * G * (HEIGHT - p["position_y"]) + pressure for p in lower]
        # Near the top, where material ends or another begins, stress is that of a spacing.
        inner = [e for e, p in zip(errors, lower) if p["position_y"] < HEIGHT - 0.5]
        runs.check(f"stage {stage}: stress of {len(inner)} of {n} particles", program.rms(inner) / scale, 5e-3)
        if stage:
            change = above[stage] - above[stage - 1]
            errors = [p["displacement_y"] + change * p["position_y"] / MODULUS for p in lower]
            runs.check(f"stage {stage}: displacement", program.rms(errors) * MODULUS / abs(change) / HEIGHT, 2e-2)


def case_nothing(runs):
    """Stages that change nothing are the run without them, to round-off."""
    cases = [case for case in all_of("boxes")[::3 if runs.mpirun else 2] + all_of("others")
             if case.name not in ("comparison", "solution")]  # with a reference
    for case in cases:
        settings = [f"{entry} = {value}" for entry, value in case.settings.items()
                    if entry not in ("Run/Number of steps", "Run/End time")]
        common = settings + ["Output/CSV = true", "Output/Particle fields = position, velocity, stress"]
        whole = runs.run(case.prm, case.name + ".whole", *common, f"Run/Number of steps = {case.steps}")
        times = program.columns_of(os.path.join(whole, "statistics.csv"))["time"]
        first, end = times[len(times) // 3], times[-1]
        parts = runs.run(without_end(runs, case), case.name + ".parts", *common, "Stages/Names = one, two",
                         f"Stages/one/Duration = {first!r}", f"Stages/two/Duration = {end - first!r}")
        a, b = (program.last_particles(directory) for directory in (whole, parts))
        names = [name for name in a[0] if name.startswith(("position", "velocity", "stress"))]
        worst, column = compare.largest_difference(names, *([[row[name] for row in rows] for name in names] for rows in (a, b)))
        runs.check(f"{case.name}: {column}", worst if len(a) == len(b) else 1, compare.BOUND)


def without_end(runs, case):
    """A copy of a case's file that says nothing of when the run ends."""
    with open(case.prm) as file:
        text = re.sub(r"(?m)^  set End time .*\n", "", file.read(), count=1)
    path = os.path.join(runs.work, case.name + ".prm")
    with open(path, "w") as file:
        file.write(text)
    return path


def case_resets(runs):
    """Plastic strains begin anew where a stage says so; stress stays, under another law as well."""
    def ends(name, *settings):
        directory = runs.run("resets.prm", name, *settings)
        numbers = [int(found) for found in (re.match(r"particles_(\d+)\.csv", file)[1] for file in sorted(os.listdir(directory))
                                            if file.endswith(".csv") and file.startswith("particles_"))]
        return [particles_of(directory, number) for number in numbers]

    begin, pressed, held, changed = ends("resets")
    _, _, kept, _ = ends("kept", "Stages/hold/Reset plastic strains = false")
    strain = [p["equivalent_plastic_strain"] for p in pressed]
    runs.check(f"plastic strain of {min(strain):.3g} to {max(strain):.3g}", not (0.004 < min(strain) and max(strain) < 0.012), 0.5)
    runs.check("as it was", max(abs(p["equivalent_plastic_strain"] - e) for p, e in zip(kept, strain)), 1e-6)
    runs.check("reset", max(p["equivalent_plastic_strain"] for p in held), 1e-6)
    for name, later in (("held", held), ("another law", changed)):
        worst = max(abs(p[f"stress_{c}"] - q[f"stress_{c}"]) for p, q in zip(pressed, later) for c in ("xx", "yy", "zz", "xy"))
        runs.check(f"{name}: stress stays", worst / max(abs(p["stress_yy"]) for p in pressed), 1e-6)
    runs.check("the other law keeps none", "equivalent_plastic_strain" in changed[0], 0.5)


def case_resumed(runs):
    """A run that goes on from the end of a stage, or from within one, is the run that was not stopped."""
    whole = runs.run("column.prm", "whole", "Checkpoints/Step interval = 250", "Checkpoints/Kept = 99", "Output/Step interval = 200")
    checkpoints = sorted(name for name in os.listdir(whole) if name.endswith(".h5"))
    ends = [int(step) for step in re.findall(r"ended at rest in step (\d+)", log_of(whole))]
    for step in (ends[0], 250 * (ends[0] // 250 + 2), ends[2], 250 * (ends[2] // 250 + 1)):
        parts = os.path.join(runs.work, f"from {step}")
        shutil.rmtree(parts, ignore_errors=True)
        shutil.copytree(whole, parts)
        for name in checkpoints:
            if int(name[11:19]) > step:
                os.remove(os.path.join(parts, name))
        status, text = runs.start(["--resume", parts])
        differ = differences(whole, parts)
        runs.check(f"from step {step}: exit status {status}, {len(files(whole))} files, different: {differ}",
                   status or len(differ), 0.5)
    # What stages to come change may be changed.
    parts = os.path.join(runs.work, "changed")
    shutil.rmtree(parts, ignore_errors=True)
    shutil.copytree(whole, parts)
    for name in checkpoints:
        if int(name[11:19]) > ends[1]:
            os.remove(os.path.join(parts, name))
    status, text = runs.start(["--resume", parts, "--set", "Stages/load/Tractions/plate/Traction = 0; -6e4"])
    end = float(re.findall(r"'load', 3 of 4, ended at rest in step \d+, t = ([\d.e+-]+)", log_of(parts))[-1])
    probe = program.columns_of(os.path.join(parts, "probes.csv"))
    moved = [u for t, u in zip(probe["time"], probe["top_displacement_y"]) if t < end * (1 + 1e-4)][-1]
    runs.check(f"twice the load: exit status {status}, the probe moved by {moved:.4g}", moved / (-2 * LOAD * 2.9 / MODULUS) - 1, 0.02)
    status, text = runs.start(["--resume", parts, "--set", "Materials/ground/Density = 1"])
    runs.check(f"others may not: {text.strip().splitlines()[-1][:120]}", status != 1 or "cannot change" not in text, 0.5)


def case_safety(runs):
    """The factor of safety of a block under an even load: 2 c/q."""
    directory = runs.run("block.prm", "block")
    log = log_of(directory)
    low, high = (float(factor) for factor in re.search(r"Factor of safety of stage 'safety': ([\d.]+)\. It stands with that and "
                                                       r"fails with ([\d.]+)\.", log).groups())
    runs.check(f"stands with {low}, fails with {high}: apart", (high - low) / low, 5.001e-3)
    runs.check("factor of safety over 2 c/q", 0.5 * (low + high) / 1.5 - 1, 0.01)  # .13 % each by criterion and tolerance
    table = program.columns_of(os.path.join(directory, "safety_safety.csv"))
    rows = list(zip(table["factor"], table["moved"], table["stands"]))
    runs.check(f"{len(rows)} trials in their order, those that stand first, moved in that order",
               rows != sorted(rows) or [row[2] for row in rows] != sorted((row[2] for row in rows), reverse=True), 0.5)
    trials = [name for name in os.listdir(directory) if name.startswith("safety_") and os.path.isdir(os.path.join(directory, name))]
    runs.check("each has its files", len(trials) - len(rows) or not all(
        os.path.exists(os.path.join(directory, trial, "probes.csv")) for trial in trials), 0.5)
    # The next stage begins where the search began, with strengths as they were: 2 q is more than 2 c.
    probe = program.columns_of(os.path.join(directory, "probes.csv"))
    runs.check(f"the next stage fails: moved by {-probe['top_displacement_y'][-1]:.3g}", -probe["top_displacement_y"][-1] < 5e-3, 0.5)
    runs.check("the end", "ended: done" not in log.splitlines()[-1], 0.5)
    for name, settings, status, message in (
            ("stands with all", ["Stages/safety/Strength reduction = 1, 1.2"], 2, "Raise it"),
            ("fails with all", ["Stages/safety/Strength reduction = 1.8, 2"], 2, "Lower it"),
            ("no probe", ["Stages/safety/Watched probe = left"], 1, "name a probe of section 'Output/Probes'"),
            ("first", ["Stages/Names = safety"], 1, "a search begins from a state of rest"),
            ("one factor", ["Stages/safety/Strength reduction = 2"], 1, "give two factors"),
            ("no limit", ["Stages/safety/Largest displacement = 0"], 1, "it must be positive, for instance a fiftieth")):
        _, found, text = runs.execute("block.prm", name, *settings)
        line = next((line for line in text.splitlines() if line.startswith("talus: ")), text.strip()[-200:])
        runs.check(f"{name}: {line}", found != status or message not in text, 0.5)
    with open(os.path.join(HERE, "block.prm")) as file:
        text = re.sub(r"(?m)^    set (Friction angle|Cohesion) .*\n", "", file.read().replace("Mohr-Coulomb", "neo-Hookean"))
    path = os.path.join(runs.work, "elastic.prm")
    with open(path, "w") as file:
        file.write(text)
    _, found, text = runs.execute(path, "no strength")
    runs.check(f"no strength: {text.strip().splitlines()[-1]}", found != 1 or "elastic.prm:" not in text or
               "no material of the run has a strength" not in text, 0.5)
    for entry in ("Strength reduction = a, b", "Materials/clay/Strength reduction = a", "Tolerance = much"):
        found, text = runs.start(["--resume", directory, "--set", f"Stages/safety/{entry}"])
        runs.check(f"{entry}: {text.strip().splitlines()[-1]}", found != 1 or "is not a valid value" not in text, 0.5)


WRONG = {
    "no duration": (["Stages/dig/Duration = 0"], "it must be positive: how long the stage lasts"),
    "a grid": (["Stages/dig/Grid/Spacing = 0.1"], "it is one for all stages"),
    "a body's shape": (["Stages/load/Bodies/lower/Upper corner = 1, 2"], "the body is there already"),
    "an unknown entry of a later stage": (["Stages/fill/Run/Damping = 1"], "unknown entry 'Damping' in section 'Run'"),
    "a wrong value of a later stage": (["Stages/fill/Run/Local damping = 2"], "it must lie between 0 and 1"),
    "an unknown stage": (["Stages/flood/Duration = 2"], "nothing reads the section 'Stages/flood'"),
    "an end time": (["Run/End time = 2"], "the run has stages, and ends after their durations"),
    "an end time of a stage": (["Stages/dig/Run/End time = 2"], "a stage ends after its 'Duration'"),
    "another directory": (["Stages/dig/Output/Directory = x"], "the files of a run are the same in all stages"),
    "no bodies": (["Stages/dig/Bodies/Names = "], "give at least one body"),
    "a misspelt entry of a stage": (["Stages/dig/Durration = 2"], "Did you mean 'Duration'?"),
}


def case_wrong(runs):
    """What is wrong in any stage is said before the first one runs."""
    for name, (settings, message) in WRONG.items():
        directory, status, text = runs.execute("column.prm", name, *settings)
        line = next((line for line in text.splitlines() if line.startswith("talus: ")), text.strip()[-200:])
        runs.check(f"{name}: {line}", status != 1 or message not in text or os.path.exists(os.path.join(directory, "log.txt")), 0.5)
    directory, status, text = runs.execute("column.prm", "no rest", "Stages/Names = gravity, dig", "Stages/gravity/Duration = 0.01",
                                           "Stages/dig/Duration = 0.01")
    runs.check("stages that do not rest: two warnings",
               status or len(re.findall(r"has not come to rest within its 'Duration'", text)) != 2, 0.5)


if __name__ == "__main__":
    sys.exit(program.main(globals(), HERE))
