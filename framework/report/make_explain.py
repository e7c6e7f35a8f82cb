"""Says where a config's error comes from, by the results of a run of `voxray explain`: make_explain.py RESULTS_DIR."""

from __future__ import annotations

import argparse
import csv
import io
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))

from report import explain, explain_page  # noqa: E402
from report.load import ReportError, load  # noqa: E402
from report.files import write_whole  # noqa: E402


def main(arguments: list[str]) -> int:
    """Exit status: 0 done, 1 a file could not be written, 2 no results to explain."""
    parser = argparse.ArgumentParser(description="Makes explain.html and explain.csv from a run of voxray explain.")
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR")
    directory = parser.parse_args(arguments).results
    try:
        results = load(directory)
        stages, images = explain.read(results)
        explained = [explain.explain(stages, images, label) for label in explain.METRICS]
        page = explain_page.render(results, images, explained)
    except ReportError as error:
        print(f"explain: {error}", file=sys.stderr)
        return 2
    lines = io.StringIO()
    csv.writer(lines, lineterminator="\n").writerows(explain_page.csv_lines(explained))
    try:
        write_whole(directory / "explain.html", page)
        write_whole(directory / "explain.csv", lines.getvalue())
    except OSError as error:
        print(f"explain: {directory}: cannot write: {error.strerror or error}", file=sys.stderr)
        return 1
    print(explain.sentence(explained[0]))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
