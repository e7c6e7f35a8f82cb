#!/usr/bin/python3
"""Runs notebooks from nothing, and compares what they show with the outputs that they store.

run_notebooks.py [NOTEBOOK...] [--write]: those of notebooks/ where none is named. Exit status 1 where a cell fails, or where a
stored text output has other words, or a number that is off by more than TOLERANCE of it; pictures are not compared.
--write stores the outputs instead.
"""
import argparse
import re
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

ROOT = Path(__file__).resolve().parents[1]
TOLERANCE = 0.05  # relative; images depend a little on device and libraries
NUMBER = re.compile(r"-?\d+\.?\d*(?:e[-+]\d+)?")


def text_of(cell):
    """A code cell's text outputs: what it prints, and values as plain text."""
    outputs = cell.get("outputs", []) if cell.cell_type == "code" else []
    return "\n".join(output.get("text") or output.get("data", {}).get("text/plain", "") for output in outputs)


def is_stale(stored, shown):
    """Whether words differ, or a number by more than the tolerance."""
    if NUMBER.sub("#", stored).split() != NUMBER.sub("#", shown).split():
        return True
    pairs = zip(map(float, NUMBER.findall(stored)), map(float, NUMBER.findall(shown)))
    return any(abs(a - b) > TOLERANCE * max(abs(a), abs(b)) for a, b in pairs)


def run(path, writes):
    """@return what is wrong, a line each."""
    notebook = nbformat.read(path, as_version=4)
    stored = [text_of(cell) for cell in notebook.cells]
    try:
        NotebookClient(notebook, timeout=None, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}).execute()
    except CellExecutionError as error:
        return [f"{path}: {error}"]
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)  # times of the run
    if writes:
        nbformat.write(notebook, path)
        return []
    return [f"{path}, cell {number}: shows\n{text_of(cell)}\nand stores\n{before}"
            for number, (cell, before) in enumerate(zip(notebook.cells, stored), 1) if is_stale(before, text_of(cell))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("notebooks", nargs="*", type=Path, metavar="NOTEBOOK")
    parser.add_argument("--write", action="store_true", help="store the outputs")
    options = parser.parse_args()
    wrong = [line for path in options.notebooks or sorted((ROOT / "notebooks").glob("*.ipynb")) for line in run(path, options.write)]
    print("\n".join(wrong) or "notebooks show what they store")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
