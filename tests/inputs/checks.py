#!/usr/bin/env python3
"""More inputs as those of run.py: tables, formulas, clipped bodies, loads, floors, and energies that are no alarm.

Usage: checks.py TALUS WORK_DIRECTORY CASE RANKS [MPIRUN ...]
"""
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.dirname(HERE), HERE]
from inputs import points, refused, text_of, warned, write  # noqa: E402
from program import columns_of, last_particles, main  # noqa: E402

MESH = {2: [("set Spacing = 0.125", "set Type = mesh\n  set Cells = 16, 16")],
        3: [("set Spacing = 0.125", "set Type = mesh\n  set Cells = 8, 8, 8")]}


def on_mesh(text, dim):
    """The same run on triangles or tetrahedra."""
    for old, new in MESH[dim] + [("set Boundary ids = 2", "set Boundaries = lower y")]:
        text = text.replace(old, new)
    return text + "subsection Kernel\n  set Type = UMLS\nend\n"


def case_headers(runs):
    """Columns that are called otherwise are not read as coordinates and volumes; separators and signs without width."""
    rows = points(2)
    for name, header in (("capitals", "V X Y"), ("mass", "x y mass"), ("no_volume", "x y z"), ("number", "ID,X,Y")):
        path = write(runs, f"{name}.txt", header + "\n" + rows)
        refused(runs, name, "point_file.prm", [f"Bodies/b/File = {path}"], f"{name}.txt:1: the columns are called '.*', but are "
                "read as 'x y volume'. Put them into this order, and call them so")
    path = write(runs, "gap.txt", "0.5,,0.01\n")
    refused(runs, "gap", "point_file.prm", [f"Bodies/b/File = {path}"], "gap.txt:1: a number is missing between two separators")
    good = {"named": "X Y V\n" + rows, "area": "x y area\n" + rows, "invisible": rows.replace(" ", "\u2003\u200b"),
            "plane": "x z volume\n" + rows}
    for name, text in good.items():
        particles = last_particles(runs.run("point_file.prm", name, f"Bodies/b/File = {write(runs, name + '.txt', text)}"))
        runs.check(f"{name}: particles", len(particles) - 16, 0.5)
        runs.check(f"{name}: mass", sum(p["mass"] for p in particles) / (1000 * 16 * 0.05**2) - 1, 1e-9)
    # Volumes in another unit.
    for name, factor, said in (("mass_for_volume", 1e3, "that they are no masses"), ("millimetres", 1e-6, "Check the unit")):
        x = [0.2 + 0.05 * k for k in range(12)]
        path = write(runs, f"{name}.txt", "".join(f"{a} {b} {0.05**2 * factor}\n" for a in x for b in x))
        warned(runs, name, "point_file.prm", [f"Bodies/b/File = {path}"], "entry 'File' in section 'Bodies/b'.*" + said)


def case_tables(runs):
    """A run that starts from another one's table goes on as that one did; names tell columns apart."""
    columns = "velocity, velocity gradient, deformation gradient, stress, mass, volume, initial position"
    disk = os.path.join(os.path.dirname(HERE), "compare", "disk_2d.prm")
    common = ["Run/Step size = 2e-4", "Output/CSV = true", f"Output/Particle fields = {columns}"]
    for law in ("linear elastic", "neo-Hookean"):
        name, material = law.replace(" ", "_"), f"Materials/rubber/Type = {law}"
        whole = last_particles(runs.run(disk, name, *common, material, "Run/Number of steps = 100"))
        half = runs.run(disk, f"{name}_half", *common, material, "Run/Number of steps = 60")
        table = max(file for file in os.listdir(half) if file.startswith("particles_") and file.endswith(".csv"))
        start = open(disk).read().split("subsection Bodies")[0] + (
            f"subsection Bodies\n  set Names = disk\n  subsection disk\n    set Shape = points\n    set File = {os.path.join(half, table)}\n  end\nend\n")
        then = last_particles(runs.run(write(runs, f"{name}.prm", start), f"{name}_then", *common, material, "Run/Number of steps = 40"))
        runs.check(f"{name}: particles", len(whole) - len(then), 0.5)
        for key in ("x", "y", "velocity_x", "stress_xy", "deformation_gradient_xy", "initial_position_x"):
            scale = max(abs(p[key]) for p in whole)
            runs.check(f"{name}: {key}", max(abs(a[key] - b[key]) for a, b in zip(whole, then)) / scale, 1e-9)
    rows = [(0.6 + 0.05 * i, 0.3 + 0.05 * j) for i in range(4) for j in range(4)]
    path = write(runs, "turned.txt", '"y","volume","x"\n' + "".join(f"{y},0.0025,{x}\n" for x, y in rows))
    particles = last_particles(runs.run("point_file.prm", "turned", f"Bodies/b/File = {path}", "Run/Number of steps = 1"))
    runs.check("turned: least x", min(p["x"] for p in particles) - 0.6, 0.01)


