#!/usr/bin/python3
"""Prints the tables of docs/probes.md from results of configs/bench/probes.yaml.

probes_table.py DIR: for each scene and method the mean ratio of indirect light and its nRMSE / relMSE; then, for each method, the
memory of all its passes (MB, largest and smallest of the scenes) and rays (millions).
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

ERRORS = "{indirect_mean_ratio:.3f}, {indirect_nrmse:.3f} / {indirect_relmse:.3f}"


def span(values, form):
    low, high = (form.format(value) for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    rows = [row for row in read_rows(sys.argv[1], "results.csv") if row["status"] == "ok"]
    scenes, methods = (list(dict.fromkeys(row[axis] for row in rows)) for axis in ("scene", "indirect"))
    cells = {(row["scene"], row["indirect"]): ERRORS.format(
        **{key: float(row[key]) for key in ("indirect_mean_ratio", "indirect_nrmse", "indirect_relmse")}) for row in rows}
    print("\n".join(markdown_table(["", *methods], [[s, *(cells.get((s, m), "-") for m in methods)] for s in scenes])))
    print()
    costs = []
    for method in methods:
        own = [row for row in rows if row["indirect"] == method]
        costs.append([method, span([float(r["memory_bytes"]) / 1e6 for r in own], "{:.0f}"),
                      span([float(r["rays"]) / 1e6 for r in own], "{:.1f}")])
    print("\n".join(markdown_table(["", "memory, MB", "rays, millions"], costs)))


if __name__ == "__main__":
    main()
