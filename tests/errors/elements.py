"""Wrong inputs of single points, and paths that end before their end: talus --element."""
from cases import Case

POINT = """\
subsection Materials
  set Names = sand
  subsection sand
    set Type = Mohr-Coulomb
    set Density = 1600
    set Young's modulus = 1e7
    set Friction angle = 30
    set Cohesion = 1e3
  end
end
subsection Element
  set Material = sand
  set Path = triaxial
  set Strain = -0.01
  set Steps = 20
  set Confining pressure = 1e5
end
subsection Output
  set Directory = output
end
"""
SAND = "    set Type = Mohr-Coulomb\n"
SOIL = "    set Friction angle = 30\n    set Cohesion = 1e3\n"
STRAIN = "  set Path = strain\n  set Direction = {}\n"
TRIAXIAL = "  set Path = triaxial\n"


def element(name, changes, *message, arguments=(), **more):
    text = POINT
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return Case(name, [], list(message), arguments=["--element", "point.prm", *arguments], files={"point.prm": text}, **more)


def entry(name, old, new, entry, *message):
    return element(name, [(old, new)], rf"point.prm:\d+: entry '{entry}' in section 'Element", *message)


def law(name, new, entry, *message):
    """Another material, whose entries stand in place of those of sand."""
    return element(name, [(SAND, f"    set Type = {new}\n"), (SOIL, "")], rf"point.prm:\d+: entry '{entry}'", *message)


