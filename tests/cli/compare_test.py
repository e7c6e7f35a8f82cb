"""The command compare: scores of images, layers, noise of a reference's halves."""
import json
import os
import sys
import unittest

import numpy as np
from PIL import Image

from support import SOURCE, CommandTest

sys.path.insert(0, os.path.join(SOURCE, "tests", "unit"))
import exr_writer


def linear(display):
    """sRGB, 0..255, to linear."""
    value = display / 255
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


class Compare(CommandTest):
    def image(self, name, value, size=(40, 30)):
        Image.fromarray(np.full((size[1], size[0], 3), value, np.uint8)).save(self.path(name))
        return name

    def scores(self, *arguments):
        return json.loads(self.expect(0, "compare", *arguments, "--json").stdout)

    def test_equal_images(self):
        self.image("a.png", 120)
        scores = self.scores("a.png", "a.png")["scores"]
        self.assertEqual((scores["flip"], scores["flip_ldr"], scores["nrmse"], scores["relmse"]), (0, 0, 0, 0))
        self.assertAlmostEqual(scores["ssim"], 1, places=6)
        self.assertAlmostEqual(scores["mean_ratio"], 1, places=6)
        self.assertGreaterEqual(scores["psnr_db"], 100)
        better = json.loads(self.expect(0, "compare", "a.png", "a.png", "--json").stdout)["better"]
        self.assertEqual(set(better), set(scores))
        self.assertEqual((better["nrmse"], better["ssim"], better["mean_ratio"]), ("low", "high", "one"))

    def test_closed_forms(self):
        self.image("test.png", 90)
        self.image("reference.png", 180)
        ratio = linear(90) / linear(180)
        result = self.scores("test.png", "reference.png")
        self.assertAlmostEqual(result["scores"]["mean_ratio"], ratio, places=5)
        self.assertAlmostEqual(result["scores"]["nrmse"], 1 - ratio, places=5)
        self.assertAlmostEqual(result["scores"]["relmse"], (1 - ratio) ** 2 / 1.01, places=5)
        self.assertAlmostEqual(result["scores"]["psnr_db"], 20 * np.log10(255 / 90), places=3)
        self.assertAlmostEqual(result["black"]["nrmse"], 1, places=6)
        self.assertAlmostEqual(result["constant"]["nrmse"], 0, places=5)

    def test_exposure_changes_display_metrics_only(self):
        self.image("test.png", 90)
        self.image("reference.png", 180)
        plain = self.scores("test.png", "reference.png")["scores"]
        dark = self.scores("test.png", "reference.png", "--exposure", "-2")["scores"]
        self.assertEqual(plain["nrmse"], dark["nrmse"])
        self.assertEqual(plain["flip"], dark["flip"])
        self.assertNotAlmostEqual(plain["psnr_db"], dark["psnr_db"], places=1)

    def test_layers_are_chosen_and_told(self):
        names = [f"View.{layer}.{channel}" for layer in ("AO", "Combined") for channel in "BGR"]
        values = np.ones((30, 40, 6), np.float32) * (4, 4, 4, 1, 1, 1)
        with open(self.path("layers.exr"), "wb") as file:
            file.write(exr_writer.exr(values, False, names))
        with open(self.path("plain.exr"), "wb") as file:
            file.write(exr_writer.exr(values[:, :, :3], False))
        for more, ratio, taken in (((), 1, "View.Combined"), (("--layer", "AO"), 0.25, "View.AO")):
            done = self.expect(0, "compare", "layers.exr", "plain.exr", "--json", *more)
            self.assertAlmostEqual(json.loads(done.stdout)["scores"]["mean_ratio"], ratio, places=6)
            self.assertEqual(done.stderr, f"voxray: layers.exr: layer '{taken}' of 2 is compared\n")
        self.assertIn("View.Combined", self.expect(2, "compare", "layers.exr", "plain.exr", "--layer", "Depth").stderr)
        self.expect(2, "compare", "plain.exr", "plain.exr", "--layer", "Depth")

    def test_a_part_alone(self):
        self.image("reference.png", 180)
        halves = np.full((30, 40, 3), 180, np.uint8)
        halves[:, 20:] = 90
        Image.fromarray(halves).save(self.path("test.png"))
        ratio = linear(90) / linear(180)
        for part, expected in (("0,0,20,30", 1), ("20,5,20,25", ratio), ("10,0,20,30", (1 + ratio) / 2)):
            scores = self.scores("test.png", "reference.png", "--part", part)["scores"]
            self.assertAlmostEqual(scores["mean_ratio"], expected, places=5)
        for part in ("21,0,20,30", "0,0,0,30"):
            self.assertIn("--part", self.expect(2, "compare", "test.png", "reference.png", "--part", part).stderr)

    def test_table(self):
        self.image("a.png", 90)
        lines = self.expect(0, "compare", "a.png", "a.png").stdout.splitlines()
        self.assertEqual(lines[0].split(), self.metrics())
        self.assertEqual([line.split()[0] for line in lines[1:]], ["test", "black", "constant"])

    def test_halves_next_to_the_reference_take_its_noise_off(self):
        for name, value in (("test", 90), ("reference", 180), ("reference_a", 180), ("reference_b", 180)):
            self.image(f"{name}.png", value)
        result = self.scores("test.png", "reference.png")
        error = 1 - linear(90) / linear(180)
        for key in ("nrmse", "nrmse_low", "nrmse_high"):
            self.assertAlmostEqual(result["scores"][key], error, places=5)
        # Without noise its floor is what a perfect image scores
        perfect = self.scores("reference.png", "reference.png")["scores"]
        self.assertEqual(result["noise"], {name: perfect[name] for name in result["noise"]})
        self.assertEqual((result["noise"]["flip"], result["noise"]["ssim"]), (0, 1))
        self.assertFalse({"nrmse", "relmse", "mean_ratio"} & set(result["noise"]))
        lines = self.expect(0, "compare", "test.png", "reference.png").stdout.splitlines()
        self.assertEqual([line.split()[0] for line in lines[1:]], ["test", "95", "95", "black", "constant", "noise"])

        # What isn't their mean is no half of it
        self.image("reference_b.png", 181)
        self.assertIn("reference_b.png", self.expect(1, "compare", "test.png", "reference.png").stderr)

    def test_flip_map(self):
        self.image("test.png", 90)
        self.image("reference.png", 180)
        self.expect(0, "compare", "test.png", "reference.png", "--flip-map", "map.png")
        with Image.open(self.path("map.png")) as written:
            self.assertEqual(written.size, (40, 30))
            self.assertGreater(np.asarray(written).mean(), 0)

    def test_previews_are_told_from_radiance(self):
        self.image("a.png", 90)
        for more in ((), ("--json",)):
            self.assertRegex(self.expect(0, "compare", "a.png", "a.png", *more).stderr, r"^voxray: warning: a\.png: .*\n$")

    def test_bad_images(self):
        self.image("a.png", 90)
        self.image("b.png", 90, (10, 10))
        self.assertIn("40x30", self.expect(2, "compare", "a.png", "b.png").stderr)
        self.assertIn("missing.exr", self.expect(2, "compare", "a.png", "missing.exr").stderr)
        for name, text in (("broken.png", "not an image"), ("table.csv", "a,b\n1,2\n"), ("notes", "")):
            self.write(name, text)
            for files in (("a.png", name), (name, "a.png")):
                self.assertIn(f"voxray: error: {name}: ", self.expect(2, "compare", *files).stderr)
        self.expect(2, "compare", "a.png", ".")
        self.assertIn("a.png", self.expect(1, "compare", "a.png", "a.png", "--flip-map", "a.png/map.png").stderr)


if __name__ == "__main__":
    unittest.main()
