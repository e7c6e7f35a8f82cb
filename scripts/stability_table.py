#!/usr/bin/python3
"""Holds results of configs/stability/matrix.yaml against limits and prints where methods fail.

stability_table.py DIR [--limits FILE] [--csv FILE]: a row a scene, a column a method; a cell that is over its scene's limit is bold,
one that did not run says so. Measures, of the indirect light:
  nrmse   root mean squared error over the reference's mean
  energy  |mean ratio - 1|
  leak    root mean square of the light where all should be black, W/(m² sr)
--csv writes the cells as a table. Exit status: 0 the matrix is whole, whether cells fail or not; 1 a scene or method is missing.
"""
import argparse
import csv
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
MEASURES = {
    "nrmse": lambda row: float(row["indirect_nrmse"]),
    "energy": lambda row: abs(float(row["indirect_mean_ratio"]) - 1),
    "leak": lambda row: float(row["indirect_nrmse"]),  # Over a black reference errors are not divided by its mean.
}


def read(*parts):
    with open(os.path.join(*parts), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def cells(rows, limits):
    """(scene, method): the value, or None where it failed."""
    return {(row["scene"], row["gather"]): MEASURES[limits[row["scene"]]["measure"]](row) if row["status"] == "ok" else None
            for row in rows if row["scene"] in limits}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR")
    parser.add_argument("--limits", default=os.path.join(ROOT, "configs", "stability", "limits.csv"), metavar="FILE")
    parser.add_argument("--csv", metavar="FILE")
    options = parser.parse_args()
    limits = {row["scene"]: row for row in read(options.limits)}
    rows = read(options.folder, "results.csv")
    found, methods = cells(rows, limits), list(dict.fromkeys(row["gather"] for row in rows))
    print("| scene | at most | " + " | ".join(methods) + " |")
    print("| --- " * (2 + len(methods)) + "|")
    failing = 0
    for scene, limit in limits.items():
        texts = []
        for method in methods:
            value = found.get((scene, method))
            fails = value is None or not value <= float(limit["limit"])
            failing += fails
            text = "does not run" if value is None else f"{value:.2g}"
            texts.append(f"**{text}**" if fails else text)
        print(f"| {scene} | {limit['measure']} {limit['limit']} | " + " | ".join(texts) + " |")
    print(f"\n{failing} of {len(limits) * len(methods)} cells fail.")
    if options.csv:
        with open(options.csv, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["scene", "method", "value"])
            writer.writerows([scene, method, "" if value is None else f"{value:.4g}"] for (scene, method), value in found.items())
    missing = set(limits) - {row["scene"] for row in rows}
    if missing:
        print(f"stability_table: no results of {', '.join(sorted(missing))}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
