"""Other renderers as variants: the pass `external`, with a stand-in for a renderer, and what export-scene writes for one."""
import json
import os
import re
import shutil
import signal
import sys
import time
import unittest
from pathlib import Path

import numpy

from look_test import Look
from support import SOURCE, CommandTest

sys.path.insert(0, os.path.join(SOURCE, "framework", "python"))
sys.path.insert(0, os.path.join(SOURCE, "framework"))
import voxray.exr  # noqa: E402
from report import exr_pixels  # noqa: E402

CONFIG = """\
name: mixed
scene: {builtin: cornell, lights: spot, environment: SKY}
image: {width: 32, height: 24, exposure_stops: 1.5}
seed: 7
graph:
  - {pass: path_trace, id: method, spp: 4, bounces: 2}
reference: {pass: path_trace, spp: 16, bounces: 2}
sweep:
  method:
    paths: {pass: path_trace, spp: 4, bounces: 2}
    other: {pass: external, bounces: 2, spp: 5, OTHER}
measure: {frames: 2, warmup: 1}
"""
QUIET = ("--out", "out", "--quiet", "--no-report")


class External(CommandTest):
    def config(self, *words, more="light: parts", sky="none"):
        """A config of path tracing and the stand-in, next to which it lies."""
        shutil.copy(os.path.join(SOURCE, "tests", "cli", "stand_in_renderer.py"), self.folder)
        command = ", ".join(json.dumps(word) for word in ("/usr/bin/python3", "stand_in_renderer.py", *words))
        return self.write("mixed.yaml", CONFIG.replace("OTHER", f"command: [{command}], {more}").replace("SKY", sky))

    def images(self, folder, more="light: parts"):
        return self.write("mixed.yaml", CONFIG.replace("OTHER", f"images: {folder}, {more}").replace("SKY", "none"))

    def runs(self):
        with open(self.path("runs.jsonl"), encoding="utf-8") as file:
            return [json.loads(line) for line in file]

    def row(self, name="other"):
        return next(row for row in self.rows("out", "results.csv") if row["name"] == name)

    def pass_row(self):
        return next(row for row in self.rows("out", "passes.csv") if row["variant"] == "other")

    def failure(self, *words, **options):
        """Why the stand-in's variant fails; the other one does not."""
        self.config(*words, **options)
        self.expect(1, "run", "mixed.yaml", *QUIET)
        self.assertEqual(self.row("paths")["status"], "ok")
        self.assertEqual(self.row()["status"], "failed")
        return self.row()["error"]


