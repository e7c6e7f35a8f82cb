"""What `voxray stability` leaves: a page with a heat map, Markdown for a terminal or a document, and lines of a CSV file."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from report import images, pages, stability, table, text
from report.results import ReportError
from report.rows import markdown_table
from report.stability import MEASURES, UNKNOWN, Cell, Row
from report.table import Table
from report.verdict import FAILS, HOLDS, NOISE, UNDECIDED

_MARKS = {HOLDS: "{}", FAILS: "**{}**", UNDECIDED: "{} ?", NOISE: "{} ~"}  # of values in a table of Markdown
_SCRIPTS = ("d3", "toolkit.js", "matrix.js", "stability.js")


class Tables(NamedTuple):
    """failing: scenes of cells that fail but run, by profile and method."""

    summary: str
    markdown: str
    failing: dict[str, dict[str, list[str]]]


def write(directory: Path, limits: Path, with_remedies: bool = False) -> Tables:
    """Makes stability.html, stability.csv, stability.md and failing.json of the runs in a folder, one folder a profile.

    @param limits what is measured in each scene and its limit; known reasons stand next to it, in LIMITS_reasons.csv
    @param with_remedies say what the runs in directory/remedies change
    @throws ReportError where there are no results or limits"""
    rows = stability.read_limits(limits)
    cells = stability.cells_of(directory, rows, stability.read_reasons(limits.with_name(limits.stem + "_reasons.csv")))
    if not cells:
        raise ReportError(f"{directory}: no profile of the limits has results there")
    if with_remedies:
        cells = stability.with_remedies(cells, directory, rows)
    tables = Tables(summary(cells), "\n".join(markdown(cells)) + "\n", stability.failing_of(cells))
    for name, content in (("stability.html", render(cells, directory)), ("stability.csv", pages.csv_text(csv_lines(cells))),
                          ("stability.md", tables.markdown), ("failing.json", json.dumps(tables.failing, indent=1) + "\n")):
        pages.write_whole(directory / name, content)
    return tables


def percent(value: float) -> str:
    """To two digits, without its sign; "does not run" for NaN."""
    return "does not run" if math.isnan(value) else text.figures(100 * value, 2)


def reason(cell: Cell) -> str:
    """Why a cell fails, as far as it is known: the reason of the table, and what finer settings change."""
    told = ", ".join(f"{percent(value)} % with {name}" for name, value in cell.helping or cell.remedies)
    if cell.helping:
        return told if cell.reason == UNKNOWN else f"{cell.reason}; {told}"
    return f"{cell.reason}; no remedy lowers it by a tenth: {told}" if told else cell.reason


def limits(row: Row) -> str:
    (_, everyone), *others = row.limits
    return percent(everyone) + "".join(f"; {percent(limit)} for {beginning}" for beginning, limit in others)


def methods_of(cells: list[Cell]) -> list[str]:
    return list(dict.fromkeys(cell.method for cell in cells))


def rows_of(cells: list[Cell]) -> Iterator[tuple[Row, list[Cell | None]]]:
    """Each row with its cells in the order of methods_of(), None where a method did not run there."""
    found = {(cell.row, cell.method): cell for cell in cells}
    for row in dict.fromkeys(cell.row for cell in cells):
        yield row, [found.get((row, method)) for method in methods_of(cells)]


def summary(cells: list[Cell]) -> str:
    """How many cells there are, how many of each verdict, and how many are empty."""
    count = {name: sum(cell.verdict == name for cell in cells) for name in (FAILS, UNDECIDED, NOISE)}
    empty = sum(cell is None for _, row in rows_of(cells) for cell in row)
    told = [(count[UNDECIDED], "undecided"), (count[NOISE], "with too much noise to tell"), (empty, "empty")]
    said = f"{count[FAILS]} of {len(cells)} cells fail" + "".join(f"; {number} {what}" for number, what in told if number)
    if not any(cell.remedies for cell in cells):
        return said
    helped = [cell for cell in cells if cell.helping]
    met = sum(cell.helping[0][1] <= cell.limit for cell in helped)
    return f"{said}; a remedy lowers {len(helped)} of these, {met} of them below their limit"


def markdown(cells: list[Cell]) -> Iterator[str]:
    def value(cell: Cell | None) -> str:
        return "" if cell is None else _MARKS[cell.verdict].format(percent(cell.value))

    return markdown_table(["scene", "measure", "limit, %", *methods_of(cells)],
                          ([row.scene, row.measure, limits(row), *map(value, found)] for row, found in rows_of(cells)))


def csv_lines(cells: list[Cell]) -> Iterator[list]:
    yield ["profile", "scene", "measure", "method", "value", "low", "high", "limit", "verdict", "reason"]
    for cell in cells:
        row, estimate = cell.row, cell.estimate
        values = ["" if math.isnan(value) else f"{value:.6g}" for value in (estimate.value, estimate.low, estimate.high)]
        yield [row.profile, row.scene, row.measure, cell.method, *values, f"{cell.limit:g}", cell.verdict, reason(cell)]


def _table(cells: list[Cell]) -> Table:
    found = Table("All cells", ["scene", "measure", "method", "value, %", "limit, %", "verdict", "why", "why that limit"],
                  words=(0, 1, 2, 5, 6, 7), note="Of the indirect light. ▼: fails.")
    for cell in cells:
        value = table.number(100 * cell.value, percent(cell.value), mark="worse" if cell.fails else "")
        found.add(cell.row.scene, cell.row.measure, cell.method, value, percent(cell.limit), cell.verdict, reason(cell), cell.row.why)
    return found


def _by_method(cells: list[Cell]) -> Table:
    found = Table("Verdicts by method", ["method", HOLDS, FAILS, UNDECIDED, NOISE], words=(0,))
    for method in methods_of(cells):
        own = [cell.verdict for cell in cells if cell.method == method]
        found.add(method, *(table.number(own.count(verdict), str(own.count(verdict))) for verdict in (HOLDS, FAILS, UNDECIDED, NOISE)))
    return found


def _words(cell: Cell) -> str:
    value = percent(cell.value) if math.isnan(cell.value) else f"{percent(cell.value)} %, limit {percent(cell.limit)} %"
    why = reason(cell)
    return f"{cell.row.measure} {value}" + (f" ({why})" if why else "")


def _data(cells: list[Cell]) -> dict:
    """What the page's script shows: of each method and scene the measure with the worst verdict, and among those the one that is
    furthest above its limit, or nearest to it.

    @throws ReportError where an image is no PNG."""
    scenes = list(dict.fromkeys(cell.row.scene for cell in cells))
    groups: dict[tuple[str, str], list[Cell]] = {}
    order = [FAILS, UNDECIDED, NOISE, HOLDS]
    for cell in sorted(cells, key=lambda cell: (order.index(cell.verdict), -cell.over)):
        groups.setdefault((cell.method, cell.row.scene), []).append(cell)
    pictures: dict[Path, int] = {}

    def shown(method: str, scene: str) -> dict | None:
        found = groups.get((method, scene))
        if not found:
            return None
        worst = found[0]
        said = f"{method} in {scene}: {worst.verdict}: {'; '.join(map(_words, found))}."
        return {"over": worst.over, "verdict": worst.verdict, "words": said,
                "images": [pictures.setdefault(path, len(pictures)) if path else None for path in (worst.truth, worst.picture)]}

    rows = [{"name": method, "cells": [shown(method, scene) for scene in scenes]} for method in methods_of(cells)]
    rows.sort(key=lambda row: [sum(cell["verdict"] == name for cell in row["cells"] if cell) for name in (FAILS, UNDECIDED, NOISE)])
    return {"scenes": scenes, "rows": rows, "pictures": [images.embed(path).uri for path in pictures]}


def render(cells: list[Cell], directory: Path) -> str:
    """The whole page, self-contained. @throws ReportError where an image is no PNG."""
    present = {cell.row.kind for cell in cells}
    return pages.render("stability.html.j2", scripts=_SCRIPTS, data=_data(cells), summary=summary(cells), cells=_table(cells),
                        methods=_by_method(cells),
                        directory=str(directory), measures=[(name, meaning) for name, (_, meaning) in MEASURES.items() if name in present])
