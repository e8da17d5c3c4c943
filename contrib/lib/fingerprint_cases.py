"""The cases of contrib/fingerprint: what of the program they cover, and the entries that make each of them."""
import dataclasses
import itertools

KERNELS = {"linear": "linear", "quadratic": "quadratic B-spline", "cubic": "cubic B-spline", "ugimp": "uGIMP"}
TREATMENTS = {"none": "none", "steffen": "Steffen", "wls": "WLS", "separable": "WLS separable",
              "everywhere": "WLS everywhere", "mls": "MLS", "mirror": "mirror", "ghost": "ghost nodes"}
TRANSFERS = {"flip": "FLIP", "pic": "PIC", "blend": "blend", "apic": "APIC", "tpic": "TPIC"}
MATERIALS = {"elastic": {"Type": "linear elastic"}, "neo": {"Type": "neo-Hookean"},
             "mises": {"Type": "von Mises", "Yield stress": 2000, "Hardening": "exponential softening",
                       "Residual yield stress": 500, "Softening rate": 5},
             "dp": {"Type": "Drucker-Prager", "Friction angle": 30, "Dilatancy angle": 10, "Cohesion": 300},
             "fluid": {"Type": "Newtonian fluid", "Sound speed": 40, "Viscosity": 5}}
CONDITIONS = {"slip": "smooth", "friction": "rough", "no-slip": "fixed", "velocity": "driven"}  # their names in the files

# What every particle has, and what some transfers and materials add to it.
FIELDS = ["position", "velocity", "velocity gradient", "deformation gradient", "stress", "mass", "volume",
          "initial position"]
STATES = {"mises": ["equivalent plastic strain"], "dp": ["equivalent plastic strain", "volumetric plastic strain"]}

# Which kind of wall stands at which faces: in two dimensions each face has each kind once, the last of them are a box of
# slip walls, with edges and corners, where the first body lies.
WALLS = {2: ["0 1 2 3", "3 0 1 2", "2 3 0 1", "1 2 3 0"],
         3: ["0,2 1 3,4 5", "4 0,2 1 3,5", "1,2 3 0,5 4", "5 4 2 0,1,3"]}
SLIP = {2: "0,2,3 1 1 1", 3: "0,2,3,4 1,5 1,5 1,5"}


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
        settings = {"Kernel/Type": KERNELS[kernel], "Kernel/Boundary treatment": TREATMENTS[treatment],
                    "Transfer/Type": TRANSFERS[transfer], **walls(SLIP[dim] if slip else turn[1], dim)}
        fields = FIELDS + (["affine moment"] if transfer == "apic" else [])
        for name, material in zip(("first", "second"), materials):
            settings.update({f"Materials/{name}/{entry}": value for entry, value in MATERIALS[material].items()})
            fields += [field for field in STATES.get(material, []) if field not in fields]
        if materials[1] == "fluid":  # bears no shear at rest
            settings["Bodies/roof/Stress"] = "-200, -200, -200, 0, 0, 0"
        if materials[1] == "neo":  # has its stress from its deformation alone
            settings["Bodies/roof/Initial stress"] = "none"
        if plain:
            settings["Run/Loops"] = "plain"
        # Steffen's functions create energy, linear ones cannot follow large motions; cubic ones let particles stray far.
        if treatment == "steffen" and transfer in ("apic", "tpic"):
            settings["Run/Number of steps"] = 8
        elif kernel == "linear":
            settings["Run/Number of steps"] = 18
        elif kernel == "cubic" and ranks > 1:
            settings["Run/Number of steps"] = 50
        settings.update(more or {})
        if any(entry.endswith("J smoothing") for entry in settings):
            fields.append("gradient of the smoothed volume ratio")
        settings["Output/Particle fields"] = ", ".join(fields)
        words = [f"{dim}d", kernel, treatment, transfer, "-".join(materials), word, "plain" if plain else "",
                 f"{ranks}ranks" if ranks > 1 else ""]
        self.cases.append(Case(".".join(w for w in words if w), dim, settings, ranks))


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
    return makes.cases
