"""Checkpoints that are wrong and yet complete: changed by h5py, with the checksums that belong to them."""
import struct

try:
    import h5py
    import numpy
except ImportError:
    h5py = None

from mutations import mutate_lines, NUMBERS

MASK = (1 << 64) - 1


def scrambled(x):
    x = ((x ^ (x >> 30)) * 0xbf58476d1ce4e5b9) & MASK
    x = ((x ^ (x >> 27)) * 0x94d049bb133111eb) & MASK
    return x ^ (x >> 31)


def checksum(data):
    data += b"\0" * (-len(data) % 8)
    words = struct.unpack(f"<{len(data) // 8}Q", data)
    return sum(scrambled(word ^ scrambled(place + 1)) for place, word in enumerate(words)) & MASK


def close(path):
    """Gives a file the end that it must have."""
    with open(path, "rb") as file:
        data = file.read()
    end = f"\nTalus checkpoint of {len(data):020d} bytes, checksum {checksum(data):016x}\n"
    with open(path, "ab") as file:
        file.write(end.encode())


def set_sum(data_set):
    data_set.attrs["checksum"] = f"{checksum(numpy.asarray(data_set[...], dtype='<f8').tobytes()):016x}"


def mutate_values(random, data_set):
    values = numpy.array(data_set[...])
    if values.size:
        at, number = random.randrange(values.size), random.choice(["0", "-1", "nan", "inf", "1e300", "1e9", "3", "0.5"])
        try:
            values.flat[at] = float(number)
        except (OverflowError, ValueError):
            values.flat[at] = 4294967295
        if random.randrange(3) == 0:
            values[...] = values.flat[at]
    data_set[...] = values
    set_sum(data_set)


def mutate(random, path):
    """A change inside of the file at `path`."""
    sets = []
    with h5py.File(path, "r+") as file:
        file.visititems(lambda name, item: sets.append(name) if isinstance(item, h5py.Dataset) else None)
        name, kind = random.choice(sets), random.randrange(8)
        if kind < 3:
            mutate_values(random, file[name])
        elif kind == 3:
            del file[name]
        elif kind == 4:
            values = file[name][...]
            del file[name]
            longer = random.choice([values[:-1], numpy.concatenate([values, values]), values.reshape(1, -1), values[:0]])
            file[name] = longer
            set_sum(file[name])
        elif kind == 5:
            attribute = random.choice(list(file.attrs))
            if attribute == "parameters":
                file.attrs[attribute] = mutate_lines(random, file.attrs[attribute]).replace("\0", "")
            elif attribute == "version":
                file.attrs[attribute] = random.choice(["9.9.9", ""])
            else:
                old = file.attrs[attribute]
                file.attrs[attribute] = random.choice([-1, 0, 2, 1e9, float("nan"), old + type(old)(1), "text"])
        elif kind == 6:
            file.attrs["parameters"] = mutate_lines(random, file.attrs["parameters"]).replace("\0", "")
        else:
            del file.attrs[random.choice(list(file.attrs))]
    close(path)
