#!/usr/bin/python3
"""Compares the path tracer on the device with the one on the host, from results of configs/bench/device_paths.yaml.

device_paths.py DIR: for each scene, of total and of indirect light: by how much the device's mean over pixels and seeds is
above the host's, %; and that difference over its standard error (z), from the differences of each seed's two images. Then
samples a second of the device over those of the host, from the median times of a frame.
"""
import math
import os
import sys

import numpy

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report import exr_pixels  # noqa: E402
from report.rows import markdown_table, read_rows  # noqa: E402

IMAGES = ("final", "indirect")


def compared(device, host):
    """Of means by seed: the device's excess over the host's mean, and z; no z for a single seed or without any difference."""
    differences = numpy.asarray(device) - numpy.asarray(host)
    spread = differences.std(ddof=1) if len(differences) > 1 else 0.0
    z = differences.mean() / (spread / math.sqrt(len(differences))) if spread > 0 else math.nan
    return differences.mean() / numpy.mean(host), z


def table(folder):
    scenes = {}
    for row in read_rows(folder, "results.csv"):
        if row["status"] == "ok":
            scenes.setdefault(row["scene"], {}).setdefault(row["seed"], {})[row["paths"]] = row
    rows = []
    for scene, by_seed in scenes.items():
        pairs = [pair for pair in by_seed.values() if len(pair) == 2]
        cells = []
        for image in IMAGES:
            device, host = ([_mean(folder, pair[side]["variant"], image) for pair in pairs] for side in ("device", "host"))
            excess, z = compared(device, host)
            cells += [f"{100 * excess:+.3f} %", "–" if math.isnan(z) else f"{z:+.1f}"]
        times = [float(pair["host"]["frame_ms_median"]) / float(pair["device"]["frame_ms_median"]) for pair in pairs]
        rows.append([scene, str(len(pairs)), *cells, f"{numpy.median(times):.2f}"])
    return markdown_table(["scene", "seeds", "total", "z", "indirect", "z", "samples/s, device over host"], rows)


def _mean(folder, variant, image):
    return exr_pixels.rgb(os.path.join(folder, "images", variant, f"{image}.exr")).mean(dtype=float)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print("\n".join(table(sys.argv[1])))
