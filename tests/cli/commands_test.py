"""Commands that render nothing: usage, passes, devices, validate, schema, scene."""
import base64
import glob
import json
import os
import shutil
import subprocess
import unittest

import numpy as np
from PIL import Image

from support import PROGRAM, SOURCE, TINY, CommandTest


class Usage(CommandTest):
    def test_help_and_version(self):
        self.assertIn("validate", self.expect(0, "--help").stdout)
        told = self.expect(0, "run", "--help").stdout
        self.assertIn("--resume", told)
        for internal in ("{false}", "DIR:DIR"):
            self.assertNotIn(internal, told)
        self.assertRegex(self.expect(0, "--version").stdout, r"^voxray \d+\.\d+\.\d+\n$")

    def test_no_command_shows_help(self):
        done = self.voxray()
        self.assertEqual(done.returncode, 2)
        self.assertIn("validate", done.stderr)

    def test_unknown_command(self):
        self.assertIn("'passes'", self.expect(2, "pases").stderr)

    def test_unknown_option_and_missing_argument(self):
        self.assertIn("--jsn", self.expect(2, "compare", "a.png", "b.png", "--jsn").stderr)
        self.assertIn("REFERENCE", self.expect(2, "compare", "a.png").stderr)
        self.expect(2, "run")

    def test_full_standard_output(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "passes"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("voxray: error: cannot write", done.stderr)


class Passes(CommandTest):
    def test_list(self):
        out = self.expect(0, "passes").stdout
        for name in ("gbuffer", "voxelize", "inject_light_rays", "gather_irradiance", "composite", "path_trace"):
            self.assertRegex(out, rf"(?m)^  {name} ")
        families = [out.index(f"\n{name}: ") for name in ("voxels", "inject", "final_gather", "path_trace")]
        self.assertEqual(families, sorted(families))

    def test_list_with_measures(self):
        listed, schema = self.expect(0, "passes").stdout, self.expect(0, "schema").stdout
        with_measures = self.expect(0, "passes", "--experiments").stdout
        for name in ("compare_voxels", "probe_irradiance"):
            self.assertNotIn(name, listed)
            self.assertRegex(with_measures, rf"(?s)\n  gbuffer .*\nexperiments: .*\n  {name} ")
            self.assertIn(f"{name}\n", self.expect(0, "passes", name).stdout)
            self.assertIn(f'"{name}"', schema)
        self.expect(2, "passes", "--experiments", "gbuffer")

    def test_one(self):
        out = self.expect(0, "passes", "inject_light_rays").stdout
        self.assertRegex(" ".join(out.split()), r"rays_per_light Rays .* Default 1048576; integer from 1 to 67108864\.")
        self.assertIn("Outputs:", out)

    def test_ports_of_values(self):
        out = " ".join(self.expect(0, "passes", "sample_vpls").stdout.split())
        self.assertIn("(with first: rsm)", out)
        out = " ".join(self.expect(0, "passes", "gather_vpls").stdout.split())
        self.assertIn("(with visibility: hybrid_leaves)", out)

    def test_allowed_values(self):
        out = self.expect(0, "passes", "gather_cones").stdout
        self.assertRegex(" ".join(out.split()), r"cones Cones .* Default 16; 5 \| 6 \| 16 \| 36\.")

    def test_unknown(self):
        self.assertIn("'gbuffer'", self.expect(2, "passes", "gbufer").stderr)


class Devices(CommandTest):
    def test_devices(self):
        self.assertIn("embree", self.expect(0, "devices").stdout)
        self.assertIn("Nothing is missing", self.expect(0, "doctor").stdout)

    def test_a_localhost_that_does_not_resolve_is_told(self):
        for status, told in ((0, False), (2, True)):
            os.makedirs(self.path("bin"), exist_ok=True)
            self.write("bin/getent", f"#!/bin/sh\nexit {status}\n")
            os.chmod(self.path("bin", "getent"), 0o755)
            path = f"{self.path('bin')}:{os.environ['PATH']}"
            done = subprocess.run([os.path.join(SOURCE, "scripts", "doctor.sh")], env={**os.environ, "PATH": path},
                                  stdout=subprocess.PIPE, text=True)
            self.assertEqual('add "127.0.0.1 localhost" to /etc/hosts' in done.stdout, told, done.stdout)

    def test_a_doctor_that_cannot_build_does_not_send_to_itself(self):
        # The launcher alone, with a cmake that fails
        for name in ("scripts", "bin"):
            os.mkdir(self.path(name))
        shutil.copy(os.path.join(SOURCE, "voxray"), self.path("voxray"))
        for name in ("scripts/doctor.sh", "bin/cmake"):
            os.chmod(self.write(name, f"#!/bin/sh\nexit {int(name == 'bin/cmake')}\n"), 0o755)
        self.environment |= {"PATH": self.path("bin") + ":" + os.environ["PATH"], "VOXRAY_SKIP_SETUP": "1"}
        for command, sends in (("doctor", False), ("devices", True)):
            done = subprocess.run([self.path("voxray"), command], env=self.environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("cmake failed", done.stderr)
            self.assertEqual("'./voxray doctor' tells" in done.stderr, sends, done.stderr)

    def test_no_driver_is_an_error(self):
        self.take_drivers_away()
        told = self.expect(1, "devices").stderr
        self.assertRegex(told, r"^voxray: error: no Vulkan device found; install .*mesa-vulkan-drivers, version 25 or later\)\n$")
        self.write("tiny.yaml", TINY)
        for command in (("doctor",), ("run", "tiny.yaml"), ("run", "tiny.yaml", "--dry-run")):
            self.assertEqual(self.expect(1, *command).stderr, told, command)
        self.assertEqual(self.expect(0, "validate", "tiny.yaml").stderr, "")


class Validate(CommandTest):
    def test_good_config(self):
        self.write("tiny.yaml", TINY)
        out = self.expect(0, "validate", "tiny.yaml").stdout
        self.assertIn("tiny.yaml: valid, 2 variants", out)
        self.assertIn("--profile smaller: valid", out)

    def test_a_run_refuses_what_validate_does(self):
        """Of each stage of reading one; mistakes.py has the others."""
        for old, new, line, name in (("  - {pass: gbuffer}", "\t- {pass: gbuffer}", 6, "spaces"), ("width: 32", "widht: 32", 3, "'width'"),
                                     ("pass: composite", "pass: compsite", 11, "'composite'"),
                                     ("rays_per_light: 4096", "rays_per_light: 0", 8, "rays_per_light"),
                                     ("[8, 16]", "[8, -16]", 14, "resolution"),
                                     ("  - {pass: gbuffer}\n", "", 8, "direct_shadow_rays: missing port 'gbuffer'"),
                                     ("{builtin: cornell}", "{builtin: cornell, camera: rear}", 2, "'rear'"),
                                     ("{builtin: cornell}", "{file: nowhere.glb}", 2, "'nowhere.glb'"),
                                     ("spp: 8", "spp: 1", 12, "reference.spp"),
                                     ("inject_light_rays, id: inject, rays_per_light: 4096", "inject_rsm, id: inject", 8, "inject_rsm")):
            self.assertIn(old, TINY)
            self.write("bad.yaml", TINY.replace(old, new, 1))
            error = self.expect(2, "run", "bad.yaml", "--out", "out").stderr
            self.assertIn(f"bad.yaml:{line}: ", error)
            self.assertIn(name, error)
            self.assertFalse(os.path.exists(self.path("out")), "a bad config leaves no results folder")

    def test_bounces_are_counted_to_the_image(self):
        # Each brings three bounces: to what it looks up, and one more where it gathers from what reflects.
        methods = {"lookup": "[{pass: inject_light_rays, bounces: 3}, gather_irradiance]",
                   "rays": "[trace_gather_rays, gather_rays, filter_irradiance]",
                   "cones": "[filter_voxels, gather_cones]",
                   "more cones": "[{pass: inject_light_rays, bounces: 1}, {pass: filter_voxels, bounces: 1}, gather_cones]",
                   "merged": "[merge_voxels, trace_gather_rays, {pass: gather_rays, source: merged_voxels}]",
                   "cache": "[{pass: update_radiance_cache, bounces: 2}, trace_gather_rays, {pass: gather_rays, source: radiance_cache}]",
                   "hit faces": "[trace_gather_rays, {pass: light_hit_faces, bounces: 2}, {pass: gather_rays, source: hit_faces}]",
                   "vpls": "[{pass: sample_vpls, bounces: 3}, gather_vpls]",
                   "mirrors": "[{pass: inject_light_rays, bounces: 2}, {pass: gather_irradiance, id: below}, gather_mirror]",
                   "paths": "[{pass: path_trace, bounces: 3, light: indirect}, filter_irradiance]"}
        sweep = "sweep:\n  gather_irradiance:\n" + "".join(f"    {k}: {v}\n" for k, v in methods.items())
        self.write("same.yaml", TINY.replace("spp: 8, bounces: 2", "spp: 8, bounces: 3").replace(
            "sweep:\n  voxelize.resolution: [8, 16]\n", sweep))
        self.assertEqual(self.expect(0, "validate", "same.yaml").stderr, "")
        warnings = self.expect(0, "validate", "same.yaml", "--set", "reference.bounces=4").stderr
        for method in ("lookup", "more cones", "cache", "vpls", "mirrors", "paths"):
            self.assertIn(f"({method})", warnings)
        self.assertRegex(warnings, r"same\.yaml:8: .*'bounces: 3'.*\(rays and 2 more\)")

    def test_profile_and_set(self):
        self.write("tiny.yaml", TINY)
        out = self.expect(0, "validate", "tiny.yaml", "--profile", "smaller", "--set", "sweep=null").stdout
        self.assertEqual(out, "tiny.yaml --profile smaller: valid, 1 variant\n")
        self.assertIn("image.width", self.expect(2, "validate", "tiny.yaml", "--set", "image.width=0").stderr)

    def test_bytes_of_files_are_never_echoed(self):
        with open(self.path("noise.png"), "wb") as file:
            file.write(b"\x89PNG\x1b[2J\xff")
        glb = b'{"asset": {"version": "2.0"}, "scenes": [{"name": "\x1b[2J\xff", "nodes": [7]}]}'
        with open(self.path("a.gltf"), "wb") as file:
            file.write(glb)
        configs = [TINY.replace("name: tiny", 'name: "\\e[2J"').encode(),
                   TINY.replace("width", '"wi\\x9b\\n\\u202edth"').encode(),
                   TINY.replace("spp: 8", '"spp\\e[2J": 8').encode(),
                   TINY.replace("builtin: cornell", 'builtin: "cor\\0nell"').encode(),
                   TINY.encode().replace(b"tiny", b"ti\xff\x1bny"), b"\xff\xfe\x1b[2J: [",
                   TINY.replace("builtin: cornell", "file: a.gltf").encode()]
        commands = [["compare", "noise.png", "noise.png"], ["compare", "a\x1b[2J.exr", "b.exr"], ["\x1b[2J"],
                    ["validate", "--set\x1b[2J"]]
        for number, config in enumerate(configs):
            with open(self.path(f"{number}.yaml"), "wb") as file:
                file.write(config)
            commands.append(["run", "--dry-run", f"{number}.yaml"])
        for command in commands:
            with self.subTest(command):
                done = subprocess.run([PROGRAM, *command], cwd=self.folder, env=self.environment, capture_output=True)
                self.assertIn(done.returncode, (1, 2))
                said = done.stderr.decode("utf-8")
                self.assertRegex(said, r"\Avoxray: error: [^\x00-\x1f\x7f-\x9f\u2028-\u202e]+\n\Z")

    def test_missing_config(self):
        self.assertIn("nowhere.yaml", self.expect(2, "validate", "nowhere.yaml").stderr)
        self.assertIn("nowhere.yaml", self.expect(2, "run", "nowhere.yaml").stderr)

    def test_every_fault_is_told(self):
        self.write("one.yaml", TINY.replace("width", "widht"))
        self.write("two.yaml", TINY.replace("height", "hieght"))
        done = self.voxray("validate", "one.yaml", "two.yaml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("one.yaml", done.stderr)
        self.assertIn("two.yaml", done.stderr)

    def test_shipped_configs(self):
        configs = sorted(glob.glob(os.path.join(SOURCE, "configs", "**", "*.yaml"), recursive=True))
        if not os.path.isdir(os.path.join(SOURCE, "..", "shared", "scenes")):  # Else scenes of our own alone.
            configs = [c for c in configs if "file:" not in open(c, encoding="utf-8").read()]
        # Set-up does not install blender, and a config that names a program that is not there is an error
        os.mkdir(self.path("programs"))
        os.symlink("/bin/true", self.path("programs/blender"))
        self.environment["PATH"] += ":" + self.path("programs")
        self.assertTrue(configs)
        self.expect(0, "validate", *configs)


class Schema(CommandTest):
    def test_schema(self):
        schema = json.loads(self.expect(0, "schema").stdout)
        self.assertIn("2020-12", schema["$schema"])
        self.assertIn("graph", schema["properties"])
        self.assertIn("rays_per_light", json.dumps(schema))

    def test_the_docs_name_every_metric(self):
        schema = json.loads(self.expect(0, "schema").stdout)
        names = schema["properties"]["measure"]["properties"]["metrics"]["items"]["enum"]
        with open(os.path.join(SOURCE, "docs", "writing-a-config.md"), encoding="utf-8") as file:
            row = next(line for line in file if line.startswith("| `metrics` |"))
        self.assertEqual([name for name in names if f"`{name}`" not in row], [])


class SceneCommand(CommandTest):
    def test_a_built_in_scene_and_its_picture(self):
        out = self.expect(0, "scene", "cornell", "--picture", "box.png").stdout
        for words in ("36 triangles", "2 x 2 x 2 m", "emits [20, 20, 20] W/(m² sr)",
                      "lights: 0 punctual, 1 emissive material, no environment",
                      "objects: 'wall -x', 'wall +x', 'floor', 'ceiling', 'wall -z', 'tall box', 'short box', 'lamp'\n",
                      "camera: {position: [0, 1, 3.8], target: [0, 1, 0], fov_deg: 40}"):
            self.assertIn(words, out)
        with Image.open(self.path("box.png")) as picture:
            pixels = np.asarray(picture, float)
        self.assertEqual(pixels.shape, (180, 320, 3))
        # Red wall on the left, green one on the right
        left, right = pixels[90, 95], pixels[90, 224]
        self.assertGreater(left[0], 1.5 * left[1])
        self.assertGreater(right[1], 1.5 * right[0])

    def test_the_camera_to_paste_is_one_that_a_config_takes(self):
        # A square without a camera and lights: what is suggested looks at it.
        data = np.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 0, 0], [2, 2, 0], [0, 2, 0]], np.float32).tobytes()
        self.write("square.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "square", "children": list(range(1, 25))},
                      *({"mesh": 0, "name": f"square {i}"} for i in range(1, 25))],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [0, 0, 0],
                           "max": [2, 2, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
            "buffers": [{"byteLength": len(data),
                         "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}))
        out = self.expect(0, "scene", "square.gltf", "--picture", "square.png").stdout
        self.assertIn("nothing shines", out)
        self.assertRegex(out, "objects: .*'square', 'square 1', .* and [56] more\n")
        camera = out.splitlines()[out.splitlines().index("a camera to begin with:") + 1].strip()
        with Image.open(self.path("square.png")) as picture:
            pixels = np.asarray(picture, float)
        self.assertNotEqual(pixels[90, 160].tolist(), pixels[2, 2].tolist())
        self.write("tiny.yaml", TINY.replace("{builtin: cornell}",
                                             "{file: square.gltf, environment: 1, " + camera + "}"))
        self.expect(0, "validate", "tiny.yaml")
        position = camera[:camera.index("target")]  # the target may be another point of the same line
        self.assertIn(position, self.expect(0, "scene", "tiny.yaml").stdout)

    def test_unknown_scenes(self):
        self.assertIn("'cornell'", self.expect(2, "scene", "cornel").stderr)
        self.assertIn("'nowhere.glb'", self.expect(2, "scene", "nowhere.glb").stderr)
        self.expect(2, "scene", "nowhere.yaml")


if __name__ == "__main__":
    unittest.main()