def case_where(runs):
    """Conditions at the nodes where a formula holds: half of a floor bears half of a block, all nodes beyond a slope."""
    floor = "set Type = no-slip\n    set Boundary ids = 2"
    body = "set Lower corner = 0, 0\n    set Upper corner = 2, 1\n    set Velocity = 0; 1"
    prm = write(runs, "where.prm", text_of(2, body=body, condition=floor))
    taken = {}
    for name, where in (("all", ""), ("left", "x < 1"), ("right", "x >= 1"), ("slope", "y < 0.5 * x")):
        more = ["Conditions/floor/Boundary ids = "] if name == "slope" else []
        s = columns_of(os.path.join(runs.run(prm, name, f"Conditions/floor/Where = {where}", "Run/Number of steps = 1", *more), "statistics.csv"))
        taken[name] = s["reaction floor y"][-1] * s["time"][-1]  # momentum
    runs.check("halves", (taken["left"] + taken["right"]) / taken["all"] - 1, 1e-12)
    runs.check("a half", taken["left"] / taken["all"] - 0.5, 0.07)
    runs.check("below a slope lies half of the block", taken["slope"] / (1000 * 2 * 0.5) - 1, 0.1)
    refused(runs, "nowhere", prm, ["Conditions/floor/Where = x > 9"], "entry 'Where' in section 'Conditions/floor'", "holds at no node")
    refused(runs, "of_time", prm, ["Conditions/floor/Where = x > t"], "entry 'Where' in section 'Conditions/floor'", "leave out t")


def case_commas(runs):
    """What muParser evaluates to something that nobody means."""
    prm = write(runs, "plain.prm", text_of(2))
    refused(runs, "comma", prm, ["Run/Body force = 0; -9,81"], "entry 'Body force'", "commas separate arguments of functions")
    refused(runs, "assignment", prm, ["Run/Body force = 0; x = 3"], "entry 'Body force'", "'=' sets a variable")
    refused(runs, "pressure", write(runs, "pressure.prm", text_of(2, more="subsection Tractions\n  set Names = p\n  subsection p\n"
            "    set Type = pressure\n    set Pressure = log(x - 0.6)\n  end\nend\n")), [],
            r"entry 'Pressure' in section 'Tractions/p'", r"the formula 'log\(x - 0.6\)' has no finite value at")
    runs.run(prm, "good", "Run/Body force = if(x < 1, 1, 2); (x >= 1 ? 1 : 0) * min(t, 1) * (x == 1) * (y != 2)")


def case_sizes(runs):
    """What does not fit into memory or into the end time is refused with its own entry; particles larger than cells are told of."""
    ring = "set Shape = ring\n    set Centre = 1, 1\n    set Inner radius = 0.2\n    set Outer radius = 0.9\n    set Particles = "
    refused(runs, "ring", write(runs, "ring.prm", text_of(2, body=ring + "60000, 60000")), [],
            r"entry 'Particles' in section 'Bodies/block': the particles of all bodies.* GB at least, and there are .* GB")
    refused(runs, "mesh", write(runs, "mesh.prm", on_mesh(text_of(2), 2)), ["Grid/Cells = 200000, 200000"], r"entry 'Cells' in section 'Grid': the mesh's .* cells take .* GB")
    warned(runs, "odd", write(runs, "odd.prm", text_of(2)), ["Grid/Upper corner = 50.125, 50.125"],
           r"entry 'Spacing' in section 'Grid': every rank stores a coarse mesh of 1.61e\+05 cells. .* for example 400 400\.")
    coarse = write(runs, "coarse.prm", text_of(2, body=ring + "1, 4"))
    warned(runs, "coarse", coarse, [], "'Particles' in section 'Bodies/block': the largest particle has the volume 0.6")
    refused(runs, "step", write(runs, "step.prm", text_of(2)), ["Run/Step size = 1e-300"], "entry 'Step size' in section 'Run': steps of 1e-300 are lost in the round-off")
    refused(runs, "kernel", write(runs, "kernel.prm", on_mesh(text_of(2), 2).replace("UMLS", "quadratic B-spline")), [], "take a kernel for meshes, such as 'UMLS'")


