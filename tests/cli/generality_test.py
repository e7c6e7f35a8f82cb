"""Scenes that nobody tuned for, small: no cell of scene × injection × gather is worse than generality.csv has it.

`generality_test.py record` (with the program in VOXRAY_PROGRAM, the repository in VOXRAY_SOURCE) writes that table again:
the scores of the config's own seed, and how far they may move when random numbers change. That is five times their
standard deviation over three seeds, its relative size pooled over the gathers of an injection.
"""
import csv
import math
import os
import statistics
import subprocess
import sys
import tempfile
import unittest

from support import PROGRAM, SOURCE, CommandTest

SCENES = ["window_room", "shell_room", "clutter", "cornell"]
TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "generality.csv")
COLUMNS = ["scene", "inject", "gather", "mean_ratio", "mean_ratio_noise", "error", "error_noise"]
NO_RATIO = 1e6  # Of an image over a black reference.
SEEDS, DEVIATIONS = (5, 6, 7), 5  # The config's own seed first.


def config(scene):
    return os.path.join(SOURCE, "configs", "generality", scene + ".yaml")


def scores(row):
    """(mean ratio, error) of a variant's indirect light: relMSE, or the leaking radiance where all should be black."""
    mean, error = float(row["indirect_mean_ratio"]), float(row["indirect_nrmse"])
    if error == 0 or mean == NO_RATIO:
        return None, error
    return mean, float(row["indirect_relmse"])


def read(*parts):
    with open(os.path.join(*parts), newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def cells(rows):
    return {(row["inject"], row["gather"]): scores(row) for row in rows}


class Generality(CommandTest):
    def test_no_cell_is_worse_than_recorded(self):
        recorded = read(TABLE)
        for scene in SCENES:
            self.expect(0, "run", config(scene), "--profile", "ci", "--quiet", "--no-report", "--out", scene,
                        "--set", "measure.build_repeats=0")
            found = cells(self.rows(scene, "results.csv"))
            expected = {(row["inject"], row["gather"]): row for row in recorded if row["scene"] == scene}
            self.assertEqual(set(found), set(expected), scene)
            for key, (mean, error) in found.items():
                row = expected[key]
                with self.subTest(scene=scene, inject=key[0], gather=key[1]):
                    if mean is not None:
                        self.assertLessEqual(abs(mean - 1),
                                             abs(float(row["mean_ratio"]) - 1) + float(row["mean_ratio_noise"]))
                    self.assertLessEqual(error, float(row["error"]) + float(row["error_noise"]))


def noise(samples):
    """Standard deviation of a score over seeds in units of its mean, pooled over lists of samples, times DEVIATIONS."""
    ratios = [statistics.stdev(values) / statistics.mean(values) for values in samples if statistics.mean(values) > 0]
    return DEVIATIONS * math.sqrt(statistics.mean(ratio * ratio for ratio in ratios)) if ratios else 0


def record():
    with open(TABLE, "w", newline="", encoding="utf-8") as file, tempfile.TemporaryDirectory() as folder:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        for scene in SCENES:
            runs = []
            for seed in SEEDS:
                out = os.path.join(folder, scene + str(seed))
                subprocess.run([PROGRAM, "run", config(scene), "--profile", "ci", "--quiet", "--out", out, "--set",
                                f"seed={seed}"], check=True, cwd=folder)
                runs.append(cells(read(out, "results.csv")))
            for (inject, gather), (mean, error) in runs[0].items():
                alike = [[run[key] for run in runs] for key in runs[0] if key[0] == inject]
                row = {"scene": scene, "inject": inject, "gather": gather, "error": f"{error:.4g}"}
                row["error_noise"] = f"{error * noise([[e for _, e in cell] for cell in alike]):.2g}"
                if mean is not None:
                    row["mean_ratio"] = f"{mean:.4f}"
                    row["mean_ratio_noise"] = f"{mean * noise([[m for m, _ in cell] for cell in alike]):.2g}"
                table.writerow(row)


if __name__ == "__main__" and sys.argv[1:] == ["record"]:
    record()
