"""scripts/tune.py: its search on costs made by hand, its measures and files on results made by a stand-in for the program."""
import contextlib
import io
import os
import stat
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import tune  # noqa: E402

# Writes results of time (p - 40)² + 10 and of 1000 / p bytes, as `run CONFIG --set leaves.primitives=P --out DIR`.
PROGRAM = """#!/usr/bin/python3
import json, os, sys
p, out = int(sys.argv[sys.argv.index("--set") + 1].split("=")[1]), sys.argv[sys.argv.index("--out") + 1]
os.makedirs(out)
open(out + "/results.csv", "w").write("variant,status,memory_bytes\\nx,%s,%g\\n" % ("failed" if p == 77 else "ok", 1000 / p))
open(out + "/passes.csv", "w").write(
    "variant,pass,phase,ms_median\\nx,leaves,build,10\\nx,mirror,frame,%g\\nx,other,frame,9\\n" % (p - 40) ** 2)
open(out + "/values.csv", "w").write("variant,pass,name,value\\nx,leaves,bytes of grids,%g\\n" % (2000 / p))
json.dump({"config": {"name": "x", "graph": [{"pass": "a", "primitives": p}], "measure": {"frames": 1}}},
          open(out + "/manifest.json", "w"))
"""


class Search(unittest.TestCase):
    def test_finds_the_valley_of_every_place_in_eight_trials(self):
        for count in range(2, 34):
            for bottom in range(count):
                tried = []
                def cost(place):
                    if place not in tried:
                        tried.append(place)
                    return (0, abs(place - bottom))
                tune.search(cost, count, 8)
                self.assertIn(bottom, tried, (count, bottom))
                self.assertLessEqual(len(tried), 8)

    def test_limits_lead_to_the_values_that_keep_them(self):
        tried = {}
        tune.search(lambda p: tried.setdefault(p, (max(10 - p, 0), p)), 17, 8)
        self.assertEqual(min(tried, key=tried.get), 10)


class Command(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="voxray-tune-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        tune.PROGRAM = os.path.join(self.folder, "program")
        with open(tune.PROGRAM, "w", encoding="utf-8") as file:
            file.write(PROGRAM)
        os.chmod(tune.PROGRAM, stat.S_IRWXU)

    def run_tune(self, *arguments):
        out, err, before = io.StringIO(), io.StringIO(), sys.argv
        sys.argv = ["tune.py", "config.yaml", "--out", os.path.join(self.folder, "out"), *arguments]
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                status = tune.main()
        finally:
            sys.argv = before
        return status, out.getvalue(), err.getvalue()

    def read(self, name):
        with open(os.path.join(self.folder, "out", name), encoding="utf-8") as file:
            return file.read()

    def test_time_within_a_limit(self):
        values = "leaves.primitives=1,2,4,8,16,32,64,128,256,512"
        status, out, _ = self.run_tune("--vary", values, "--minimize", "leaves.ms+mirror.ms")
        self.assertEqual(status, 0, out)
        self.assertIn("leaves.primitives=32: leaves.ms+mirror.ms 74", out)
        self.assertIn("- {\"pass\": \"a\", \"primitives\": 32}", self.read("chosen.yaml"))
        self.assertIn("32,0,74.0", self.read("trail.csv"))
        status, out, _ = self.run_tune("--vary", values, "--minimize", "mirror.ms", "--limit", '"bytes of grids"=20')
        self.assertEqual(status, 0)
        self.assertIn("leaves.primitives=128: mirror.ms 7744", out)

    def test_every_value_and_failed_trials(self):
        status, out, _ = self.run_tune("--vary", "leaves.primitives=77,64,32", "--minimize", "mirror.ms", "--every")
        self.assertEqual(status, 0)
        self.assertIn("leaves.primitives=32: mirror.ms 64, after 3 of 3", out)
        status, _, err = self.run_tune("--vary", "leaves.primitives=64,32", "--limit", "memory_bytes=1", "--minimize", "mirror.ms")
        self.assertEqual(status, 1)
        self.assertIn("no value keeps the limits", err)

    def test_mistakes(self):
        for arguments, said in ((("--vary", "x"), "PATH=V1"), (("--vary", "x=1,1"), "two different values"),
                                (("--vary", "x=1,2", "--limit", "a"), "MEASURE=NUMBER"),
                                (("--vary", "x=1,2", "--minimize", "nothing.ms"), "no pass with"),
                                (("--vary", "x=1,2", "--trials", "1"), "at least 2")):
            status, _, err = self.run_tune(*arguments)
            self.assertEqual(status, 2)
            self.assertIn(said, err)


if __name__ == "__main__":
    unittest.main()
