"""Which color and mark stands for a method, a variant or a pass, the same in every chart and legend of a page.

Colors are names of CSS variables of style.css, so that a chart follows the reader's light or dark scheme.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from report.methods import families_of
from report.ranking import is_numeric
from report.results import Results

_CSS = Path(__file__).with_name("style.css").read_text(encoding="utf-8")
VALUES = dict(reversed(re.findall(r"--([\w-]+): ([^;]+);", _CSS)))  # of the light scheme, which comes first
CATEGORY_COLORS = tuple(f"c{i}" for i in range(8))
# Matplotlib's marker -> the same shape as an SVG path round (0, 0), about 5 units in radius.
MARKERS = {
    "o": "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z",
    "s": "M-4.5 -4.5h9v9h-9z",
    "^": "M0 -5.5l5.5 10h-11z",
    "D": "M0 -6l6 6l-6 6l-6 -6z",
    "v": "M0 5.5l5.5 -10h-11z",
    "P": "M-2 -5h4v3h3v4h-3v3h-4v-3h-3v-4h3z",
}


class Style(NamedTuple):
    color: str
    marker: str = "o"

    @property
    def mark(self) -> str:
        """Its SVG path."""
        return MARKERS[self.marker]


class Legend(NamedTuple):
    """What colors or marks tell, and of each its label."""

    key: str
    entries: list[tuple[str, Style]]


def styles(count: int) -> list[Style]:
    """Pairs of a color and a mark, of which 24 differ."""
    return [Style(CATEGORY_COLORS[i % len(CATEGORY_COLORS)], list(MARKERS)[i % len(MARKERS)]) for i in range(count)]


def variant_styles(results: Results) -> tuple[dict[str, Style], list[Legend], bool]:
    """Color and mark tell the method; where there is one alone, the color tells the first sweep key and the mark the second.

    @return the style of each variant, the legends, and whether lines join variants of a style: where a single key swaps
        methods.
    """
    families, keys, rows = families_of(results), results.sweep_keys, results.variants
    found = dict.fromkeys(rows["variant"], Style(CATEGORY_COLORS[0]))  # failed ones are of no method
    if len(families) > 1:
        own = styles(len(families))
        found |= {name: style for style, (_, names) in zip(own, families) for name in names}
        legend = Legend("method", [(method.name, style) for (method, _), style in zip(families, own)])
        return found, [legend], len(keys) == 1
    if not keys:
        return found, [], False
    color_of = dict(zip(_values(rows[keys[0]]), CATEGORY_COLORS * len(rows)))
    legends = [Legend(keys[0], [(value, Style(color)) for value, color in color_of.items()])]
    colors, markers = rows[keys[0]].map(color_of), ["o"] * len(rows)
    if len(keys) > 1:
        marker_of = dict(zip(_values(rows[keys[1]]), list(MARKERS) * len(rows)))
        legends.append(Legend(keys[1], [(value, Style("muted", marker)) for value, marker in marker_of.items()]))
        markers = rows[keys[1]].map(marker_of)
    return dict(zip(rows["variant"], map(Style, colors, markers))), legends, False


def pass_colors(results: Results) -> dict[str, str]:
    """The background of each kind of pass, as CSS, in the order in which passes.csv first names them. The colors that
    are there once more come in stripes."""
    return {name: background(i) for i, name in enumerate(results.passes["kind"].unique())}


def background(index: int) -> str:
    """The background of the part of a bar with this index."""
    color = f"var(--{CATEGORY_COLORS[index % len(CATEGORY_COLORS)]})"
    gap, angle = divmod(index // len(CATEGORY_COLORS), 2)
    return color if index < len(CATEGORY_COLORS) else \
        f"repeating-linear-gradient({45 + 90 * (1 - angle)}deg, {color} 0 4px, var(--card) 4px {6 + 2 * gap}px)"


def _values(column: pd.Series) -> list[str]:
    values = list(column.unique())
    return sorted(values, key=float) if is_numeric(column) else values
