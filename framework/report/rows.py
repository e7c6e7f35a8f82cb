"""Tables of results as text: CSV to read, Markdown to write. Needs no library, unlike load.py."""

from __future__ import annotations

import csv
import os
from collections.abc import Iterable, Iterator


def read_rows(*parts: str | os.PathLike[str]) -> list[dict[str, str]]:
    """The rows of a CSV file, the parts of whose path these are."""
    with open(os.path.join(*parts), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def markdown_table(headings: Iterable[str], rows: Iterable[Iterable[str]]) -> Iterator[str]:
    """The lines of a table."""
    headings = list(headings)
    for cells in (headings, ["---"] * len(headings), *rows):
        yield f"| {' | '.join(cells)} |"
