"""Wrong meshes, from files of gmsh and without."""
from cases import BOX, Case, MESH, wrong_entry

FROM_FILE = "set File = case.msh\n  set Spacing = 0.1"


def msh(nodes, cells, kind="2 1 2"):
    """A file of gmsh, from lines of coordinates and of numbers; `kind` is gmsh's of triangles."""
    n, m = nodes.count("\n"), cells.count("\n")
    numbers = "".join(f"{i + 1}\n" for i in range(n))
    return {"case.msh": f"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {n} 1 {n}\n2 1 0 {n}\n{numbers}{nodes}$EndNodes\n"
                        f"$Elements\n1 {m} 1 {m}\n{kind} {m}\n{cells}$EndElements\n"}


def wrong_mesh(name, text, *message, files=None):
    return Case(name, MESH + [("set Cells = 16, 8", text)], list(message), files=files or {})


CASES = {
    "meshes": [
        wrong_mesh("no such file", "set File = nowhere.msh\n  set Spacing = 0.1", "nowhere.msh"),
        wrong_mesh("flat cell", FROM_FILE, "case.msh", "triangle 2", "flat",
                   files=msh("0 0 0\n2 0 0\n2 1 0\n1 0.5 0\n", "1 1 2 3\n2 1 4 3\n")),
        wrong_mesh("inverted cell", FROM_FILE, "triangle 2", "inverted", "triangle 1",
                   files=msh("0 0 0\n2 0 0\n0 1 0\n0.4 0.4 0\n2 -1 0\n", "1 1 2 3\n2 2 4 3\n3 1 5 2\n")),
        wrong_mesh("hanging node", FROM_FILE, r"node 5 at \(1, 0.5\)", "hangs on a face of triangle 1",
                   files=msh("0 0 0\n2 0 0\n0 1 0\n2 1 0\n1 0.5 0\n", "1 1 2 3\n2 2 4 5\n3 5 4 3\n")),
        wrong_mesh("node without a cell", FROM_FILE, r"node 5 at \(3, 3\)", "belongs to no triangle",
                   files=msh("0 0 0\n2 0 0\n0 1 0\n2 1 0\n3 3 0\n", "1 1 2 3\n2 2 4 3\n")),
        wrong_mesh("three cells at a face", FROM_FILE, "more than two cells", "triangle 1", "triangle 2", "triangle 3",
                   files=msh("0 0 0\n2 0 0\n0 1 0\n2 1 0\n3 3 0\n", "1 1 2 3\n2 2 4 3\n3 2 5 3\n")),
        wrong_mesh("tetrahedra in 2D", FROM_FILE, "case.msh", "is a tetrahedron, but the run has 2 dimensions",
                   files=msh("0 0 0\n2 0 0\n0 1 0\n0 0 1\n", "1 1 2 3 4\n", "3 1 4")),
        wrong_mesh("file and cells", "set Cells = 2, 2\n  set File = a.msh", "entry 'File' in section 'Grid'", "and not both"),
        wrong_mesh("no spacing", "set File = a.msh", "entry 'Spacing' in section 'Grid'", "about that of the mesh's edges"),
        Case("box kernel", [("set Spacing = 0.125", "set Type = mesh\n  set Cells = 16, 8"),
                            ("set Type = quadratic B-spline", "set Type = linear")],
             [r"FILE:LINE: entry 'Type' in section 'Kernel'", "needs a box grid"]),
        wrong_entry("mesh kernel", "set Type = quadratic B-spline", "set Type = UMLS", "Type",
                    "needs a mesh of triangles or tetrahedra"),
        Case("unknown boundary", MESH + [("set Boundaries = lower y", "set Boundaries = floor")],
             [r"FILE:LINE: entry 'Boundaries' in section 'Conditions/floor'", "no boundary 'floor'", r"'lower x' \(0\)"]),
        Case("body outside the mesh", MESH + [(BOX, BOX.replace("0.25, 0.25", "0.25, -0.1"))],
             [r"FILE:LINE: ", "Lower corner", "lies outside the grid, whose mesh lies between"]),
    ],
}
