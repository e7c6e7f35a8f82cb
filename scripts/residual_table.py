#!/usr/bin/python3
"""Prints the tables of docs/residual-rays.md from results of configs/bench/residual_rays.yaml.

residual_table.py DIR: for each scene and variant the time of a frame's indirect light (G-buffer, rays, paths, filters; not what
stores light, which all variants but paths share), its nRMSE / relMSE and mean ratio, and its time over that in which filtered paths,
and gather rays without a residual, have no more error: below 1 where it is faster; - where the others have no variant with as
little error, > where their fastest already has.
residual_table.py DIR... --means: of the profiles `means` and `samples`: for each scene and variant the ratio of its indirect
light's mean to the reference's, over seeds, each with a reference of its own, with its standard error.
"""
import math
import os
import sys

import numpy

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402
from rivals_table import ERRORS, frame_time, front, speed_up, variants  # noqa: E402


def means(*folders):
    """Headings, and rows of cells."""
    scenes, methods = {}, []
    for row in (row for folder in folders for row in read_rows(folder, "results.csv")):
        if row["status"] == "ok":
            method = row.get("gbuffer") or row["indirect"]
            scenes.setdefault(row["scene"], {}).setdefault(method, []).append(row)
            if method not in methods:
                methods.append(method)
    lines = []
    for scene, found in scenes.items():
        lines.append([f"`{scene}`", *(ratio(found.get(method, [])) for method in methods)])
    return ["scene", *methods], lines


def ratio(rows):
    values = numpy.array([float(row["indirect_mean_ratio"]) for row in rows])
    if len(values) < 2:
        return "-"
    return f"{values.mean():.4f} ± {values.std(ddof=1) / math.sqrt(len(values)):.4f}"


def times(folder):
    """Headings, and rows of cells."""
    lines = []
    for scene, found in variants(folder).items():
        timed = [(frame_time(passes), row) for passes, row in found]
        fronts = {start: {name: front([(ms, float(row[name])) for ms, row in timed if is_plain(row, start)]) for name in ERRORS}
                  for start in ("filtered paths, ", "rays, ")}
        for ms, row in timed:
            errors = {name: float(row[name]) for name in ERRORS}
            lines.append([f"`{scene}`", row["indirect"], f"{ms:.0f}", " / ".join(f"{error:.3f}" for error in errors.values()),
                          f"{float(row['indirect_mean_ratio']):.3f}",
                          *(" / ".join(speed_up(ms, error, rivals[name]) for name, error in errors.items()) for rivals in fronts.values())])
    return ["scene", "method", "ms", "nRMSE / relMSE", "mean ratio", "time over paths'", "time over rays'"], lines


def is_plain(row, start):
    return row["indirect"].startswith(start) and "residual" not in row["indirect"]


def main():
    folders = [argument for argument in sys.argv[1:] if argument != "--means"]
    has_means = "--means" in sys.argv
    if not folders or (len(folders) > 1 and not has_means):
        raise SystemExit(__doc__)
    print("\n".join(markdown_table(*(means if has_means else times)(*folders))))


if __name__ == "__main__":
    main()
