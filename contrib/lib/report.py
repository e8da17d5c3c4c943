"""Acceptance figures and tables."""
import csv
import dataclasses
import math


@dataclasses.dataclass
class Figure:
    """A measured value that must lie between two bounds."""
    name: str
    value: float
    lower: float = -math.inf
    upper: float = math.inf
    unit: str = ""

    @property
    def passes(self):
        return self.lower <= self.value <= self.upper  # False for NaN

    def line(self):
        unit = f" {self.unit}" if self.unit else ""
        if math.isinf(self.lower):
            bound = f"<= {self.upper:.6g}"
        elif math.isinf(self.upper):
            bound = f">= {self.lower:.6g}"
        else:
            bound = f"{self.lower:.6g} to {self.upper:.6g}"
        return f"{'PASS' if self.passes else 'FAIL'}  {self.name:52} {self.value:10.6g}{unit:4}  {bound}{unit}"


def near(name, value, expected, tolerance, unit=""):
    return Figure(name, value, expected - tolerance, expected + tolerance, unit)


def write_csv(path, rows):
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def format_table(rows):
    """Rows of one set of columns as aligned text: numbers to the right with four digits."""
    def text(value):
        return f"{value:.4g}" if isinstance(value, float) and abs(value) < 1e4 else (
            f"{value:.0f}" if isinstance(value, float) and math.isfinite(value) else str(value))

    cells = [list(rows[0])] + [[text(value) for value in row.values()] for row in rows]
    is_number = [isinstance(value, float) for value in rows[0].values()]
    widths = [max(len(line[c]) for line in cells) for c in range(len(cells[0]))]
    return "\n".join("  ".join(cell.rjust(width) if number else cell.ljust(width)
                               for cell, width, number in zip(line, widths, is_number)).rstrip() for line in cells)
