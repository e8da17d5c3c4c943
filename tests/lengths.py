"""
No function of the program and its tests over 60 lines, no file over 300: what is longer nobody reads at once. And no class of
one name in two headers, which no compiler sees where no file includes both.
"""

import pathlib
import re
import sys

LONGEST_FUNCTION, LONGEST_FILE = 60, 300


def functions(lines):
    """First line and length of each block that follows parentheses, by the layout that clang-format gives."""
    for first, line in enumerate(lines):
        if not re.fullmatch(r" *\{", line):
            continue
        last = next((i for i in range(first, len(lines)) if lines[i].startswith(line.replace("{", "}"))), None)
        head, above = "", first - 1
        while above >= 0 and lines[above].strip() and not re.search(r"([;{}]|\*/)$", lines[above]):
            head, above = lines[above].strip() + " " + head, above - 1
        if last and "(" in head and not re.match(r"(template <.*> )?(class|struct|namespace|enum) ", head):
            yield first, last - first - 1


def classes(text):
    """Names of the classes that a header defines in the namespace of the program."""
    return re.findall(r"^  (?:class|struct) (\w+)(?: final)?\s*(?::[^;{]*)?\n  \{", text, re.M)


def main():
    problems, headers = [], {}
    for folder in sys.argv[1:]:
        for path in sorted(pathlib.Path(folder).rglob("*")):
            if path.suffix not in (".cc", ".h"):
                continue
            text = path.read_text()
            lines = text.splitlines()
            for name in classes(text) if path.suffix == ".h" and "include" in path.parts else []:
                if headers.setdefault(name, path) != path:
                    problems.append(f"{path}: a class '{name}' is in {headers[name]} as well")
            if len(lines) > LONGEST_FILE:
                problems.append(f"{path}: {len(lines)} lines, more than {LONGEST_FILE}")
            problems += [f"{path}:{first + 1}: a function of {length} lines, more than {LONGEST_FUNCTION}"
                         for first, length in functions(lines) if length > LONGEST_FUNCTION]
    print("\n".join(problems))
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
