"""scripts/raise_capacity.py: its search on costs made by hand, and its files on results made by a stand-in for the program."""
import contextlib
import io
import os
import stat
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import raise_capacity  # noqa: E402
import tune  # noqa: E402

# Writes results of (p - 60)² ms and of 100 leaves with grids, of 20 triangles each, as `run CONFIG --set leaves.primitives=P --out DIR`.
PROGRAM = """#!/usr/bin/python3
import json, os, sys
p, out = int(sys.argv[sys.argv.index("--set") + 1].split("=")[1]), sys.argv[sys.argv.index("--out") + 1]
os.makedirs(out)
open(out + "/results.csv", "w").write("variant,status\\nx,%s\\n" % ("failed" if p == 77 else "ok"))
open(out + "/passes.csv", "w").write("variant,pass,phase,ms_median\\nx,leaves,build,%g\\nx,mirror,frame,1\\n" % (p - 60) ** 2)
open(out + "/values.csv", "w").write("variant,pass,name,value\\nx,leaves,triangles in leaves with grids,2000\\nx,leaves,leaves with a grid,100\\n")
json.dump({"config": {"name": "x", "graph": [{"pass": "a", "primitives": p}], "measure": {"frames": 1}}}, open(out + "/manifest.json", "w"))
"""


class Search(unittest.TestCase):
    def found(self, bottom, mean, trials):
        tried = []

        def cost(capacity):
            tried.append(capacity)
            return abs(capacity - bottom)
        return raise_capacity.search(cost, mean, 16, trials), tried

    def test_halves_its_step_where_the_cost_grows(self):
        found, tried = self.found(57, lambda _: 20, 8)
        self.assertEqual(tried, [16, 36, 56, 76, 66, 61, 58, 60])
        self.assertEqual(found, 58)

    def test_ends_without_grids(self):
        found, tried = self.found(1000, lambda capacity: 100 if capacity < 200 else 0, 8)
        self.assertEqual(tried, [16, 116, 216])
        self.assertEqual(found, 216)

    def test_never_lowers_the_capacity(self):
        found, tried = self.found(2, lambda _: 8, 8)
        self.assertEqual((found, tried), (16, [16, 24, 20, 18, 17]))


class Command(unittest.TestCase):
    def rows(self, trail):
        if not os.path.exists(trail):
            return []
        with open(trail, encoding="utf-8") as file:
            return file.read().splitlines()

    def run_command(self, *arguments):
        with tempfile.TemporaryDirectory(prefix="voxray-capacity-") as folder:
            tune.PROGRAM = os.path.join(folder, "program")
            with open(tune.PROGRAM, "w", encoding="utf-8") as file:
                file.write(PROGRAM)
            os.chmod(tune.PROGRAM, stat.S_IRWXU)
            results = os.path.join(folder, "out")
            out, err, before = io.StringIO(), io.StringIO(), sys.argv
            sys.argv = ["raise_capacity.py", "config.yaml", "--out", results, *arguments]
            try:
                with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                    status = raise_capacity.main()
            finally:
                sys.argv = before
            trail = os.path.join(results, "trail.csv")
            rows = open(trail, encoding="utf-8").read().splitlines() if os.path.exists(trail) else []
            return status, out.getvalue(), err.getvalue(), self.rows(os.path.join(results, "trail.csv"))

    def test_results(self):
        status, out, _, rows = self.run_command("--start", "20")
        self.assertEqual(status, 0)
        self.assertIn("leaves.primitives=60: leaves.ms+mirror.ms 1, after 8 trials", out)
        self.assertEqual([row.split(",")[0] for row in rows[1:]], ["20", "40", "60", "80", "70", "65", "62", "61"])

    def test_failures(self):
        self.assertEqual(self.run_command("--start", "77")[0], 1)
        status, _, err, _ = self.run_command("--start", "0")
        self.assertEqual(status, 2)
        self.assertIn("at least 1", err)


if __name__ == "__main__":
    unittest.main()
