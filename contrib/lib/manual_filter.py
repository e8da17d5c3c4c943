"""A page of doc/ for Doxygen: headings get the names by which other pages link to them. Usage: manual_filter.py PAGE.md"""
import pathlib
import re
import sys


def slug(title):
    """As on GitHub: lower case, blanks to hyphens, no other signs."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title).lower()
    return re.sub(r"[^a-z0-9_ -]", "", plain).replace(" ", "-")


def main():
    path = pathlib.Path(sys.argv[1])
    seen = {}  # how often a name has been given: the second `use` is called `use-1`
    for n, line in enumerate(path.read_text().splitlines()):
        heading = re.match(r"#{1,4} (.*\S)\s*$", line) if n > 0 else None
        if heading:
            name = slug(heading[1])
            seen[name] = seen.get(name, -1) + 1
            line = f"{line.rstrip()} {{#{path.stem}-{name}{f'-{seen[name]}' if seen[name] else ''}}}"
        elif not line.startswith("    "):
            line = re.sub(r"\]\(#([a-z0-9_-]+)\)", rf"](@ref {path.stem}-\1)", line)
            line = re.sub(r"\]\((?:\.\./|doc/)?([a-z_]+|README)\.md#([a-z0-9_-]+)\)", r"](@ref \1-\2)", line)
        print(line)


if __name__ == "__main__":
    main()
