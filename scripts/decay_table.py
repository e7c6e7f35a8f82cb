#!/usr/bin/python3
"""Prints a table of docs/probes.md from results of configs/stability/probes.yaml --profile decay.

decay_table.py DIR: in how many frames after a light went out a half, a fifth and a tenth of its indirect light are left, by the mean
ratio to each frame's reference.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

PARTS = {"a half": 0.5, "a fifth": 0.2, "a tenth": 0.1}


def frames_until(excess, part):
    """`excess` of the light over its reference from the first frame without the light on."""
    return next((str(i) for i, value in enumerate(excess) if value < part * excess[0]), f"over {len(excess)}")


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    ratios = {}
    for row in read_rows(sys.argv[1], "frames.csv"):
        ratios.setdefault(row["variant"], []).append(float(row["indirect_mean_ratio"]))
    rows = []
    for row in read_rows(sys.argv[1], "results.csv"):
        own = ratios[row["variant"]]
        off = max(range(1, len(own)), key=lambda i: own[i] - own[i - 1])
        excess = [ratio - 1 for ratio in own[off:]]
        rows.append([row["probes"], *(frames_until(excess, part) for part in PARTS.values())])
    print("\n".join(markdown_table(["probes", *PARTS], rows)))


if __name__ == "__main__":
    main()
