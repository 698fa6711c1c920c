"""Numbers, times and tables as the pages write them."""
import math


def number(value, form="{:.3g}"):
    """A number for a cell; a dash where there is none."""
    if value is None:
        return "-"
    value = float(value)
    return "-" if math.isnan(value) or math.isinf(value) else form.format(value)


def percent(value, digits=1):
    return number(value, "{:.%df} %%" % digits) if value is None else number(100 * float(value), "{:.%df} %%" % digits)


def hours(seconds):
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"


def table(head, rows):
    if any(len(row) != len(head) for row in rows):
        raise ValueError(f"a row of the table of '{head[0]}' has not the {len(head)} cells of its head")
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])
