"""Inputs that the cases change, and what talus must say of them."""
import os
import re


def write(runs, name, text, encoding="utf-8"):
    """A file in the work directory: its path."""
    os.makedirs(runs.work, exist_ok=True)
    path = os.path.join(runs.work, name)
    with open(path, "wb") as file:
        file.write(text if isinstance(text, bytes) else text.encode(encoding))
    return path


def expect(runs, name, text, *patterns):
    """All patterns stand in the text of a run, each on one line."""
    for pattern in patterns:
        found = re.search(pattern, text)
        runs.check(f"{name}: says '{pattern}'", not found, 0.5)
        if not found:
            print(text)


def refused(runs, name, prm, settings, *patterns, status=1):
    _, found, text = runs.execute(prm, name, *settings)
    runs.check(f"{name}: exit status {found} for {status}", found - status, 0.5)
    messages = [line for line in text.splitlines() if line.startswith("talus: ")]
    runs.check(f"{name}: {len(messages)} message", len(messages) - 1, 0.5)
    expect(runs, name, "\n".join(messages), *patterns)


def warned(runs, name, prm, settings, *patterns):
    """The run ends well; each pattern is in one warning, which is said once, on the terminal and in the log."""
    directory, status, text = runs.execute(prm, name, *settings)
    runs.check(f"{name}: exit status {status}", status, 0.5)
    log = open(os.path.join(directory, "log.txt")).read() if status == 0 else ""
    for where, lines in (("terminal", text.splitlines()), ("log", log.splitlines())):
        warnings = [line for line in lines if line.startswith("warning: ")]
        for pattern in patterns:
            n = sum(bool(re.search(pattern, line)) for line in warnings)
            runs.check(f"{name}: {where} warns once of '{pattern}'", n - 1, 0.5)
            if n != 1:
                print("\n".join(warnings))
        if not patterns:
            runs.check(f"{name}: no warning, {where}", len(warnings), 0.5)
            print("\n".join(warnings))
    return directory


def points(dim, separator=" ", form="{:.4f}", end="\n"):
    lines = []
    for k in range(4**dim):
        x = [0.31 + 0.05 * (k // 4**d % 4) for d in range(dim)] + [0.05**dim]
        lines.append(separator.join(form.format(c) for c in x))
    return end.join(lines) + end


BASE = """\
set Dimension = {dim}
subsection Run
  set End time = 1e-3
  # run
end
subsection Grid
  set Upper corner = 2, 2{two}
  set Spacing = 0.125
end
subsection Materials
  set Names = rubber
  subsection rubber
    set Density = 1e3
    set Young's modulus = 1e6
    # material
  end
end
subsection Bodies
  set Names = block
  subsection block
    # body
  end
end
subsection Conditions
  set Names = floor
  subsection floor
    # condition
  end
end
subsection Output
  set Grid = false
end
"""
BLOCK = "set Lower corner = 0.5, 0{half}\n    set Upper corner = 1.5, 1{one}"


def text_of(dim, run="", material="", body=BLOCK, condition="set Boundary ids = 2", more=""):
    """A block on a floor, with changes; a body's text may hold {half} and {one} for a third coordinate."""
    text = BASE.format(dim=dim, two=", 2" * (dim == 3))
    body = body.format(half=", 0.5" * (dim == 3), one=", 1.5" * (dim == 3))
    for mark, new in (("# run", run), ("# material", material), ("# body", body), ("# condition", condition)):
        text = text.replace(mark, new)
    return text + more
