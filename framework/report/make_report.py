"""Makes report.html from a run's result files: make_report.py RESULTS_DIR [--images front|all|ID...]."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))

from report import page  # noqa: E402
from report.load import load  # noqa: E402
from report.pages import write_whole  # noqa: E402
from report.results import ReportError  # noqa: E402


def main(arguments: list[str]) -> int:
    """Exit status: 0 done, 1 the page could not be written, 2 no results to read, or no such variant."""
    parser = argparse.ArgumentParser(description="Makes one self-contained report.html from a run's results.")
    parser.add_argument("results", type=Path, metavar="RESULTS_DIR", help="the folder that holds results.csv")
    parser.add_argument("--images", nargs="+", default=[], metavar="front|all|ID",
                        help="variants to show with images, passes and graph: those on a Pareto front, all, or numbers or names; "
                        "without it all where they fit into a page of 60 MB, else those of the fronts that do")
    options = parser.parse_args(arguments)
    directory = options.results
    try:
        source = page.render(load(directory), options.images)
    except ReportError as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    target = directory / "report.html"
    try:
        write_whole(target, source)
    except OSError as error:
        print(f"report: {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    print(target)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
