"""Which colour and marker stands for a variant or a pass, the same in every chart and legend of a page.

Colours are names of CSS variables of style.css, so that a chart follows the reader's light or dark scheme.
"""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd

from report.names import Family
from report.ranking import is_numeric
from report.results import Results

CATEGORY_COLORS = tuple(f"c{i}" for i in range(8))
RAMP_COLORS = tuple(f"s{i}" for i in range(7))  # for numbers: from little to much
# Matplotlib's marker -> the same shape as an SVG path round (0, 0), about 5 units in radius.
MARKERS = {
    "o": "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z",
    "s": "M-4.5 -4.5h9v9h-9z",
    "^": "M0 -5.5l5.5 10h-11z",
    "D": "M0 -6l6 6l-6 6l-6 -6z",
    "v": "M0 5.5l5.5 -10h-11z",
    "P": "M-2 -5h4v3h3v4h-3v3h-4v-3h-3v-4h3z",
}


@dataclass(frozen=True)
class Style:
    color: str
    marker: str


@dataclass(frozen=True)
class LegendEntry:
    label: str
    style: Style


@dataclass(frozen=True)
class Legend:
    """One sweep key and how its values are shown."""

    key: str
    entries: list[LegendEntry]


def variant_styles(results: Results, families: list[Family]) -> tuple[dict[str, Style], list[Legend], list[list[str]]]:
    """The style of each variant: colour by the first sweep key, marker by the second. Where a single key swaps methods
    and some differ in parameters alone, colour by method.

    @return the styles, their legends, and the variants to join by a line.
    """
    table, keys = results.variants, results.sweep_keys
    plain = Style(CATEGORY_COLORS[0], "o")
    if not keys:
        return {name: plain for name in table["variant"]}, [], []
    if len(keys) == 1 and not is_numeric(table[keys[0]]) and len(families) < len(results.ok):
        style_of = {family.name: Style(CATEGORY_COLORS[i % len(CATEGORY_COLORS)], list(MARKERS)[i % len(MARKERS)])
                    for i, family in enumerate(families)}
        styles = dict.fromkeys(table["variant"], plain)  # failed ones are in no family
        styles |= {name: style_of[family.name] for family in families for name in family.variants}
        return styles, [Legend("method", [LegendEntry(*entry) for entry in style_of.items()])], \
            [family.variants for family in families if len(family.variants) > 1]

    colors = _colors(table[keys[0]])
    shapes = list(MARKERS)
    second = _values(table[keys[1]]) if keys[1:] else []
    shape_of = {value: shapes[i % len(shapes)] for i, value in enumerate(second)}
    legends = [Legend(keys[0], [LegendEntry(value, Style(color, "o")) for value, color in colors.items()])]
    if shape_of:
        legends.append(Legend(keys[1], [LegendEntry(v, Style("muted", m)) for v, m in shape_of.items()]))
    styles = {row["variant"]: Style(colors[row[keys[0]]], shape_of[row[keys[1]]] if shape_of else "o")
              for row in table[["variant", *keys]].to_dict("records")}
    return styles, legends, []


def pass_colors(results: Results) -> dict[str, str]:
    """The background of each kind of pass, as CSS, in the order in which passes.csv first names them. The colours that
    are there once more come in stripes."""
    return {name: _background(i) for i, name in enumerate(results.passes["kind"].unique())}


def _background(index: int) -> str:
    color = f"var(--{CATEGORY_COLORS[index % len(CATEGORY_COLORS)]})"
    gap, angle = divmod(index // len(CATEGORY_COLORS), 2)
    return color if index < len(CATEGORY_COLORS) else \
        f"repeating-linear-gradient({45 + 90 * (1 - angle)}deg, {color} 0 4px, var(--card) 4px {6 + 2 * gap}px)"


def _values(column: pd.Series) -> list[str]:
    values = list(column.unique())
    return sorted(values, key=float) if is_numeric(column) else values


def _colors(column: pd.Series) -> dict[str, str]:
    values = _values(column)
    if not is_numeric(column):
        return {value: CATEGORY_COLORS[i % len(CATEGORY_COLORS)] for i, value in enumerate(values)}
    # Numbers take evenly spaced steps of the ramp.
    last = max(len(values) - 1, 1)
    return {value: RAMP_COLORS[round(i * (len(RAMP_COLORS) - 1) / last)] for i, value in enumerate(values)}
