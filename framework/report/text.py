"""Numbers and configs as text for a reader."""

from __future__ import annotations

import math
from collections.abc import Iterable

import yaml


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


def first(words: list[str], limit: int) -> str:
    """The first words, and how many more there are."""
    more = len(words) - limit
    return ", ".join(words[:limit]) + (f" and {more} more" if more > 0 else "")


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


def _scaled(value: float, step: float, units: str) -> tuple[float, str]:
    while abs(value) >= step and len(units) > 1:
        value, units = value / step, units[1:]
    return value, units[0].strip()


def count(value: float) -> str:
    """A whole number with its unit prefix: 1.05 M."""
    scaled, unit = _scaled(value, 1000, " kMG")
    return f"{figures(scaled)} {unit}".rstrip()


def size(value: float) -> str:
    """Bytes with a binary unit."""
    scaled, unit = _scaled(value, 1024, " KMG")
    return "–" if math.isnan(value) else f"{figures(scaled)} {unit}{'iB' if unit else 'B'}"


def yaml_of(value, is_one_line: bool = False) -> str:
    """A JSON value as YAML, what holds no list and no map on one line, or all of it."""
    dumped = yaml.safe_dump(value, sort_keys=False, allow_unicode=True, default_flow_style=is_one_line or None,
                            width=math.inf if is_one_line else 120)
    return dumped.removesuffix("...\n").strip()


def plain(value) -> str:
    """A JSON value for a reader: text without quotes, everything else as YAML on one line."""
    return value if isinstance(value, str) else yaml_of(value, True)
