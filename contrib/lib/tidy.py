"""
clang-tidy over all sources. Most of its time goes into deal.II's headers, so that the files of a directory are looked at
together, as one unit; what does not compile in company is looked at alone.
"""
import concurrent.futures
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.path.join(ROOT, os.environ.get("TALUS_BUILD", "build"))
FILES_OF_UNIT = 12
SOURCE = re.compile(r"^(\S+?\.(?:cc|h)):\d+:\d+: (?:error|warning): (.*)$", re.M)


def flags():
    """What clang has to know, of all files in the build: where headers are, and what is defined."""
    with open(os.path.join(BUILD, "compile_commands.json")) as file:
        commands = json.load(file)
    found = {}
    for command in commands:
        words = shlex.split(command["command"])
        for word, after in zip(words, words[1:] + [""]):
            if word == "-isystem":
                found[word + after] = None
            elif word.startswith(("-I", "-D", "-std=", "-march=")):
                found[word] = None
    found["-I" + os.path.join(BUILD, "generated")] = None
    return list(found)


def write_unit(path, files):
    with open(path, "w") as unit:
        for i, file in enumerate(files):
            # Each file has its own object of this name.
            unit.write(f'#define registration registration_{i}\n#include "{file}"\n#undef registration\n')


def look(files, known_flags, directory):
    """What is found in these files: lines, each once."""
    name = os.path.join(directory, re.sub(r"\W", "_", os.path.relpath(files[0], ROOT)) + f"_{len(files)}.cc")
    write_unit(name, files)
    run = subprocess.run(["clang-tidy", "--quiet", "--config-file=" + os.path.join(ROOT, ".clang-tidy"),
                          "--checks=-bugprone-suspicious-include",
                          "--header-filter=" + ROOT + "/.*", name, "--", *known_flags],
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    broken, found = [], []
    for file, message in SOURCE.findall(run.stdout):
        if "clang-diagnostic-error" in message:
            broken.append(file)
    if broken and len(files) > 1:
        alone = [file for file in files if file in broken] or files
        together = [file for file in files if file not in alone]
        found = [line for file in alone for line in look([file], known_flags, directory)]
        return found + (look(together, known_flags, directory) if together else [])
    for match in SOURCE.finditer(run.stdout):
        found.append(os.path.relpath(match.group(0), ROOT) if os.path.isabs(match.group(1)) else match.group(0))
    return found


def units(directories):
    for directory in directories:
        for path, _, names in sorted(os.walk(os.path.join(ROOT, directory))):
            files = sorted(os.path.join(path, name) for name in names if name.endswith(".cc"))
            for first in range(0, len(files), FILES_OF_UNIT):
                yield files[first:first + FILES_OF_UNIT]


def main(directories):
    for directory in directories:
        if not os.path.isdir(os.path.join(ROOT, directory)):
            sys.exit(f"contrib/tidy: there is no directory '{directory}' here.")
    if not os.path.exists(os.path.join(BUILD, "compile_commands.json")):
        sys.exit(f"contrib/tidy: configure a build first: cmake -S . -B {os.path.relpath(BUILD, ROOT)} -G Ninja")
    all_units, known_flags, found = list(units(directories)), flags(), set()
    with tempfile.TemporaryDirectory() as work, concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for n, lines in enumerate(pool.map(lambda files: look(files, known_flags, work), all_units), 1):
            for line in lines:
                if line not in found:
                    print(line, flush=True)
            found.update(lines)
            print(f"{n} of {len(all_units)}: {os.path.relpath(os.path.dirname(all_units[n - 1][0]), ROOT)}", file=sys.stderr)
    print(f"{sum(map(len, all_units))} files, {len(found)} findings")
    sys.exit(1 if found else 0)


main(sys.argv[1:] or ["source"])
