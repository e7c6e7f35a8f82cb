#!/usr/bin/python3
"""Prints the tables of docs/filtering.md from results of configs/bench/denoisers.yaml.

denoisers_table.py DIR...: nRMSE / relMSE of indirect light by scene, source and estimator, means over compared frames; then the
geometric mean of nRMSE over scenes, of each source by regression over that of independent paths of as many samples by the mean; then
errors by regression over those of Open Image Denoise (configs/bench/denoisers_oidn.csv).
"""
import csv
import math
import os
import sys

sys.dont_write_bytecode = True
ROOT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..")
sys.path.append(os.path.join(ROOT, "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

SAMPLES = ("1", "4", "16")
KINDS = ("paths", "stratified paths", "rays")
MEASURES = ("nrmse", "relmse")


def mean(values):
    return sum(values) / len(values)


def errors_of(folders):
    """{(scene, source, estimator): (nRMSE, relMSE)}"""
    found = {}
    for folder in folders:
        frames = {}
        if os.path.exists(os.path.join(folder, "frames.csv")):
            for row in read_rows(folder, "frames.csv"):
                frames.setdefault(row["variant"], []).append(row)
        for row in read_rows(folder, "results.csv"):
            if row["status"] == "ok":
                own = frames.get(row["variant"], [row])
                found[row["scene"], row["source"], row["filter_irradiance.estimator"]] = tuple(
                    mean([float(frame["indirect_" + measure]) for frame in own]) for measure in MEASURES)
    return found


def table(found, scenes):
    kinds = [kind for kind in KINDS if any(source.startswith(kind) for _, source, _ in found)]
    rows = []
    for scene in scenes:
        for estimator in ("mean", "regression"):
            cells = [found.get((scene, f"{kind}, {samples}", estimator)) for kind in kinds for samples in SAMPLES]
            rows.append([f"`{scene}`, {estimator}", *("-" if cell is None else f"{cell[0]:.3f} / {cell[1]:.4f}" for cell in cells)])
    return markdown_table(["scene, estimator", *(f"{kind}, {samples}" for kind in kinds for samples in SAMPLES)], rows)


def gains(found, scenes):
    """Geometric means over scenes of nRMSE over that of the same number of independent paths, by the mean."""
    for kind in KINDS[:2]:
        for samples in SAMPLES:
            for estimator in ("mean", "regression"):
                pairs = [(found.get((scene, f"{kind}, {samples}", estimator)), found.get((scene, f"paths, {samples}", "mean"))) for scene in scenes]
                logs = [math.log(new[0] / old[0]) for new, old in pairs if new and old]
                if logs:
                    yield f"{kind}, {samples}, {estimator}: nRMSE {math.exp(mean(logs)):.3f} of that of paths, {samples}, mean ({len(logs)} scenes)"


def against_oidn(found):
    with open(os.path.join(ROOT, "configs", "bench", "denoisers_oidn.csv"), encoding="utf-8") as file:
        for row in csv.DictReader(file):
            for kind in ("", "stratified "):
                own = found.get((row["scene"], kind + row["source"], "regression"))
                if own:
                    ratios = ", ".join(f"{measure} {value / float(row[measure]):.2f}" for measure, value in zip(MEASURES, own))
                    yield f"{row['scene']}, {kind}{row['source']}, over Open Image Denoise: {ratios}"


def main():
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    found = errors_of(sys.argv[1:])
    scenes = list(dict.fromkeys(scene for scene, _, _ in found))
    print("\n".join([*table(found, scenes), "", *gains(found, scenes), "", *against_oidn(found)]))


if __name__ == "__main__":
    main()
