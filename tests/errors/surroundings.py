"""Wrong files, directories and disks; checkpoints that do not fit."""
import os
import shutil
import struct

from cases import BOX, Case, MESH, POINTS, POINTS_ENTRY
from meshes import FROM_FILE, msh

try:
    import h5py
except ImportError:
    h5py = None

BINARY = bytes(range(256)) * 4
STEPS = ["case.prm", "--set", "Run/Number of steps = 4", "--set", "Checkpoints/Step interval = 2"]
LONGER = ["--set", "Run/Number of steps = 6"]
OUTLINE = (BOX, "    set Shape = surface\n    set File = outline.txt\n")
INCLUDE = ("set Dimension = 2\n", "include more.prm\nset Dimension = 2\n")
DISK = ["case.prm", "--set", "Output/Directory = disk/output", "--set", "Output/Step interval = 1", "--set", "Output/CSV = true",
        "--set", "Checkpoints/Step interval = 1", "--set", "Run/Courant number = 0.01"]


def unreadable(name):
    return lambda directory: os.chmod(os.path.join(directory, name), 0)


def in_newest(directory):
    return os.path.join(directory, "output", "checkpoint_00000004.h5")


def remove(*names):
    def spoil(directory):
        for name in names:
            os.remove(os.path.join(directory, "output", name))
    return spoil


def of_all(change):
    """Does so with each of the checkpoints."""
    def spoil(directory):
        for step in (2, 4):
            change(os.path.join(directory, "output", f"checkpoint_{step:08d}.h5"))
    return spoil


