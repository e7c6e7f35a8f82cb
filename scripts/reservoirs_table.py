#!/usr/bin/python3
"""Prints the tables of docs/reservoirs.md from results of configs/bench/reservoirs.yaml and reservoirs_time.yaml.

reservoirs_table.py DIR: for each scene the mean of resampled rays' indirect light over the reference's, and the mean squared
error of one path, and of one gather ray, a pixel over that of one resampled gather ray; - where a variant is missing.
reservoirs_table.py DIR --time: for each scene and variant the time of a frame's indirect light (G-buffer, rays, filter), its
errors, and its time over that in which plain rays of one image have no more nRMSE / relMSE; - where none has as little, > where
their fastest already has.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402
from rivals_table import ERRORS, frame_time, front, speed_up, variants  # noqa: E402

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


def time_table(folder):
    """Headings, and rows of cells."""
    lines = []
    for scene, found in variants(folder).items():
        plain = [(passes, row) for passes, row in found if row["indirect"].startswith("rays, ")]
        fronts = {name: front([(frame_time(passes), float(row[name])) for passes, row in plain]) for name in ERRORS}
        for passes, row in found:
            ms, errors = frame_time(passes), {name: float(row[name]) for name in ERRORS}
            lines.append([f"`{scene}`", row["indirect"], f"{ms:.0f}", " / ".join(f"{error:.3f}" for error in errors.values()),
                          " / ".join(speed_up(ms, error, fronts[name]) for name, error in errors.items())])
    return ["scene", "method", "ms", "nRMSE / relMSE", "its time over that of plain rays"], lines


def main():
    if len(sys.argv) < 2 or sys.argv[2:] not in ([], ["--time"]):
        raise SystemExit(__doc__)
    print("\n".join(markdown_table(*(time_table if sys.argv[2:] else table)(sys.argv[1]))))


if __name__ == "__main__":
    main()
