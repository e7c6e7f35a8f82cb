"""Holds the runs of `voxray stability` against their limits: make_stability.py RESULTS_DIR LIMITS.csv."""

from __future__ import annotations

import argparse
import csv
import io
import json
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))

from report import stability, stability_page  # noqa: E402
from report.files import write_whole  # noqa: E402
from report.load import ReportError  # noqa: E402


def main(arguments: list[str]) -> int:
    """Exit status: 0 done, 1 a file could not be written, 2 no results or limits to read."""
    parser = argparse.ArgumentParser(description="Makes stability.html, stability.md and stability.csv from the runs of a matrix.")
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR", help="holds a results folder for each profile")
    parser.add_argument("limits", type=Path, metavar="LIMITS.csv",
                        help="what is measured in each scene and its limit; known reasons stand next to it, in LIMITS_reasons.csv")
    parser.add_argument("--remedies", action="store_true", help="say what the runs in RESULTS_DIR/remedies change")
    options = parser.parse_args(arguments)
    try:
        reasons = stability.read_reasons(options.limits.with_name(options.limits.stem + "_reasons.csv"))
        rows = stability.read_limits(options.limits)
        cells = stability.cells_of(options.results, rows, reasons)
        if options.remedies:
            cells = stability.with_remedies(cells, options.results, rows)
        page = stability_page.render(cells, options.results)
    except ReportError as error:
        print(f"stability: {error}", file=sys.stderr)
        return 2
    lines = io.StringIO()
    csv.writer(lines, lineterminator="\n").writerows(stability_page.csv_lines(cells))
    try:
        write_whole(options.results / "stability.html", page)
        write_whole(options.results / "stability.csv", lines.getvalue())
        write_whole(options.results / "stability.md", "\n".join(stability_page.markdown(cells)) + "\n")
        write_whole(options.results / "failing.json", json.dumps(stability.failing_of(cells), indent=1) + "\n")
    except OSError as error:
        print(f"stability: {options.results}: cannot write: {error.strerror or error}", file=sys.stderr)
        return 1
    print(stability_page.summary(cells))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
