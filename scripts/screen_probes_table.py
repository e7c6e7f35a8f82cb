#!/usr/bin/python3
"""Prints the table of docs/screen-probes.md from results of configs/bench/screen_probes.yaml.

screen_probes_table.py DIR: for each scene and method the mean ratio of indirect light, its nRMSE / relMSE, and gather rays a pixel.
"""
import json
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

METHODS = ("rays, 1 a pixel", "rays, 4 a pixel", "probes", "probes, cache", "probes, 4 x 4", "probes, high")
GATHERS = {"indirect", "trace_gather_rays", "gather_rays"}  # Where probes or the filter are 'indirect'.
CELL = "{indirect_mean_ratio:.3f}, {indirect_nrmse:.3f} / {indirect_relmse:.3f}, {rays_per_pixel:.1f}"


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    with open(os.path.join(sys.argv[1], "manifest.json"), encoding="utf-8") as file:
        image = json.load(file)["image"]
    rays = {}
    for row in read_rows(sys.argv[1], "passes.csv"):
        if row["pass"] in GATHERS and row["phase"] == "frame":
            rays[row["variant"]] = rays.get(row["variant"], 0) + int(row["rays"])
    cells, scenes = {}, []
    for row in read_rows(sys.argv[1], "results.csv"):
        if row["status"] != "ok":
            continue
        if row["scene"] not in scenes:
            scenes.append(row["scene"])
        errors = {key: float(row[key]) for key in ("indirect_mean_ratio", "indirect_nrmse", "indirect_relmse")}
        cells[row["scene"], row["indirect"]] = CELL.format(rays_per_pixel=rays[row["variant"]] / (image["width"] * image["height"]), **errors)
    print("\n".join(markdown_table(["", *METHODS], [[s, *(cells.get((s, m), "-") for m in METHODS)] for s in scenes])))


if __name__ == "__main__":
    main()
