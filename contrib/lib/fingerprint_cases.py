"""The cases of contrib/fingerprint: what of the program they cover, and the entries that make each of them."""
import dataclasses
import itertools

KERNELS = {"linear": "linear", "quadratic": "quadratic B-spline", "cubic": "cubic B-spline", "ugimp": "uGIMP"}
DOMAIN_KERNELS = {"cpdi": "CPDI"}                            # of particles' domains: no treatment, no wall at a face
MESH_KERNELS = {"p1": "P1", "umls": "UMLS", "c1": "C1 UMLS"}  # on triangles and tetrahedra
ALL_KERNELS = {**KERNELS, **DOMAIN_KERNELS, **MESH_KERNELS}
TREATMENTS = {"none": "none", "steffen": "Steffen", "wls": "WLS", "separable": "WLS separable",
              "everywhere": "WLS everywhere", "mls": "MLS", "mirror": "mirror", "ghost": "ghost nodes"}
TRANSFERS = {"flip": "FLIP", "pic": "PIC", "blend": "blend", "apic": "APIC", "tpic": "TPIC"}
ALL_TRANSFERS = {**TRANSFERS, "cpls": "CPLS"}
MATERIALS = {"elastic": {"Type": "linear elastic"}, "neo": {"Type": "neo-Hookean"},
             "mises": {"Type": "von Mises", "Yield stress": 2000, "Hardening": "exponential softening",
                       "Residual yield stress": 500, "Softening rate": 5},
             "dp": {"Type": "Drucker-Prager", "Friction angle": 30, "Dilatancy angle": 10, "Cohesion": 300},
             "fluid": {"Type": "Newtonian fluid", "Sound speed": 40, "Viscosity": 5}}
ALL_MATERIALS = {**MATERIALS,
                 "mc": {"Type": "Mohr-Coulomb", "Friction angle": 30, "Dilatancy angle": 10, "Cohesion": 300,
                        "Residual cohesion": 100, "Tension strength": 200},
                 "hooke": {"Type": "Hooke"},
                 "hencky": {"Type": "Hencky", "Yield stress": 2000, "Hardening": "exponential softening",
                            "Residual yield stress": 500, "Softening rate": 5}}
CONDITIONS = {"slip": "smooth", "friction": "rough", "no-slip": "fixed", "velocity": "driven"}  # their names in the files

ALL_CONDITIONS = [*CONDITIONS, "symmetry"]

# What every particle has, and what some transfers and materials add to it.
FIELDS = ["position", "velocity", "velocity gradient", "deformation gradient", "stress", "mass", "volume",
          "initial position"]
STATES = {"mc": ["equivalent plastic strain", "volumetric plastic strain"],
          "mises": ["equivalent plastic strain"], "hencky": ["equivalent plastic strain"], "dp": ["equivalent plastic strain", "volumetric plastic strain"]}

# Which kind of wall stands at which faces: in two dimensions each face has each kind once, the last of them are a box of
# slip walls, with edges and corners, where the first body lies.
WALLS = {2: ["0 1 2 3", "3 0 1 2", "2 3 0 1", "1 2 3 0"],
         3: ["0,2 1 3,4 5", "4 0,2 1 3,5", "1,2 3 0,5 4", "5 4 2 0,1,3"]}
SLIP = {2: "0,2,3 1 1 1", 3: "0,2,3,4 1,5 1,5 1,5"}

# The box as a mesh: its cells. Around domains of particles the grid is larger by a cell, and walls lie within.
MESH_CELLS = {2: "16, 12", 3: "8, 6, 6"}
LARGER = {2: {"Grid/Lower corner": "-0.2, -0.2", "Grid/Upper corner": "1.8, 1.4"},
          3: {"Grid/Lower corner": "-0.4, -0.4, -0.4", "Grid/Upper corner": "2, 1.6, 1.6"}}
SIZES = (1.6, 1.2, 1.2)


@dataclasses.dataclass
class Case:
    name: str
    dim: int
    settings: dict
    ranks: int = 1

    @property
    def prm(self):
        return f"contrib/lib/fingerprint_{self.dim}d.prm"


