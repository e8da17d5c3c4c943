"""Runs the benchmarks and writes one page of HTML: the claims of the three papers, each with its bound, what was found,
pass or fail, and the picture."""
import argparse
import base64
import html
import json
import math
import pathlib
import sys

import reproduce
import runs

PAPERS = (
    ("Nakamura, Matsumura & Mizutani (2023): Taylor PIC and kernel correction",
     ("kernels", "shear", "footing", "disk", "dam", "column")),
    ("Tran, Solowski, Berzins & Guilkey (2019): CPLS", ("imls", "vibration", "ring", "vortex", "disks", "wall")),
    ("Cao et al. (2024): UMLS", ("bar", "umls-disks", "cantilever", "wavy", "slope", "container", "apic")),
    ("Beside the papers", ("shear-3d", "column-3d", "martin-moyce", "taylor", "slope-2d", "strength-reduction", "bearing", "silo")))
QUICK = ("kernels", "imls", "disk", "shear-3d", "martin-moyce", "apic")
STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 62em; margin: 2em auto; padding: 0 1em; color: #222; }
h1, h2, h3 { line-height: 1.2; } h2 { margin-top: 2.5em; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; margin: 1em 0; } th, td { padding: .2em .8em .2em 0; text-align: left; vertical-align: top; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.pass { color: #17692f; } .fail { color: #b00020; font-weight: bold; } .missing { color: #888; }
img { max-width: 100%; } p.origin { color: #666; font-size: 90%; }
"""


def number(value):
    return f"{value:.4g}" if value is not None and math.isfinite(value) else "not found"


def bound(figure):
    unit = " " + figure["unit"] if figure["unit"] else ""
    lower, upper = figure["lower"], figure["upper"]
    if math.isinf(lower):
        return f"at most {upper:.4g}{unit}"
    return f"at least {lower:.4g}{unit}" if math.isinf(upper) else f"{lower:.4g} to {upper:.4g}{unit}"


def passes(figure):
    return figure["lower"] <= figure["value"] <= figure["upper"]  # false for NaN


def figure_row(figure):
    verdict = "pass" if passes(figure) else "fail"
    return (f'<tr><td>{html.escape(figure["name"])}</td><td class="number">{number(figure["value"])} '
            f'{html.escape(figure["unit"])}</td><td class="number">{html.escape(bound(figure))}</td>'
            f'<td class="{verdict}">{verdict}</td></tr>')


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min"


def pictures(directory):
    """The figures within the page, so that it can be passed on as one file."""
    return "".join(f'<p><img alt="{path.stem}" src="data:image/png;base64,{base64.b64encode(path.read_bytes()).decode()}"></p>'
                   for path in sorted(directory.glob("*.png")))


def section(name, result, directory):
    head = f'<h3 id="{name}">{name}: {html.escape(reproduce.load(name).TITLE)}</h3>'
    if result is None:
        return head + '<p class="missing">not run</p>'
    rows = "".join(figure_row(figure) for figure in result["figures"])
    return (f'{head}<p class="origin"><code>contrib/reproduce {name}</code>: {result["runs"]} runs, '
            f'{duration(result["seconds"])} in all; {html.escape(result["version"])}; {result["date"]}; '
            f'{html.escape(result["machine"])}</p><table><tr><th>claim</th><th>found</th><th>bound</th><th></th></tr>{rows}'
            f'</table>{pictures(directory)}')


def summary_row(name, result):
    if result is None:
        return f'<tr><td><a href="#{name}">{name}</a></td><td class="missing" colspan="2">not run</td></tr>'
    n_passed = sum(passes(figure) for figure in result["figures"])
    verdict = "pass" if n_passed == len(result["figures"]) else "fail"
    return (f'<tr><td><a href="#{name}">{name}</a></td><td class="number {verdict}">{n_passed} of {len(result["figures"])}</td>'
            f'<td class="number">{duration(result["seconds"])}</td></tr>')


def read(path):
    return json.loads(path.read_text()) if path.exists() else None


def markdown_section(name, result):
    if result is None:
        return [f"### {name}", "", "No result is kept.", ""]
    title = reproduce.load(name).TITLE
    lines = [f"### {name}", "", f"{title[0].upper()}{title[1:]}. {result['runs']} runs, {duration(result['seconds'])}; {result['version']}; "
             f"{result['date']}; {result['machine']}.", "", "| claim | found | bound | |", "|---|---|---|---|"]
    lines += [f"| {figure['name'].replace('|', '&#124;')} | {number(figure['value'])} {figure['unit']} | {bound(figure)} | "
              f"{'pass' if passes(figure) else '**fail**'} |" for figure in result["figures"]]
    if (reproduce.FIGURES / f"{name}.png").exists():
        lines += ["", f"![{name}](figures/{name}.png)"]
    return lines + [""]


def markdown(found):
    """doc/report.md: the results that are kept in doc/results."""
    lines = ["# Verification: the latest results", "", "Written by `contrib/report --doc` from what `contrib/reproduce NAME --doc` has left in "
             "`doc/results`. What the papers claim,", "and why figures differ: [benchmarks](benchmarks.md), [shear](shear.md), [cpls](cpls.md), "
             "[umls](umls.md).", "", "| benchmark | within bounds | time | commit, date |", "|---|---|---|---|"]
    for _, names in PAPERS:
        for name in names:
            result = found[name]
            lines.append(f"| [{name}](#{name}) | no result is kept | | |" if result is None else
                         f"| [{name}](#{name}) | {sum(map(passes, result['figures']))} of {len(result['figures'])} | "
                         f"{duration(result['seconds'])} | {result['version'].split('commit ')[-1].split(')')[0]}, {result['date']} |")
    for title, names in PAPERS:
        lines += ["", f"## {title}", ""]
        for name in names:
            lines += markdown_section(name, found[name])
    return "\n".join(lines).rstrip() + "\n"


def page(output):
    found = {name: read(output / name / "result.json") for _, names in PAPERS for name in names}
    n_figures = sum(len(result["figures"]) for result in found.values() if result)
    n_passed = sum(passes(figure) for result in found.values() if result for figure in result["figures"])
    parts = [f'<!DOCTYPE html><html lang="en"><head><meta charset="utf-8"><title>Talus: verification</title>'
             f'<style>{STYLE}</style></head><body><h1>Talus: verification</h1><p>Of {n_figures} acceptance figures '
             f'{n_passed} lie within their bounds. Each table is what <code>contrib/reproduce NAME</code> prints.</p>']
    for title, names in PAPERS:
        rows = "".join(summary_row(name, found[name]) for name in names)
        parts.append(f'<p><b>{html.escape(title)}</b></p><table><tr><th>benchmark</th><th>within bounds</th><th>time</th></tr>'
                     f'{rows}</table>')
    for title, names in PAPERS:
        parts.append(f"<h2>{html.escape(title)}</h2>")
        parts += [section(name, found[name], output / name) for name in names]
    return "\n".join(parts) + "\n</body></html>\n"


def parse_arguments():
    known = [name for _, names in PAPERS for name in names]
    parser = argparse.ArgumentParser(prog="contrib/report", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="these benchmarks alone; the page shows what is there of others")
    parser.add_argument("--quick", action="store_true", help=f"those that take minutes: {', '.join(QUICK)}")
    parser.add_argument("--evaluate", action="store_true", help="make no run: take those that earlier calls have left")
    parser.add_argument("--doc", action="store_true", help="also renew doc/report.md, and the results and figures in doc that it shows")
    parser.add_argument("--output", default=runs.ROOT / "reproduce", type=pathlib.Path,
                        help="directory of the results, and of index.html (reproduce)")
    parser.add_argument("--jobs", type=int, default=runs.default_jobs(), help="runs at a time (%(default)s)")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of each run (%(default)s)")
    arguments = parser.parse_args()
    for name in arguments.names:
        if name not in known:
            parser.error(f"there is no benchmark '{name}': {', '.join(known)}")
    arguments.names = arguments.names or (QUICK if arguments.quick else known)
    return arguments


def main():
    arguments = parse_arguments()
    failed = 0
    for name in arguments.names:
        if arguments.evaluate and not (arguments.output / name / "runs").exists() and reproduce.load(name).runs():
            continue  # the page says that it has not been run
        print(f"\n{name}: {reproduce.load(name).TITLE}", flush=True)
        failed += reproduce.reproduce(name, argparse.Namespace(**{**vars(arguments), "output": arguments.output / name}))
    target = arguments.output / "index.html"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page(arguments.output))
    if arguments.doc:
        kept = {name: read(reproduce.RESULTS / f"{name}.json") for _, names in PAPERS for name in names}
        (runs.ROOT / "doc" / "report.md").write_text(markdown(kept))
    print(f"\n{target} shows all of them; {failed} of {len(arguments.names)} benchmarks have a figure out of its bounds.")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
