"""The wrong inputs: how each changes the base file, and what talus must answer."""
from dataclasses import dataclass, field

BASE = """\
set Dimension = 2
subsection Run
  set End time = 0.01
  set Courant number = 0.5
end
subsection Grid
  set Lower corner = 0, 0
  set Upper corner = 2, 1
  set Spacing = 0.125
end
subsection Kernel
  set Type = quadratic B-spline
end
subsection Materials
  set Names = rubber
  subsection rubber
    set Density = 1e3
    set Young's modulus = 1e6
    set Poisson's ratio = 0.3
  end
end
subsection Bodies
  set Names = block
  subsection block
    set Lower corner = 0.25, 0.25
    set Upper corner = 1.75, 0.75
    set Velocity = 1; 0
  end
end
subsection Conditions
  set Names = floor
  subsection floor
    set Type = velocity
    set Boundary ids = 2
  end
end
subsection Output
  set Directory = output
end
"""


@dataclass
class Case:
    name: str
    changes: list  # (old, new) in BASE; FILE:LINE in a message is the line of the last
    message: list  # patterns that the message must contain
    status: int = 1
    arguments: list = field(default_factory=lambda: ["case.prm"])
    files: dict = field(default_factory=dict)
    output: str = ""  # directory whose files must be complete and finite
    before: list = field(default_factory=list)  # arguments of runs that must succeed first
    spoil: object = None  # called with the directory, after them
    disk: int = 0  # kB of a file system for the directory 'disk'
    is_user: bool = False  # run by somebody who is not root


# On a mesh of triangles.
MESH = [("set Spacing = 0.125", "set Type = mesh\n  set Cells = 16, 8"), ("quadratic B-spline", "UMLS"),
        ("set Boundary ids = 2", "set Boundaries = lower y")]


BOX = "    set Lower corner = 0.25, 0.25\n    set Upper corner = 1.75, 0.75\n"
BALL = "    set Centre = 1.25, {}\n    set Shape = ball\n    set Radius = {}\n"
POINTS = "    set Shape = points\n    set File = points.txt\n"
POINTS_ENTRY = "case.prm:26: entry 'File' in section 'Bodies/block': "
OUTSIDE = [r"lies outside the grid, which reaches from \(0, 0\) to \(2, 1\)", "Move the body, or enlarge the grid"]
EACH_STEP = ["--set", "Output/Step interval = 1", "--set", "Output/CSV = true"]
SHEAR = ["SHEAR", "--set", "Grid/Lower corner = -0.55, 0", "--set", "Grid/Upper corner = 1.55, 1", "--set",
         "Grid/Spacing = 0.1", "--set", "Run/Courant number = 5", "--set", "Output/Directory = output"] + EACH_STEP
DIVERGED = [r"(Particle \d+ |The kinetic energy )", r"step \d+", r"t = [-+.e\d]+", r"dt = [-+.e\d]+",
            r"at \([-.e\d]+, [-.e\d]+\)", "Lower the Courant number"]

EDGES = [argument.replace("Courant number = 5", "Courant number = 1.01") for argument in SHEAR[:-4]] + [
    "--set", "Transfer/Type = FLIP", "--set"]
ENERGY = DIVERGED[1:] + ["The kinetic and elastic energy .* is more than twice the", r"Most of it has particle \d+ at"]


def wrong_entry(name, old, new, entry, *message):
    return Case(name, [(old, new)], [r"FILE:LINE: ", f"entry '{entry}'", *message])


def wrong_solution(name, text, entry, *message, changes=()):
    section = "subsection Verification\n  # here\nend\n"
    return Case(name, [*changes, ("subsection Output\n", section + "subsection Output\n"), ("  # here", text)],
                [r"FILE:LINE: ", f"entry '{entry}' in section 'Verification'", *message])


def wrong_traction(name, text, entry, *message):
    section = "subsection Tractions\n  set Names = load\n  subsection load\n    # here\n  end\nend\n"
    return Case(name, [("subsection Output\n", section + "subsection Output\n"), ("    # here", text)],
                [r"FILE:LINE: ", f"entry '{entry}' in section 'Tractions/load'", *message])


