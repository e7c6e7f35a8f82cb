#!/usr/bin/python3
"""Prints the tables of docs/cone-tracing.md from results of configs/bench/cone_bias.yaml.

cone_table.py DIR...: for each scene and kind of cones the mean ratio / relMSE / nRMSE of the indirect light, means over seeds, the
first with its standard error, and the median time of gather_cones and of a filter of its residual, ms.
cone_table.py DIR... --levels: of the profile `levels`: for each scene and width of cones the light that cones take, by where along
the exact ray, over that of the rays; with `--by-level` by level of the voxels instead, that of rays read in voxels of that level
beside that taken by cones.
"""
import math
import os
import statistics
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

PARTS = {
    "near hits": "rays, hits within 2 voxels",
    "as wide as the cone": "rays, read as wide as the cone",
    "cones": "cones",
    "start": "cones, within 2 voxels of the start",
    "before": "cones, before the ray's hit",
    "at": "cones, at the ray's hit",
    "behind": "cones, behind the ray's hit",
    "no hit": "cones, where the ray hits nothing",
    "opacity before": "opacity before the ray's hit",
    "lacking behind": "opacity lacking behind it",
}
LEVELS = range(8)
TIMED = ("cones", "gather_cones")  # A list of passes: its last one, the filter, has the list's id.
ERRORS = ("indirect_mean_ratio", "indirect_relmse", "indirect_nrmse")


def scored(folders):
    """Headings, and rows of cells: a scene a row, a kind of cones a column."""
    found, kinds = {}, []
    for folder in folders:
        times = {}
        for row in read_rows(folder, "passes.csv"):
            if row["pass"] in TIMED:
                times[row["variant"]] = times.get(row["variant"], 0) + float(row["ms_median"])
        for row in read_rows(folder, "results.csv"):
            if row["cones"] not in kinds:
                kinds.append(row["cones"])
            seeds = found.setdefault(row["scene"], {}).setdefault(row["cones"], [])
            if row["status"] == "ok":
                seeds.append([float(row[name]) for name in ERRORS] + [times[row["variant"]]])
    lines = [[f"`{scene}`", *(cell(cells.get(kind, [])) for kind in kinds)] for scene, cells in found.items()]
    return ["scene", *kinds], lines


def cell(seeds):
    """Means over seeds, and the standard error of the mean ratio."""
    if len(seeds) < 2:
        return "-"
    ratios, relmses, nrmses, times = zip(*seeds)
    error = statistics.stdev(ratios) / math.sqrt(len(seeds))
    return (f"{statistics.mean(ratios):.3f} ± {error:.3f} / {statistics.mean(relmses):.2g} / {statistics.mean(nrmses):.2g}, "
            f"{statistics.median(times):.0f} ms")


def compared(folders):
    """Scene, width and the values of each variant of compare_cones."""
    for folder in folders:
        values = {}
        for row in read_rows(folder, "values.csv"):
            if row["pass"] == "cones":
                values.setdefault(row["variant"], {})[row["name"]] = float(row["value"])
        for row in read_rows(folder, "results.csv"):
            if row["status"] == "ok":
                yield row["scene"], row["cones"], values[row["variant"]]


def parts(folders):
    rows = [[f"`{scene}`", width, *(f"{found[name]:.3f}" for name in PARTS.values())] for scene, width, found in compared(folders)]
    return ["scene", "width", *PARTS], rows


def levels(folders):
    rows = [[f"`{scene}`", width, *(f"{found[f'rays, read in level {k}']:.2f} / {found[f'cones, taken in level {k}']:.2f}" for k in LEVELS)]
            for scene, width, found in compared(folders)]
    return ["scene", "width", *map(str, LEVELS)], rows


def main():
    folders = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    options = set(sys.argv[1:]) - set(folders)
    if not folders or options - {"--levels", "--by-level"}:
        sys.exit(__doc__)
    table = levels if "--by-level" in options else parts if "--levels" in options else scored
    print("\n".join(markdown_table(*table(folders))))


if __name__ == "__main__":
    main()
