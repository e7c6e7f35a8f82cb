"""What passes reported (values.csv): a table, and a chart over the frames of what was reported in several."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd

from report import text
from report.charts import frame_chart
from report.names import Names
from report.results import Results


@dataclass(frozen=True)
class ValueTable:
    """One row for each variant, its number and name first; cells are in the order of `headings`."""

    headings: list[str]
    rows: list[tuple[str, str, list[str]]]


def value_table(results: Results, names: Names) -> ValueTable | None:
    """Every value of every variant; of several frames the mean and the largest. None where nothing was reported."""
    if results.values.empty:
        return None
    keys = _keys(results.values)
    groups = dict(list(results.values.groupby(["variant", "pass", "name"])))
    rows = []
    for name in results.ok["variant"]:
        cells = [_cell(groups.get((name, *key))) for key in keys]
        if any(cells):
            rows.append((names.numbers[name], names.short[name], cells))
    return ValueTable([f"{part}: {name}" for part, name in keys], rows)


def value_charts(shown: Results, results: Results) -> list[dict]:
    """A chart for each value that changes from frame to frame in some variant: one line for each variant that is shown."""
    series = shown.values[shown.values["frame"].notna()]
    charts = []
    for part, name in _keys(series):
        rows = series[(series["pass"] == part) & (series["name"] == name)]
        if rows.groupby("variant")["value"].nunique().max() > 1:
            charts.append(frame_chart(rows, "value", f"{part}: {name}", results))
    return charts


def _keys(values: pd.DataFrame) -> list[tuple[str, str]]:
    return list(values[["pass", "name"]].drop_duplicates().itertuples(index=False, name=None))


def _cell(values: pd.DataFrame | None) -> str:
    if values is None:
        return ""
    # A build pass that reports again in frames, because surfaces move, is shown by its frames alone
    if values["frame"].notna().any():
        values = values[values["frame"].notna()]
    values = values["value"]
    if len(values) == 1:
        return text.exact(values.iloc[0])
    return f"{text.figures(values.mean())} (most {text.figures(values.max())})"