def case_mesh_files(runs):
    """What a file of a mesh is, and the line at which it cannot be read."""
    nodes = "".join(f"{x} {y} 0\n" for y in (0, 1, 2) for x in (0, 1, 2))
    corners = [(y * 3 + x + 1, y * 3 + x + 2, y * 3 + x + 4, y * 3 + x + 5) for y in (0, 1) for x in (0, 1)]
    triangles = [t for a, b, c, d in corners for t in ((a, b, c), (b, d, c))]
    cells = "".join(f"{i + 1} {a} {b} {c}\n" for i, (a, b, c) in enumerate(triangles))
    good = ("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 9 1 9\n2 1 0 9\n" + "".join(f"{i + 1}\n" for i in range(9)) + nodes +
            "$EndNodes\n$Elements\n1 8 1 8\n2 1 2 8\n" + cells + "$EndElements\n")
    text = on_mesh(text_of(2), 2).replace("set Upper corner = 2, 2\n  set Type = mesh\n  set Cells = 16, 16", "set Type = mesh\n  set Spacing = 0.25\n  # file")
    text = text.replace("set Boundaries = lower y", "set Half spaces = y <= 0")
    for name, content, *words in (("marked", "\ufeff" + good), ("fortran", good.replace("1 1 0\n", "1.0D+0 1 0\n")), ("windows", good.replace("\n", "\r\n")),
                                  ("empty", "", "'.*' cannot be read: it is empty"), ("wide", good.encode("utf-16"), "is UTF-16 text. Save it as plain text"),
                                  ("nan", good.replace("1 1 0\n", "nan 1 0\n"), "in line 20 'nan' stands where a finite number should"),
                                  ("comma", good.replace("1 1 0\n", "1,5 1 0\n"), "in line 20 '1,5' stands where a finite number should"),
                                  ("half", good[:150], "it ends too early")):
        mesh = write(runs, f"{name}.msh", content)
        prm = write(runs, f"{name}.prm", text.replace("# file", f"set File = {mesh}"))
        if words:
            refused(runs, name, prm, [], *words)
        else:
            runs.run(prm, name)


def case_clipping(runs):
    """Half, quarter and eighth models have their part of the mass, on boxes and on meshes; odd cuts are told of."""
    shapes = {2: {"ball": ("set Shape = ball\n    set Centre = 2, 2\n    set Radius = 0.5", math.pi / 16),
                  "offset": ("set Shape = ball\n    set Centre = 2, 2\n    set Radius = 0.5\n    set Lattice offset = 0.5, 0.5", math.pi / 16),
                  "ring": ("set Shape = ring\n    set Centre = 0, 1\n    set Inner radius = 0.25\n    set Outer radius = 0.5\n    "
                           "set Particles = 4, 30", math.pi * 3 / 32),
                  "box": ("set Lower corner = -0.53125, 0.5\n    set Upper corner = 0.46875, 1", 0.234375)},
              3: {"ball": ("set Shape = ball\n    set Centre = 2, 0, 2\n    set Radius = 1\n    set Lattice offset = 0.5, 0.5, 0.5", math.pi / 6),
                  "ring": ("set Shape = ring\n    set Centre = 1, 1, -0.5\n    set Inner radius = 0.5\n    set Outer radius = 1\n    "
                           "set Height = 1\n    set Particles = 3, 20, 5", 0.375 * math.pi)}}
    for dim, of_dim in shapes.items():
        for name, (body, volume) in of_dim.items():
            text = text_of(dim, body=body + "\n    set Clip to grid = true")
            if dim == 3:
                text = text.replace("set Spacing = 0.125", "set Spacing = 0.25")
            for grid, prm in (("grid", text), ("mesh", on_mesh(text.replace("set Spacing = 0.25", "set Spacing = 0.125"), dim))):
                prm = write(runs, f"{name}_{dim}d_{grid}.prm", prm)
                mass = sum(p["mass"] for p in last_particles(runs.run(prm, f"{name}_{dim}d_{grid}", "Output/CSV = true", "Output/Particle fields = mass")))
                runs.check(f"{name} {dim}D {grid}: mass {mass:.2f} for {1000 * volume:.2f}", mass / (1000 * volume) - 1, 0.012)
    odd = write(runs, "odd.prm", text_of(2, body="set Lower corner = -0.5, -0.2\n    set Upper corner = 0.47, 1.3\n    set Clip to grid = true"))
    warned(runs, "odd", odd, [], r"entry 'Clip to grid' in section 'Bodies/block': the particles left have a volume of 0.63\d+, and what "
           r"the grid leaves of the body has 0.61")
    warned(runs, "even", odd, ["Bodies/block/Lower corner = 0, 0"])


