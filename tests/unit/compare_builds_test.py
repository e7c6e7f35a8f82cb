"""scripts/compare_builds.py on small results made by hand."""
import contextlib
import io
import os
import sys
import tempfile
import types
import unittest

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import compare_builds  # noqa: E402
from exr_writer import exr  # noqa: E402
from report import exr_pixels  # noqa: E402

HEADER = "variant,status,error,device,tracer,x.size,build_ms,frame_ms_median,memory_bytes,rays,flip,nrmse"


class CompareBuilds(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        self.image = numpy.random.default_rng(1).random((37, 5, 3)).astype(numpy.float32).round(1)

    def write(self, side, rows, image=None, variant="size-1", config="configs_one"):
        folder = os.path.join(self.root, side, config)
        os.makedirs(os.path.join(folder, "images", variant), exist_ok=True)
        with open(os.path.join(folder, "results.csv"), "w", encoding="utf-8") as file:
            file.write("\n".join([HEADER, *rows]) + "\n")
        with open(os.path.join(folder, "images", variant, "final.exr"), "wb") as file:
            file.write(exr(self.image if image is None else image, zipped=side == "b"))

    def compare(self, ignore=()):
        """(whether something differs, what is printed)"""
        options = types.SimpleNamespace(filter="", ignore=ignore, lines=20)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            differ = compare_builds.compare(options, os.path.join(self.root, "a"), os.path.join(self.root, "b"), {})
        return differ, printed.getvalue()

    def test_pixels_are_read(self):
        for zipped in (False, True):
            path = os.path.join(self.root, "image.exr")
            with open(path, "wb") as file:
                file.write(exr(self.image, zipped))
            channels = exr_pixels.read(path)
            for i, name in enumerate("RGB"):
                self.assertTrue((channels[name] == self.image[:, :, i]).all())

    def test_clocks_do_not_count(self):
        self.write("a", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"])
        self.write("b", ["size-1,ok,,gpu,embree,1,20,30,100,7,0.5,0.2"])
        differ, text = self.compare()
        self.assertFalse(differ)
        self.assertRegex(text, r"configs_one +1 +0 +0\.0e\+00 +0\.0e\+00 +0\.0e\+00 +1\.500 +2\.000")

    def test_one_bit_of_a_pixel_counts(self):
        changed = self.image.copy()
        changed[30, 2, 1] = numpy.nextafter(changed[30, 2, 1], numpy.float32(2))
        self.write("a", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"])
        self.write("b", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"], changed)
        differ, text = self.compare()
        self.assertTrue(differ)
        self.assertIn("final.exr: 1 of 185 pixels", text)

    def test_numbers_count_unless_ignored(self):
        self.write("a", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"])
        self.write("b", ["size-1,ok,,gpu,embree,1,10,20,101,7,0.5,0.2"])
        self.assertTrue(self.compare()[0])
        self.assertFalse(self.compare(ignore=["memory"])[0])
        self.write("b", ["size-1,ok,,gpu,embree,1,10,20,100,8,0.5,0.2"])
        self.assertTrue(self.compare()[0])
        self.write("b", ["size-1,failed,why,gpu,embree,1,,,,,,"])
        self.assertTrue(self.compare()[0])

    def test_changes_are_relative(self):
        self.write("a", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"], 2 * numpy.ones_like(self.image))
        self.write("b", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.3"], 3 * numpy.ones_like(self.image))
        self.assertRegex(self.compare()[1], r"configs_one +1 +2 +5\.0e-01 +5\.0e-01 +5\.0e-01 ")

    def test_variants_with_other_names_are_paired_in_order(self):
        self.write("a", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"])
        self.write("b", ["width-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"], variant="width-1")
        differ, text = self.compare()
        self.assertFalse(differ)
        self.assertIn("paired by order: size-1 and width-1", text)

    def test_what_is_missing_counts(self):
        self.write("a", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"])
        self.write("b", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"])
        os.remove(os.path.join(self.root, "b", "configs_one", "images", "size-1", "final.exr"))
        self.assertTrue(self.compare()[0])
        self.write("b", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2", "size-2,ok,,gpu,embree,2,10,20,100,7,0.5,0.2"])
        self.assertTrue(self.compare()[0])
        self.write("a", ["size-1,ok,,gpu,embree,1,10,20,100,7,0.5,0.2"], config="configs_two")
        self.assertIn("no results.csv in b", self.compare()[1])

    def test_small_profiles_are_found(self):
        path = os.path.join(self.root, "config.yaml")
        for text, small in (("profiles:\n  # Fast.\n  small:\n    x: 1\n", True), ("name: x\nsmall: 1\n", False),
                            ("profiles:\n  large: {x: 1}\n\n  small: {x: 1}\n", True), ("profiles: {}\n", False)):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            self.assertEqual(compare_builds.has_small_profile(path), small, text)


if __name__ == "__main__":
    unittest.main()
