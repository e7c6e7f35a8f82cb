"""`voxray stability`: a part of its matrix, no cell worse than stability.csv has it; what it runs and what it refuses.

`stability_test.py record` (with the program in VOXRAY_PROGRAM, the repository in VOXRAY_SOURCE) writes that table again: the
numbers of the first seed, and how far they may move when random numbers change. That is five times their standard
deviation over three seeds, its relative size pooled over the methods of a row.
"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
from PIL import Image

from generality_test import SEEDS, noise
from support import PROGRAM, SOURCE, CommandTest

sys.path.insert(0, os.path.join(SOURCE, "framework", "python"))
sys.path.insert(0, os.path.join(SOURCE, "framework"))
import voxray.exr  # noqa: E402
from report import exr_pixels  # noqa: E402

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
        """By plans, which load no scene; cli.commands validates the whole matrix."""
        def plan(*words):
            matrix = os.path.join(SOURCE, "configs", "stability", "matrix.yaml")
            return json.loads(self.expect(0, "plan", matrix, "--only", "method=cones", *words).stdout)

        planned = {variant["values"][1] for profile in plan()["profiles"] for variant in plan("--profile", profile)["variants"]}
        with open(LIMITS, newline="", encoding="utf-8") as file:
            limited = {row["scene"] for row in csv.DictReader(file)}
        self.assertEqual(planned, limited)

    def test_methods_that_are_left_out_are_not_warned_of(self):
        # Methods of the profile `mirrors` have other passes than those of the rest
        done = self.expect(0, "stability", "cones", "--scenario", "furnace", "--scenario", "mirror room", "--dry-run", "--tracer", "embree",
                           "--out", "out")
        self.assertEqual(len(set(re.findall(r"^seed 1, (.+), cones \(tracer", done.stdout, re.MULTILINE))), 2)
        self.assertNotIn("is never run", done.stderr)

    def test_mistakes(self):
        for words, part in ((["final gathers", "--profile", "energy"], "'final gather'"),
                            (["--scenario", "furnance", "--profile", "energy"], "'furnace'"),
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


    def scores(self, status, *words):
        """Scores the exported folder `theirs`. @return the rows of stability.csv"""
        self.expect(status, "stability", "--config", "theirs/matrix.yaml", "--tracer", "embree", "--quiet", "--out", "out", *words)
        return read(self.path("out", "stability.csv"))

    def leave(self, *folder, **images):
        """Leaves even images of these radiances as another renderer does, or images of a shape (height, width, 3)."""
        target = Path(self.path("theirs", *folder))
        (target / "time.json").write_text('{"render_seconds": 1}', encoding="utf-8")
        for name, radiance in images.items():
            voxray.exr.write(target / f"{name}.exr", numpy.broadcast_to(radiance, (9, 16, 3)))

    def test_still_scenes_are_exported_with_masks_and_images_of_another_renderer_scored(self):
        self.write("own.yaml", OWN_MATRIX.replace("cornell: {builtin: cornell}}", "cornell: {builtin: cornell}, again: {builtin: cornell, lights: area}, "
                                                  "away: {builtin: cornell, transform: {translate: [10000, 0, 0]}}, "
                                                  "far: {builtin: cornell, boxes: false, transform: {translate: [10000, 0, 0]}}}"))
        self.write("own.csv", "profile,scene,measure,methods,limit,scale,why\nplain,cornell,energy,,0.1,,light stays\n"
                   "plain,cornell,energy@left,,0.1,,in the left half\nplain,far,mean,,0.01,,anywhere\nplain,away,mean,,0.01,,anywhere\n"
                   "plain,again,image,,0.01,1,the same\n")
        os.mkdir(self.path("masks"))
        Image.fromarray(numpy.repeat([[255] * 8 + [0] * 8], 9, 0).astype(numpy.uint8)).save(self.path("masks", "left.png"))
        self.expect(0, "stability", "--config", "own.yaml", "--export", "theirs")
        # What is an earlier scene again, or that elsewhere, can't be told from it, and is left out
        self.assertEqual(self.files("theirs"), ["masks/left.png", "matrix.csv", "matrix.yaml", *(f"plain/{scene}/scene.{kind}" for scene in
                                                ("cornell", "far") for kind in ("glb", "json"))])
        self.assertEqual([row["measure"] for row in self.rows("theirs", "matrix.csv")], ["energy", "energy@left", "mean"])
        cell, left, far = (("cornell", "energy", "other renderer"), ("cornell", "energy@left", "other renderer"),
                           ("far", "mean", "other renderer"))
        self.assertIn("plain/cornell: lacks direct.exr, time.json, indirect.exr or final.exr", self.scores(1)[cell]["reason"])

        # The mean of 0.25 over the reference's is that of 0.5 over it, halved; all light less direct light is indirect light.
        self.leave("plain", "cornell", direct=0.5, final=0.75)
        self.leave("plain", "far", direct=0.5, indirect=0.25)
        found = self.scores(0)
        self.assertEqual(float(found[far]["value"]), 0)
        light, light_left = (float(found[name]["value"]) for name in (cell, left))
        self.leave("plain", "cornell", final=1.0)
        self.assertAlmostEqual(float(self.scores(0)[cell]["value"]), 2 * (1 + light) - 1, 4)
        # What is wrong outside of a mask does not count under it
        self.leave("plain", "cornell", indirect=numpy.repeat(numpy.repeat([[[0.25]] * 8 + [[9.0]] * 8], 9, 0), 3, 2))
        found = self.scores(0)
        self.assertAlmostEqual(float(found[left]["value"]), light_left, 6)
        self.assertEqual(found[cell]["verdict"], "fails")
        self.assertEqual(found[far]["verdict"], "fails")

    def test_sequences_are_exported_frame_by_frame_and_our_own_images_of_them_hold(self):
        walk = "{builtin: cornell, time_step: 0.1, camera: {position: [0, 1, 3.4], target: [0, 1, 0], fov_deg: 40, move: [0.3, 0, 0]}, " \
               "moving_spheres: {count: 1, radius: 0.3, center: [0, 1, 0.5], swing: [0.3, 0, 0], period: 1}}"
        self.write("own.yaml", OWN_MATRIX.replace("spp: 16", "spp: 256").replace(
            "profiles:", "profiles:\n  moving: {measure: {frames: 3, warmup: 2, compare_every: 1}, sweep.scene: {walk: %s}}" % walk))
        self.write("own.csv", "profile,scene,measure,methods,limit,scale,why\nmoving,walk,flicker,,0.3,,an eye\n")
        self.expect(0, "stability", "--config", "own.yaml", "--export", "theirs")
        frames = [f"frame_{frame:03}" for frame in range(3)]
        self.assertEqual(self.files("theirs"), ["matrix.csv", "matrix.yaml", *(f"moving/walk/{frame}/scene.{kind}" for frame in frames
                                                                                 for kind in ("glb", "json"))])
        cell = "walk", "flicker", "other renderer"
        self.assertIn("frame_000: lacks", self.scores(1)[cell]["reason"])

        # Each exported frame as a scene of its own, by path tracing
        images = []
        for frame in frames:
            self.write("frame.yaml", "name: frame\nscene: {file: theirs/moving/walk/%s/scene.glb}\nimage: {width: 16, height: 9}\n"
                       "graph: [{pass: path_trace, spp: 1024, bounces: 3}]\nmeasure: {frames: 1, warmup: 0}\n" % frame)
            self.expect(0, "run", "frame.yaml", "--tracer", "embree", "--quiet", "--no-report", "--out", frame)
            folder, = (Path(self.path(frame, "images")) / name for name in os.listdir(self.path(frame, "images")))
            final, indirect = (exr_pixels.rgb(folder / f"{name}.exr") for name in ("final", "indirect"))
            images.append({"direct": final - indirect, "indirect": indirect})
        for frame, own in zip(frames, images):
            self.leave("moving", "walk", frame, **own)
        right = self.scores(0)[cell]
        self.assertEqual(right["verdict"], "holds")
        # Frames in another order
        for frame, own in zip(frames, (images[2], images[0], images[1])):
            self.leave("moving", "walk", frame, **own)
        wrong = self.scores(0)[cell]
        self.assertEqual(wrong["verdict"], "fails")
        self.assertGreater(float(wrong["value"]), 3 * float(right["value"]))

    def test_what_has_no_limit_is_not_exported(self):
        self.write("own.yaml", OWN_MATRIX)
        self.write("own.csv", "profile,scene,measure,methods,limit,scale,why\nother,cornell,energy,,0.1,,light stays\n")
        self.assertIn("no limit for these scenes", self.expect(2, "stability", "--config", "own.yaml", "--export", "no").stderr)


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