def case_idle(runs):
    """Loads that are zero, conditions that others undo, floors that do not hold, levels with nothing above them."""
    def warns(name, *patterns, **changes):
        warned(runs, name, write(runs, f"{name}.prm", text_of(2, **changes)), [], *patterns)

    def load(formula):
        return f"subsection Tractions\n  set Names = load\n  subsection load\n    set Traction = {formula}\n  end\nend\n"

    def layer(level, force="0; -10"):
        return {"run": f"set Body force = {force}", "body": f"set Lower corner = 0.5, 0\n    set Upper corner = 1.5, 1\n    set Initial stress = geostatic"
                f"\n    set Unit weight = 1e4\n    set Surface level = {level}"}

    warns("late_load", "'Traction' in section 'Tractions/load': the load is zero at all times", more=load("0; -100 * (t > 1)"))
    warns("pulse", more=load("0; -100 * sin(1000 * pi * t)"))
    warns("place", more=load("0; -100 * (x > 1.4)"))
    for later, words in (("no-slip", ["'Type' in section 'Conditions/floor': the condition has no effect: 'base'"]), ("slip", [])):
        both = text_of(2, condition=f"set Boundary ids = 2\n  end\n  subsection base\n    set Type = {later}\n    set Boundary ids = 2, 0")
        warned(runs, f"undone_{later}", write(runs, f"undone_{later}.prm", both.replace("Names = floor", "Names = floor, base")), [], *words)
    gravity = "set Body force = 0; -10"
    warns("sideways", "the body 'block' falls along y", run=gravity, condition="set Type = velocity\n    set Boundary ids = 2\n    set Components = x")
    warns("walls", "the body 'block' falls along y", run=gravity, condition="set Type = slip\n    set Boundary ids = 0, 1", body="set Upper corner = 2, 1")
    warns("pulse_of_gravity", "the body 'block' falls along y", run="set Body force = 0; -10 * sin(1000 * pi * t)", condition="set Boundary ids = 0")
    interval = "set Boundary ids = 2\n    set Type = slip\n    set Start time = 1e-4\n    set End time = "
    warns("flash", "'End time' in section 'Conditions/floor': the condition acts from 0.0001 to 0.00015, which is less than a step",
          condition=interval + "1.5e-4")
    warns("long", condition=interval + "5e-2")
    warns("shaking", run="set Body force = 20 * sin(2000 * pi * t); 0", condition="set Boundary ids = 2")
    warns("level", r"'Surface level' in section 'Bodies/block': it is 5, but nothing lies above the body, which ends at y = 1: there the initial "
          r"stress is 4e\+04", **layer(5))
    warns("level_below", **layer(1))
    warns("ramp", r"'Unit weight' in section 'Bodies/block': it is 1e\+04, but density times body force is 0 at the start", **layer(1, "0; -10 * min(1, t / 1e-3)"))
    warns("psi", "'Dilatancy angle' in section 'Materials/rubber': it is 0.2",
          material="set Type = Drucker-Prager\n    set Friction angle = 30\n    set Dilatancy angle = 0.2")
    warns("no_stress", "'Stress' in section 'Bodies/block': the initial stress is zero", body="set Lower corner = 0.5, 0\n    set Upper corner = 1.5, 1\n    set Initial stress = uniform")
    water = write(runs, "water.prm", text_of(2, run=gravity, material="set Type = Newtonian fluid\n    set Sound speed = 2").replace("    set Young's modulus = 1e6\n", ""))
    warned(runs, "slow", water, [], r"'Sound speed' in section 'Materials/rubber': it is 2, .*compress it by 250 %. Take at least 44.7")
    warned(runs, "quick", water, ["Materials/rubber/Sound speed = 44.8"])


def case_energy_watch(runs):
    """Swings that are sound are no alarm: forces of time and of place, whose work is that of the way."""
    body = "set Lower corner = {}, 0.75\n    set Upper corner = {}, 1.25"
    # Work is force times way: of what is shaken it exceeds the energy by the integration loss, sum m (b dt)^2 / 2.
    motions = {"shaken": ("100 * cos(50 * t)", body.format(0.75, 1.25), 0.5, 1),
               "swing": ("-40 * (x - 1)", body.format(1, 1.5), 2, 0.02),
               "turned": ("(t < 0.1 ? 10 : -10)", body.format(0.75, 1.25), 0.3, 0.05)}
    for name, (force, where, time, bound) in motions.items():
        text = text_of(2, run=f"set Body force = {force}; 0", body=where, condition="set Boundary ids = 0").replace("End time = 1e-3", f"End time = {time}")
        directory = warned(runs, name, write(runs, f"{name}.prm", text), ["Transfer/Type = FLIP"])
        s = columns_of(os.path.join(directory, "statistics.csv"))
        error = max(abs(k + e - w - s["kinetic energy"][0]) for k, e, w in zip(s["kinetic energy"], s["strain energy"], s["body force work"]))
        runs.check(f"{name}: energy less work, over the greatest energy", error / max(s["kinetic energy"]), bound)


if __name__ == "__main__":
    sys.exit(main(globals(), HERE))
