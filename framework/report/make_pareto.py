"""Compares the methods of many runs on one page: make_pareto.py --out FILE.html RESULTS_DIR..."""

from __future__ import annotations

import argparse
import csv
import io
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).resolve().parents[1]))

from report import pareto_page  # noqa: E402
from report.files import write_whole  # noqa: E402
from report.load import LIGHTS, ReportError, load  # noqa: E402


def main(arguments: list[str]) -> int:
    """Exit status: 0 done, 1 a file could not be written, 2 no results to read, or another metric."""
    parser = argparse.ArgumentParser(description="Charts all variants of many runs, scene by scene.")
    parser.add_argument("results", type=Path, nargs="+", metavar="RESULTS_DIR")
    parser.add_argument("--out", type=Path, required=True, help="the page; a table of the same name ends in .csv")
    parser.add_argument("--error", default="nrmse", help="a metric that is better where it is lower")
    parser.add_argument("--light", choices=sorted(LIGHTS), default="indirect")
    options = parser.parse_args(arguments)
    try:
        runs = [load(directory) for directory in options.results]
        usable = {metric.key: metric for metric in runs[0].metrics if metric.better == "low"}
        if options.error not in usable:
            raise ReportError(f"--error: '{options.error}' is none of {', '.join(usable)}")
        metric = usable[options.error]
        table = list(pareto_page.csv_lines(runs, metric, options.light))
        if len(table) < 2:
            raise ReportError(f"no variant has {metric.label} of the {options.light} light")
    except ReportError as error:
        print(f"pareto: {error}", file=sys.stderr)
        return 2
    lines = io.StringIO()
    csv.writer(lines, lineterminator="\n").writerows(table)
    try:
        write_whole(options.out, pareto_page.render(runs, metric, options.light))
        write_whole(options.out.with_suffix(".csv"), lines.getvalue())
    except OSError as error:
        print(f"pareto: {options.out}: cannot write: {error.strerror or error}", file=sys.stderr)
        return 1
    print(options.out)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