CASES = {
    "element": [
        Case("element without a file", [], ["No parameter file given"], arguments=["--element"]),
        Case("element of a missing file", [], ["Cannot read the parameter file 'absent.prm'"],
             arguments=["--element", "absent.prm"]),
        Case("element and resume", [], ["--element has no checkpoints to go on from"],
             arguments=["--element", "--resume", "output"]),
        Case("element of a run's file", [], ["case.prm: the section 'Run' is of a run", "Leave out --element"],
             arguments=["--element", "case.prm"]),
        Case("run of an element's file", [], ["point.prm: the section 'Element' is of a single point", "talus --element point.prm"],
             arguments=["point.prm"], files={"point.prm": POINT}),
        Case("element without a material", [], ["entry 'Names' in section 'Materials'", "at least one material"],
             arguments=["--element", "point.prm"], files={"point.prm": "subsection Element\n  set Path = triaxial\nend\n"}),
        entry("unknown material", "Material = sand", "Material = sandd", "Material", "Did you mean 'sand'"),
        entry("unknown path", "Path = triaxial", "Path = triaxal", "Path", "Did you mean 'triaxial'", "oedometer"),
        entry("steps of 0", "Steps = 20", "Steps = 0", "Steps", "at least 1|between 1"),
        entry("strain of words", "Strain = -0.01", "Strain = much", "Strain", "a list"),
        entry("strain of 0", "Strain = -0.01", "Strain = 0", "Strain", "must differ from the one before"),
        entry("strain that stays", "Strain = -0.01", "Strain = -0.01, -0.01", "Strain", "must differ"),
        entry("strain in percent", "Strain = -0.01", "Strain = -100", "Strain", "not percentages"),
        entry("strain rate of 0", "Steps = 20", "Strain rate = 0", "Strain rate", "must be positive"),
        entry("initial stress of three", "Confining pressure = 1e5", "Initial stress = -1, -1, -1", "Initial stress",
              "a list, separated by commas, of 6"),
        element("two initial stresses", [("Steps = 20", "Initial stress = -1, -1, -1, 0, 0, 0")],
                "'Confining pressure'", "'Initial stress' says it too"),
        entry("stress beyond the surface", "Confining pressure = 1e5", "Initial stress = -1e5, -1e5, -1e6, 0, 0, 0",
              "Initial stress", "bears less than this stress"),
        law("pressure that rubber would lose", "neo-Hookean", "Confining pressure", "stress from its deformation alone",
            "Leave it out"),
        element("shear that water would lose", [(SAND + "    set Density = 1600\n    set Young's modulus = 1e7\n" + SOIL,
                                                 "    set Type = Newtonian fluid\n    set Sound speed = 10\n"),
                                                ("Confining pressure = 1e5", "Initial stress = 0, 0, 0, 1, 0, 0")],
                "'Initial stress'", "bears nothing but pressure at rest"),
        element("tension that water has no density for",
                [(SAND + "    set Density = 1600\n    set Young's modulus = 1e7\n" + SOIL,
                  "    set Type = Newtonian fluid\n    set Sound speed = 10\n"),
                 ("Confining pressure = 1e5", "Confining pressure = -1e6")], "'Sound speed'", "no density gives it"),
        element("no direction", [(TRIAXIAL, "  set Path = strain\n")], "'Direction'", "give 9 numbers"),
        entry("direction of six", TRIAXIAL, STRAIN.format("1, 0, 0, 0, 1, 0"), "Direction", "give 9 numbers"),
        entry("direction of ten", TRIAXIAL, STRAIN.format("1, 0, 0, 0, 1, 0, 0, 0, 0, 0"), "Direction", "0 to 9"),
        entry("held and driven", TRIAXIAL, STRAIN.format("1,0,0, 0,0,0, 0,0,0") + "  set Held stresses = yy, xx\n",
              "Held stresses", "'xx' can not be held"),
        entry("held twice", TRIAXIAL, STRAIN.format("1,0,0, 0,0,0, 0,0,0") + "  set Held stresses = yy, yy\n",
              "Held stresses", "stands there twice"),
        entry("held nowhere", TRIAXIAL, STRAIN.format("1,0,0, 0,0,0, 0,0,0") + "  set Held stresses = yx\n",
              "Held stresses", "one of xx, yy, zz, xy, xz, yz"),
        element("final stress of three", [(TRIAXIAL, "  set Path = stress\n  set Final stress = 1, 1, 1\n"),
                                          ("  set Strain = -0.01\n", "")], "'Final stress'", "of 6"),
        element("stage without a section", [("  set Path = triaxial\n", "  set Names = load\n")],
                r"point.prm:\d+: unknown entry '(Steps|Strain)' in section 'Element'"),
        element("unknown entry of an element", [("Steps = 20", "Stepps = 20")], "unknown entry 'Stepps'", "Did you mean 'Steps'"),
        element("probes of an element", [("  set Directory = output\n", "  set Directory = output\n  set CSV = true\n")],
                "unknown entry 'CSV' in section 'Output'"),
        element("directory not empty", [], "'Directory' in section 'Output'", "is not empty. Set 'Overwrite'",
                before=[["--element", "point.prm"]]),
        element("stress beyond strength", [(TRIAXIAL, "  set Path = stress\n  set Final stress = -1e5, -1e5, -1e6, 0, 0, 0\n"),
                                           ("  set Strain = -0.01\n", "")],
                r"Step \d+, from share = \S+ to \S+: no strain gives the stresses", "no strength for them", status=2),
        element("turned inside out", [(TRIAXIAL, STRAIN.format("0,0,0, 0,0,0, 0,0,1")), ("Strain = -0.01", "Strain = -30")],
                "Step 1, from factor = 0 to -1.5: it turns the point inside out", "Raise 'Steps'", status=2),
        element("sheared beyond numbers", [(TRIAXIAL, "  set Path = simple shear\n"), ("Strain = -0.01", "Strain = 1e12")],
                r"After step \d+ the point is stretched by more than numbers can tell", "Lower 'Strain'", status=2),
        element("stage beyond strength",
                [(TRIAXIAL, "  set Names = load, pull\n  subsection load\n    set Steps = 10\n  end\n  subsection pull\n"
                            "    set Path = stress\n    set Final stress = 1e6, 1e6, 1e6, 0, 0, 0\n    set Steps = 10\n  end\n"),
                 ("  set Strain = -0.01\n  set Steps = 20\n", "")],
                r"Step \d+ of stage 'pull', from share", status=2),
    ],
}
