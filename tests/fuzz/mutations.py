"""Ways to spoil a file: some know what a line means, others know bytes."""
import re

NUMBERS = ["0", "-1", "1", "2", "3", "7", "0.5", "0.3", "1e-9", "1e-300", "1e300", "1.7e308", "-1e308", "1e999", "nan", "-inf",
           "inf", "1e9", "2147483648", "4294967296", "-2147483649", "18446744073709551616", "1e20", "-0", "0x10", "1,5", "1e",
           "1d3", "1.", ".5", "+2", "--1", "1 2", "50%"]
LISTS = ["", ",", "0", "0, 0", "1, 1, 1", "0, 0, 0, 0", "nan, 0", "1e300, 1e300", "-1, -1", "0, 1, 2, 3, 4, 5, 6", "x+", "all",
         "1e9, 1e9", "1000000000, 1", "0; 0", "1, , 2", "2, 1"]
FORMULAS = ["1; 0", "0", "", ";", "x/0; 0", "0; sqrt(-1)", "log(x - 1); 0", "t^t; 0", "((((x; 0", "x = 3; 0", "sin; cos",
            "1e308*10; 0", "rand(); 0", "if(x<1, 1, 0); 0", "x; y; z", "1/t; 0", "exp(1000*t); 0", "pi; e", "x^0.5; y^-1",
            "1e200*x; 0", "u; v", "abs(; 0", "1 ? 2 : 3; 0", "x < 1; 0", "; 1; 0"]
WORDS = ["none", "true", "false", "yes", "-", "nothing", "box", "ball", "ring", "points", "surface", "mesh", "friction", "slip",
         "symmetry", "velocity", "no-slip", "linear", "cubic B-spline", "CPDI", "CPLS", "UMLS", "C1 UMLS", "P1", "uGIMP", "FLIP",
         "APIC", "PIC", "blend", "WLS", "MLS", "mirror", "ghost nodes", "WLS everywhere", "Hencky", "Hooke", "neo-Hookean",
         "von Mises", "Drucker-Prager", "Newtonian fluid", "plain", "hydrostatic", "uniform", "vibration", "vortex", "J2", "dynamic",
         "\u00e9\u4e2d", "a" * 5000, "/", "..", ".", "/dev/null", "/proc/self/mem", "''", "\"", "$HOME", "%s%n", "a/b", "a|b", "#"]
ENTRY = re.compile(r"^(\s*set\s+)([^=]*?)(\s*=\s*)(.*)$")


def mutate_value(random, value, values):
    kind = random.randrange(8)
    if kind == 0:
        return random.choice(NUMBERS)
    if kind == 1:
        return random.choice(LISTS)
    if kind == 2:
        return random.choice(FORMULAS)
    if kind == 3:
        return random.choice(WORDS)
    if kind == 4:  # what stands at another entry
        return random.choice(values)
    if kind == 5:  # one part of it
        parts = re.split(r"([,;]\s*)", value)
        parts[2 * random.randrange((len(parts) + 1) // 2)] = random.choice(NUMBERS)
        return "".join(parts)
    if kind == 6:  # a number of it, larger or smaller
        found = list(re.finditer(r"\d+\.?\d*(e[-+]?\d+)?", value))
        if found:
            number = random.choice(found)
            new = float(number[0]) * random.choice([-1, 0.5, 2, 0, 1 + 1e-9, 1e10, 1e-10])
            return value[:number.start()] + f"{new:.15g}" + value[number.end():]
    return mutate_bytes(random, value.encode(), 1).decode("utf8", "replace").replace("\n", " ")


def mutate_lines(random, text):
    """One change of a parameter file that knows what a line is."""
    lines = text.split("\n")
    entries = [i for i, line in enumerate(lines) if ENTRY.match(line)]
    values = [ENTRY.match(lines[i])[4] for i in entries]
    kind, at = random.randrange(20), random.randrange(len(lines))
    if kind < 12 and entries:
        at = random.choice(entries)
        match = ENTRY.match(lines[at])
        lines[at] = match[1] + match[2] + match[3] + mutate_value(random, match[4].split("#")[0].strip(), values)
    elif kind == 12:
        del lines[at]
    elif kind == 13:
        lines.insert(random.randrange(len(lines)), lines[at])
    elif kind == 14:
        other = random.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    elif kind == 15:
        lines.insert(at, random.choice(["end", "subsection", "subsection new", "include case.prm", "include /", "include nowhere",
                                        "set", "set =", "set a", "set a = ", "\\", "set b = 1 \\", "#", "\t", "end end"]))
    elif kind == 16:
        names = [i for i, line in enumerate(lines) if " Names" in line]
        if names:
            at = random.choice(names)
            lines[at] += random.choice([", other", ", ", ", " + lines[at].split("=")[1].split(",")[0], ",,", " more", "\u00fc"])
    elif kind == 17 and entries:
        at = random.choice(entries)
        lines[at] = mutate_bytes(random, lines[at].encode(), 1).decode("utf8", "replace")
    elif kind == 18:
        sections = [line for line in lines if "subsection" in line]
        if sections:
            lines.insert(at, random.choice(sections))
    else:
        lines = lines[:at]
    return "\n".join(lines)


def mutate_table(random, text):
    """One change of numbers in lines: points, meshes, surfaces."""
    lines = text.split("\n")
    at = random.randrange(len(lines))
    kind = random.randrange(8)
    words = lines[at].split(" ")
    if kind < 4:
        words[random.randrange(len(words))] = random.choice(NUMBERS + ["node", "", "1000000", "-5", "999999999999"])
        lines[at] = " ".join(words)
    elif kind == 4:
        del lines[at]
    elif kind == 5:
        lines.insert(random.randrange(len(lines)), lines[at])
    elif kind == 6:
        other = random.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    else:
        lines = lines[:at]
    return "\n".join(lines)


def mutate_bytes(random, data, n=0):
    """A few changes that know nothing."""
    data = bytearray(data)
    for _ in range(n or random.choice([1, 1, 2, 8, 64])):
        at = random.randrange(len(data) + 1)
        kind = random.randrange(6)
        if kind == 0 and at < len(data):
            data[at] ^= 1 << random.randrange(8)
        elif kind == 1 and at < len(data):
            data[at] = random.randrange(256)
        elif kind == 2:
            data[at:at] = bytes(random.randrange(256) for _ in range(random.choice([1, 2, 9])))
        elif kind == 3:
            del data[at:at + random.choice([1, 3, 17])]
        elif kind == 4:
            data[at:at] = data[at:at + random.choice([1, 5, 40])]
        elif random.randrange(4) == 0:
            del data[at:]
    return bytes(data)
