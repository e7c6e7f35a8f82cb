"""Tables of a page, and the table of results: columns are sweep keys, costs and scores; rows are variants."""

from __future__ import annotations

import math
from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from report import ranking, text
from report.results import BASELINES, LIGHTS, Metric, Results, interval_columns


class Cell(NamedTuple):
    """A cell or a heading of a table.

    sort: what it sorts by; "": its text. small: what stands below. mark: "", "best", "tie" or "worse". link: an id.
    """

    text: str
    css: str = ""
    sort: str = ""
    title: str = ""
    small: str = ""
    mark: str = ""
    link: str = ""

    def classes(self, is_words: bool) -> str:
        """For HTML."""
        return f"{self.css} {self.mark} {'words' if is_words else ''}".strip()


@dataclass
class Table:
    """What macros.html.j2 draws: rows of cells or plain texts. `words`: the columns of words, which are aligned to the left."""

    title: str
    headings: Sequence[Cell | str]
    rows: list[Sequence[Cell | str]] = field(default_factory=list)
    note: str = ""
    words: Container[int] = (0,)
    footers: list[Sequence[Cell | str]] = field(default_factory=list)

    def __post_init__(self):
        self.headings = [heading if isinstance(heading, Cell) else Cell(heading) for heading in self.headings]

    def add(self, *cells: Cell | str) -> None:
        """Adds a row."""
        self.rows.append(cells)


def number(value: float, written: str = "", **of_cell) -> Cell:
    """A cell that sorts, and is saved, by a number, whatever stands in it. What has none stays last."""
    return Cell(written or text.figures(value), sort="none" if math.isnan(value) else repr(float(value)), **of_cell)


class _Cost(NamedTuple):
    heading: str
    title: str
    write: Callable[[float], str]


_COSTS = {
    "frame_ms_median": _Cost("frame, ms", "median of the measured frames; lower is better", text.figures),
    "build_ms": _Cost("build, ms", "once for each scene or light; lower is better; – where nothing is built", text.cost),
    "memory_bytes": _Cost("memory", "device memory that the passes keep; lower is better", text.size),
    "rays": _Cost("rays", "rays traced", text.count),
}
_ARROWS = {"low": "↓", "high": "↑", "one": "→1"}


class Column(NamedTuple):
    """A column of the results table. Scores have a metric; `light` is "" where it holds for both lights."""

    key: str
    heading: str
    title: str
    light: str = ""
    metric: Metric | None = None

    @property
    def css(self) -> str:
        return f"only-{self.light}" if self.light else ""


def columns_of(results: Results, lights: list[str]) -> list[Column]:
    """The columns after the number and the name, without scores that no variant and no baseline has: time, error, its
    bias and noise, and energy first, then the other scores and costs, last what the sweep varied."""
    metrics = results.metrics[:1] + results.seed_metrics
    metrics += tuple(m for m in results.metrics[1:] if m.better == "one")
    metrics += tuple(m for m in results.metrics if m not in metrics)
    time, *costs = [Column(key, cost.heading, cost.title) for key, cost in _COSTS.items()]
    columns = [time, *score_columns(results, lights, metrics), *costs]
    columns += [Column(key, key, f"{key} that the variant ran on")
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
            key = LIGHTS[light] + metric.key + region
            if results.ok[key].notna().any() or any(math.isfinite(results.baseline(name, key, reference))
                                                    for name in BASELINES for reference in results.references):
                unit = f", {metric.unit}" if metric.unit else ""
                columns.append(Column(key, f"{metric.label}{unit}\u00a0{_ARROWS[metric.better]}",
                                      f"{metric.meaning} ({light} light)", light, metric))
    return columns


def results_table(results: Results, title: str, columns: list[Column], anchors: dict[str, str],
                  has_baselines: bool = True) -> Table:
    """The variants, marked with the best of each column, its ties, and what a black image beats; below, what a black and a
    constant image and each reference's own noise score.

    @param anchors where a variant's images are, or its row where the page has none"""
    marks, beaten = ({column.key: marks_of(column) for column in columns} for marks_of in (
        lambda column: _marks(results, column),
        lambda column: ranking.all_beaten(results, column.metric, column.key) if column.metric else {}))
    headings = [Cell("#"), Cell("variant"), *(Cell(c.heading, c.css, title=c.title) for c in columns)]
    table = Table(title, headings, words=(1,))
    for row in results.variants.to_dict("records"):
        name = row["variant"]
        failed = "failed" if row["status"] != "ok" else ""
        table.rows.append([Cell(results.numbers[name], "number", results.numbers[name]),
                           Cell(results.names[name], f"name {failed}", title=name, link=anchors[name]),
                           *(_cell(row, column, marks[column.key].get(name, ""), beaten[column.key].get(name, []))
                             for column in columns)])
    if has_baselines:
        table.footers = _footers(results, columns)
    return table


def _marks(results: Results, column: Column) -> dict[str, str]:
    if column.metric:
        return ranking.score_marks(results, column.metric, column.key)
    return ranking.cost_marks(results, column.key) if column.key in ranking.COST_COLUMNS else {}


def _score(value: float, metric: Metric) -> str:
    return text.ratio(value) if metric.better == "one" else text.figures(value)


def _cell(row: Mapping, column: Column, mark: str, beaten_by: list[str]) -> Cell:
    value = row[column.key]
    if column.metric:
        low, high = (row.get(name, math.nan) for name in interval_columns(column.key))
        return number(value, _score(value, column.metric), css=column.css,
                      title=f"worse than a {' and a '.join(beaten_by)} image" if beaten_by else "",
                      small=text.span(low, high) if math.isfinite(low) and math.isfinite(high) else "",
                      mark="worse" if beaten_by else mark)
    if column.key in _COSTS:
        return number(value, _COSTS[column.key].write(value), title=_cost_title(row, column.key), mark=mark)
    return Cell(value)


def _cost_title(row: Mapping, key: str) -> str:
    if key == "frame_ms_median":
        return f"p05 {text.figures(row['frame_ms_p05'])}, p95 {text.figures(row['frame_ms_p95'])} ms"
    return f"{text.size(row['peak_bytes'])} at the most, with scratch memory" if key == "memory_bytes" else ""


def _footers(results: Results, columns: list[Column]) -> list[list[Cell]]:
    """What is known of a black and a constant image, and of the references' noise where it is not taken off."""
    found = []
    for reference in results.references:
        folder = "" if results.only_reference is not None else f" ({reference.get('folder')})"
        named = [(f"a {name} image", [results.baseline(name, c.key, reference) for c in columns]) for name in BASELINES]
        named.append(("the reference's own noise", [results.noise(c.key, reference) for c in columns]))
        found += [[Cell(""), Cell(name + folder, "name"), *(Cell(_score(value, c.metric) if c.metric else "", c.css)
                                                           for value, c in zip(values, columns))]
                  for name, values in named if any(map(math.isfinite, values))]
    return found
