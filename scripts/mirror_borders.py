#!/usr/bin/python3
"""Steps that a mirror shows where rays that end on triangles border on rays that end on cells of hybrid leaves' grids.

mirror_borders.py RUN [--truth VARIANT]

RUN: a folder that `voxray run CONFIG --aovs` wrote. VARIANT: the variant whose mirror rays go through triangles alone. A row for
each variant with cells. Pairs of neighboring pixels of the mirror are told apart by what three quarters or more of each pixel's
rays ended on: borders, triangles in one and cells in the other; triangles, in both; cells, in both. Of luminance, over the mean of
VARIANT's over the mirror:

  step      mean of cells less triangles over borders, less the same of VARIANT at the same pairs
  gradient  mean difference within a pair, without its sign, of what the variant shows less what VARIANT does: 0 where the kinds of
            leaves leave no trace
"""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "framework"))
import numpy
from report import exr_pixels
from report.images import LUMINANCE
from report.rows import markdown_table

SURE = 0.75  # Part of a pixel's rays.


def luminance(path):
    channels = exr_pixels.read(path)
    return sum(w * channels[c].astype(float) for w, c in zip(LUMINANCE, "RGB"))


def pairs(image):
    """The two pixels of each pair: along rows, then along columns."""
    return (numpy.concatenate([image[:, :-1].ravel(), image[:-1].ravel()]),
            numpy.concatenate([image[:, 1:].ravel(), image[1:].ravel()]))


def measure(image, truth, ends):
    """Step and gradients of an image, and how many borders there are."""
    triangles, cells = ends["ends.triangles"], ends["ends.cells"]
    is_mirror = sum(ends[f"ends.{kind}"] for kind in ("triangles", "cells", "cones", "nowhere")) > 0
    off = (image - truth) / truth[is_mirror].mean()
    (t0, t1), (c0, c1), (a, b) = pairs(triangles >= SURE), pairs(cells >= SURE), pairs(off)
    forth, back = t0 & c1, c0 & t1
    between = {"borders": forth | back, "triangles": t0 & t1, "cells": c0 & c1}
    found = {name: float(numpy.abs(a - b)[where].mean()) if where.any() else float("nan") for name, where in between.items()}
    step = numpy.concatenate([(b - a)[forth], (a - b)[back]])
    found["step"] = float(step.mean()) if len(step) else float("nan")
    return found, int(between["borders"].sum())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", metavar="RUN")
    parser.add_argument("--truth", default="triangles", metavar="VARIANT")
    options = parser.parse_args()
    images = os.path.join(options.run, "images")
    truth = luminance(os.path.join(images, options.truth, "final.exr"))
    rows = []
    for variant in sorted(os.listdir(images)):
        path = os.path.join(images, variant, "aovs.mirror.exr")
        if variant == options.truth or not os.path.exists(path):
            continue
        ends = exr_pixels.read(path)
        if not ends["ends.cells"].any():
            continue
        found, count = measure(luminance(os.path.join(images, variant, "final.exr")), truth, ends)
        rows.append([variant, str(count), *(f"{found[k]:.4f}" for k in ("step", "borders", "triangles", "cells"))])
    print("\n".join(markdown_table(["variant", "borders", "step", "gradient: borders", "triangles", "cells"], rows)))


if __name__ == "__main__":
    main()
