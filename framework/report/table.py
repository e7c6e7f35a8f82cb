"""The results table: columns are sweep keys, costs and scores; rows are variants, baselines and the noise."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from report import ranking, text
from report.names import Names
from report.results import BASELINES, LIGHTS, Metric, Results, interval_columns


@dataclass(frozen=True)
class _Cost:
    heading: str
    title: str
    write: Callable[[float], str]


_COSTS = {
    "build_ms": _Cost("build, ms", "once for each scene or light; lower is better; – where nothing is built", text.cost),
    "frame_ms_median": _Cost("frame, ms", "median of the measured frames; lower is better", text.figures),
    "memory_bytes": _Cost("memory", "device memory that the passes keep; lower is better", text.size),
    "rays": _Cost("rays", "rays traced", text.count),
}


_FIRST_COST = "frame_ms_median"
_ARROWS = {"low": "↓", "high": "↑", "one": "→1"}


@dataclass(frozen=True)
class Column:
    """A column of the results table. Scores have a metric; `light` is "" where it holds for both lights."""

    key: str
    heading: str
    title: str
    light: str = ""
    align_text: bool = False
    metric: Metric | None = None


class Cell(NamedTuple):
    """`sort` is a number or a text to sort by; `mark` is "", "best", "tie" or "worse"; `interval` is "" for none."""

    text: str
    sort: str = ""
    light: str = ""
    mark: str = ""
    title: str = ""
    is_text: bool = False
    interval: str = ""

    @property
    def css(self) -> str:
        """Its classes."""
        light = f"only-{self.light}" if self.light else ""
        return " ".join([word for word in (light, self.mark, "words" if self.is_text else "") if word])


@dataclass(frozen=True)
class Row:
    """`name` is what is shown, `full_name` the variant's own, as in the files. `anchor`: where its images are, or "row-"
    and its number where the page has none."""

    number: str
    name: str
    anchor: str
    cells: list[Cell]
    error: str = ""
    full_name: str = ""


def columns_of(results: Results, lights: list[str]) -> list[Column]:
    """The columns after the number and the name, without scores that no variant and no baseline has: time, error, its
    bias and noise, and energy first, then the other scores and costs, last what the sweep varied."""
    metrics = results.metrics[:1] + results.seed_metrics
    metrics += tuple(m for m in results.metrics[1:] if m.better == "one")
    metrics += tuple(m for m in results.metrics if m not in metrics)
    costs = {key: Column(key, cost.heading, cost.title) for key, cost in _COSTS.items()}
    columns = [costs.pop(_FIRST_COST), *score_columns(results, lights, metrics), *costs.values()]
    columns += [Column(key, key, f"{key} that the variant ran on", align_text=True)
                for key in ("device", "tracer") if results.variants[key].nunique() > 1]
    if len(results.sweep_keys) < 2:  # its values are the variants' names
        return columns
    # Numbers are there to sort by; words stand in the names
    numeric = [key for key in results.sweep_keys if ranking.is_numeric(results.variants[key])]
    return columns + [Column(key, key, "varied by the sweep") for key in numeric]


def score_columns(results: Results, lights: list[str], metrics: tuple[Metric, ...], region: str = "") -> list[Column]:
    """Columns of scores that some variant or baseline has. @param region "" or "@" and a mask's name."""
    columns = []
    for light in lights:
        for metric in metrics:
            column = LIGHTS[light] + metric.key + region
            known = results.ok[column].notna().any() or any(
                math.isfinite(results.baseline(name, column, reference))
                for name in BASELINES for reference in results.references())
            if known:
                unit = f", {metric.unit}" if metric.unit else ""
                columns.append(Column(column, f"{metric.label}{unit}\u00a0{_ARROWS[metric.better]}",
                                      f"{metric.meaning} ({light} light)", light, metric=metric))
    return columns


def variant_rows(results: Results, columns: list[Column], names: Names, anchors: dict[str, str]) -> list[Row]:
    """The variants' rows, marked with the best of each column, its ties, and what a black image beats."""
    marks = {column.key: _marks(results, column) for column in columns}
    beaten = {column.key: ranking.all_beaten(results, column.metric, column.key) for column in columns if column.metric}
    rows = []
    for row in results.variants.to_dict("records"):
        name = row["variant"]
        cells = [_cell(row, column, marks[column.key].get(name, ""), beaten.get(column.key, {}).get(name, []))
                 for column in columns]
        failed = row["status"] != "ok"
        error = (row["error"] or f"status is '{row['status']}', with no error text") if failed else ""
        rows.append(Row(names.numbers[name], names.short[name], anchors[name], cells, error, name))
    return rows


def _marks(results: Results, column: Column) -> dict[str, str]:
    if column.metric:
        return ranking.score_marks(results, column.metric, column.key)
    return ranking.cost_marks(results, column.key) if column.key in ranking.COST_COLUMNS else {}


def _score(value: float, metric: Metric) -> str:
    return text.ratio(value) if metric.better == "one" else text.figures(value)


def _cell(row: Mapping, column: Column, mark: str, beaten_by: list[str]) -> Cell:
    value = row[column.key]
    if column.metric:
        title = f"worse than a {' and a '.join(beaten_by)} image" if beaten_by else ""
        return Cell(_score(value, column.metric), _sort(value), column.light, "worse" if beaten_by else mark, title,
                    interval=_interval(row, column))
    if column.key in _COSTS:
        return Cell(_COSTS[column.key].write(value), _sort(value), mark=mark, title=_cost_title(row, column.key))
    return Cell(value, value, is_text=column.align_text)


def _cost_title(row: Mapping, key: str) -> str:
    if key == "frame_ms_median":
        return f"p05 {text.figures(row['frame_ms_p05'])}, p95 {text.figures(row['frame_ms_p95'])} ms"
    return f"{text.size(row['peak_bytes'])} at the most, with scratch memory" if key == "memory_bytes" else ""


def _interval(row: Mapping, column: Column) -> str:
    low, high = (row.get(name, math.nan) for name in interval_columns(column.key))
    return text.span(low, high) if math.isfinite(low) and math.isfinite(high) else ""


def baseline_rows(results: Results, columns: list[Column]) -> list[Row]:
    """What a black and a constant image score, as far as the run measured it."""
    return [row for reference in results.references() for name in BASELINES
            if (row := _reference_row(f"a {name} image{_folder(results, reference)}", columns,
                                      lambda column: results.baseline(name, column, reference)))]


def noise_rows(results: Results, columns: list[Column]) -> list[Row]:
    """What the noise of each reference alone scores, where it is not taken off."""
    return [row for reference in results.references()
            if (row := _reference_row(f"the reference's own noise{_folder(results, reference)}", columns,
                                      lambda column: results.noise(column, reference)))]


def _folder(results: Results, reference: dict) -> str:
    return "" if results.only_reference is not None else f" ({reference.get('folder')})"


def _reference_row(name: str, columns: list[Column], value_of: Callable[[str], float]) -> Row | None:
    values = {c.key: value_of(c.key) for c in columns if c.light}
    if not any(math.isfinite(value) for value in values.values()):
        return None
    return Row("", name, "", [Cell(_score(values[c.key], c.metric) if c.light else "", light=c.light) for c in columns])


def _sort(value: float) -> str:
    return "" if math.isnan(value) else repr(float(value))
