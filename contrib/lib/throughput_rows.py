"""The rows of throughput: an elastic block under gravity with each kernel, transfer, boundary treatment and material."""
import dataclasses

import runs

KERNELS = {"linear": "linear", "quadratic": "quadratic B-spline", "cubic": "cubic B-spline", "ugimp": "uGIMP",
           "cpdi": "CPDI", "p1": "P1", "umls": "UMLS", "c1": "C1 UMLS"}
TRANSFERS = {"flip": "FLIP", "pic": "PIC", "apic": "APIC", "tpic": "TPIC", "cpls": "CPLS"}
TREATMENTS = {"wls": "WLS", "everywhere": "WLS everywhere", "separable": "WLS separable", "none": "none",
              "mirror": "mirror", "ghost": "ghost nodes"}
MATERIALS = {"neo": {"Type": "neo-Hookean"}, "elastic": {"Type": "linear elastic"},
             "mises": {"Type": "von Mises", "Yield stress": 500}, "dp": {"Type": "Drucker-Prager"},
             "fluid": {"Type": "Newtonian fluid"}, "two": {"Type": "neo-Hookean"}}
TABLE = ["quadratic-tpic-wls-neo", "quadratic-apic-wls-neo", "quadratic-tpic-wls-elastic", "quadratic-flip-wls-elastic",
         "quadratic-pic-wls-elastic", "quadratic-apic-wls-elastic", "quadratic-tpic-wls-mises", "quadratic-tpic-wls-dp",
         "quadratic-tpic-wls-fluid", "ugimp-tpic-wls-elastic", "cubic-tpic-wls-elastic",
         "quadratic-tpic-everywhere-neo", "quadratic-tpic-mirror-neo", "quadratic-tpic-ghost-neo", "quadratic-tpic-wls-two",
         "cpdi-tpic-none-neo", "cpdi-flip-none-neo", "cpdi-cpls-none-neo", "umls-tpic-none-neo", "c1-tpic-none-neo"]
FILES = {2: ("prm/elastic_block.prm", 200), 3: ("prm/elastic_block_3d.prm", 40)}
# Mirrors are at slip walls. Two materials, one in each half, take off together, so that particles change ranks.
MIRROR = {"Conditions/floor/Type": "slip"}
# Domains may reach below their floor: it lies inside the grid, and CPDI has no treatment.
INNER_FLOOR = {2: {"Grid/Lower corner": "-0.02, -0.02", "Conditions/floor/Boundary ids": "",
                   "Conditions/floor/Half spaces": "y <= 0"},
               3: {"Grid/Lower corner": "-0.1, -0.1, -0.1", "Conditions/floor/Boundary ids": "",
                   "Conditions/floor/Half spaces": "z <= 0"}}
# The same boxes, each cut into two triangles or six tetrahedra.
MESH = {2: {"Grid/Type": "mesh", "Grid/Cells": "208, 208", "Conditions/floor/Boundary ids": "",
            "Conditions/floor/Boundaries": "lower y"},
        3: {"Grid/Type": "mesh", "Grid/Cells": "48, 48, 48", "Conditions/floor/Boundary ids": "",
            "Conditions/floor/Boundaries": "lower z"}}
TWO = {"Materials/Names": "soil, stone", "Materials/stone/Type": "linear elastic", "Bodies/Names": "block, top",
       "Bodies/top/Material": "stone", "Bodies/top/Particles per cell and direction": 2}
HALVES = {2: {"Bodies/block/Upper corner": "1, 0.5", "Bodies/top/Lower corner": "0, 0.5",
              "Bodies/top/Upper corner": "1, 1", "Bodies/block/Velocity": "0.5; 0.5", "Bodies/top/Velocity": "0.5; 0.5"},
          3: {"Bodies/block/Upper corner": "1, 1, 0.5", "Bodies/top/Lower corner": "0, 0, 0.5",
              "Bodies/top/Upper corner": "1, 1, 1", "Bodies/block/Velocity": "2; 2; 2",
              "Bodies/top/Velocity": "2; 2; 2"}}


@dataclasses.dataclass
class Row:
    name: str
    dim: int
    prm: str
    steps: int
    settings: dict
    wall: list = dataclasses.field(default_factory=list)
    processor: list = dataclasses.field(default_factory=list)
    busiest: list = dataclasses.field(default_factory=list)  # of one rank, outside waiting for others
    parts: list = dataclasses.field(default_factory=list)    # the parts of the longer run's steps, by its own clock
    messages: float = 0  # that a rank sends in a step
    sent: float = 0      # by a rank in a step [kB]
    particles: int = 0
    bytes_per_particle: float = 0
    peak_bytes: float = 0
    phases: dict = dataclasses.field(default_factory=dict)
    instructions: list = dataclasses.field(default_factory=list)  # per particle and step; empty where nobody counts


def table_row(name, dim, steps):
    """The row called KERNEL-TRANSFER-TREATMENT-MATERIAL."""
    parts = name.split("-")
    if len(parts) != 4 or any(part not in choices for part, choices in
                              zip(parts, (KERNELS, TRANSFERS, TREATMENTS, MATERIALS))):
        runs.stop(f"there is no row '{name}'. It is KERNEL-TRANSFER-TREATMENT-MATERIAL of\n  "
                  + "\n  ".join(", ".join(choices) for choices in (KERNELS, TRANSFERS, TREATMENTS, MATERIALS)))
    kernel, transfer, treatment, material = parts
    prm, default_steps = FILES[dim]
    settings = {"Kernel/Type": KERNELS[kernel], "Transfer/Type": TRANSFERS[transfer]}
    has_treatment = kernel not in ("cpdi", "p1", "umls", "c1")
    settings.update({"Kernel/Boundary treatment": TREATMENTS[treatment]} if has_treatment else
                    INNER_FLOOR[dim] if kernel == "cpdi" else MESH[dim])
    settings.update({f"Materials/soil/{entry}": value for entry, value in MATERIALS[material].items()})
    settings.update(MIRROR if treatment == "mirror" else {})
    settings.update({**TWO, **HALVES[dim]} if material == "two" else {})
    return Row(name, dim, prm, steps or default_steps, settings)
