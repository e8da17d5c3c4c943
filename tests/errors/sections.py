"""Wrong inputs of every section of a parameter file, and of every type that it chooses."""
from cases import BALL, BOX, Case, MESH, wrong_entry, wrong_traction

E, NU = "    set Young's modulus = 1e6\n", "    set Poisson's ratio = 0.3\n"
RUN, KERNEL, DENSITY = "  set Courant number = 0.5", "  set Type = quadratic B-spline", "    set Density = 1e3"


def in_run(name, text, entry, *message):
    return wrong_entry(name, RUN, RUN + "\n  set " + text, entry, *message)


def in_kernel(name, text, *message):
    return Case(name, [(KERNEL, text)], ["case.prm", *message])


def in_material(name, kind, text, entry, *message):
    return wrong_entry(name, DENSITY, f"    set Type = {kind}\n{DENSITY}\n    set {text}", entry, *message)


def in_body(name, text, entry, *message):
    return wrong_entry(name, "    set Velocity = 1; 0", text, entry, *message)


def in_floor(name, text, entry, *message):
    return wrong_entry(name, "    set Type = velocity\n    set Boundary ids = 2", text, entry, *message)


def in_output(name, text, entry, *message):
    return wrong_entry(name, "  set Directory = output", "  set Directory = output\n  " + text, entry, *message)


def in_section(name, section, text, entry, *message, changes=()):
    """A section that the base file has not; `text` has lines 'set ...' and may have sections."""
    body = "".join(f"  {line}\n" for line in text.split("\n"))
    return Case(name, [*changes, ("subsection Output\n", f"subsection {section}\n{body}end\nsubsection Output\n")],
                [r"case.prm:\d+: ", f"'{entry}'", *message])


def contact(name, text, entry, *message):
    text = "\n".join("  set " + line for line in text.split("\n"))
    return in_section(name, "Contacts", f"set Names = wall\nsubsection wall\n{text}\nend", entry, *message)


def obstacle(name, text, entry, *message):
    text = "\n".join("  set " + line for line in text.split("\n"))
    return in_section(name, "Obstacles", f"set Names = bed\nsubsection bed\n{text}\nend", entry, *message)


def reference(name, text, entry, *message):
    return in_section(name, "FEM reference", "set Compare = yes\n" + text, entry, *message)


FLUID = [(E + NU, ""), (DENSITY, "    set Type = Newtonian fluid\n" + DENSITY)]
SOLID = "Lower corner = 0.25, 0.25\nset Upper corner = 1.75, 0.75\nset Cells = 6, 2"
BOTTOM = "\nsubsection Conditions\n  set Names = bottom\n  subsection bottom\n    set {}\n  end\nend"
PROBE = "subsection Probes\n  set Names = a\n  subsection a\n    set {}\n  end\n  end"

