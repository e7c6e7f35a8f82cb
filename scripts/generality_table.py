#!/usr/bin/python3
"""Prints the table of docs/generality.md from results of configs/generality.

generality_table.py RESULTS...: folders that `./voxray run configs/generality/SCENE.yaml` wrote. A cell is the mean
ratio, relMSE and nRMSE of the indirect light; where the reference is black, the root mean square of the leaking
radiance, W/(m² sr), alone. Then comes how much light leaks into shell_room, and last what a black image and a constant
image of the right mean score in each scene.
"""
import json
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "framework"))
from report import exr_pixels  # noqa: E402
from report.rows import markdown_table, read_rows  # noqa: E402

VOXELS = "voxelize.resolution"
COLUMNS = ("indirect_mean_ratio", "indirect_relmse", "indirect_nrmse")
NO_RATIO = 1e6  # the mean ratio that an image has over a black reference
# What the floor outside of shell_room reflects of the sun alone, W/(m² sr): albedo / pi times irradiance times cosine.
SUNLIT_FLOOR = 0.75 / math.pi * 20 * 0.6 / math.hypot(0.5, 0.6, 1)
PLAIN = {"variant", "name", "status", "error", "device", "tracer", VOXELS, "inject", "gather"}


def is_black(row):
    """Whether all should be black."""
    return float(row["indirect_nrmse"]) == 0 or float(row["indirect_mean_ratio"]) == NO_RATIO


def cell(row):
    if row["status"] != "ok":
        return "failed"
    if is_black(row):
        return f"rms {float(row['indirect_nrmse']):.2g}"
    return " / ".join((f"{float(row['indirect_mean_ratio']):.3f}", f"{float(row['indirect_relmse']):.2g}",
                       f"{float(row['indirect_nrmse']):.2g}"))


def leak(folder, row):
    """Light inside over light outside, in percent: the mean indirect radiance of all pixels, which should be black, over
    SUNLIT_FLOOR."""
    channels = exr_pixels.read(os.path.join(folder, "images", row["variant"], "indirect.exr"))
    return 100 * sum(channels[name].mean(dtype=float) for name in "RGB") / 3 / SUNLIT_FLOOR


def swept(row):
    """What a config sweeps beyond voxels, injection and gather: columns before the timings."""
    names = list(row)
    return ", ".join(f"{name.split('.')[-1]}: {row[name]}" for name in names[:names.index("build_ms")]
                     if name not in PLAIN)


def name_of(folder):
    return os.path.basename(os.path.normpath(folder)).replace("generality_", "")


def baselines(folder):
    """A row for each reference: what images score that know nothing of the scene but, at best, its mean."""
    with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
        references = json.load(file)["references"]
    variants = {row["variant"]: swept(row) for row in read_rows(folder, "results.csv")}
    for reference in references:
        scores = reference["baselines"]
        if scores["black"]["indirect_nrmse"] == 0:
            continue
        which = next(filter(None, (variants.get(name) for name in reference["variants"])), "")
        texts = (" / ".join(f"{float(f'{s[name]:.2g}'):g}" for name in COLUMNS) for s in (scores["black"], scores["constant"]))
        yield f"`{name_of(folder)}`{', ' + which if which else ''}", *texts


def table(rows, text):
    """A line an injection, named by the last pass of its chain, and a column a gather and resolution; `text` of each row."""
    cells = {(swept(row), row["inject"], row["gather"], int(row[VOXELS])): text(row) for row in rows}
    lines = dict.fromkeys((key[0], key[1]) for key in cells)
    columns = sorted({(key[2], key[3]) for key in cells}, key=lambda column: (column[0] != "gather_rays", column))
    return markdown_table(["injection", *(f"`{gather}`, {voxels}³" for gather, voxels in columns)],
                          ((f"{inject}{', ' + variant if variant else ''}",
                            *(cells.get((variant, inject, *column), "") for column in columns)) for variant, inject in lines))


if __name__ == "__main__":
    for results in sys.argv[1:]:
        print(f"\n### {name_of(results)}\n")
        print("\n".join(table(read_rows(results, "results.csv"), cell)))
        black = [row for row in read_rows(results, "results.csv") if row["status"] == "ok" and is_black(row)]
        if name_of(results) == "shell_room" and black:
            print("\nLight inside over light outside, %:\n")
            print("\n".join(table(black, lambda row, folder=results: f"{leak(folder, row):.2g}")))
    print("\n### A black and a constant image\n")
    print("\n".join(markdown_table(("scene", "black", "constant, of the right mean"),
                                   (row for results in sys.argv[1:] for row in baselines(results)))))
