"""Scenes of files: export-scene, and the tutorial's config of one."""
import json
import os
import pathlib
import struct
import sys
import unittest

import numpy as np

from support import SOURCE, TINY, CommandTest

sys.path.insert(0, os.path.join(SOURCE, "tests", "scale"))
import gltf_cases


class Tutorial(CommandTest):
    def test_its_config_renders_the_scene_of_a_file(self):
        with open(os.path.join(SOURCE, "docs", "tutorial.md"), encoding="utf-8") as file:
            config = file.read().split("```yaml\n")[1].split("```")[0]
        self.write("tiny.yaml", TINY)
        self.expect(0, "export-scene", "tiny.yaml", "room.glb")
        self.assertIn("cameras: 1", self.expect(0, "scene", "room.glb").stdout)
        # Its lamp hangs above this lower room.
        self.assertIn("point: [0, 2.2, 0]", config)
        self.write("room.yaml", config.replace("point: [0, 2.2, 0]", "point: [0, 1.8, 0]"))
        done = self.expect(0, "validate", "room.yaml")
        self.assertEqual((done.stdout, done.stderr), ("room.yaml: valid, 5 variants\n", ""))


    def test_scene_writes_it(self):
        with open(os.path.join(SOURCE, "docs", "tutorial.md"), encoding="utf-8") as file:
            config = file.read().split("```yaml\n")[1].split("```")[0]
        self.write("tiny.yaml", TINY)
        self.expect(0, "export-scene", "tiny.yaml", "room.glb")
        os.mkdir(self.path('else"where'))
        os.rename(self.path("room.glb"), self.path('else"where', "room.glb"))
        out = "room.yaml"
        self.expect(0, "scene", 'else"where/room.glb', "--write-config", out)
        with open(self.path(out), encoding="utf-8") as file:
            written = file.read()
        self.assertEqual(written.split("image: ")[1], config.split("image: ")[1])
        done = self.expect(0, "validate", out)
        self.assertEqual((done.stdout, done.stderr), (out + ": valid, 5 variants\n", ""))
        self.assertIn("it is there already", self.expect(2, "scene", 'else"where/room.glb', "--write-config", out).stderr)
        self.expect(0, "scene", "plane", "--write-config", "plane.yaml")
        self.expect(0, "validate", "plane.yaml")

    def test_a_dark_room_gets_an_exposure(self):
        self.write("dark.yaml", TINY.replace("{builtin: cornell}", "{builtin: cornell, override: {lamp: {emission: [0.02, 0.02, 0.02]}}}"))
        self.expect(0, "export-scene", "dark.yaml", "dark.glb")
        self.expect(0, "scene", "dark.glb", "--write-config", "found.yaml")
        written = self.bytes("found.yaml").decode()
        self.assertIn("# Its own lights are seen", written)
        # The lamp has a thousandth of the 20 W/(m² sr) with which the room is bright enough
        self.assertIn(int(written.split("exposure_stops: ")[1].split("}")[0]), (10, 11, 12))

    def test_objects_may_be_hidden(self):
        self.write("tiny.yaml", TINY.replace("{builtin: cornell}", "{builtin: cornell, hide: [tall box, red]}"))
        self.expect(0, "validate", "tiny.yaml")


class GeneratedFiles(CommandTest):
    def test_each_is_read_or_refused_with_its_cause(self):
        """A sixth of the files that gltf_chain.py renders all of."""
        folder = pathlib.Path(self.path("cases"))
        expected = gltf_cases.write_cases(folder)
        for file, good in list(expected.items())[::6]:
            with self.subTest(file):
                done = self.voxray("scene", str(folder / file))
                self.assertIn(done.returncode, (0,) if good else (1, 2), done.stderr)
                self.assertEqual(done.stderr.count("voxray: error: "), 0 if good else 1, done.stderr)


class ExportScene(CommandTest):
    def document(self, name):
        data = self.bytes(name)
        magic, version, length, chunk, kind = struct.unpack_from("<IIIII", data)
        self.assertEqual((magic, version, length, kind), (0x46546C67, 2, len(data), 0x4E4F534A))
        return json.loads(data[20:20 + chunk])

    def test_camera_and_lights_are_in_it(self):
        self.write("tiny.yaml", TINY.replace("{builtin: cornell}", """
  builtin: cornell
  camera: {position: [0, 1, 3], target: [0, 1, 0], fov_deg: 50}
  lights: [{point: [0, 1.5, 0], intensity: [1, 2, 3]}]"""))
        self.expect(0, "export-scene", "tiny.yaml", "out.glb")
        document = self.document("out.glb")
        cameras = [camera["perspective"]["yfov"] for camera in document["cameras"]]
        self.assertTrue(any(abs(fov - np.radians(50)) < 1e-5 for fov in cameras), cameras)
        lights = document["extensions"]["KHR_lights_punctual"]["lights"]
        self.assertTrue(any(light["type"] == "point" for light in lights), lights)
        placed = [node["extensions"]["KHR_lights_punctual"]["light"] for node in document["nodes"]
                  if "KHR_lights_punctual" in node.get("extensions", {})]
        self.assertEqual(sorted(placed), list(range(len(lights))))

    def test_a_frame_of_what_moves_and_masks(self):
        self.write("tiny.yaml", TINY.replace("{builtin: cornell}", """
  builtin: cornell
  camera: {position: [0, 1, 3], target: [0, 1, 0], fov_deg: 50, move: [0.1, 0, 0]}
  lights: [{point: [0, 1.5, 0], intensity: 1, move: [0, -0.1, 0], off_at: 3}]""") + "  masked: {measure.masks: {floor: {object: floor}}}\n")
        for words, frame, place, height in ((["--frame", "2"], 2, 0.2, 1.3), ([], None, 0, 1.5)):
            self.expect(0, "export-scene", "tiny.yaml", "out.glb", *words)
            sidecar = self.json("out.json")
            self.assertEqual(sidecar.get("frame"), frame)
            self.assertAlmostEqual(sidecar["camera"]["position"][0], place, 5)
            self.assertAlmostEqual(sidecar["lights"][0]["position"][1], height, 5)
        self.expect(0, "export-scene", "tiny.yaml", "out.glb", "--frame", "3")
        self.assertEqual(self.json("out.json")["lights"][0]["intensity"], [0, 0, 0])
        self.assertNotIn("out.mask.floor.png", self.files())
        self.expect(0, "export-scene", "tiny.yaml", "out.glb", "--profile", "masked")
        self.assertIn("out.mask.floor.png", self.files())

    def test_bad_target(self):
        self.write("tiny.yaml", TINY)
        self.assertIn("tiny.yaml", self.expect(1, "export-scene", "tiny.yaml", "tiny.yaml/out.glb").stderr)
        self.expect(2, "export-scene", "nowhere.yaml", "out.glb")


if __name__ == "__main__":
    unittest.main()