class Command(External):
    def test_it_is_a_variant_like_any_other(self):
        self.config("time=1.25")
        self.expect(0, "run", "mixed.yaml", "--out", "out")
        row = self.row()
        self.assertEqual(row["status"], "ok")
        self.assertEqual([float(row[column]) for column in ("frame_ms_median", "frame_ms_p05", "build_ms")], [1250, 1250, 0])
        image = exr_pixels.rgb(self.path("out", "images", "other", "final.exr"))
        self.assertTrue(numpy.all(image == 1))
        self.assertTrue(numpy.all(exr_pixels.rgb(self.path("out", "images", "other", "indirect.exr")) == 0.75))
        for column in ("nrmse", "flip", "mean_ratio", "indirect_mean_ratio"):
            self.assertTrue(row[column], column)
        reference = exr_pixels.rgb(next(self.path("out", "images", name) for name in os.listdir(self.path("out", "images"))
                                         if name.startswith("reference")) + "/final.exr")
        self.assertAlmostEqual(float(row["mean_ratio"]), 1 / reference.mean(), delta=1e-3 / reference.mean())
        self.assertEqual(self.pass_row()["clock"], "told by the renderer")
        page = self.bytes("out", "report.html").decode()
        self.assertIn("told by the renderer", page)
        self.expect(0, "pareto", "out", "--out", "methods.html")
        self.assertIn("external", self.bytes("methods.html").decode())

    def test_it_runs_once_and_is_told_what_gltf_lacks(self):
        self.config()
        self.expect(0, "run", "mixed.yaml", *QUIET)
        (asked,) = self.runs()
        self.assertEqual({key: asked[key] for key in ("format", "scene", "image", "exposure_stops", "spp", "bounces", "seed", "light")},
                         {"format": 1, "scene": "scene.glb", "image": {"width": 32, "height": 24}, "exposure_stops": 1.5, "spp": 5,
                          "bounces": 2, "seed": 7, "light": "parts"})
        self.assertEqual(asked["files"], ["scene.glb", "scene.json"])
        self.assertEqual((asked["environment"], asked["materials"]), (None, "lambert"))
        (light,) = asked["lights"]
        self.assertEqual(light["type"], "spot")
        self.assertLess(light["inner_deg"], light["outer_deg"])
        self.assertAlmostEqual(sum(x * x for x in asked["camera"]["forward"]), 1, places=5)
        self.assertEqual(self.pass_row()["clock"], "wall clock of the program")
        self.assertGreater(float(self.row()["frame_ms_median"]), 10)

    def test_it_runs_for_each_frame_where_it_keeps_light(self):
        self.config(more="light: parts, each_frame: true")
        self.expect(0, "run", "mixed.yaml", *QUIET)
        self.assertEqual([run.get("frame") for run in self.runs()], [None, 0, 1])
        os.makedirs(self.path("theirs"))
        self.images("theirs", more="each_frame: true")
        self.assertIn("each_frame: 'images' holds one frame", self.expect(2, "run", "mixed.yaml", *QUIET).stderr)

    def test_a_second_seed_is_a_second_run(self):
        self.config()
        self.expect(0, "run", "mixed.yaml", *QUIET, "--set", "measure.second_seed=true")
        self.assertEqual([run["seed"] for run in self.runs()], [7, 8])

    def test_an_environment_comes_along(self):
        voxray.exr.write(Path(self.path("sky.exr")), numpy.full((4, 8, 3), 2.0))
        self.config(sky="{map: sky.exr, scale: 3}")
        self.expect(0, "run", "mixed.yaml", *QUIET)
        (asked,) = self.runs()
        self.assertEqual(asked["environment"], {"radiance": [3, 3, 3], "map": "scene.environment.exr"})
        self.assertIn("scene.environment.exr", asked["files"])
        self.expect(0, "export-scene", "mixed.yaml", "room.glb")
        self.assertTrue(numpy.all(exr_pixels.rgb(self.path("room.environment.exr")) == 2))
        self.assertEqual(self.json("room.json")["environment"], {"radiance": [3, 3, 3], "map": "room.environment.exr"})

    def test_resume_takes_what_is_there_and_refuses_another_program(self):
        self.config("time=1")
        self.expect(0, "run", "mixed.yaml", *QUIET)
        self.expect(0, "run", "mixed.yaml", *QUIET, "--resume")
        self.assertEqual(len(self.runs()), 1)
        with open(self.path("stand_in_renderer.py"), "a", encoding="utf-8") as file:
            file.write("# another version\n")
        self.assertIn("another graph", self.expect(2, "run", "mixed.yaml", *QUIET, "--resume").stderr)

    def test_failures_name_their_cause(self):
        said = self.failure("fail")
        for words in ("external", "exit status 1", "reading the scene | no licence for | this machine"):
            self.assertIn(words, said)
        self.assertIn("1 values are NaN or infinite, the first in column 3, row 2", self.failure("nan"))
        self.assertIn("33 x 24 pixels, the config's image 32 x 24", self.failure("wide"))
        self.assertIn("final.exr is missing", self.failure("nothing", more="light: total"))
        self.assertIn("timeout_s = 0.2 s", self.failure("sleep=30", more="timeout_s: 0.2"))
        self.assertIn("more than 0 seconds", self.failure("time=-1"))

    def test_a_program_that_is_missing(self):
        self.write("mixed.yaml", CONFIG.replace("OTHER", "command: [no_such_renderer], install: get it from the shop").replace("SKY", "none"))
        said = self.expect(2, "run", "mixed.yaml", *QUIET).stderr
        self.assertIn("mixed.yaml:", said)
        self.assertIn("there is no program 'no_such_renderer': get it from the shop", said)

    def test_a_program_runs_only_from_a_config(self):
        self.config()
        said = self.expect(2, "run", "mixed.yaml", *QUIET, "--set",
                           "sweep.method={other: {pass: external, command: [/bin/true]}}").stderr
        self.assertIn("a program runs only from a config's file", said)
        self.assertIn("list of words", self.expect(2, "validate", self.write("mixed.yaml", CONFIG.replace(
            "OTHER", "command: rm -r out").replace("SKY", "none"))).stderr)
        for none_or_both in ("light: total", "command: [/bin/true], images: ."):
            self.write("mixed.yaml", CONFIG.replace("OTHER", none_or_both).replace("SKY", "none"))
            self.assertIn("either a 'command'", self.expect(2, "validate", "mixed.yaml").stderr)
        self.config()
        self.assertIn("external", self.expect(2, "pack", "mixed.yaml").stderr)

    def test_ctrl_c_ends_the_program(self):
        self.config("sleep=60")
        process = self.start_until(lambda: os.path.exists(self.path("runs.jsonl")), "run", "mixed.yaml", *QUIET)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        for _ in range(100):
            if not os.path.exists(f"/proc/{self.runs()[0]['process']}"):
                return
            time.sleep(0.05)
        self.fail("the program lives on")