def cut(path):
    os.truncate(path, os.path.getsize(path) // 2)


def flip(path):
    with open(path, "r+b") as file:
        file.seek(5000)
        byte = file.read(1)[0]
        file.seek(5000)
        file.write(bytes([byte ^ 1]))


def refill(content):
    def change(path):
        with open(path, "wb") as file:
            file.write(content)
    return change


def make_directory(path):
    os.remove(path)
    os.makedirs(path)


def scrambled(x):
    x = ((x ^ (x >> 30)) * 0xbf58476d1ce4e5b9) & ((1 << 64) - 1)
    x = ((x ^ (x >> 27)) * 0x94d049bb133111eb) & ((1 << 64) - 1)
    return x ^ (x >> 31)


def close(path):
    """The line that a complete file ends with (checksum.h)."""
    with open(path, "rb") as file:
        data = file.read()
    words = struct.unpack(f"<{(len(data) + 7) // 8}Q", data + b"\0" * (-len(data) % 8))
    total = sum(scrambled(word ^ scrambled(place + 1)) for place, word in enumerate(words)) & ((1 << 64) - 1)
    with open(path, "ab") as file:
        file.write(f"\nTalus checkpoint of {len(data):020d} bytes, checksum {total:016x}\n".encode())


def inside(change):
    """A change that a complete file has in it."""
    def of_path(path):
        with h5py.File(path, "r+") as file:
            change(file)
        close(path)
    return of_all(of_path)


def set_format(file):
    file.attrs["format"] = 99


def begin_stage(file):
    file.attrs["begins stage"] = 1


def remove_column(file):
    del file["particles/velocity_x"]


def change_column(file):
    file["particles/velocity_x"][3] = 7.


def no_number(file):
    data = file["particles/initial_position_x"]
    values = data[:]
    values[3] = float("nan")
    data[...] = values
    words = struct.unpack(f"<{len(values)}Q", values.tobytes())
    total = sum(scrambled(word ^ scrambled(place + 1)) for place, word in enumerate(words)) & ((1 << 64) - 1)
    data.attrs["checksum"] = f"{total:016x}"


def other_body(file):
    file.attrs["parameters"] = file.attrs["parameters"].replace("1.75, 0.75", "1.75, 0.5")


def no_statistics(directory):
    os.remove(os.path.join(directory, "output", "statistics.csv"))


def other_columns(directory):
    path = os.path.join(directory, "output", "statistics.csv")
    with open(path) as file:
        text = file.read()
    with open(path, "w") as file:
        file.write(text.replace("step size", "step length", 1))


def wrong_row(directory):
    path = os.path.join(directory, "output", "statistics.csv")
    with open(path) as file:
        rows = file.read().split("\n")
    rows[2] = rows[2][:20]
    with open(path, "w") as file:
        file.write("\n".join(rows))


def resumed(name, spoil, *message, status=1, more=(), changes=()):
    return Case(name, list(changes), list(message), status, ["--resume", "output"] + LONGER + list(more), before=[STEPS],
                spoil=spoil)


CASES = {
    "files": [
        Case("a directory as parameter file", [], ["'output'", "it is a directory", "give that of a file"], arguments=["output"],
             files={"output/a": ""}),
        Case("an empty parameter file", [], ["Parameter file 'empty.prm' is empty|'empty.prm' is empty", "Check the name"],
             arguments=["empty.prm"], files={"empty.prm": "\n \n"}),
        Case("a binary parameter file", [], ["'binary.prm' is a binary file", "plain text"], arguments=["binary.prm"],
             files={"binary.prm": BINARY}),
        Case("a spreadsheet", [(BOX, POINTS)], ["zip archive, as spreadsheets are", "plain text"],
             files={"points.txt": b"PK\x03\x04" + BINARY}),
        Case("a parameter file that nobody may read", [], ["case.prm", "no permission"], spoil=unreadable("case.prm"), is_user=True),
        Case("an include that is a directory", [INCLUDE], ["case.prm:1: ", "more.prm", "it is a directory"],
             files={"more.prm/a": ""}),
        Case("an include that is not there", [INCLUDE], ["case.prm:1: ", "more.prm", "Check the name"]),
        Case("an include of itself", [("set Dimension = 2\n", "include case.prm\nset Dimension = 2\n")],
             ["case.prm:1: ", "includes itself"]),
        Case("a directory as points", [(BOX, POINTS)], [POINTS_ENTRY, "it is a directory"], files={"points.txt/a": ""}),
        Case("binary points", [(BOX, POINTS)], [POINTS_ENTRY, "'points.txt' is a binary file"], files={"points.txt": BINARY}),
        Case("points that nobody may read", [(BOX, POINTS)], [POINTS_ENTRY, "no permission"], files={"points.txt": "1 1 1\n"},
             spoil=unreadable("points.txt"), is_user=True),
        Case("points beyond numbers", [(BOX, POINTS)], ["points.txt:1: ", "'1e999' is too large"],
             files={"points.txt": "0.5 0.5 1e999\n"}),
        Case("columns in another order", [(BOX, POINTS)], ["points.txt:1: ", "Put them into this order"],
             files={"points.txt": "V x y\n0.01 0.5 0.5\n"}),
        Case("a directory as outline", [OUTLINE], ["case.prm:26: ", "'File'", "it is a directory"], files={"outline.txt/a": ""}),
        Case("an empty outline", [OUTLINE], ["case.prm:26: ", "outline.txt"], files={"outline.txt": ""}),
        Case("a binary outline", [OUTLINE], ["case.prm:26: ", "outline.txt"], files={"outline.txt": BINARY}),
        Case("an outline of words", [OUTLINE], ["outline.txt:2: |outline.txt'? line 2", "'one'"],
             files={"outline.txt": "0.3 0.3\n1 one\n1 1\n0.3 0.3\n"}),
        Case("a mesh cut short", MESH + [("set Cells = 16, 8", FROM_FILE)], ["case.msh", "ends too early"],
             files={"case.msh": msh("0 0 0\n2 0 0\n0 1 0\n", "1 1 2 3\n")["case.msh"][:-18]}),
        Case("a mesh that is empty", MESH + [("set Cells = 16, 8", FROM_FILE)], ["case.msh"], files={"case.msh": ""}),
        Case("a binary mesh", MESH + [("set Cells = 16, 8", FROM_FILE)], ["case.msh", "is a binary file", "plain text"], files={"case.msh": BINARY}),
        Case("a directory as mesh", MESH + [("set Cells = 16, 8", FROM_FILE)], ["FILE:LINE: ", "entry 'File'", "it is a directory"],
             files={"case.msh/a": ""}),
        Case("a mesh of old times", MESH + [("set Cells = 16, 8", FROM_FILE)], ["case.msh", "version 2.2", "gmsh -format msh41"],
             files={"case.msh": "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"}),
        Case("a mesh with the wrong node", MESH + [("set Cells = 16, 8", FROM_FILE)], ["case.msh", "node 9, which does not exist"],
             files=msh("0 0 0\n2 0 0\n0 1 0\n", "1 1 2 9\n")),
        Case("a mesh that promises too much", MESH + [("set Cells = 16, 8", FROM_FILE)], ["case.msh"],
             files={"case.msh": msh("0 0 0\n2 0 0\n0 1 0\n", "1 1 2 3\n")["case.msh"].replace("2 1 0 3\n", "2 1 0 99999999999999\n")}),
        Case("a mesh of lines among triangles", MESH + [("set Cells = 16, 8", FROM_FILE)], ["case.msh", "element 1 of type 1", "another dimension"],
             files=msh("0 0 0\n2 0 0\n0 1 0\n", "1 1 2 3\n", "2 1 1")),
        Case("a mesh of less than nothing", MESH + [("set Cells = 16, 8", FROM_FILE)], ["case.msh"],
             files={"case.msh": msh("0 0 0\n2 0 0\n0 1 0\n", "1 1 2 3\n")["case.msh"].replace("2 1 0 3\n", "2 1 0 -3\n")}),
    ],
    "directories": [
        Case("a directory that cannot be made", [], ["'Directory' in section 'Output'", "cannot create the directory", "Choose another"],
             arguments=["case.prm", "--set", "Output/Directory = /proc/talus"]),
        Case("a directory that nobody may write into", [], ["'Directory'", "not writable|cannot write", "permissions"],
             arguments=["case.prm", "--set", "Output/Directory = shut"], is_user=True, files={"shut/a": ""},
             spoil=lambda directory: (os.remove(os.path.join(directory, "shut", "a")),
                                      os.chmod(os.path.join(directory, "shut"), 0o555))),
        Case("a directory that nobody may make", [], ["'Directory'", "cannot create the directory", "Permission denied"],
             arguments=["case.prm", "--set", "Output/Directory = shut/output"], is_user=True, files={"shut/a": ""},
             spoil=lambda directory: os.chmod(os.path.join(directory, "shut"), 0o555)),
        Case("a disk that is full at once", [], ["Cannot write '[^']*'", "[Dd]isk full"], 2, DISK, disk=16),
        Case("a disk that fills with outputs", [], ["Cannot write 'disk/output/[^']*'", "[Dd]isk full"], 2, DISK, disk=300,
             output="disk/output"),
        Case("a disk that fills with checkpoints", [], [r"Cannot write 'disk/output/checkpoint_\d+\.h5'", "[Dd]isk full"], 2,
             DISK[:3] + DISK[7:] + ["--set", "Checkpoints/Kept = 1000"], disk=1000),
    ],
    "checkpoints": [
        resumed("checkpoints cut short", of_all(cut), "checkpoint_00000004.h5' is not a complete checkpoint", "no other one"),
        resumed("checkpoints with a bit flipped", of_all(flip), "checkpoint_00000004.h5' is damaged", "no other one"),
        resumed("empty checkpoints", of_all(refill(b"")), "is not a complete checkpoint"),
        resumed("text as checkpoints", of_all(refill(b"x y volume\n" * 100)), "is not a complete checkpoint"),
        resumed("directories as checkpoints", of_all(make_directory), "is not a complete checkpoint"),
        resumed("no table to go on with", no_statistics, "statistics.csv", "cannot read", status=2),
        resumed("a table of other columns", other_columns, "the columns of 'output/statistics.csv'", status=2),
        resumed("a table with half a row", wrong_row, "line 3 of 'output/statistics.csv'", "Mend or remove", status=2),
        resumed("another grid", None, "--set \"Grid/Spacing = 0.25\"", "cannot change", "Start a new run",
                more=["--set", "Grid/Spacing = 0.25"]),
        resumed("another directory", None, "'Directory' in section 'Output'", "cannot change",
                more=["--set", "Output/Directory = elsewhere"]),
        resumed("a run at its end", None, "is at its end", "Give a later one", more=["--set", "Run/Number of steps = 4"]),
        resumed("an end before now", None, "is at its end", more=["--set", "Run/End time = 1e-6"]),
        resumed("points that are gone", lambda directory: os.remove(os.path.join(directory, "points.txt")),
                "points.txt", "cannot read", changes=[(BOX, POINTS)]),
        resumed("points that are more", lambda directory: shutil.copy(os.path.join(directory, "more.txt"),
                                                                      os.path.join(directory, "points.txt")),
                "has 2 particles, and the bodies of its run have 3", "changed", changes=[(BOX, POINTS)]),
    ] + ([
        resumed("checkpoints of another version", inside(set_format), "has the format 99", r"reads format \d+",
                "Go on with the version that wrote it"),
        resumed("checkpoints of another problem", inside(other_body), r"has \d+ particles, and the bodies of its run have \d+"),
        resumed("checkpoints without a column", inside(remove_column), "particles/velocity_x", "another version"),
        resumed("checkpoints with a wrong number", inside(change_column), "the checksum of 'particles/velocity_x'", "Remove the file"),
        resumed("checkpoints that begin a stage", inside(begin_stage), "begins a stage, and the run's first one begins without"),
        resumed("checkpoints without a number", inside(no_number), "'particles/initial_position_x' has 1 numbers that are not finite"),
    ] if h5py else []),
}
for case in CASES["checkpoints"]:
    if case.changes:
        case.files.update({"points.txt": "0.5 0.5 0.01\n0.6 0.5 0.01\n", "more.txt": "0.5 0.5 0.01\n0.6 0.5 0.01\n0.7 0.5 0.01\n"})
