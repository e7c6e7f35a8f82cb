"""A part of configs/stability/matrix.yaml, small: no cell is worse than stability.csv has it, and none is left out.

`stability_test.py record` (with the program in VOXRAY_PROGRAM, the repository in VOXRAY_SOURCE) writes that table again.
"""
import csv
import os
import subprocess
import sys
import tempfile
import unittest

from support import PROGRAM, SOURCE, CommandTest

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stability.csv")
CONFIG = os.path.join(SOURCE, "configs", "stability", "matrix.yaml")
SCRIPT = os.path.join(SOURCE, "scripts", "stability_table.py")
WORSE, MARGIN = 1.5, 0.01  # times what is recorded and this more: other processors round otherwise, and light rays race


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {(row["scene"], row["method"]): row["value"] for row in csv.DictReader(file)}


def arguments(out):
    return ["run", CONFIG, "--profile", "ci", "--tracer", "embree", "--quiet", "--no-report", "--out", out]


def table(out, path):
    return subprocess.run(["/usr/bin/python3", SCRIPT, out, "--csv", path], capture_output=True, text=True, check=False)


class Stability(CommandTest):
    def test_no_cell_is_worse_than_recorded(self):
        self.expect(0, *arguments("out"))
        done = table(self.path("out"), self.path("cells.csv"))
        self.assertEqual(done.returncode, 0, done.stderr)
        print(done.stdout)
        found, recorded = read(self.path("cells.csv")), read(TABLE)
        self.assertEqual(set(found), set(recorded))
        for cell, value in found.items():
            with self.subTest(cell=cell):
                self.assertLessEqual(float(value), float(recorded[cell]) * WORSE + MARGIN)


if __name__ == "__main__":
    if sys.argv[1:] == ["record"]:
        with tempfile.TemporaryDirectory(prefix="voxray-stability-") as folder:
            subprocess.run([PROGRAM, *arguments(folder)], check=True)
            print(table(folder, TABLE).stdout)
    else:
        unittest.main()
