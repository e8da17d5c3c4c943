"""What is stopped and resumed: files and entries, until each thing that can be chosen in a parameter file has its turn."""
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "contrib", "lib"))
from fingerprint_cases import all_cases, KERNELS, TREATMENTS, TRANSFERS, MATERIALS  # noqa: E402

WALLS = {"Conditions/walls/Boundary ids": "",
         "Conditions/walls/Boundaries": "lower x, upper x, lower y, upper y, lower z, upper z"}
PROBES = {"Output/Probes/Names": "near, along", "Output/Probes/near/Position": "0.6, 0.7", "Output/Probes/near/Kind": "point",
          "Output/Probes/along/Position": "0.6, 0.7", "Output/Probes/along/Kind": "particle"}

# Name: file, steps, entries. What the scenes of contrib/fingerprint have not.
OTHERS = {
    "CPDI": ("tests/compare/stretch_2d.prm", 30, {"Kernel/Type": "CPDI", "Transfer/Type": "APIC"}),
    "CPLS": ("tests/compare/balls_3d.prm", 12, {"Kernel/Type": "CPDI", "Kernel/Layers": 1, "Transfer/Type": "CPLS"}),
    "ghost walls": ("tests/compare/walls_2d.prm", 60, {"Conditions/floor/Account time": 0.05, "Run/Energy account": "true",
                                                      "Conditions/right/Start time": 0.002, "Conditions/right/End time": 0.01}),
    "MUSL": ("tests/compare/disk_2d.prm", 30, {"Run/MUSL": "true", "Run/Mass cutoff": 1e-4, "Materials/rubber/Type": "Mohr-Coulomb",
                                               "Materials/rubber/Cohesion": 1e3, "Output/HDF5": "true", **PROBES}),
    "F-bar": ("tests/compare/disk_2d.prm", 30, {"Run/F-bar": "true", "Materials/rubber/Type": "Hencky",
                                                "Materials/rubber/Yield stress": 1e4}),
    "F-bar on a mesh": ("tests/compare/disk_2d.prm", 30, {"Run/F-bar": "true", "Grid/Type": "mesh", "Kernel/Type": "UMLS"}),
    "obstacles": ("tests/compare/bed_2d.prm", 40, {"Run/Energy account": "true"}),
    "contact": ("prm/bowl.prm", 30, {"Run/Energy account": "true"}),
    "comparison": ("prm/shear.prm", 30, {"Run/End time": 1.2e-3, "FEM reference/Average from": 0.4,
                                         "FEM reference/Cells": "10, 10"}),
    "solution": ("prm/vibration.prm", 30, {"Run/End time": 7.5e-3}),
    "UMLS": ("tests/compare/disk_2d.prm", 30, {"Grid/Type": "mesh", "Kernel/Type": "UMLS", "Transfer/Type": "APIC",
                                               "Materials/rubber/Type": "Hooke", "Conditions/Names": "side",
                                               "Conditions/side/Type": "symmetry", "Conditions/side/Boundaries": "upper x",
                                               "Bodies/disk/Centre": "1.5, 0.9"}),
    "C1 UMLS": ("tests/compare/balls_3d.prm", 12, {"Grid/Type": "mesh", "Kernel/Type": "C1 UMLS", "Run/MUSL": "true", **WALLS}),
    "P1": ("tests/compare/disk_2d.prm", 30, {"Grid/Type": "mesh", "Kernel/Type": "P1", "Transfer/Type": "PIC",
                                             "Run/Courant number": 0.1}),
}


class Case:
    def __init__(self, name, prm, steps, settings):
        self.name, self.prm, self.steps, self.settings = name, os.path.join(ROOT, prm), steps, settings


def of_fingerprint():
    """A few of its cases that have among them all it knows, each with the steps it is run for there."""
    of_kind = {"Kernel/Type": KERNELS, "Kernel/Boundary treatment": TREATMENTS, "Transfer/Type": TRANSFERS}
    missing = {(entry, value) for entry, values in of_kind.items() for value in values.values()}
    missing |= {("Type", material["Type"]) for material in MATERIALS.values()} | {("J smoothing", ""), ("dim", 3)}
    chosen = []
    cases = [case for case in all_cases() if case.ranks == 1 and "linear.everywhere" not in case.name]  # some diverge
    while missing:
        def new(case):
            of_case = {(entry, str(value)) for entry, value in case.settings.items()}
            of_case |= {("Type", str(value)) for entry, value in of_case if entry.startswith("Materials/")}
            of_case.add(("dim", case.dim))
            of_case |= {("J smoothing", "") for entry, value in of_case if entry.endswith("J smoothing")}
            return missing & of_case
        best = max(cases, key=lambda case: (len(new(case)), case.dim == 2))
        assert new(best), f"no case has {missing}"
        missing -= new(best)
        steps = int(best.settings.get("Run/Number of steps", 30))
        chosen.append(Case(best.name, best.prm, steps, best.settings))
    return chosen


# On another number of ranks.
RANKS = {
    "disk": ("tests/compare/disk_2d.prm", 60, {"Transfer/Type": "APIC"}),
    "balls": ("tests/compare/balls_3d.prm", 30, {"Kernel/Type": "cubic B-spline"}),
    "walls": ("tests/compare/walls_2d.prm", 120, {"Conditions/floor/Account time": 0.05}),
    "CPDI": ("tests/compare/disk_2d.prm", 60, {"Kernel/Type": "CPDI", "Transfer/Type": "APIC"}),
    "UMLS": ("tests/compare/disk_2d.prm", 60, {"Grid/Type": "mesh", "Kernel/Type": "UMLS"}),
    "UMLS in 3D": ("tests/compare/balls_3d.prm", 12, {"Grid/Type": "mesh", "Kernel/Type": "UMLS", **WALLS}),
}

# A disk that flies into another rank's part of the grid, so that the cells are shared out anew, and more than once.
FLIGHT = {"Bodies/disk/Centre": "0.5, 0.5", "Bodies/disk/Radius": 0.4, "Bodies/disk/Velocity": "6 - 3*(y - 0.5); 5 + 3*(x - 0.5)",
          "Bodies/disk/Velocity gradient": "0, -3, 3, 0", "Run/Largest imbalance": 1.2}
FINE = {**FLIGHT, "Grid/Cells": "64, 64"}  # p4est moves four cells at a time: 16 particles of 500
BALANCE = {
    "box": ("tests/compare/disk_2d.prm", 240, {**FINE, "Transfer/Type": "APIC"}),
    "CPDI": ("tests/compare/disk_2d.prm", 150, {**FLIGHT, "Kernel/Type": "CPDI"}),
    "walls": ("tests/compare/walls_2d.prm", 240, {"Conditions/floor/Account time": 0.05, "Run/Largest imbalance": 1.2,
                                                  "Conditions/right/Start time": 0.02}),
    "mesh": ("tests/compare/disk_2d.prm", 150, {**FINE, "Grid/Type": "mesh", "Kernel/Type": "UMLS"}),
}


def all_of(word):
    if word == "boxes":
        return of_fingerprint()
    return [Case(name, *of_name) for name, of_name in {"ranks": RANKS, "balance": BALANCE, "others": OTHERS}[word].items()]
