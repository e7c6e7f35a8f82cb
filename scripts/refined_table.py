#!/usr/bin/python3
"""Prints the table of docs/refined-voxels.md from results of configs/bench/refined_voxels.yaml.

refined_table.py DIR...: folders of runs, each of some scenes and variants. For each scene and variant: the bytes of
voxels and their light that are left after the build (voxelize, refine_voxels, injection, gather), errors of indirect light
against the variant "512" of the same scene (nRMSE, relMSE and ratio of the means), and against the path-traced reference.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "framework"))
import numpy  # noqa: E402
from report import exr_pixels  # noqa: E402
from report.rows import markdown_table, read_rows  # noqa: E402

FINEST = "512"
STORED = {"voxelize", "refine_voxels", "light", "gather"}
RELMSE_OFFSET = 0.01  # metrics.h: of the squared mean of the reference.


def pixels(folder, variant):
    channels = exr_pixels.read(os.path.join(folder, "images", variant, "indirect.exr"))
    return numpy.stack([channels[name] for name in "RGB"]).astype(float)


def errors(image, finest):
    """nRMSE, relMSE and ratio of means of an image."""
    squared, mean = (image - finest) ** 2, finest.mean()
    relative = squared / (finest ** 2 + RELMSE_OFFSET * mean ** 2)
    return numpy.sqrt(squared.mean()) / mean, relative.mean(), image.mean() / mean


def variants(folders):
    """By scene and variant of light: its folder, its row of results, and those of its passes."""
    found = {}
    for folder in folders:
        passes = read_rows(folder, "passes.csv")
        for row in read_rows(folder, "results.csv"):
            if row["status"] == "ok":
                mine = [p for p in passes if p["variant"] == row["variant"]]
                found.setdefault(row["scene"], {})[row["light"]] = folder, row, mine
    return found


def table(folders):
    rows = []
    for scene, lights in variants(folders).items():
        if FINEST not in lights:
            continue
        folder, row, _ = lights[FINEST]
        finest = pixels(folder, row["variant"])
        for light, (folder, row, passes) in lights.items():
            stored = sum(int(p["memory_bytes"]) for p in passes if p["pass"] in STORED)
            nrmse, relmse, ratio = errors(pixels(folder, row["variant"]), finest)
            model = "-" if light == FINEST else f"{nrmse:.3f} / {relmse:.4f} / {ratio:.3f}"
            rows.append([scene, light, f"{stored / 2 ** 20:.1f}", model,
                         f"{float(row['indirect_nrmse']):.3f} / {float(row['indirect_relmse']):.4f}"])
    return markdown_table(["scene", "voxels", "MiB", "to 512³: nRMSE / relMSE / mean", "to the reference"], rows)


if __name__ == "__main__":
    print("\n".join(table(sys.argv[1:])))
