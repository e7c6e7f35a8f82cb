"""`voxray session`: its answers, and its images against those of `run`."""
import csv
import json
import os
import subprocess
import sys

from support import PROGRAM, SOURCE, TINY, CommandTest

sys.path[:0] = [os.path.join(SOURCE, "tests", "scale"), os.path.join(SOURCE, "framework")]
import session_changes  # noqa: E402
from report import exr_pixels  # noqa: E402


class Session(CommandTest):
    def start(self, config, *options):
        self.write("session.yaml", config)
        process = subprocess.Popen([PROGRAM, "session", "session.yaml", "--stdio", "--images", "shown", "--validate", *options],
                                   cwd=self.folder, env=self.environment, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.stdin.close)
        self.process = process
        return json.loads(process.stdout.readline())

    def send(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def ask(self, command, **keys):
        return self.send(json.dumps({"id": 5, "command": command, **keys}))

    def done(self, command, **keys):
        answer = self.ask(command, **keys)
        self.assertTrue(answer["ok"], answer)
        return answer

    def refusal(self, command, **keys):
        answer = self.ask(command, **keys)
        self.assertFalse(answer["ok"], answer)
        self.assertEqual(answer["id"], 5)
        return answer["error"]

    def reused(self):
        return {one["id"] for one in self.done("render")["passes"] if one["reused"]}

    def expect_images_of_run(self, *options):
        self.expect(0, "run", "session.yaml", "--out", "run", "--no-report", *options)
        [variant] = [name for name in os.listdir(self.path("run", "images")) if name != "reference"]
        for name in ("final.exr", "indirect.exr"):
            right, shown = (exr_pixels.read(self.path(*folder, name)) for folder in (("run", "images", variant), ("shown",)))
            self.assertEqual(right.keys(), shown.keys())
            for channel, values in right.items():
                self.assertEqual(values.tobytes(), shown[channel].tobytes(), (name, channel, options))

    def test_images_and_scores_are_those_of_a_run(self):
        greeting = self.start(TINY)
        self.assertEqual([one["id"] for one in greeting["variants"]], ["resolution-8", "resolution-16"])
        self.assertEqual(self.reused(), set())
        self.expect_images_of_run("--only", "voxelize.resolution=8")
        scores = self.done("score")["scores"]
        with open(self.path("run", "results.csv"), newline="", encoding="utf-8") as file:
            [row] = csv.DictReader(file)
        self.assertAlmostEqual(float(row["nrmse"]), scores["nrmse"], 6)

        # Only what depends on it is built again
        self.assertEqual(self.reused(), {"voxelize", "inject"})
        self.done("set", path="gather_irradiance", value=["trace_gather_rays", "gather_rays"])
        self.done("set", path="trace_gather_rays.rays_per_block", value=4)
        self.assertEqual(self.reused(), {"voxelize", "inject"})
        self.expect_images_of_run("--only", "voxelize.resolution=8", "--set", "gather_irradiance=[trace_gather_rays, gather_rays]",
                                  "--set", "trace_gather_rays.rays_per_block=4")
        self.done("set", path="inject.bounces", value=1)
        self.assertEqual(self.reused(), {"voxelize"})
        self.done("select", variant="resolution-16")
        self.assertEqual(self.reused(), set())
        self.expect_images_of_run("--only", "voxelize.resolution=16")
        self.done("set", path="seed", value=8)
        self.assertEqual(self.reused(), set())
        self.done("set", path="scene.camera", value={"position": [0, 1, 3], "target": [0, 1, 0], "fov_deg": 50})
        self.assertEqual(self.reused(), {"voxelize", "inject"})
        self.expect_images_of_run("--only", "voxelize.resolution=16", "--set", "seed=8", "--set",
                                  "scene.camera={position: [0, 1, 3], target: [0, 1, 0], fov_deg: 50}")

    def test_a_cache_that_is_filled_from_the_camera_is_filled_again(self):
        self.start("""
name: cached
scene: {builtin: cornell}
image: {width: 32, height: 24}
seed: 7
graph:
  - {pass: gbuffer}
  - {pass: update_radiance_cache, update: once, rays_per_image: 4096, bounces: 1}
  - {pass: trace_gather_rays}
  - {pass: gather_rays, source: radiance_cache}
  - {pass: direct_shadow_rays}
  - {pass: composite}
""")
        self.done("render")
        self.assertIn("update_radiance_cache", self.reused())
        camera = {"position": [0.2, 1, 3], "target": [0, 1, 0], "fov_deg": 50}
        self.done("set", path="scene.camera", value=camera)
        self.assertNotIn("update_radiance_cache", self.reused())
        self.done("set", path="image.width", value=40)
        self.assertNotIn("update_radiance_cache", self.reused())

    def test_a_new_view_of_a_known_scene_is_checked_for_a_surface_alone(self):
        self.start(TINY)
        camera = {"position": [0, 1, 3], "target": [0, 1, 9], "fov_deg": 50}
        self.assertIn("no surface lies in its view", self.refusal("set", path="scene.camera", value=camera))
        camera["target"] = [0, 1, 0]
        self.done("set", path="scene.camera", value=camera)
        self.assertNotIn("black", str(self.done("set", path="image.exposure_stops", value=-20)["warnings"]))
        # Other lights are another scene
        lamp = {"point": [0, 1.5, 0], "intensity": [1, 1, 1]}
        self.assertIn("black", str(self.done("set", path="scene.lights", value=[lamp])["warnings"]))

    def test_what_is_refused_changes_nothing(self):
        self.start(TINY)
        self.assertIn("nothing is rendered", self.refusal("score"))
        before = self.done("config")["config"]
        for path, value, message in (("voxelize.resolution", "many", "voxelize.resolution"), ("voxelize.size", 4, "'size'"),
                                     ("gather_irradiance", "no_pass", "no_pass"), ("image.width", 0, "image.width"),
                                     ("scene.builtin", "nowhere", "nowhere"), ("sweep", {"seed": [1, 2]}, "one variant"),
                                     ("gather_irradiance", None, "expected a pass")):
            self.assertIn(message, self.refusal("set", path=path, value=value))
        self.assertIn("resolution-8, resolution-16", self.refusal("select", variant="resolution-9"))
        self.assertEqual(self.done("config")["config"], before)
        self.done("render")
        self.expect_images_of_run("--only", "voxelize.resolution=8")

        # Requests that are none
        for line in ("", "{", "[1]", '"set"', '{"id": 5}', '{"id": 5, "command": "set"}', '{"command": "st"}', "\x01", "{" * 200,
                     '{"id": 5, "command": "render", "frames": 2}', '{"id": 5, "command": "set", "path": "seed"}'):
            answer = self.send(line)
            self.assertFalse(answer["ok"], answer)
            self.assertRegex(answer["error"], r"request \d+|the request")
        self.done("render")

    def test_a_variant_stands_alone(self):
        # What other variants of the sweep need is neither refused nor warned of
        greeting = self.start(TINY.replace("voxelize, resolution: 16", "voxelize, resolution: 16, samples_per_voxel_edge: 2").replace(
            "voxelize.resolution: [8, 16]", "voxelize.method: [exact, three_axis]"))
        images = []
        for variant in greeting["variants"]:
            self.done("select", variant=variant["id"])
            self.done("render")
            images.append(self.bytes("shown", "final.exr"))
        self.assertNotEqual(*images)
        self.start(TINY.replace("voxelize.resolution: [8, 16]", "gather_irradiance: [{pass: path_trace, light: indirect}, gather_irradiance]"))
        self.assertNotIn("never run", str(self.done("select", variant="path_trace")["warnings"]))
        graph = [*self.done("config")["config"]["graph"], {"pass": "voxelize", "id": "idle"}]
        self.assertIn("'idle' is never run", str(self.done("set", path="graph", value=graph)["warnings"]))

    def test_it_needs_a_config_that_is_right(self):
        self.write("wrong.yaml", TINY.replace("resolution: 16", "resolution: x"))
        self.expect(2, "session", "wrong.yaml", "--stdio", "--images", "shown")
        self.expect(2, "session", "wrong.yaml", "--images", "shown")

    def test_random_changes_give_the_images_of_fresh_sessions(self):
        differ, (taken, refused, renders), _ = session_changes.run(PROGRAM, 24, 3, self.folder)
        self.assertEqual(differ, [])
        self.assertGreater(min(taken, refused, renders), 3)