CASES = {
    "run": [
        in_run("negative step size", "Step size = -1", "Step size", "at least 0"),
        wrong_entry("negative Courant number", RUN, "  set Courant number = -1", "Courant number", "must not be negative"),
        in_run("no end time", "Number of steps = -1", "Number of steps", "whole number"),
        in_run("half a step", "Number of steps = 1.5", "Number of steps", "whole number"),
        in_run("steps beyond numbers", "Number of steps = 99999999999", "Number of steps", "whole number"),
        in_run("unknown stepper", "Stepper = implicit", "Stepper", "Choices: explicit"),
        in_run("unknown loops", "Loops = fast", "Loops", "batched", "plain"),
        in_run("MUSL maybe", "MUSL = perhaps", "MUSL", "true"),
        in_run("negative mass cutoff", "Mass cutoff = -1", "Mass cutoff", "between 0 and 1"),
        in_run("balance finer than balance", "Largest imbalance = 0.5", "Largest imbalance"),
        in_run("body force of three components", "Body force = 0; -9.81; 0", "Body force", "2 expressions"),
        in_run("F-bar of no averages", "F-bar averages = -1", "F-bar averages", "F-bar"),
        wrong_entry("end time of 0", "set End time = 0.01", "set End time = 0", "End time", "must be positive"),
        wrong_entry("steps for ages", "set End time = 0.01", "set End time = 1e12", "End time", "steps"),
        Case("steps for ages by Courant number", [(RUN, "  set Courant number = 1e-12")],
             ["case.prm:3: ", "'End time'", r"would take \S+ steps", "Check the units"]),
        Case("steps for ages by step size", [(RUN, "  set Step size = 1e-15")],
             ["case.prm:3: ", "'End time'", r"would take \S+ steps", "Check the units"]),
        wrong_entry("four dimensions", "set Dimension = 2", "set Dimension = 4", "Dimension", "Choices: 2, 3"),
        Case("a box of 2D in 3D", [("set Dimension = 2", "set Dimension = 3")], ["case.prm:25: ", "'Lower corner'", "of 3 "]),
    ],
    "kernel": [
        in_kernel("unknown treatment", KERNEL + "\n  set Boundary treatment = WSL", "Boundary treatment", "Did you mean 'WLS'"),
        in_kernel("half length of 0", "  set Type = uGIMP\n  set Half length = 0", "'Half length'"),
        in_kernel("half length beyond the cell", "  set Type = uGIMP\n  set Half length = 3", "'Half length'", "between"),
        in_kernel("half length of B-splines", KERNEL + "\n  set Half length = 0.2", "Half length"),
        in_kernel("no layers", "  set Type = CPDI\n  set Layers = 0", "'Layers'", "at least|between"),
        in_kernel("Steffen's uGIMP", "  set Type = uGIMP\n  set Boundary treatment = Steffen", "'Boundary treatment'",
                  "Use 'none' or 'WLS'"),
        in_kernel("CPDI with a treatment", "  set Type = CPDI\n  set Boundary treatment = WLS", "Boundary treatment"),
        in_kernel("unknown transfer", KERNEL + "\nend\nsubsection Transfer\n  set Type = FLIPP", "Did you mean 'FLIP'"),
        in_kernel("FLIP beyond FLIP", KERNEL + "\nend\nsubsection Transfer\n  set Type = blend\n  set FLIP fraction = 1.5",
                  "'FLIP fraction'", "between 0 and 1"),
        in_kernel("projection of FLIP", KERNEL + "\nend\nsubsection Transfer\n  set Type = FLIP\n  set Slip projection = true",
                  "'Slip projection'"),
        in_kernel("CPLS without CPDI", KERNEL + "\nend\nsubsection Transfer\n  set Type = CPLS", "CPDI"),
    ],
    "grid": [
        wrong_entry("grid inside out", "set Upper corner = 2, 1", "set Upper corner = -2, 1", "Upper corner", "above"),
        wrong_entry("flat grid", "set Upper corner = 2, 1", "set Upper corner = 2, 0", "Upper corner", "above"),
        wrong_entry("one corner", "set Upper corner = 2, 1", "set Upper corner = 2", "Upper corner", "list.* of 2"),
        wrong_entry("no spacing", "set Spacing = 0.125", "set Spacing = 0", "Spacing"),
        wrong_entry("negative spacing", "set Spacing = 0.125", "set Spacing = -0.125", "Spacing", "at least 0"),
        wrong_entry("spacings of three", "set Spacing = 0.125", "set Spacing = 0.1, 0.1, 0.1", "Spacing", "1 (to|or) 2|2"),
        wrong_entry("spacing and cells", "set Spacing = 0.125", "set Spacing = 0.125\n  set Cells = 16, 8", "(Cells|Spacing)"),
        Case("neither", [("set Spacing = 0.125", "set Type = box")], ["case.prm: ", "'Spacing'", "give either"]),
        wrong_entry("no cells", "set Spacing = 0.125", "set Cells = 0, 8", "Cells", "at least 1"),
        wrong_entry("cells beyond numbers", "set Spacing = 0.125", "set Cells = 3000000000, 8", "Cells"),
        wrong_entry("cells beyond memory", "set Spacing = 0.125", "set Cells = 1000000, 100000", "Cells", "memory"),
        wrong_entry("unknown type", "set Spacing = 0.125", "set Type = hexagons", "Type", "Choices: .*box"),
        Case("mesh cells beyond memory", MESH + [("set Cells = 16, 8", "set Cells = 400000, 100000")],
             [r"FILE:LINE: entry 'Cells'", "memory"]),
    ],
    "materials": [
        wrong_entry("no material", "set Names = rubber", "set Names = ", "Names", "material"),
        wrong_entry("materials twice", "set Names = rubber", "set Names = rubber, rubber", "Names", "stands there twice"),
        wrong_entry("name with a slash", "set Names = rubber", "set Names = rub/ber", "Names", "must not contain"),
        wrong_entry("no stiffness", E, "    set Young's modulus = 0\n", "Young's modulus", "must be positive"),
        in_material("unknown material", "von Mieses", "Yield stress = 1", "Type", "Did you mean 'von Mises'"),
        in_material("entry of another material", "neo-Hookean", "Yield stress = 1", "Yield stress", "Known there"),
        in_material("negative yield stress", "von Mises", "Yield stress = -1", "Yield stress", "positive"),
        in_material("unknown hardening", "von Mises", "Hardening = cubic", "Hardening", "perfect"),
        in_material("residual above the first", "von Mises", "Yield stress = 10\n    set Hardening = exponential softening\n"
                    "    set Residual yield stress = 20", "Residual yield stress"),
        in_material("negative hardening", "Hencky", "Hardening modulus = -1e9\n    set Hardening = linear", "Hardening modulus"),
        in_material("unknown norm", "Hencky", "Strength norm = Tresca", "Strength norm", "von Mises"),
        in_material("upright sand", "Drucker-Prager", "Friction angle = 90", "Friction angle", "90"),
        in_material("negative cohesion", "Drucker-Prager", "Cohesion = -1", "Cohesion", "at least 0|negative"),
        in_material("sand that swells too much", "Drucker-Prager", "Friction angle = 20\n    set Dilatancy angle = 30",
                    "Dilatancy angle", "friction angle"),
        Case("silent fluid", FLUID + [(DENSITY, DENSITY + "\n    set Sound speed = 0")],
             ["case.prm:19: ", "'Sound speed'", "must be positive"]),
        Case("fluid that gains energy", FLUID + [(DENSITY, DENSITY + "\n    set Viscosity = -1")], ["case.prm:19: ", "'Viscosity'", "must not be negative"]),
        Case("smoothing beyond one", FLUID + [(DENSITY, DENSITY + "\n    set J smoothing = -1")], ["case.prm:19: ", "'J smoothing'", "must not be negative"]),
        in_material("misspelt entry", "Hooke", "Poissons ratio = 0.1", "Poissons ratio", "Did you mean 'Poisson's ratio'"),
    ],
    "more_bodies": [
        wrong_entry("no body", "set Names = block", "set Names =", "Names", "at least one body"),
        Case("no body for a load", [("subsection Output\n", "subsection Tractions\n  set Names = load\n  subsection load\n    set Traction = 1; 0\n"
                                     "  end\nend\nsubsection Output\n"), ("set Names = block", "set Names =")],
             [r"FILE:LINE: entry 'Names' in section 'Bodies': give at least one body"]),
        Case("no material for a reference", [("subsection Output\n", "subsection FEM reference\n  set Compare = yes\nend\nsubsection Output\n"),
                                             ("set Names = block", "set Names ="), ("set Names = rubber", "set Names =")],
             [r"entry 'Names' in section '(Materials|Bodies)': give at least one"]),
        in_body("unknown shape", "    set Shape = cube", "Shape", "Choices: .*box"),
        in_body("unknown material", "    set Material = steel", "Material", "rubber"),
        in_body("no particles per cell", "    set Particles per cell and direction = 0", "Particles per cell and direction", "1"),
        in_body("more particles than memory", "    set Particles per cell and direction = 100000",
                "Particles per cell and direction", "between 1 and 16"),
        in_body("jitter beyond the neighbour", "    set Jitter = 2", "Jitter", "between"),
        in_body("gradient of three numbers", "    set Velocity gradient = 1, 2, 3", "Velocity gradient", "4"),
        in_body("deformation inside out", "    set Deformation gradient = -1, 0, 0, 1", "Deformation gradient"),
        in_body("unknown initial stress", "    set Initial stress = hydraulic", "Initial stress", "hydrostatic"),
        in_body("stress of two numbers", "    set Initial stress = uniform\n    set Stress = 1, 2", "Stress", "6|list"),
        Case("bodies that overlap", [("set Names = block\n  subsection block", "set Names = block, twin\n  subsection twin\n"
                                      + BOX + "  end\n  subsection block")], ["case.prm", "overlap"]),
        Case("cylinder along no axis", [(BOX, BALL.format(0.5, 0.2).replace("ball", "cylinder") + "    set Height = -1\n")],
             ["case.prm", "'Height'", "positive|empty"]),
        Case("ring with no sector", [(BOX, "    set Shape = ring\n    set Centre = 1, 0.5\n    set Inner radius = 0.1\n"
                                           "    set Outer radius = 0.4\n    set First angle = 90\n    set Last angle = 90\n")],
             ["case.prm", "angle"]),
        Case("no outline", [(BOX, "    set Shape = surface\n    set File = nowhere.txt\n")],
             ["case.prm", "'File' in section 'Bodies/block'", "nowhere.txt", "Check the name"]),
        Case("open outline", [(BOX, "    set Shape = surface\n    set File = outline.txt\n")],
             ["outline.txt", "not closed", "Repeat"], files={"outline.txt": "0.3 0.3\n1 0.3\n1 0.7\n"}),
        Case("outline that crosses itself", [(BOX, "    set Shape = surface\n    set File = outline.txt\n")],
             ["outline.txt", "cross|itself|intersect"], files={"outline.txt": "0.3 0.3\n1 0.7\n1 0.3\n0.3 0.7\n0.3 0.3\n"}),
    ],
    "conditions": [
        in_floor("unknown condition", "    set Type = glue\n    set Boundary ids = 2", "Type", "Choices: .*no-slip"),
        in_floor("ids in words", "    set Type = slip\n    set Boundary ids = bottom", "Boundary ids", "whole number"),
        in_floor("names on a box", "    set Type = slip\n    set Boundaries = south", "Boundaries", "Give 'Boundary ids'"),
        in_floor("component that is none", "    set Type = velocity\n    set Boundary ids = 2\n    set Components = w",
                 "Components", "x, y"),
        in_floor("velocity of one component", "    set Type = velocity\n    set Boundary ids = 2\n    set Velocity = 1", "Velocity",
                 "2 expressions"),
        in_floor("wall that leaves", "    set Type = friction\n    set Boundary ids = 2\n    set Friction coefficient = 0.1\n"
                 "    set Wall velocity = 0; 1", "Wall velocity"),
        in_floor("box without a corner", "    set Type = velocity\n    set Lower corner = 0, 0", "Lower corner", "both corners"),
        in_floor("sink", "    set Type = symmetry\n    set Half spaces = z <= 0", "Half spaces"),
        Case("condition without a section", [("set Names = floor", "set Names = ceiling")],
             ["case.prm:34: ", "nothing reads the section 'Conditions/floor'", "list 'floor' in 'Names'"]),
        wrong_traction("unknown traction", "    set Type = suction", "Type", "Choices: .*pressure"),
        wrong_traction("no layers of corners", "    set Type = pressure\n    set Layers = 0", "Layers", "1"),
        wrong_traction("pressure of two", "    set Type = pressure\n    set Pressure = 1; 2", "Pressure", "expected one expression"),
        wrong_traction("traction of one", "    set Traction = 1", "Traction", "2 expressions"),
        wrong_traction("no points", "    set Points per cell edge = 0", "Points per cell edge", "1"),
        wrong_traction("force nowhere", "    set Type = force\n    set Position = 0.5", "Position", "2"),
        contact("no pressure", "Surface = ball\nCentre = 1, 0.5\nRadius = 3\nPressure = 0", "Pressure", "must be positive"),
        contact("unknown surface", "Surface = cube\nPressure = 1e5", "Surface", "Choices: .*ball"),
        contact("no radius", "Surface = ball\nRadius = -1\nPressure = 1e5", "Radius", "positive|at least"),
        contact("friction that drives", "Surface = ball\nCentre = 1, 0.5\nRadius = 3\nPressure = 1e5\nFriction coefficient = -1",
                "Friction coefficient", "at least 0|negative"),
        contact("mesh of a box", "Surface = mesh\nPressure = 1e5", "Surface", "mesh"),
        obstacle("obstacle in a body", "Surface = formula\nFormula = y - 0.3", "Surface", "24 particle.*deepest of them, particle", "Move the obstacle"),
        obstacle("obstacle beyond the grid", "Surface = formula\nFormula = y + 1", "Surface", "no node", "two spacings thick"),
        obstacle("obstacle that breathes", "Formula = y - 0.1 * t", "Formula", "leave out t"),
        obstacle("obstacle that bends", "Formula = y - 0.1\nDisplacement = x; 0", "Displacement", "moves as a whole"),
        obstacle("obstacle that twists", "Formula = y - 0.1\nRotation = y", "Rotation", "turns as a whole"),
        obstacle("obstacle with friction that drives", "Formula = y - 0.1\nFriction coefficient = -1", "Friction coefficient",
                 "must not be negative"),
        obstacle("obstacle of two formulas", "Formula = y; x", "Formula", "one number"),
        obstacle("obstacle without a number", "Formula = log(x - 5)", "Formula", "no finite value"),
        obstacle("obstacle of two corners", "Surface = polygon\nCorners = 0, 0; 1, 0", "Corners", "three corners"),
        obstacle("obstacle that crosses itself", "Surface = polygon\nCorners = 0, 0; 2, 0.2; 2, 0; 0, 0.2", "Corners", "cross"),
        obstacle("obstacle of a missing file", "Surface = surface\nFile = nowhere.txt", "File", "nowhere.txt"),
        contact("no surface file", "Surface = surface\nFile = nowhere.txt\nPressure = 1e5", "File", "nowhere.txt"),
    ],
    "results": [
        wrong_entry("no directory", "  set Directory = output", "  set Directory =", "Directory", "no name"),
        in_output("negative interval", "set Time interval = -1", "Time interval", "at least 0"),
        in_output("infinite interval", "set Time interval = inf", "Time interval", "finite"),
        in_output("statistics never", "set Statistics interval = 0", "Statistics interval", "at least 1"),
        in_output("probe off the body", PROBE.format("Kind = point\n    set Position = 5, 5"), "Position", "grid|outside"),
        in_output("probe of no kind", PROBE.format("Kind = line"), "Kind", "particle"),
        in_output("probe in one dimension", PROBE.format("Position = 1"), "Position", "2"),
        in_output("unknown field of probes", "subsection Probes\n  set Names = a\n  set Fields = colour\n  end", "Fields", "Choices"),
        in_section("no checkpoint kept", "Checkpoints", "set Kept = 0", "Kept", "at least 1"),
        in_section("checkpoints before now", "Checkpoints", "set Time interval = -1", "Time interval", "at least 0"),
        in_section("checkpoints in half steps", "Checkpoints", "set Step interval = 0.5", "Step interval", "whole number"),
        in_section("unknown solution", "Verification", "set Solution = shear", "Solution", "Choices: .*vortex"),
        reference("unknown model", "set Model = Mohr-Coulomb", "Model", "Choices: .*J2"),
        reference("no degree", "set Degree = 0\nset " + SOLID, "Degree", "1"),
        reference("no elements", "set Lower corner = 0.25, 0.25\nset Upper corner = 1.75, 0.75\nset Cells = 0, 2", "Cells", "1"),
        reference("elements inside out", "set Lower corner = 1, 1\nset Upper corner = 0, 0", "Upper corner", "is empty"),
        reference("elements beyond memory", "set " + SOLID.replace("6, 2", "1000000, 100000") +
                  BOTTOM.format("Boundary ids = 2"), "Cells", "memory"),
        reference("reference that may float", "set " + SOLID + BOTTOM.format("Boundary ids = 2\n    set Components = x"), "Names",
                  "free to move or turn"),
        reference("half a displacement", "set " + SOLID + BOTTOM.format("Boundary ids = 2\n    set Displacement = 1"),
                  "Displacement", "2 expressions"),
        reference("unknown material", "set Material = steel\nset " + SOLID + BOTTOM.format("Boundary ids = 2"), "Material"),
    ],
}
