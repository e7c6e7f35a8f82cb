#!/usr/bin/python3
"""Prints the table of docs/reservoirs.md from results of configs/bench/reservoirs.yaml.

reservoirs_table.py DIR: for each scene the mean of resampled rays' indirect light over the reference's, and the mean squared
error of one path, and of one gather ray, a pixel over that of one resampled gather ray; - where a variant is missing.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

RIVALS = ("path", "ray")


def table(folder):
    """Headings, and rows of cells."""
    scenes, methods = {}, []
    for row in read_rows(folder, "results.csv"):
        if row["status"] != "ok":
            continue
        scenes.setdefault(row["scene"], {})[row["indirect"]] = row
        if row["indirect"] not in (*RIVALS, *methods):
            methods.append(row["indirect"])
    headings = ["scene", *(f"{method}: {what}" for method in methods for what in ("mean ratio", *(f"over one {r}" for r in RIVALS)))]
    return headings, [[f"`{scene}`", *(cell for method in methods for cell in cells(rows, method))] for scene, rows in scenes.items()]


def cells(rows, method):
    """Mean ratio of a method, and squared errors of its rivals over its own."""
    own = rows.get(method)
    yield f"{float(own['indirect_mean_ratio']):.3f}" if own else "-"
    for rival in RIVALS:
        has_both = own and rival in rows
        yield f"{(float(rows[rival]['indirect_nrmse']) / float(own['indirect_nrmse'])) ** 2:.2g}" if has_both else "-"


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    print("\n".join(markdown_table(*table(sys.argv[1]))))


if __name__ == "__main__":
    main()
