"""Tests of what the report reads from result files, and of what it writes."""

from __future__ import annotations

import base64
import io
import math
import unittest
from unittest import mock

from report_support import ReportTest, made_up

from report import images, text
from report.load import load
from report.results import ReportError
from PIL import Image


class Reading(ReportTest):
    def test_names_stay_text_and_scores_become_numbers(self):
        rows = [made_up.variant("001", 10, 0.3, resolution="064"),
                made_up.variant("None", 20, 0.2, resolution="1e2")]
        results = load(made_up.write_results(self.directory, rows, made_up.manifest(["resolution"]), images=False))
        self.assertEqual(list(results.variants["variant"]), ["001", "None"])
        self.assertEqual(list(results.variants["resolution"]), ["064", "1e2"])
        self.assertEqual(results.sweep_keys, ["resolution"])
        self.assertEqual(results.variants["nrmse"][1], 0.2)
        self.assertTrue(math.isnan(results.variants["indirect_nrmse"][0]))

    def test_no_results(self):
        self.directory.mkdir(parents=True)
        with self.assertRaisesRegex(ReportError, "no such file"):
            load(self.directory)
        (self.directory / "results.csv").write_bytes(b"\xff\xfe\x00")
        self.assertEqual(self.run_program()[0], 2)
        (self.directory / "results.csv").write_text("a,b\n1,2\n")
        status, errors = self.run_program()
        self.assertEqual(status, 2)
        self.assertRegex(errors, "no column 'variant'")
        self.assertEqual(errors.count("\n"), 1)

    def test_broken_files_are_refused_by_name(self):
        for name, content, words in (("passes.csv", "what,is\nthis,here\n", "passes.csv: has no column 'variant'"), ("passes.csv", None, "passes.csv: no such file"),
                                     ("values.csv", "what,is\nthis,here\n", "values.csv: has no column 'variant'"), ("frames.csv", "variant\na\n", "no column 'frame'"),
                                     ("manifest.json", '{"commit": ', "manifest.json: cannot read"), ("manifest.json", None, "manifest.json: cannot read")):
            made_up.write_results(self.directory, [made_up.variant("a", 10, 0.3)], made_up.manifest([]), images=False)
            path = self.directory / name
            path.write_text(content) if content else path.unlink()
            status, errors = self.run_program()
            self.assertEqual(status, 2)
            self.assertIn(words, errors)
            path.unlink(missing_ok=True)


class Writing(ReportTest):
    def test_failed_writing_keeps_the_old_page(self):
        self.make([made_up.variant("a", 10, 0.3)], made_up.manifest([]), images=False)
        old = (self.directory / "report.html").read_bytes()
        before = sorted(self.directory.iterdir())
        with mock.patch("os.fsync", side_effect=OSError(28, "No space left on device")):
            status, errors = self.run_program()
        self.assertEqual(status, 1)
        self.assertIn("No space left on device", errors)
        self.assertEqual(old, (self.directory / "report.html").read_bytes())
        self.assertEqual(before, sorted(self.directory.iterdir()))

    def test_error_map_in_false_colours(self):
        self.directory.mkdir(parents=True)
        path = self.directory / "flip.png"
        grey = Image.new("L", (3, 1))
        grey.putdata([0, 128, 255])
        grey.save(path)
        picture = images.embed_error(path)
        self.assertEqual((picture.width, picture.height), (3, 1))
        data = io.BytesIO(base64.b64decode(picture.uri.split(",")[1]))
        # Magma's ends are (0.001462, 0.000466, 0.013866) and (0.987053, 0.991438, 0.749504).
        colors = list(Image.open(data).convert("RGB").getdata())
        self.assertEqual((colors[0], colors[2]), ((0, 0, 4), (252, 253, 191)))

    def test_numbers_for_a_reader(self):
        self.assertEqual([text.ratio(x) for x in (0.99831, 1.00259, 0, 0.0123456, 12.345, math.nan)],
                         ["0.998", "1.003", "0", "0.0123", "12.3", "–"])
        self.assertEqual([text.figures(x) for x in (0.0123456, 12.345, 1234.5, 9.9999, 0, math.nan, math.inf, 1e-9)],
                         ["0.0123", "12.3", "1\u202f234", "10.0", "0", "–", "∞", "1.00e-09"])
        self.assertEqual(text.size(3 * 2**20), "3.00 MiB")
        self.assertEqual(text.count(262144), "262 k")

    def test_config_as_yaml(self):
        config = {"name": "x y", "image": {"width": 8}, "list": [1, 2], "graph": [{"pass": "a", "n": 1}],
                  "none": None, "quoted": "a: b", "empty": {}}
        self.assertEqual(text.yaml_of(config), "name: x y\nimage: {width: 8}\nlist: [1, 2]\ngraph:\n"
                         "- {pass: a, n: 1}\nnone: null\nquoted: 'a: b'\nempty: {}")
        self.assertEqual([text.plain(value) for value in ("null", ["null", None], 0.5, True)],
                         ["null", "['null', null]", "0.5", "true"])


if __name__ == "__main__":
    unittest.main()
