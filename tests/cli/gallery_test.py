"""scripts/gallery.py on a tiny run, and docs/gallery.md against the configs that it shows."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from PIL import Image
from support import PROGRAM, SOURCE, TINY, CommandTest

sys.path.insert(0, os.path.join(SOURCE, "scripts"))
import gallery  # noqa: E402

# One variant, with tiles of some blocks of pixels
CONFIG = TINY.partition("sweep:")[0].replace("{width: 32, height: 24}", "{width: 128, height: 72}").replace(
    "  - {pass: voxelize,", "  # Few voxels\n  - {pass: voxelize,") + "measure: {frames: 1, warmup: 0}\n"
GRAPH = CONFIG[CONFIG.index("graph:"):CONFIG.index("reference:")]
PAGE = "# Before\n<!-- gallery: tiny -->\nold\n<!-- end -->\nbetween\n<!-- gallery: other -->\nkept\n<!-- end -->\n"


class Gallery(CommandTest):
    def gallery(self, *arguments):
        return subprocess.run([sys.executable, os.path.join(SOURCE, "scripts", "gallery.py"), *arguments, "--program", PROGRAM,
                               "--out", "out", "--pictures", "pictures", "--page", "page.md"], cwd=self.folder,
                              env=self.environment, capture_output=True, text=True)

    def test_a_picture_and_a_section_of_a_run(self):
        self.write("tiny.yaml", CONFIG)
        self.write("page.md", PAGE)
        done = self.gallery("tiny.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = Path(self.path("page.md")).read_text(encoding="utf-8")
        self.assertRegex(page, r"\A# Before\n<!-- gallery: tiny -->\n!\[[^]]+\]\(pictures/tiny.jpg\)\n\n"
                               r"\| frame \| build \|.*\n\|.*\n\| [\d.]+ s \|.*\| 8 samples a pixel, [\d.]+ s \|\n\n```yaml\n")
        self.assertIn(f"```yaml\n{GRAPH}```\n<!-- end -->\nbetween\n<!-- gallery: other -->\nkept\n<!-- end -->\n", page)

        final = self.path("out", "tiny", "images", "default", "final.png")
        with Image.open(self.path("pictures", "tiny.jpg")) as picture, Image.open(final) as ours:
            self.assertEqual(picture.width, 128)
            self.assertGreater(picture.height, 72 + 72 // 3)
            top = np.asarray(picture.crop((0, 0, 128, 72)), dtype=float) - np.asarray(ours.convert("RGB"), dtype=float)
        self.assertLess(abs(top).mean(), 8)  # Of 255, by JPEG

        # What is finished stays
        done = self.gallery("tiny.yaml")
        self.assertIn("1 of 1", done.stdout)
        self.assertEqual(Path(self.path("page.md")).read_text(encoding="utf-8"), page)

    def test_what_can_not_be_shown(self):
        self.write("page.md", PAGE)
        self.write("two.yaml", CONFIG + "sweep: {voxelize.resolution: [8, 16]}\n")
        self.write("nowhere.yaml", CONFIG)
        for name, message in (("two", "2 finished variants"), ("nowhere", "no lines '<!-- gallery: nowhere -->'")):
            done = self.gallery(f"{name}.yaml")
            self.assertEqual(done.returncode, 1)
            self.assertIn(message, done.stderr)
        self.assertEqual(self.gallery("absent.yaml").returncode, 2)

    def test_relative_error_of_black_is_none(self):
        self.assertEqual(gallery.relative(np.array([1.0, 0.0]), np.array([2.0, 0.0])).tolist(), [0.5, 0])

    def test_the_part_with_the_largest_error(self):
        error = np.zeros((20, 30))
        error[5:9, 11:17] = 1
        self.assertEqual(gallery.worst_window(error, 6, 4), (11, 5))


class Page(unittest.TestCase):
    def test_the_page_shows_every_config_as_it_stands(self):
        page = Path(SOURCE, "docs", "gallery.md").read_text(encoding="utf-8")
        configs = sorted(Path(SOURCE, "configs", "gallery").glob("*.yaml"))
        self.assertGreaterEqual(len(configs), 8)
        for config in configs:
            with self.subTest(config=config.stem):
                _, found, rest = page.partition(f"<!-- gallery: {config.stem} -->\n")
                self.assertTrue(found)
                self.assertIn(f"```yaml\n{gallery.graph_of(config)}```\n", rest.partition("<!-- end -->")[0])
                with Image.open(Path(SOURCE, "docs", "images", "gallery", f"{config.stem}.jpg")) as picture:
                    self.assertEqual(picture.width, 1280)


if __name__ == "__main__":
    unittest.main()