CASES = {
    "command_line": [
        Case("no file", [], ["No parameter file given", "Try talus --help"], arguments=[]),
        Case("missing file", [], ["Cannot read the parameter file 'absent.prm'", "Check the name"],
             arguments=["absent.prm"]),
        Case("unknown option", [], ["Unknown option '--fast'", "Try talus --help"], arguments=["--fast", "case.prm"]),
        Case("set without value", [], ["--set \"Run/End time\"", "expected \"Section/Entry = value\""],
             arguments=["case.prm", "--set", "Run/End time"]),
        Case("unknown entry by --set", [], ["--set \"Run/End tim = 1\"", "Did you mean 'End time'"],
             arguments=["case.prm", "--set", "Run/End tim = 1"]),
        Case("resume without a directory", [], ["--resume needs the directory"], arguments=["--resume"]),
        Case("resume and a file", [], ["--resume takes the parameters from the checkpoint", "Leave out the parameter file"],
             arguments=["case.prm", "--resume", "output"]),
        Case("resume in no directory", [], ["--resume absent: there is no checkpoint in this directory", "Give the directory"],
             arguments=["--resume", "absent"]),
        Case("resume from half a checkpoint", [],
             ["'output/checkpoint_00000010.h5' is not a complete checkpoint, and there is no other one"],
             arguments=["--resume", "output"], files={"output/checkpoint_00000010.h5": "\211HDF\r\n"}),
    ],
    "entries": [
        wrong_entry("unknown entry", "set Courant number", "set Courant numbr", "Courant numbr",
                    "Did you mean 'Courant number'"),
        Case("slip projection beside ghost nodes",
             [("set Type = quadratic B-spline", "set Type = quadratic B-spline\n  set Boundary treatment = ghost nodes\nend\n"
               "subsection Transfer\n  set Slip projection = true")],
             ["'Slip projection' in section 'Transfer'", "with 'Boundary treatment = ghost nodes' none is", "Leave it out"]),
        Case("unknown section", [("subsection Run\n", "subsection Rum\n")],
             ["case.prm:[34]: ", "section 'Rum'", "Did you mean 'Run'"]),
        wrong_entry("misspelt kernel", "quadratic B-spline", "quadratic Bspline", "Type", "no 'quadratic Bspline'",
                    "Did you mean 'quadratic B-spline'", "Choices: .*linear"),
        Case("duplicate set",
             [("  set Courant number = 0.5\n", "  set Courant number = 0.5\n  set Courant number = 0.4\n")],
             ["case.prm:5: ", "entry 'Courant number'", "set before, at case.prm:4", "Remove one"]),
        Case("missing end", [("  set Spacing = 0.125\nend\n", "  set Spacing = 0.125\n")],
             ["case.prm:6: ", "subsection 'Grid' is never closed", "Add 'end'"]),
        Case("nonsense line", [("set Dimension = 2\n", "Dimension = 2\n")],
             ["FILE:LINE: ", "cannot understand 'Dimension = 2'", "A line is"]),
    ],
    "numbers": [
        wrong_entry("incompressible", "set Poisson's ratio = 0.3", "set Poisson's ratio = 0.5", "Poisson's ratio",
                    "between -1 and 0.5", "Use 0.49"),
        wrong_entry("negative density", "set Density = 1e3", "set Density = -1e3", "Density", "must be positive"),
        wrong_entry("NaN as density", "set Density = 1e3", "set Density = nan", "Density", "'nan'",
                    "Give a finite number"),
        wrong_entry("infinite end time", "set End time = 0.01", "set End time = inf", "End time", "'inf'",
                    "Give a finite number"),
        wrong_entry("NaN in a list", "set Upper corner = 2, 1", "set Upper corner = nan, 1", "Upper corner",
                    "Give a list, separated by commas, of 2 .*a finite number"),
        wrong_entry("text as number", "set Spacing = 0.125", "set Spacing = [fine]", "Spacing",
                    r"'\[fine\]' is not a valid value", "Give a list.* of at least 0"),
        wrong_entry("full damping", "set Courant number = 0.5", "set Local damping = 1", "Local damping",
                    "between 0 and 1"),
        wrong_entry("negative friction", "    set Type = velocity",
                    "    set Friction coefficient = -0.1\n    set Type = friction", "Friction coefficient",
                    "must not be negative"),
        wrong_entry("boundary id of 3D", "set Boundary ids = 2", "set Boundary ids = 5", "Boundary ids",
                    "a whole number between 0 and 3"),
    ],
    "functions": [
        wrong_entry("NaN as velocity", "set Velocity = 1; 0", "set Velocity = nan; 0", "Velocity",
                    "cannot understand 'nan; 0'", "Use x,y,t"),
        wrong_entry("bad function", "set Velocity = 1; 0", "set Velocity = 1 +* x; 0", "Velocity",
                    "cannot understand", "Unexpected operator", "Use x,y,t"),
        wrong_entry("unknown variable", "set Velocity = 1; 0", "set Velocity = 1; z", "Velocity", "Use x,y,t"),
        wrong_entry("too few components", "set Velocity = 1; 0", "set Velocity = 1", "Velocity",
                    "expected 2 expressions"),
        # Only one of two ranks has a particle there: it ends the other.
        wrong_entry("undefined in places", "set Velocity = 1; 0", "set Velocity = sqrt(1.7 - x); 0", "Velocity",
                    r"no finite value at the particle at \(1.7\d*, 0.\d+\)", "Correct the function"),
    ],
    "bodies": [
        wrong_entry("empty body", "set Upper corner = 1.75, 0.75", "set Upper corner = 1.75, 0.25", "Upper corner",
                    "the body is empty", "must lie above"),
        Case("empty ball", [(BOX, BALL.format(0.5, 0))],
             ["entry 'Radius' in section 'Bodies/block'", "the body is empty", "must be positive"]),
        Case("empty ring", [(BOX, "    set Inner radius = 1\n    set Shape = ring\n")],
             ["entry 'Outer radius' in section 'Bodies/block'", "the body is empty", "greater than the inner"]),
        Case("ring partly outside the grid", [(BOX, "    set Shape = ring\n")],
             ["entry 'Centre' in section 'Bodies/block'", *OUTSIDE]),
        wrong_entry("body outside the grid", BOX, BOX.replace("0.25, 0", "2.25, 0").replace("1.75, 0", "2.75, 0"),
                    "Lower corner' in section 'Bodies/block", *OUTSIDE),
        wrong_entry("body partly outside the grid", "set Lower corner = 0.25, 0.25", "set Lower corner = 0.25, -0.1",
                    "Lower corner", r"point \(0.[\d]+, -0.0[\d]+\)", *OUTSIDE),
        wrong_entry("ball partly outside the grid", BOX, BALL.format(0.5, 0.6), "Centre' in section 'Bodies/block",
                    *OUTSIDE),
        Case("lattice partly outside the grid", [(BOX, "    set Upper corner = 1, 1\n    set Lattice offset = 0, 0.6\n")],
             ["entry 'Lower corner' in section 'Bodies/block'", *OUTSIDE]),
    ],
    "points": [
        Case("points outside the grid", [(BOX, POINTS)],
             [POINTS_ENTRY, r"\(1, 1.5\)", *OUTSIDE], files={"points.txt": "0.5 0.5 0.01\n1 1.5 0.01\n"}),
        Case("short line", [(BOX, POINTS)],
             ["points.txt:3: ", "expected 3 numbers", "found 2", "Complete or remove the line"],
             files={"points.txt": "# x y volume\n0.5 0.5 0.01\n0.6 0.5\n"}),
        Case("word", [(BOX, POINTS)], ["points.txt:1: ", "'o.5' is not a finite number", "Correct"],
             files={"points.txt": "0.5 o.5 0.01\n"}),
        Case("NaN", [(BOX, POINTS)], ["points.txt:1: ", "'nan' is not a finite number", "Correct"],
             files={"points.txt": "0.5 nan 0.01\n"}),
        Case("negative volume", [(BOX, POINTS)], ["points.txt:1: ", "the volume must be positive", "Correct"],
             files={"points.txt": "0.5 0.5 -0.01\n"}),
        Case("no points", [(BOX, POINTS)], [POINTS_ENTRY, "the body is empty", "contains no points", "Give one"],
             files={"points.txt": "# x y volume\n"}),
        Case("missing point file", [(BOX, POINTS)], [POINTS_ENTRY, "cannot read 'points.txt'", "Check the name"]),
    ],
    "surroundings": [
        Case("output below a file", [("set Directory = output", "set Directory = notes/output")],
             ["FILE:LINE: ", "entry 'Directory'", "'notes' is a file", "Choose another directory"],
             files={"notes": ""}),
        Case("old output directory", [("set Directory = output", "set Directory = output")],
             ["FILE:LINE: ", "entry 'Directory'", "not empty", "Set 'Overwrite' to true"],
             files={"output/log.txt": ""}),
        wrong_entry("spacing that does not divide the box", "set Spacing = 0.125", "set Spacing = 0.15", "Spacing",
                    "13.3+ spacings long in direction x", "Move a corner"),
        wrong_entry("more cells than memory", "set Spacing = 0.125", "set Spacing = 1e-6", "Spacing",
                    r"2e\+12 cells take .* GB at least, and there are .* GB of memory", "larger spacing"),
        wrong_entry("more cells than numbers", "set Spacing = 0.125", "set Spacing = 1e-10", "Spacing",
                    r"2e\+10 cells long in direction x, too many", "larger spacing"),
        wrong_entry("empty box of nodes", "set Boundary ids = 2",
                    "set Lower corner = 0.01, 0.01\n    set Upper corner = 0.02, 0.02", "Lower corner",
                    "no node of the grid", "at least a spacing wide"),
        Case("condition that acts nowhere", [("    set Boundary ids = 2\n", "")],
             ["case.prm: ", "entry 'Boundary ids' in section 'Conditions/floor'", "acts nowhere", "Give boundary ids"]),
        Case("friction in a box of nodes",
             [("set Type = velocity\n    set Boundary ids = 2",
               "set Type = friction\n    set Lower corner = 0, 0\n    set Upper corner = 2, 0.1")],
             ["case.prm: ", "entry 'Boundary ids' in section 'Conditions/floor'", "friction needs the faces"]),
        wrong_entry("half space without a node", "set Boundary ids = 2", "set Half spaces = y <= -0.5", "Half spaces",
                    "no node of the grid lies in 'y <= -0.5'", "Move the plane"),
        wrong_entry("half space that is none", "set Boundary ids = 2", "set Half spaces = y < 1", "Half spaces",
                    "cannot understand 'y < 1'", "x <= 0.1"),
        wrong_solution("solution of another material", "  set Solution = vortex", "Solution", "one neo-Hookean material"),
        wrong_solution("solution with tractions", "  set Solution = ring", "Solution", "Set Poisson's ratio to 0",
                       changes=[("    set Density", "    set Type = neo-Hookean\n    set Density")]),
        wrong_solution("solution inside out", "  set Amplitude = 0.5\n  set Solution = vibration", "Amplitude",
                       "inside out", "smaller amplitude",
                       changes=[("    set Density", "    set Type = neo-Hookean\n    set Density")]),
        wrong_entry("condition that never acts", "    set Boundary ids = 2",
                    "    set End time = 1\n    set Start time = 2\n    set Boundary ids = 2", "End time", "never acts",
                    "after the start time"),
        Case("body force beside a solution",
             [("    set Density", "    set Type = neo-Hookean\n    set Density"),
              ("subsection Output\n", "subsection Verification\n  set Solution = vortex\nend\nsubsection Output\n"),
              ("  set End time", "  set Body force = 0; -9.81\n  set End time")],
             ["FILE:LINE: ", "entry 'Body force' in section 'Run'", "the manufactured solution gives it"]),
        wrong_traction("face that does not exist", "    set Faces = top", "Faces", "has no face 'top'",
                       r"Choices: all, x-, x\+, y-, y\+"),
        wrong_traction("traction that acts nowhere", "    set Lower corner = 0.5, 0.4\n    set Upper corner = 1, 0.6",
                       "Lower corner", "no point of the surface", "Make it larger"),
        wrong_traction("traction on no body", "    set Body = blok", "Body", "Did you mean 'block'"),
        wrong_traction("force off the body", "    set Position = 1.9, 0.9\n    set Type = force", "Position",
                       "no particle of 'block'", "Move it to the body"),
        wrong_entry("unknown field", "set Directory = output", "set Particle fields = presure", "Particle fields",
                    "presure", "pressure"),
    ],
    "diverged": [
        Case("Courant number 5, WLS", [], DIVERGED, 2, SHEAR, output="output"),
        Case("Courant number 5, Steffen", [], DIVERGED, 2,
             SHEAR + ["--set", "Kernel/Boundary treatment = Steffen", "--set", "Transfer/Type = APIC"],
             output="output"),
        Case("Courant number 5, FLIP", [], DIVERGED, 2, SHEAR + ["--set", "Transfer/Type = FLIP"], output="output"),
        # A free edge at the limit of stability: the stress diverges, the kinetic energy stays below its own bound.
        Case("elastic energy, on the way", [], ENERGY + [r"in step \d00,"], 2, EDGES + ["Run/End time = 0.0525"]),
        Case("elastic energy, at the end", [], ENERGY + ["in step 594,"], 2, EDGES + ["Run/Number of steps = 594"]),
        Case("particle leaves the grid", [("set Velocity = 1; 0", "set Velocity = 100; 0")],
             [r"Particle \d+ left the grid, at \(2[.\d]*, 0[.\d]*\) in step \d+, t = 0\.00\d+, dt = ",
              "Enlarge the grid"], 2, ["case.prm"] + EACH_STEP, output="output"),
        Case("particle leaves the mesh", MESH + [("set Velocity = 1; 0", "set Velocity = 100; 0")],
             [r"Particle \d+ left the grid, at \(2[.\d]*, 0[.\d]*\) in step \d+, t = 0\.00\d+, dt = ",
              "No condition acts on the nodes there", "enlarge the mesh"], 2, ["case.prm"] + EACH_STEP, output="output"),
        Case("particle pressed through the end of a mesh",
             MESH + [("set Velocity = 1; 0", "set Velocity = 20; 0"), ("1.75, 0.75", "1.95, 0.5"), ("1e6", "1e3"),
                     ("set Boundaries = lower y", "set Boundaries = upper x"), ("= 0.01", "= 0.1")],
             [r"Particle \d+ left the grid, at \(2[.\d]*, 0[.\d]*\) in step \d+, t = ", "A condition acts on the nodes there",
              "'No-slip mirrors' or 'Slip mirrors' of section 'Grid'", "'Held boundaries'"], 2, ["case.prm"] + EACH_STEP, output="output"),
    ],
}
