"""The tables of `voxray stability`: a page, Markdown for a terminal or a document, and lines of a CSV file."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from report import images, pages, stability, text
from report.rows import markdown_table
from report.stability import MEASURES, UNKNOWN, Cell, Row


@dataclass(frozen=True)
class Tables:
    """failing: scenes of cells that fail but run, by profile and method."""

    summary: str
    markdown: str
    failing: dict[str, dict[str, list[str]]]


def write(directory: Path, limits: Path, with_remedies: bool = False) -> Tables:
    """Makes stability.html, stability.csv, stability.md and failing.json of the runs in a folder, one folder a profile.

    @param limits what is measured in each scene and its limit; known reasons stand next to it, in LIMITS_reasons.csv
    @param with_remedies say what the runs in directory/remedies change
    @throws ReportError where there are no results or limits"""
    reasons = stability.read_reasons(limits.with_name(limits.stem + "_reasons.csv"))
    rows = stability.read_limits(limits)
    cells = stability.cells_of(directory, rows, reasons)
    if with_remedies:
        cells = stability.with_remedies(cells, directory, rows)
    tables = Tables(summary(cells), "\n".join(markdown(cells)) + "\n", stability.failing_of(cells))
    pages.write_whole(directory / "stability.html", render(cells, directory))
    pages.write_whole(directory / "stability.csv", pages.csv_text(csv_lines(cells)))
    pages.write_whole(directory / "stability.md", tables.markdown)
    pages.write_whole(directory / "failing.json", json.dumps(tables.failing, indent=1) + "\n")
    return tables


def percent(value: float) -> str:
    """To two digits, without its sign; "does not run" for NaN."""
    return "does not run" if math.isnan(value) else text.figures(100 * value, 2)


def reason(cell: Cell) -> str:
    """Why a cell fails, as far as it is known: the reason of the table, and what finer settings change."""
    if not cell.remedies:
        return cell.reason
    told = [f"{percent(value)} % with {name}" for name, value in cell.helping]
    if not told:
        return f"{cell.reason}; no remedy lowers it by a tenth: " + ", ".join(f"{percent(value)} % with {name}" for name, value in cell.remedies)
    return ", ".join(told) if cell.reason == UNKNOWN else f"{cell.reason}; " + ", ".join(told)


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
    """How many cells there are, and how many fail or are empty."""
    failing = sum(cell.fails for cell in cells)
    empty = sum(cell is None for _, row in rows_of(cells) for cell in row)
    said = f"{failing} of {len(cells)} cells fail" + (f"; {empty} are empty" if empty else "")
    if not any(cell.remedies for cell in cells):
        return said
    helped = [cell for cell in cells if cell.helping]
    met = sum(cell.helping[0][1] <= cell.limit for cell in helped)
    return f"{said}; a remedy lowers {len(helped)} of these, {met} of them below their limit"


def markdown(cells: list[Cell]) -> Iterator[str]:
    def value(cell: Cell | None) -> str:
        return "" if cell is None else f"**{percent(cell.value)}**" if cell.fails else percent(cell.value)

    return markdown_table(["scene", "measure", "limit, %", *methods_of(cells)],
                          ([row.scene, row.measure, limits(row), *map(value, found)] for row, found in rows_of(cells)))


def csv_lines(cells: list[Cell]) -> Iterator[list]:
    yield ["profile", "scene", "measure", "method", "value", "limit", "fails", "reason"]
    for cell in cells:
        row = cell.row
        value = "" if math.isnan(cell.value) else f"{cell.value:.6g}"
        yield [row.profile, row.scene, row.measure, cell.method, value, f"{cell.limit:g}", int(cell.fails), reason(cell)]


def _table(cells: list[Cell]) -> list[tuple[Row, str, list[tuple[str, str, str]]]]:
    """The rows with their limits, and text, CSS class and title of each of their cells."""
    shown = []
    for row, found in rows_of(cells):
        entries = [("", "", "not run") if cell is None else
                   (percent(cell.value), "worse" if cell.fails else "", reason(cell) or row.why) for cell in found]
        shown.append((row, limits(row), entries))
    return shown


def render(cells: list[Cell], directory: Path) -> str:
    """The whole page, self-contained. @throws ReportError where an image is no PNG."""
    failing = [cell for cell in cells if cell.fails]
    tally = [(method, sum(cell.method == method for cell in failing), sum(cell.method == method for cell in cells))
             for method in methods_of(cells)]
    embedded = {path: images.embed(path) for cell in failing for path in (cell.picture, cell.truth) if path}
    return pages.render(
        "stability.html.j2", summary=summary(cells), tally=tally,
        methods=methods_of(cells), table=_table(cells), directory=str(directory),
        measures=[(name, meaning) for name, (_, meaning) in MEASURES.items() if any(cell.row.measure == name for cell in cells)],
        failing=[(cell, reason(cell), percent(cell.value), percent(cell.limit), embedded.get(cell.picture), embedded.get(cell.truth))
                 for cell in failing])
