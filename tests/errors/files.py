"""Whether the files that a failed run left behind are complete and finite."""
import base64
import math
import os
import re
import struct
import zlib


def decode(kind, body):
    """The numbers of an array in base64: a head of 32-bit numbers, then blocks that zlib reads."""
    body = body.strip()
    if not body:  # a rank without particles
        return ()
    n_blocks, size, last = struct.unpack("<3I", base64.b64decode(body[:16]))
    length = -(-4 * (3 + n_blocks) // 3) * 4  # of the head in base64: count, sizes of a block and of the last, compressed sizes
    compressed = struct.unpack(f"<{n_blocks}I", base64.b64decode(body[:length])[12:])
    blocks, data, begin = base64.b64decode(body[length:]), b"", 0
    for n in compressed:
        data += zlib.decompress(blocks[begin:begin + n])
        begin += n
    assert begin == len(blocks) and len(data) == (n_blocks - 1) * size + last
    size, letter = (4, "f") if kind == "Float32" else (8, "d")
    return struct.unpack(f"<{len(data) // size}{letter}", data)


ARRAY = r'<DataArray type="(Float32|Float64)"([^>]*)format="binary">\s*([^<]*)</DataArray>'


def numbers_of_vtu(text):
    """All floating point numbers of a VTU file."""
    for kind, _, body in re.findall(ARRAY, text):
        yield from decode(kind, body)


def arrays_of_vtu(path):
    """The floating point arrays of a VTU file by name, the pieces of all ranks one after the other; "points" has no name."""
    with open(path) as file:
        text = file.read()
    arrays = {}
    for kind, attributes, body in re.findall(ARRAY, text):
        name = re.search(r'Name="([^"]*)"', attributes)
        arrays.setdefault(name[1] if name else "points", []).extend(decode(kind, body))
    return arrays


def problems_in_csv(text):
    rows = [row for row in text.split("\n") if row and not row.startswith("#")]
    counts = {row.count(",") for row in rows}
    if not text.endswith("\n") or len(counts) > 1:
        return ["incomplete"]
    for row in rows[1:]:
        if not all(math.isfinite(float(value)) for value in row.split(",")):
            return ["a number that is not finite"]
    return []


def problems_in_failure(directory, stderr):
    """Of the state that a message names: it must have all particles, whatever their numbers are."""
    named = re.search(r"The state at the failure is in '([^']*)'", stderr)
    if not named:
        return ["the message names no state at the failure"]
    path = os.path.join(directory, named[1])
    try:
        whole, begin = (arrays_of_vtu(p) for p in (path, os.path.join(os.path.dirname(path), "particles_00000.vtu")))
    except FileNotFoundError as error:
        return [f"{error.filename} does not exist"]
    if sorted(whole["id"]) != sorted(begin["id"]) or len(whole["points"]) != len(begin["points"]):
        return [f"{named[1]} has {len(whole['id'])} particles, not {len(begin['id'])}"]
    with open(os.path.join(os.path.dirname(path), "log.txt")) as log:
        first, *_, last = log.read().splitlines()
    problems = [] if re.search(r"started on \S+ in '.*', \d+ rank\(s\): talus \d\S* \(commit \w[-\w]*\), .*--set", first) else [
        f"the first line of log.txt is '{first}'"]
    message = next(line[7:] for line in stderr.splitlines() if line.startswith("talus: "))
    return problems if last.endswith(" ended: failed. " + message) else problems + [f"the last line of log.txt is '{last}'"]


def problems_in_vtu(text):
    if not text.rstrip().endswith("</VTKFile>"):
        return ["incomplete"]
    numbers = list(numbers_of_vtu(text))
    if not numbers:
        return ["no numbers found"]
    return [] if all(math.isfinite(number) for number in numbers) else ["a number that is not finite"]


def problems_in_hdf5(path):
    """Of a file of particles; nothing where no Python package can read it."""
    try:
        import h5py
        import numpy
    except ModuleNotFoundError:
        return []
    with h5py.File(path, "r") as file:
        sizes = {len(data) for data in file.values()}
        found = [f"{name}: a number that is not finite" for name, data in file.items() if not numpy.isfinite(data[...]).all()]
        return found + ([f"data sets of {sorted(sizes)} rows"] if len(sizes) != 1 else [])


def problems_in_directory(directory):
    problems = []
    names = sorted(os.listdir(directory))
    for wanted in ("statistics.csv", "particles_00000.vtu", "particles_00000.csv", "particles.pvd", "log.txt"):
        if wanted not in names:
            problems.append(f"{wanted} is missing")
    for name in names:
        if name.endswith(".h5"):
            if name.startswith("particles_"):
                problems += [f"{name}: {problem}" for problem in problems_in_hdf5(os.path.join(directory, name))]
            continue  # of a checkpoint its checksum tells
        with open(os.path.join(directory, name)) as file:
            text = file.read()
        found = []
        if name.endswith(".tmp"):
            found = ["left over"]
        elif name.startswith("failure_"):
            found = [] if text.rstrip().endswith("</VTKFile>") or (name.endswith(".csv") and text.endswith("\n")) else ["incomplete"]
        elif name.endswith(".csv"):
            found = problems_in_csv(text)
        elif name.endswith(".vtu"):
            found = problems_in_vtu(text)
        elif name.endswith(".pvd"):
            listed = re.findall(r'file="([^"]*)"', text)
            found = [f"{file} does not exist" for file in listed if file not in names]
        problems += [f"{name}: {problem}" for problem in found]
    return problems