class Looked(Look):
    """`look` offers the other variants: at each change of the view a program would run, and images would be of another one."""

    yaml = CONFIG.replace("OTHER", f"command: [/usr/bin/python3, {SOURCE}/tests/cli/stand_in_renderer.py], light: parts").replace("SKY", "none")
    yaml = re.sub("(    paths: .*\n)(    other: .*\n)", r"\2\1", yaml)

    def test_its_variant_is_not_offered(self):
        start = json.loads(self.ask(name="start.json")[1])
        self.assertEqual([variant["name"] for variant in start["variants"]], ["paths"])
        answer, png = self.image(changes=[{"path": "image.width", "value": 24}])
        self.assertTrue(png, answer)
        self.assertIn("no variant 'other'", self.image(variant="other")[0]["error"])
        self.assertFalse(os.path.exists(self.path("runs.jsonl")))
        self.process.send_signal(signal.SIGINT)
        said = self.process.stderr.read()
        self.assertIn("warning: not shown, as another renderer would render at each change of the view: other", said)

    def test_alone_it_is_refused(self):
        self.write("alone.yaml", re.sub("    paths: .*\n", "", self.yaml))
        said = self.expect(2, "look", "alone.yaml").stderr
        self.assertIn("alone.yaml:10", said)
        self.assertIn("'./voxray run' renders it", said)


class Cycles(External):
    @unittest.skipUnless(shutil.which("blender"), "Blender is not installed")
    def test_its_image_is_ours(self):
        """A spot light, and a sky with a red half on the left and a green spot on the right, which is seen beside the box."""
        sky = numpy.full((32, 64, 3), 0.05)
        sky[:, 16:32, 0] = 1
        sky[10:20, 36:44, 1] = 3
        voxray.exr.write(Path(self.path("sky.exr")), sky)
        script = os.path.join(SOURCE, "scripts", "external", "cycles.py")
        words = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", script, "--"]
        config = CONFIG.replace("spp: 5, OTHER", f"light: parts, spp: 256, command: {json.dumps(words)}").replace("SKY", "sky.exr")
        self.write("mixed.yaml", config.replace("reference: {pass: path_trace, spp: 16", "reference: {pass: path_trace, spp: 1024"))
        self.expect(0, "run", "mixed.yaml", *QUIET)
        self.assertEqual(self.pass_row()["clock"], "told by the renderer")
        folders = (self.path("out", "images", "other"), self.path("out", "images", "reference"))
        for name, most in (("final", 0.02), ("indirect", 0.04)):
            theirs, ours = (exr_pixels.rgb(f"{folder}/{name}.exr") for folder in folders)
            halves = [(image[:, :16].mean(axis=(0, 1)), image[:, 16:].mean(axis=(0, 1))) for image in (theirs, ours)]
            self.assertLess(numpy.abs(numpy.array(halves[0]) / halves[1] - 1).max(), most, name)


class Images(External):
    def fill(self, **files):
        os.makedirs(self.path("theirs"), exist_ok=True)
        for name, value in files.items():
            voxray.exr.write(Path(self.path("theirs", f"{name}.exr")), numpy.full((24, 32, 3), value))

    def test_a_folder_is_a_variant(self):
        self.fill(direct=0.5, indirect=0.25)
        self.images("theirs")
        self.expect(1, "run", "mixed.yaml", *QUIET)
        self.assertIn("time.json is missing", self.row()["error"])
        self.write("theirs/time.json", '{"render_seconds": 60}')
        self.expect(0, "run", "mixed.yaml", *QUIET)
        self.assertEqual(float(self.row()["frame_ms_median"]), 60000)
        self.assertTrue(numpy.all(exr_pixels.rgb(self.path("out", "images", "other", "final.exr")) == 0.75))
        self.expect(0, "run", "mixed.yaml", *QUIET, "--resume")
        self.fill(direct=0.25)
        self.assertIn("another graph", self.expect(2, "run", "mixed.yaml", *QUIET, "--resume").stderr)

    def test_a_folder_that_is_missing(self):
        self.images("nowhere")
        self.assertIn("no folder 'nowhere'", self.expect(2, "validate", "mixed.yaml").stderr)


class Example(External):
    def test_it_runs(self):
        program = os.path.join(SOURCE, "docs", "examples", "external", "renderer.py")
        self.write("mixed.yaml", CONFIG.replace("OTHER", f"command: [/usr/bin/python3, {program}]").replace("SKY", "none"))
        self.expect(0, "run", "mixed.yaml", *QUIET)
        self.assertEqual(self.pass_row()["clock"], "told by the renderer")


if __name__ == "__main__":
    unittest.main()
