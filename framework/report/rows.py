"""Tables of results as text, without what the report needs to read them (load.py)."""

from __future__ import annotations

import csv
import os


def read_rows(*parts: str | os.PathLike[str]) -> list[dict[str, str]]:
    """The rows of a CSV file, the parts of whose path these are."""
    with open(os.path.join(*parts), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))
