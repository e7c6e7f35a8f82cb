"""What passes reported (values.csv): a table, and a chart over the frames of what was reported in several."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from report import text
from report.load import Results
from report.style import Style
from report.svg import STAND_INS, drawing, to_svg


@dataclass(frozen=True)
class ValueTable:
    """A row a variant, its number and name first; cells are in the order of `headings`."""

    headings: list[str]
    rows: list[tuple[str, str, list[str]]]


def value_table(results: Results, numbers: dict[str, str]) -> ValueTable | None:
    """Every value of every variant; of several frames the mean and the largest. None where nothing was reported."""
    if results.values.empty:
        return None
    keys = _keys(results.values)
    groups = dict(list(results.values.groupby(["variant", "pass", "name"])))
    rows = []
    for name in results.ok["variant"]:
        cells = [_cell(groups.get((name, *key))) for key in keys]
        if any(cells):
            rows.append((numbers[name], name, cells))
    return ValueTable([f"{part}: {name}" for part, name in keys], rows)


def value_charts(results: Results, styles: dict[str, Style], numbers: dict[str, str]) -> list[str]:
    """A chart for each value that some variant reported in several frames: a line a variant, over frames."""
    series = results.values[results.values["frame"].notna()]
    charts = []
    for i, (part, name) in enumerate(_keys(series)):
        rows = series[(series["pass"] == part) & (series["name"] == name)]
        if rows["frame"].nunique() > 1:
            charts.append(_chart(rows, f"{part}: {name}", styles, numbers, f"values-{i}"))
    return charts


def _keys(values: pd.DataFrame) -> list[tuple[str, str]]:
    return list(values[["pass", "name"]].drop_duplicates().itertuples(index=False, name=None))


def _cell(values: pd.DataFrame | None) -> str:
    if values is None:
        return ""
    # Of what a build pass reports and reports again where surfaces move, the frames count.
    if values["frame"].notna().any():
        values = values[values["frame"].notna()]
    values = values["value"]
    if len(values) == 1:
        return text.exact(values.iloc[0])
    return f"{text.figures(values.mean())} (most {text.figures(values.max())})"


def _chart(rows: pd.DataFrame, caption: str, styles: dict[str, Style], numbers: dict[str, str],
           chart_id: str) -> str:
    with drawing():
        figure = Figure(figsize=(5.0, 3.7), dpi=72)  # matplotlib's SVG has 72 units an inch
        axes = figure.add_axes((0.16, 0.13, 0.80, 0.85))
        titles = []
        for i, (variant, own) in enumerate(rows.groupby("variant", sort=False)):
            own = own.sort_values("frame")
            style = styles[variant]
            line = axes.plot(own["frame"], own["value"], color=STAND_INS[style.color], linewidth=1.2,
                             marker=style.marker, markersize=4)[0]
            line.set_gid(f"{chart_id}-point-{i}")
            titles.append(f"{numbers[variant]} {variant}: {text.figures(own['value'].mean())} on average")
        axes.set_ylim(bottom=min(0.0, rows["value"].min()))
        axes.set_xlabel("measured frame")
        axes.set_ylabel(caption)
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.grid(True, color=STAND_INS["grid"], linewidth=0.6)
        axes.spines[["top", "right"]].set_visible(False)
        axes.set_axisbelow(True)
        return to_svg(figure, chart_id, caption, titles)
