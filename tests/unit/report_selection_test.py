"""Tests of which variants a page shows with their images, and of what stays of the others."""

from __future__ import annotations

import unittest
from unittest import mock

from report_support import Page, ReportTest, made_up, numbers_of

from report import charts, make_report, ranking, selection
from report.load import load


def five() -> list[dict]:
    """a, b and d are on the front of time against error; c is beaten by b, e by all."""
    table = (("a", 10, 0.5), ("b", 20, 0.3), ("c", 25, 0.4), ("d", 40, 0.1), ("e", 50, 0.6))
    return [made_up.variant(name, ms, error) for name, ms, error in table]


class Selection(ReportTest):
    def selected(self, *wanted: str) -> str:
        results = load(self.directory)
        return "".join(selection.selected(results, results.lights(), list(wanted)))

    def write(self, rows=None, run=None, **options):
        made_up.write_results(self.directory, rows or five(), run or made_up.manifest([]), indirect=False, **options)

    def test_all_the_front_or_some_by_number_or_name(self):
        self.write()
        for wanted, expected in (("", "abcde"), ("all", "abcde"), ("front", "abd"), ("2 e", "be"), ("front 5", "abde")):
            self.assertEqual(self.selected(*wanted.split()), expected, wanted)

    def test_what_is_no_variant_is_refused_by_name(self):
        self.write()
        self.assertEqual(make_report.main([str(self.directory), "--images", "front", "7"]), 2)
        self.assertFalse((self.directory / "report.html").exists())

    def test_each_scene_has_a_front_of_its_own(self):
        rows = five()
        for row in rows:
            row["scene"] = "cornell" if row["variant"] in "abd" else "sponza"
        self.write(rows, made_up.manifest(["scene"]))
        self.assertEqual(self.selected("front"), "abcd")  # of c and e, c beats e

    def test_a_page_that_would_be_too_large_holds_what_fits_of_the_front(self):
        self.write()
        with mock.patch.object(selection, "_bytes", lambda *_: 10.0), mock.patch.object(selection, "_ROW_BYTES", 0):
            for size, expected in ((60, "abcde"), (59, "abd"), (35, "ab"), (10, "")):  # with a reference
                with mock.patch.object(selection, "_MAX_BYTES", size):
                    self.assertEqual(self.selected(), expected, size)
        with mock.patch.object(selection, "_MAX_VARIANTS", 4):
            self.assertEqual(self.selected(), "abd")

    def test_half_floats_that_would_be_too_large_are_those_of_the_front(self):
        self.write(floats=True)
        results = load(self.directory)
        with mock.patch.object(selection, "_float_bytes", lambda *_: 10.0):
            for size, shown, expected in ((60, "abcde", "abcde"), (59, "abcde", "abd"), (59, "bce", "bce"), (35, "abcde", "ab"), (10, "abcde", "")):
                with mock.patch.object(selection, "_MAX_FLOAT_BYTES", size):
                    self.assertEqual(selection.with_floats(results, results.lights(), list(shown)), {"reference", *expected}, size)
            with mock.patch.object(selection, "_MAX_FLOAT_BYTES", 9):
                self.assertEqual(selection.with_floats(results, results.lights(), list("abcde")), set())

    def test_others_keep_their_row_and_their_points(self):
        self.write()
        self.assertEqual(make_report.main([str(self.directory), "--images", "front"]), 0)
        source = (self.directory / "report.html").read_text(encoding="utf-8")
        shown = Page(source)
        self.assertIn("2 variants are not shown with their images", shown.text)
        ids, links = shown.attributes("id"), shown.attributes("href")
        links += [f"#{variant['anchor']}" for variant in numbers_of(source)["variants"]]
        self.assertEqual([name for name in ids if name.startswith("variant-") and name.count("-") == 1],
                         ["variant-1", "variant-2", "variant-4"])
        self.assertEqual([name for name in ids if name.startswith("row-")], [f"row-{i}" for i in range(1, 6)])
        self.assertIn("#row-3", links)
        self.assertLessEqual(set(links), {f"#{name}" for name in ids})


class Layers(unittest.TestCase):
    def test_fronts_come_one_after_another(self):
        points = [(1, 5), (2, 3), (3, 4), (4, 1), (5, 2), (6, 9)]
        self.assertEqual(ranking.pareto_layers(points, 3), [0, 1, 3])
        self.assertEqual(ranking.pareto_layers(points, 9), [0, 1, 3, 2, 4, 5])
        self.assertEqual(ranking.pareto_layers(points, 4), [0, 1, 3, 2])


class ManyPoints(ReportTest):
    def test_those_far_from_the_front_are_dots(self):
        rows = [made_up.variant(f"v{i}", 10 + i % 20, 0.1 + 0.01 * (i // 20)) for i in range(400)]
        results = load(made_up.write_results(self.directory, rows, made_up.manifest([]), images=False))
        chart, absent = charts.error_chart(results, results.metrics[0], "total", "frame")
        self.assertEqual((len(chart["drawn"]), len(chart["marked"]), len(chart["labelled"]), absent), (400, 250, 80, []))
        self.assertIn(0, chart["marked"])  # the fastest with the least error
        self.assertNotIn(399, chart["marked"])


if __name__ == "__main__":
    unittest.main()
