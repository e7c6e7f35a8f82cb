"""`voxray stability`: a part of its matrix, no cell worse than stability.csv has it; what it runs and what it refuses.

`stability_test.py record` (with the program in VOXRAY_PROGRAM, the repository in VOXRAY_SOURCE) writes that table again: the
numbers of the first seed, and how far they may move when random numbers change. That is five times their standard
deviation over three seeds, its relative size pooled over the methods of a row.
"""
import csv
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy

from generality_test import SEEDS, noise
from support import PROGRAM, SOURCE, CommandTest

sys.path.insert(0, os.path.join(SOURCE, "framework", "python"))
import voxray.exr  # noqa: E402

METHODS = ["cones", "marched cones", "final gather"]
SCENARIOS = ["wall of 1/4 voxel", "wall of 1 voxel", "furnace", "a second run", "10 km away", "1 mm large", "light times 1e6"]
SMALLER = ["--set", "image={width: 32, height: 18}", "--set", f"sweep.seed=[{SEEDS[0]}]"]
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
        done = self.expect(0, "stability", "cones", "--dry-run", "--tracer", "embree", "--out", "out")
        said = done.stdout
        self.assertNotIn("is never run", done.stderr)
        scenes = set(re.findall(r"^seed 1, (.+), cones \(tracer", said, re.MULTILINE))
        with open(LIMITS, newline="", encoding="utf-8") as file:
            limited = {row["scene"] for row in csv.DictReader(file)}
        self.assertEqual(scenes, limited)

    def test_mistakes(self):
        for words, part in ((["final gathers"], "'final gather'"),
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


    def test_the_scenes_of_a_matrix_are_exported_and_images_of_another_renderer_scored(self):
        self.write("own.yaml", OWN_MATRIX.replace("profiles:", "profiles:\n  moving: {measure: {frames: 3, compare_every: 1}}"))
        self.write("own.csv", "profile,scene,measure,methods,limit,scale,why\nplain,cornell,energy,,0.1,,light stays\n"
                   "moving,cornell,flicker,,0.1,,an eye\n")
        self.expect(0, "stability", "--config", "own.yaml", "--export", "theirs")
        self.assertEqual(self.files("theirs"), ["matrix.csv", "matrix.yaml", "plain/cornell/scene.glb", "plain/cornell/scene.json"])
        self.assertEqual([row["measure"] for row in self.rows("theirs", "matrix.csv")], ["energy"])
        words = ["stability", "--config", "theirs/matrix.yaml", "--tracer", "embree", "--quiet", "--out", "out"]
        self.expect(1, *words)
        cell = "cornell", "energy", "other renderer"
        self.assertIn("plain/cornell: lacks direct.exr, time.json, indirect.exr or final.exr", read(self.path("out", "stability.csv"))[cell]["reason"])

        def value(**images):
            folder = Path(self.path("theirs", "plain", "cornell"))
            (folder / "time.json").write_text('{"render_seconds": 1}', encoding="utf-8")
            for name, radiance in images.items():
                voxray.exr.write(folder / f"{name}.exr", numpy.full((9, 16, 3), radiance))
            self.expect(0, *words)
            return float(read(self.path("out", "stability.csv"))[cell]["value"])

        # The mean of 0.25 over the reference's is that of 0.5 over it, halved; all light less direct light is indirect light.
        light = value(direct=0.5, final=0.75)
        self.assertAlmostEqual(value(direct=0.5, final=1.0), 2 * (1 + light) - 1, 4)
        self.assertAlmostEqual(value(indirect=0.25), light, 4)
        self.assertIn("none of these scenes is still", self.expect(2, "stability", "--config", "own.yaml", "--profile", "moving", "--export", "no").stderr)


def record():
    with open(TABLE, "w", newline="", encoding="utf-8") as file, tempfile.TemporaryDirectory() as folder:
        runs = []
        for seed in SEEDS:
            out = os.path.join(folder, str(seed))
            subprocess.run([PROGRAM, *arguments(out, "--set", f"sweep.seed=[{seed}]")], check=True, cwd=folder)
            runs.append({cell: float(row["value"]) for cell, row in read(os.path.join(out, "stability.csv")).items()})
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        for (scene, measure, method), value in runs[0].items():
            alike = [[run[cell] for run in runs] for cell in runs[0] if cell[:2] == (scene, measure)]
            table.writerow({"scene": scene, "measure": measure, "method": method, "value": f"{value:.4g}",
                            "noise": f"{value * noise(alike):.2g}"})


if __name__ == "__main__" and sys.argv[1:] == ["record"]:
    record()