def walls(text, dim):
    faces = dict(zip(CONDITIONS.values(), text.split()))
    normals = {int(face) // 2 for face in faces["rough"].split(",")}
    along = "; ".join("0" if d in normals else "0.1" for d in range(dim))  # walls move along themselves
    return {**{f"Conditions/{kind}/Boundary ids": ids for kind, ids in faces.items()}, "Conditions/rough/Wall velocity": along}


def of_faces(settings, dim, entry, name):
    """Conditions by `entry`, which calls face 2 d + 1 (upper) or 2 d of axis d name(d, upper), instead of numbers."""
    result = dict(settings)
    for kind in CONDITIONS.values():
        faces = [int(face) for face in settings[f"Conditions/{kind}/Boundary ids"].split(",")]
        result[f"Conditions/{kind}/Boundary ids"] = ""
        result[f"Conditions/{kind}/{entry}"] = ", ".join(name("xyz"[face // 2], face % 2) for face in faces)
    return result


class Makes:
    """Makes cases; materials and walls go round from case to case, so that all meet."""

    def __init__(self):
        self.cases = []
        pairs = [(a, b) for a, b in itertools.product(MATERIALS, repeat=2) if a != b]
        n = len(pairs)
        self.turns = {dim: itertools.cycle([(pairs[7 * i % n], WALLS[dim][(i + i // n) % 4]) for i in range(4 * n)])
                      for dim in (2, 3)}

    def add(self, dim, kernel, treatment, transfer, *, plain=False, ranks=1, slip=False, materials=None, word="", more=None):
        turn = next(self.turns[dim])
        materials = materials or turn[0]
        if kernel in DOMAIN_KERNELS:  # domains follow F, which a fluid has not
            materials = tuple("hencky" if material == "fluid" else material for material in materials)
        settings = {"Kernel/Type": ALL_KERNELS[kernel], "Transfer/Type": ALL_TRANSFERS[transfer],
                    **self.place(kernel, treatment, walls(SLIP[dim] if slip else turn[1], dim), dim)}
        fields = FIELDS + (["affine moment"] if transfer == "apic" else [])
        for name, material in zip(("first", "second"), materials):
            settings.update({f"Materials/{name}/{entry}": value for entry, value in ALL_MATERIALS[material].items()})
            fields += [field for field in STATES.get(material, []) if field not in fields]
        if materials[1] == "fluid":  # bears no shear at rest
            settings["Bodies/roof/Stress"] = "-200, -200, -200, 0, 0, 0"
        if materials[1] in ("neo", "hooke", "hencky"):  # has its stress from its deformation alone
            settings["Bodies/roof/Initial stress"] = "none"
        if plain:
            settings["Run/Loops"] = "plain"
        # Steffen's functions create energy, linear ones cannot follow large motions; cubic ones let particles stray far.
        if treatment == "steffen" and transfer in ("apic", "tpic"):
            settings["Run/Number of steps"] = 8
        elif kernel in ("linear", "p1"):
            settings["Run/Number of steps"] = 10
        elif kernel in ("cubic", "cpdi") and ranks > 1:
            settings["Run/Number of steps"] = 50
        settings.update(more or {})
        if any(entry.endswith("J smoothing") for entry in settings):
            fields.append("gradient of the smoothed volume ratio")
        settings["Output/Particle fields"] = ", ".join(fields)
        words = [f"{dim}d", kernel, treatment, transfer, "-".join(materials), word, "plain" if plain else "",
                 f"{ranks}ranks" if ranks > 1 else ""]
        self.cases.append(Case(".".join(w for w in words if w), dim, settings, ranks))


    @staticmethod
    def place(kernel, treatment, conditions, dim):
        """Treatment, grid and conditions; no loads on surfaces where the kernel has none."""
        if kernel in MESH_KERNELS:
            conditions = of_faces(conditions, dim, "Boundaries", lambda axis, upper: ("lower ", "upper ")[upper] + axis)
            return {"Grid/Type": "mesh", "Grid/Cells": MESH_CELLS[dim], "Tractions/Names": "", **conditions}
        if kernel in DOMAIN_KERNELS:
            conditions = of_faces(conditions, dim, "Half spaces",
                                  lambda axis, upper: f"{axis} >= {SIZES['xyz'.index(axis)]}" if upper else f"{axis} <= 0")
            return {**LARGER[dim], **conditions}
        return {"Kernel/Boundary treatment": TREATMENTS[treatment], **conditions}


def fits(kernel, treatment):
    """Steffen's functions are defined for B-splines and hats."""
    return not (kernel == "ugimp" and treatment == "steffen")


def rotating():
    """Kernels and treatments, each pair with one transfer; each kernel meets each transfer."""
    for k, kernel in enumerate(KERNELS):
        for t, treatment in enumerate(TREATMENTS):
            if fits(kernel, treatment):
                yield kernel, treatment, list(TRANSFERS)[(k + t) % len(TRANSFERS)]


def all_cases():
    makes = Makes()
    for kernel, treatment, transfer in itertools.product(KERNELS, TREATMENTS, TRANSFERS):
        if fits(kernel, treatment):
            makes.add(2, kernel, treatment, transfer)
    for i, (kernel, treatment, transfer) in enumerate(rotating()):
        makes.add(3, kernel, treatment, transfer)
        makes.add(2 + i % 2, kernel, treatment, transfer, plain=True)
    projection = {"Transfer/Slip projection": "true"}
    smoothing = {"Materials/first/J smoothing": 0.1}
    for k, kernel in enumerate(KERNELS):
        # Slip walls, with edges and corners: mirrored and projected.
        makes.add(2, kernel, "mirror", "flip" if k % 2 else "tpic", slip=True, word="corner", plain=k % 2 == 1)
        makes.add(3, kernel, "mirror", "apic", slip=True, word="corner", plain=k % 2 == 0)
        makes.add(2, kernel, "wls" if k % 2 else "separable", "tpic", slip=True, word="projection", more=projection)
        makes.add(3, kernel, "separable", "apic", slip=True, word="projection", plain=k % 2 == 1, more=projection)
        makes.add(2 + k % 2, kernel, "separable", "tpic", slip=True, materials=("fluid", "neo"), word="smoothing",
                  more=smoothing)
    # What is beside kernels.
    others = {"damping": {"Run/Local damping": 0.4}, "swirl": {"Run/Body force": "10 * y; -10 * x + t"},
              "fixed-step": {"Run/Step size": 4e-4}, "rectangle": {"Grid/Spacing": "0.1, 0.08"},
              "cylinder": {"Bodies/disk/Shape": "cylinder", "Bodies/disk/Height": 0.3}}
    for word, more in others.items():
        makes.add(2, "quadratic", "wls", "tpic", word=word, more=more)
    makes.add(2, "ugimp", "wls", "tpic", word="half-length", more={"Kernel/Half length": 0.2})
    makes.add(2, "quadratic", "wls", "blend", word="fraction", more={"Transfer/FLIP fraction": 0.7})
    # Between ranks.
    for i, (kernel, treatment, transfer) in enumerate(rotating()):
        if i % 3 == 0:
            makes.add(2 + i % 2, kernel, treatment, transfer, ranks=2)
    for dim in (2, 3):
        makes.add(dim, "quadratic", "mirror", "apic", slip=True, word="corner", ranks=2)
        makes.add(dim, "cubic", "separable", "tpic", slip=True, word="projection", ranks=2, more=projection)
        makes.add(dim, "quadratic", "wls", "tpic", slip=True, materials=("fluid", "dp"), word="smoothing", ranks=2,
                  more=smoothing)
    lists(makes)
    return makes.cases


def lists(makes):
    """Kernels whose stencils are lists, and what there is beside them."""
    for k, kernel in enumerate((*DOMAIN_KERNELS, *MESH_KERNELS)):
        for t, transfer in enumerate((*TRANSFERS, *(["cpls"] if kernel in DOMAIN_KERNELS else []))):
            makes.add(2, kernel, "", transfer)
            makes.add(3, kernel, "", transfer)
            makes.add(2 + (k + t) % 2, kernel, "", transfer, ranks=2,
                      more={"Kernel/Layers": 1} if kernel in DOMAIN_KERNELS else None)
    for dim in (2, 3):
        makes.add(dim, "quadratic", "ghost", "apic", materials=("hencky", "hooke"), word="strains")
        makes.add(dim, "quadratic", "ghost", "tpic", materials=("mc", "elastic"), word="pyramid", ranks=dim - 1)
        makes.add(dim, "umls", "", "tpic", materials=("hencky", "hencky"), word="f-bar", more={"Run/F-bar": "true"})
        makes.add(dim, "quadratic", "ghost", "tpic", materials=("hencky", "neo"), word="f-bar", ranks=2,
                  more={"Run/F-bar": "true"})
        makes.add(dim, "cubic", "ghost", "flip", word="musl", more={"Run/MUSL": "true"})
        makes.add(dim, "quadratic", "wls", "tpic", word="symmetry", more={"Conditions/smooth/Type": "symmetry"})
