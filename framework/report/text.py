"""Numbers and configs as text for a reader."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable

from markupsafe import Markup, escape

_PLAIN = re.compile(r"[A-Za-z_/.][\w ./+-]*")


def figures(value: float, digits: int = 3) -> str:
    """`value` to some significant digits without an exponent where that stays short; "–" for NaN."""
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if value == 0:
        return "0"
    exponent = int(f"{value:.{digits - 1}e}".partition("e")[2])  # of the rounded value
    if not -5 <= exponent < 6:
        return f"{value:.{digits - 1}e}"
    return f"{value:,.{max(digits - 1 - exponent, 0)}f}".replace(",", "\u202f")


def joined(words: Iterable) -> str:
    """a, b and c"""
    *first, last = [*map(str, words)] or [""]
    return f"{', '.join(first)} and {last}" if first else last


def cost(value: float) -> str:
    """As figures(); "–" for what costs nothing, for there is no such thing."""
    return figures(value) if value != 0 else "–"


def ratio(value: float) -> str:
    """A value that is best at 1, to three decimals, so that 0.998 and 1.003 can be compared; far from 1 as figures()."""
    return f"{value:.3f}" if 0.1 <= abs(value) < 10 else figures(value)


def span(low: float, high: float) -> str:
    """An interval to two significant digits of its wider end, at least as many as tell its ends apart."""
    for digits in (2, 3, 4):
        first, last = figures(low, digits), figures(high, digits)
        if first != last:
            break
    return f"{first}–{last}"


def exact(value: float) -> str:
    """A whole number with all of its digits, any other to four."""
    whole = math.isfinite(value) and value == int(value)
    return f"{int(value):,}".replace(",", "\u202f") if whole else figures(value, 4)


def count(value: float) -> str:
    """A whole number with its unit prefix: 1.05 M."""
    for step, unit in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= step:
            return f"{figures(value / step)} {unit}"
    return figures(value)


def size(value: float) -> str:
    """Bytes with a binary unit."""
    for step, unit in ((2**30, "GiB"), (2**20, "MiB"), (2**10, "KiB")):
        if abs(value) >= step:
            return f"{figures(value / step)} {unit}"
    return figures(value) + ("" if math.isnan(value) else " B")


def breakable(value: str) -> Markup:
    """`value` as HTML that may be broken after the marks between its words; copied, it is `value` again. HTML stays."""
    if isinstance(value, Markup):
        return value
    return Markup(re.sub(r"([,=._/])", r"\1<wbr>", str(escape(value))))


def yaml_like(value, indent: int = 0) -> str:
    """A JSON value as YAML-like text, short lists and leaves on one line."""
    pad = "  " * indent
    if isinstance(value, dict) and value and not _is_short(value):
        lines = []
        for key, item in value.items():
            nested = isinstance(item, (dict, list)) and item and not _is_short(item)
            lines.append(f"{pad}{_scalar(key)}:" + (f"\n{yaml_like(item, indent + 1)}" if nested else
                                                    f" {yaml_like(item)}"))
        return "\n".join(lines)
    if isinstance(value, list) and value and not _is_short(value):
        return "\n".join(f"{pad}- {yaml_like(item, indent + 1).lstrip()}" for item in value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_scalar(key)}: {yaml_like(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(yaml_like(item) for item in value) + "]"
    return _scalar(value)


def plain(value) -> str:
    """A JSON value for a reader: text without quotes, everything else YAML-like."""
    return value if isinstance(value, str) else yaml_like(value)


def _is_short(value) -> bool:
    items = value.values() if isinstance(value, dict) else value
    leaves = not any(isinstance(item, (dict, list)) for item in items)
    return leaves and len(json.dumps(value)) <= (0 if isinstance(value, dict) else 90)


def _scalar(value) -> str:
    if isinstance(value, str) and _PLAIN.fullmatch(value) and value not in ("null", "true", "false"):
        return value
    return json.dumps(value, ensure_ascii=False)
