"""`voxray stability`: a part of its matrix, no cell worse than stability.csv has it; what it runs and what it refuses.

`stability_test.py record` (with the program in VOXRAY_PROGRAM, the repository in VOXRAY_SOURCE) writes that table again: the
numbers of the config's own seed, and how far they may move when random numbers change. That is five times their standard
deviation over three seeds, its relative size pooled over the methods of a row.
"""
import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest

from generality_test import SEEDS, noise
from support import PROGRAM, SOURCE, CommandTest

METHODS = ["lookup", "gather rays", "cones octree"]
SCENARIOS = ["wall of 1/4 voxel", "wall of 1 voxel", "furnace", "a second run", "10 km away", "1 mm large", "light times 1e6"]
SMALLER = ["--set", "image={width: 32, height: 18}"]
TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stability.csv")
LIMITS = os.path.join(SOURCE, "configs", "stability", "matrix.csv")
COLUMNS = ["scene", "measure", "method", "value", "noise"]
ROUNDING = 1e-6  # of processors that round otherwise

OWN_MATRIX = """\
name: own
scene: {builtin: cornell}
image: {width: 16, height: 9}
graph:
  - {pass: gbuffer}
  - {pass: voxelize, resolution: 16}
  - {pass: inject_light_rays, id: inject, rays_per_light: 4096, bounces: 2}
  - {pass: direct_shadow_rays, id: direct}
  - {pass: gather_irradiance, id: method}
  - {pass: composite}
reference: {pass: path_trace, spp: 16, bounces: 3}
sweep:
  scene: {cornell: {builtin: cornell}}
  method: {lookup: gather_irradiance, gather rays: [trace_gather_rays, gather_rays, filter_irradiance]}
measure: {frames: 1, warmup: 0, build_repeats: 0}
profiles:
  plain: {seed: 3}
"""


def arguments(out, *more):
    scenarios = [word for name in SCENARIOS for word in ("--scenario", name)]
    return ["stability", *METHODS, *scenarios, "--tracer", "embree", "--quiet", "--out", out, *SMALLER, *more]


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {(row["scene"], row["measure"], row["method"]): row for row in csv.DictReader(file)}


class Stability(CommandTest):
    def test_no_cell_is_worse_than_recorded(self):
        self.expect(0, *arguments("out"))
        found, recorded = read(self.path("out", "stability.csv")), read(TABLE)
        self.assertEqual(set(found), set(recorded))
        for cell, row in found.items():
            with self.subTest(cell=cell):
                limit = float(recorded[cell]["value"]) + float(recorded[cell]["noise"]) + ROUNDING
                self.assertLessEqual(float(row["value"]), limit)
        self.assertIn("stability.html", os.listdir(self.path("out")))

    def test_every_scene_has_its_limit_and_every_limit_its_scene(self):
        done = self.expect(0, "stability", "lookup", "--dry-run", "--tracer", "embree", "--out", "out")
        said = done.stdout
        self.assertNotIn("is never run", done.stderr)
        scenes = set(re.findall(r"^(.+), lookup \(tracer", said, re.MULTILINE))
        with open(LIMITS, newline="", encoding="utf-8") as file:
            limited = {row["scene"] for row in csv.DictReader(file)}
        self.assertEqual(scenes, limited)

    def test_mistakes(self):
        for words, part in ((["gather ray"], "'gather rays'"),
                            (["--scenario", "furnance"], "'furnace'"),
                            (["--profile", "leek"], "'leak'")):
            self.assertIn(part, self.expect(2, "stability", "--dry-run", *words).stderr)
        plain = self.write("plain.yaml", "name: plain\nscene: {builtin: cornell}\ngraph: [{pass: path_trace, spp: 1}]\nprofiles: {a: {seed: 1}}\n")
        self.assertIn("'scene'", self.expect(2, "stability", "--config", plain).stderr)


    def test_remedies_run_what_fails_again(self):
        """Both methods fail a limit of 0; the remedy has an entry for one of them, whose chain it changes."""
        self.write("own.yaml", OWN_MATRIX)
        self.write("own.csv", "profile,scene,measure,methods,limit,scale,why\nplain,cornell,energy,,0,,no error at all\n")
        remedy = '{"more rays": {"ga": {"%s": 256, "inject.rays_per_light": 65536}}}'
        self.write("own_remedies.json", remedy % "trace_gather_rays.rays_per_block")
        words = ["stability", "--config", "own.yaml", "--tracer", "embree", "--quiet", "--out", "out"]
        self.expect(0, *words, "--remedies")
        found = read(self.path("out", "stability.csv"))
        self.assertIn("more rays", found["cornell", "energy", "gather rays"]["reason"])
        self.assertEqual(found["cornell", "energy", "lookup"]["reason"], "not known")
        again = ("out", "remedies", "more_rays", "gather_rays", "plain")
        self.assertEqual([row["method"] for row in self.rows(*again, "results.csv")], ["gather rays"])
        chain, = self.json(*again, "manifest.json")["config"]["sweep"]["method"].values()
        self.assertEqual(chain[0], {"pass": "trace_gather_rays", "rays_per_block": 256})
        # Asked without remedies, nothing of earlier ones is told.
        self.expect(0, *words, "--resume")
        self.assertEqual(read(self.path("out", "stability.csv"))["cornell", "energy", "gather rays"]["reason"], "not known")
        self.write("own_remedies.json", remedy % "trace_gather_ray.rays_per_block")
        self.assertIn("trace_gather_ray", self.expect(2, *words, "--remedies", "--resume").stderr)


def record():
    with open(TABLE, "w", newline="", encoding="utf-8") as file, tempfile.TemporaryDirectory() as folder:
        runs = []
        for seed in SEEDS:
            out = os.path.join(folder, str(seed))
            subprocess.run([PROGRAM, *arguments(out, "--set", f"seed={seed}")], check=True, cwd=folder)
            runs.append({cell: float(row["value"]) for cell, row in read(os.path.join(out, "stability.csv")).items()})
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        for (scene, measure, method), value in runs[0].items():
            alike = [[run[cell] for run in runs] for cell in runs[0] if cell[:2] == (scene, measure)]
            table.writerow({"scene": scene, "measure": measure, "method": method, "value": f"{value:.4g}",
                            "noise": f"{value * noise(alike):.2g}"})


if __name__ == "__main__" and sys.argv[1:] == ["record"]:
    record()
