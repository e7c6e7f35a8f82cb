#!/usr/bin/python3
"""Prints what gather rays take to reach the error of filtered path tracing, from results of configs/bench/rivals.yaml.

rivals_table.py DIR: for each scene and number of samples, frame times of path tracing (G-buffer, paths, filter) over those
of gather rays (G-buffer, rays, gather, filter), at equal nRMSE and at equal relMSE of indirect light. Between numbers of
rays the time is interpolated, logarithm over logarithm. `>` where the fewest rays already have less error, `-` where the
most have more. Direct light is in neither, nor is what is built before the first frame.
"""
import csv
import math
import os
import sys

LEFT_OUT = {"direct", "composite"}
ERRORS = ("indirect_nrmse", "indirect_relmse")


def read(*parts):
    with open(os.path.join(*parts), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def variants(folder):
    """By scene: (is path tracing, ms a frame, result row) of each variant, from fast to slow."""
    passes = {}
    for row in read(folder, "passes.csv"):
        passes.setdefault(row["variant"], []).append(row)
    scenes = {}
    for row in read(folder, "results.csv"):
        if row["status"] != "ok":
            continue
        mine = passes[row["variant"]]
        ms = sum(float(p["ms_median"]) for p in mine if p["phase"] == "frame" and p["pass"] not in LEFT_OUT)
        scenes.setdefault(row["scene"], []).append((any(p["pass"] == "paths" for p in mine), ms, row))
    return {scene: sorted(found, key=lambda variant: variant[1]) for scene, found in scenes.items()}


def time_to(error, name, gathers):
    """(mark, ms) that gather rays take to an error; ms is None where the most rays don't reach it."""
    points = [(ms, float(row[name])) for ms, row in gathers]
    if points[0][1] <= error:
        return ">", points[0][0]
    for (ms0, error0), (ms1, error1) in zip(points, points[1:]):
        if error1 <= error < error0:
            at = math.log(error0 / error) / math.log(error0 / error1)
            return "", ms0 * (ms1 / ms0) ** at
    return "-", None


def cells(error, name, ms, gathers):
    """The gathers' time, and the speed-up."""
    mark, own = time_to(error, name, gathers)
    return f"{mark}" if own is None else f"{own:.0f}", f"{mark}" if own is None else f"{mark}{ms / own:.1f}"


def table(folder):
    yield "| scene | path tracing | ms | nRMSE | gather rays, ms | speed-up | relMSE | gather rays, ms | speed-up |"
    yield "|" + " --- |" * 9
    for scene, found in variants(folder).items():
        gathers = [(ms, row) for is_paths, ms, row in found if not is_paths]
        for is_paths, ms, row in found:
            if not is_paths:
                continue
            values = [f"{float(row[name]):.3f} | " + " | ".join(cells(float(row[name]), name, ms, gathers))
                      for name in ERRORS]
            yield f"| {scene} | {row['indirect']} | {ms:.0f} | {' | '.join(values)} |"


if __name__ == "__main__":
    print("\n".join(table(sys.argv[1])))
