"""Small valid inputs from which the mutations start: each thing that a file can choose is in one of them."""
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests", "errors"))
from cases import BASE  # noqa: E402

POINTS = "# x y volume\n0.5 0.5 0.01\n0.6 0.5 0.01\n0.7, 0.5, 0.01\n0.8;0.5;1d-2\n"
POLYGON = "0.3 0.3\n1.5 0.3\n1.5 0.7\n0.3 0.7\n0.3 0.3\n"
FACETS = [((0, 0, 0), (0, 1, 0), (1, 0, 0)), ((0, 0, 0), (1, 0, 0), (0, 0, 1)), ((0, 0, 0), (0, 0, 1), (0, 1, 0)),
          ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
TABLE = ("# time 0 [time]\nid,body,x,y,volume,velocity_x,velocity_y,stress_xx,stress_yy,stress_zz,stress_xy,weight\n" +
         "".join(f"{i},{i % 2},{0.5 + 0.1 * i},0.5,0.01,1,0,-1,-2,-3,0.5,9\n" for i in range(5)))
RASTER = ("ncols 5\nnrows 4\nxllcenter 0\nyllcorner -0.125\ncellsize 0.25\nNODATA_value -9999\n" +
          "\n".join(" ".join(f"{0.5 + 0.05 * i * j:.2f}" for i in range(5)) for j in range(4)) + "\n")
UNION = ("    set Shape = difference\n    set Names = all, hole\n    subsection all\n      set Shape = polygon\n"
         "      set Corners = 0.3, 0.3; 1.6, 0.3; 1.4, 0.8; 0.3, 0.7\n    end\n    subsection hole\n      set Shape = ball\n"
         "      set Centre = 0.8, 0.5\n      set Radius = 0.15\n    end\n")
STL = "solid tet\n" + "".join("facet normal 0 0 0\nouter loop\n" + "".join(
    f"vertex {0.2 + 0.6 * x} {0.2 + 0.6 * y} {0.2 + 0.6 * z}\n" for x, y, z in facet) + "endloop\nendfacet\n" for facet in FACETS
) + "endsolid tet\n"

CUBE = """\
set Dimension = 3
subsection Run
  set Courant number = 0.3
end
subsection Grid
  set Cells = 4, 4, 4
end
subsection Kernel
  set Type = {kernel}
end
subsection Materials
  set Names = a
  subsection a
    set Type = neo-Hookean
  end
end
subsection Bodies
  set Names = body
  subsection body
{shape}
  end
end
"""


def changed(text, *changes):
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


BOX = "    set Lower corner = 0.25, 0.25\n    set Upper corner = 1.75, 0.75\n"
SECTION = ("subsection Output\n", "{}subsection Output\n")


def with_section(text, section):
    return changed(text, ("subsection Output\n", section + "subsection Output\n"))


def material(text, kind, more=""):
    return changed(text, ("    set Density = 1e3\n", f"    set Type = {kind}\n    set Density = 1e3\n{more}"))


LOADS = """\
subsection Tractions
  set Names = pull, water, hook
  subsection pull
    set Faces = x+
    set Traction = 500 + 1e5 * t; 100 * y
  end
  subsection water
    set Type = pressure
    set Pressure = 2000
  end
  subsection hook
    set Type = force
    set Position = 1.3, 0.6
    set Force = 3; -2
  end
end
subsection Contacts
  set Names = ball
  subsection ball
    set Surface = ball
    set Centre = 1, 0.5
    set Radius = 3
    set Pressure = 1e5
    set Friction coefficient = 0.3
  end
end
subsection Obstacles
  set Names = bed, wheel
  subsection bed
    set Formula = y + 0.3*x - 0.15
    set Friction coefficient = 0.3
    set Account time = 0.01
  end
  subsection wheel
    set Surface = polygon
    set Corners = 1.6, 0.85; 1.9, 0.85; 1.9, 0.98; 1.6, 0.98
    set Displacement = 0.1*t; 0
    set Rotation = t
    set Centre of rotation = 1.75, 0.9
  end
end
"""
WALLS = ("  set Names = floor\n", """\
  set Names = floor, rough, peg, still
  subsection rough
    set Type = friction
    set Boundary ids = 0
    set Friction coefficient = 0.3
    set Wall velocity = 0; 0.1*t
  end
  subsection peg
    set Type = velocity
    set Lower corner = 0.4, 0.3
    set Upper corner = 0.7, 0.5
    set Components = y
    set Velocity = 0; 0.1 * x
    set Start time = 1e-4
    set End time = 5e-3
  end
  subsection still
    set Type = symmetry
    set Half spaces = y >= 1
  end
""")
PROBES = ("  set Directory = output\n", """\
  set Directory = output
  set CSV = true
  set HDF5 = true
  set Step interval = 2
  subsection Probes
    set Names = near, along
    subsection near
      set Kind = point
      set Position = 0.6, 0.6
    end
    subsection along
      set Kind = particle
      set Position = 0.6, 0.6
    end
  end
""")
REFERENCE = """\
subsection FEM reference
  set Compare = yes
  set Degree = 1
  set Lower corner = 0.25, 0.25
  set Upper corner = 1.75, 0.75
  set Cells = 6, 2
  subsection Conditions
    set Names = bottom, top
    subsection bottom
      set Boundary ids = 2
      set Displacement = 0; 0
    end
    subsection top
      set Boundary ids = 3
      set Displacement = 1e-3 * t; 0
    end
  end
  subsection Regions
    set Names = all
    subsection all
      set Where = x < 1
    end
  end
end
"""
STAGES = """\
subsection Stages
  set Names = one, two
  subsection one
    set Duration = 1.2e-3
    set Rest = 1e-6
  end
  subsection two
    set Duration = 1
    set Reset displacements = true
    set Reset plastic strains = true
    subsection Run
      set Local damping = 0.2
    end
    subsection Materials
      subsection rubber
        set Type = Mohr-Coulomb
        set Cohesion = 1e5
      end
    end
    subsection Bodies
      set Names = drop, block
      subsection drop
        set Shape = ball
        set Centre = 1, 0.9
        set Radius = 0.09
      end
    end
    subsection Tractions
      set Names = pull
      subsection pull
        set Body = block
        set Faces = x+
        set Traction = 100; 0
      end
    end
  end
end
"""
MESH = [("set Spacing = 0.125", "set Type = mesh\n  set Cells = 8, 4"), ("quadratic B-spline", "UMLS"),
        ("set Boundary ids = 2", "set Boundaries = lower y")]
FILE = [("set Lower corner = 0, 0\n  set Upper corner = 2, 1\n  set Spacing = 0.125",
         "set Type = mesh\n  set File = mesh.msh\n  set Spacing = 0.2"), ("quadratic B-spline", "UMLS"),
        ("set Boundary ids = 2", "set Boundaries = bottom"), (BOX, "    set Lower corner = 0.1, 0.1\n"
                                                               "    set Upper corner = 0.25, 0.9\n")]
YIELD = "    set Yield stress = 2000\n    set Hardening = exponential softening\n    set Softening rate = 5\n"


def read(path):
    with open(os.path.join(ROOT, path)) as file:
        return file.read()


# Name: parameter file and the files that it names.
SEEDS = {
    "base": (BASE, {}),
    "walls": (changed(BASE, WALLS), {}),
    "loads": (with_section(changed(BASE, PROBES), LOADS), {}),
    "mises": (material(BASE, "von Mises", YIELD), {}),
    "sand": (material(changed(BASE, ("quadratic B-spline", "cubic B-spline")), "Drucker-Prager",
                      "    set Friction angle = 30\n    set Cohesion = 300\n"), {}),
    "fluid": (changed(BASE, ("    set Density = 1e3\n    set Young's modulus = 1e6\n    set Poisson's ratio = 0.3\n",
                             "    set Type = Newtonian fluid\n    set Sound speed = 40\n    set J smoothing = 0.1\n"),
                      (PROBES[0], PROBES[0] + "  set Grid = false\n")), {}),
    "hencky": (changed(material(BASE, "Hencky"), ("  set Courant number = 0.5\n",
                                                  "  set Courant number = 0.5\n  set F-bar = true\n  set MUSL = true\n")), {}),
    "cpdi": (changed(BASE, ("quadratic B-spline\nend\n", "CPDI\nend\nsubsection Transfer\n  set Type = CPLS\nend\n")), {}),
    "account": (changed(BASE, ("quadratic B-spline\nend\n", "uGIMP\nend\nsubsection Transfer\n  set Type = blend\nend\n"),
                        ("  set Courant number = 0.5\n", "  set Step size = 1e-4\n  set Energy account = true\n")), {}),
    "reference": (with_section(BASE, REFERENCE), {}),
    "solution": (with_section(material(BASE, "neo-Hookean"), "subsection Verification\n  set Solution = vortex\nend\n"), {}),
    "points": (changed(BASE, (BOX, "    set Shape = points\n    set File = points.txt\n")), {"points.txt": POINTS}),
    "polygon": (changed(BASE, (BOX, "    set Shape = surface\n    set File = outline.txt\n")), {"outline.txt": POLYGON}),
    "table": (changed(BASE, (BOX, "    set Shape = points\n    set File = table.csv\n    set Ignore columns = weight\n"
                                  "    set Only body = 1\n")), {"table.csv": TABLE}),
    "stages": (with_section(changed(BASE, PROBES, ("  set End time = 0.01\n", "  set Step size = 7e-4\n")), STAGES), {}),
    "regions": (changed(BASE, (BOX, UNION)), {}),
    "where": (changed(BASE, (BOX, BOX + "    set Where = y < 0.5 + 0.1 * sin(5 * x) && x > 0.3\n"),
                      ("set Boundary ids = 2", "set Boundary ids = 2\n    set Where = x < 1")), {}),
    "slip": (material(BASE, "Mohr-Coulomb", "    set Cohesion = 1e4\n    set Residual cohesion = 1e3\n    set Softening slip = 0.5\n"
                      "    set Band width = 2\n"), {}),
    "ring": (changed(BASE, (BOX, "    set Shape = ring\n    set Centre = 1, 0.5\n    set Inner radius = 0.1\n"
                                 "    set Outer radius = 0.4\n")), {}),
    "mesh": (changed(BASE, *MESH), {}),
    "file": (changed(BASE, *FILE), {"mesh.msh": read("tests/mesh/data/plate.msh")}),
    "ball 3D": (CUBE.format(kernel="quadratic B-spline", shape="    set Shape = ball\n    set Centre = 0.5, 0.5, 0.5\n"
                                                               "    set Radius = 0.3"), {}),
    "raster 3D": (CUBE.format(kernel="linear", shape="    set Shape = raster\n    set File = dem.asc\n    set Bottom = 0.2"),
                  {"dem.asc": RASTER}),
    "surface 3D": (CUBE.format(kernel="linear", shape="    set Shape = surface\n    set File = body.stl"), {"body.stl": STL}),
}
