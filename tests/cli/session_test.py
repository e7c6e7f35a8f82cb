"""`voxray session`: its answers, and its images against those of `run`."""
import csv
import json
import os
import subprocess
import sys

import numpy as np
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

    def test_images_in_numpys_format(self):
        self.start(TINY)
        shown = self.done("render")["images"]
        with_numpy = self.start(TINY, "--format", "npy")
        self.assertEqual(with_numpy["protocol"], 1)
        for name, file in self.done("render")["images"].items():
            array = np.load(file)
            self.assertEqual(array.dtype, np.float32)
            channels = exr_pixels.read(shown[name])
            np.testing.assert_array_equal(array, np.stack([channels[channel] for channel in "RGB"], axis=-1), name)
        self.done("reference")
        self.done("score")
        self.assertEqual(np.load(self.path("shown", "flip.npy")).shape, (24, 32))
        self.assertIn("--format", self.expect(2, "session", "session.yaml", "--stdio", "--images", "shown", "--format", "png").stderr)

    def test_a_pass_on_which_the_image_does_not_depend(self):
        self.start(TINY)
        self.done("set", path="gather_irradiance", value={"pass": "path_trace", "light": "indirect", "spp": 1})
        self.assertIn("does not depend on 'inject'", "".join(self.done("set", path="inject.bounces", value=1)["warnings"]))
        self.assertNotIn("does not depend", "".join(self.done("set", path="gather_irradiance.spp", value=2)["warnings"]))

    def view(self, name, **parameters):
        """@return channels by name, or the array of a .npy file"""
        answer = self.done("view", name=name, parameters=parameters)
        if answer["file"].endswith(".npy"):
            array = np.load(answer["file"])
            self.assertEqual([list(array.shape), array.dtype], [answer["shape"], answer["type"]], name)
            return array
        channels = exr_pixels.read(answer["file"])
        self.assertEqual(set(channels), set(answer["channels"]), name)
        return channels

    def expect_same(self, channels, expected):
        for name, values in channels.items():
            self.assertEqual(values.tobytes(), expected[name].tobytes(), name)

    def test_views_are_what_a_run_writes(self):
        self.start(TINY)
        self.done("render")
        views = {one["name"]: one for one in self.done("views")["views"]}
        self.expect(0, "run", "session.yaml", "--only", "voxelize.resolution=8", "--out", "run", "--no-report", "--aovs")
        aovs = exr_pixels.read(self.path("run", "images", "resolution-8", "aovs.gbuffer.exr"))
        seen = set()
        for name, view in views.items():
            if view["kind"] != "aov":
                continue
            channels = self.view(name)
            self.assertEqual(view["shape"], [24, 32] + [len(channels)] * (len(channels) > 1), name)
            self.expect_same(channels, aovs)
            seen |= set(channels)
        self.assertEqual(seen, set(aovs))
        for name, file in (("composite.final", "final"), ("gather_irradiance.indirect", "indirect")):
            self.assertEqual(views[name]["quantity"], "radiance")
            self.expect_same(self.view(name), exr_pixels.read(self.path("run", "images", "resolution-8", file + ".exr")))
        # All others can be read, too
        for name, view in views.items():
            if view["kind"] == "voxels":
                continue
            self.assertTrue(os.path.isfile(self.done("view", name=name, picture=True)["picture"]), name)
            if view["kind"] == "buffer":
                self.assertEqual(list(self.view(name).shape), view["shape"])
        occupied = sum(int(word).bit_count() for word in self.view("voxelize.voxel occupancy"))
        self.assertEqual(self.view("voxelize.voxel materials").shape, (occupied, 9))
        # Nothing was touched
        self.assertEqual(self.reused(), {"voxelize", "inject"})
        self.expect_images_of_run("--only", "voxelize.resolution=8")

    def test_voxels_are_those_of_show_voxels(self):
        self.start(TINY)
        self.done("render")
        [voxels] = [one for one in self.done("views")["views"] if one["kind"] == "voxels"]
        self.assertEqual(voxels["name"], "show_voxels")
        self.assertEqual(voxels["shows"], ["albedo", "irradiance", "opacity", "normal"])
        self.write("voxels.yaml", TINY[:TINY.index("  - {pass: direct")].replace("resolution: 16", "resolution: 8")
                   + "  - {pass: show_voxels}\nsweep: {show_voxels.show: [albedo, irradiance, opacity, normal]}\n")
        self.expect(0, "run", "voxels.yaml", "--out", "run", "--no-report")
        for show in voxels["shows"]:
            self.expect_same(self.view("show_voxels", show=show), exr_pixels.read(self.path("run", "images", f"show-{show}", "final.exr")))
        self.assertEqual(self.reused(), {"voxelize", "inject"})
        self.expect_images_of_run("--only", "voxelize.resolution=8")

    def test_views_that_are_not_there(self):
        self.start(TINY)
        self.done("render")
        for name, parameters, message in (("gbuffer.Ns", {}, "did you mean 'gbuffer.N"), ("nothing", {}, "no view 'nothing'"),
                                          ("gbuffer.N", {"show": "albedo"}, "show_voxels"), ("show_voxels", {"show": "radiance"}, "'radiance'"),
                                          ("show_voxels", {"show": "colors"}, "show_voxels.show"), ("show_voxels", {"size": 1}, "'size'")):
            self.assertIn(message, self.refusal("view", name=name, parameters=parameters), (name, parameters))
        self.assertIn("N.X", self.view("gbuffer.N"))
        self.refusal("set", path="image.width", value=0)
        self.assertEqual(self.view("gbuffer.Z")["Z"].shape, (24, 32))

    def test_scores_and_views_are_of_the_current_values(self):
        self.start(TINY)
        first = self.done("score")["scores"]
        self.done("set", path="image.width", value=16)
        self.assertEqual(self.view("gbuffer.Z")["Z"].shape, (24, 16))
        self.done("set", path="image.width", value=32)
        self.done("set", path="voxelize.resolution", value=16)
        second = self.done("score")["scores"]
        self.done("select", variant="resolution-16")
        third = self.done("score")["scores"]
        self.assertNotEqual(first["nrmse"], second["nrmse"])
        self.assertEqual(second, third)
        self.done("render")
        self.assertEqual(self.done("score")["scores"], third)

    def test_a_variant_by_its_name(self):
        self.start(TINY)
        self.done("set", path="voxelize.resolution", value=12)
        self.refusal("set", path="image.width", value=0)
        self.done("set", path="image.width", value=16)
        self.done("set", path="voxelize.resolution", value=10)
        self.assertEqual(self.done("select", variant="resolution 16")["dropped"], ["image.width", "voxelize.resolution"])
        self.assertEqual(self.done("select", variant="resolution-8")["dropped"], [])
        self.done("render")
        self.expect_images_of_run("--only", "voxelize.resolution=8")

    def test_what_was_set_in_another_variant(self):
        greeting = self.start(TINY.replace("voxelize.resolution: [8, 16]", "gather_irradiance: [gather_irradiance, {pass: path_trace, light: indirect}]"))
        first, second = (variant["id"] for variant in greeting["variants"])
        self.done("set", path="image.width", value=16)
        self.done("set", path="gather_irradiance.radius", value=2)
        before = self.done("config")["config"]
        self.assertIn("radius", self.refusal("select", variant=second, keep=True))
        self.assertEqual(self.done("config")["config"], before)
        self.done("set", path="gather_irradiance.radius", value=None)
        self.assertEqual(self.done("select", variant=second, keep=True)["dropped"], [])
        self.done("set", path="graph", value=self.done("config")["config"]["graph"])
        self.assertEqual(self.done("select", variant=first, keep=True)["dropped"], ["graph"])
        self.assertEqual(self.done("config")["config"]["image"]["width"], 16)

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

    def test_a_reference_grows_until_it_is_that_of_a_run(self):
        self.use_own_references("grown")
        self.start(TINY.replace("spp: 8", "spp: 256"))
        looked = self.done("reference", ms=0)
        self.assertEqual((looked["samples"], looked["images"]), (0, {}))
        self.done("render")
        samples = [self.done("reference", ms=1)["samples"] for _ in range(3)]
        self.assertEqual(samples, sorted(set(samples)))
        self.assertLess(samples[2], 256)
        early = self.done("score")
        self.assertEqual((early["samples"], early["of"]), (samples[2], 256))
        self.assertLessEqual(early["scores"]["nrmse_low"], early["scores"]["nrmse"])
        self.assertGreater(early["scores"]["flip_noise"], 0)
        # Passes leave it alone, what it shows does not
        self.done("set", path="inject.bounces", value=1)
        self.assertEqual(self.done("reference", ms=0)["samples"], samples[2])
        self.done("set", path="image.width", value=40)
        self.assertEqual(self.done("reference", ms=0)["samples"], 0)
        self.done("set", path="image.width", value=32)
        self.assertEqual(self.done("reference", ms=0)["samples"], 0)

        whole = self.done("reference")
        self.assertEqual(whole["samples"], whole["of"])
        self.done("set", path="inject.bounces", value=2)
        self.done("render")
        late = self.done("score")["scores"]
        self.assertLess(late["flip_noise"], early["scores"]["flip_noise"])
        # A run that renders it at once
        self.use_own_references("at-once")
        self.expect(0, "run", "session.yaml", "--out", "run", "--no-report", "--only", "voxelize.resolution=8")
        for name in ("final", "indirect"):
            at_once = exr_pixels.rgb(self.path("run", "images", "reference", name + ".exr"))
            np.testing.assert_array_equal(at_once, exr_pixels.rgb(whole["images"][name]), name)
        with open(self.path("run", "results.csv"), newline="", encoding="utf-8") as file:
            [row] = csv.DictReader(file)
        for column in ("nrmse", "nrmse_low", "indirect_flip"):
            self.assertAlmostEqual(float(row[column]), late[column], 6)
        # Whoever renders the same one later takes it from the cache
        self.done("set", path="seed", value=8)
        self.assertEqual(self.done("reference", ms=0)["samples"], 0)
        self.done("set", path="seed", value=7)
        self.assertEqual(self.done("reference", ms=0)["samples"], whole["of"])
        self.assertIn("0 or more", self.refusal("reference", ms=-1))
        self.done("set", path="reference", value=None)
        self.assertIn("no reference", self.refusal("reference"))

    def test_what_is_refused_changes_nothing(self):
        self.start(TINY)
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
        greeting = self.start(TINY.replace("{builtin: cornell}", "{builtin: cornell, time_step: 0.1, moving_spheres: {count: 2}}").replace(
            "voxelize.resolution: [8, 16]", "scene.moving_spheres.count: [0, 2]"))
        for variant, has_time in zip(greeting["variants"], (False, True), strict=True):
            self.done("select", variant=variant["id"])
            self.assertEqual("time_step" in self.done("config")["config"]["scene"], has_time)
            self.done("render")

    def test_it_needs_a_config_that_is_right(self):
        self.write("wrong.yaml", TINY.replace("resolution: 16", "resolution: x"))
        self.expect(2, "session", "wrong.yaml", "--stdio", "--images", "shown")
        self.expect(2, "session", "wrong.yaml", "--images", "shown")

    def test_random_changes_give_the_images_of_fresh_sessions(self):
        differ, (taken, refused, renders), _ = session_changes.run(PROGRAM, 40, 3, self.folder)
        self.assertEqual(differ, [])
        self.assertGreater(min(taken, refused, renders), 3)
