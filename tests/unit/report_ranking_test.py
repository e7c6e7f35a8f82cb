"""Tests of what the report concludes: which variants tie, are best, lie on the front or below a black image."""

from __future__ import annotations

import math
import unittest

import numpy as np
from report_support import FLIP, NRMSE, Page, ReportTest, made_up

from report import page, ranking, summary, table
from report.load import load
from report.results import Metric, interval_of


class Comparing(ReportTest):
    def results(self, rows, **changes):
        run = made_up.manifest([])
        run.update(changes)
        return load(made_up.write_results(self.directory, rows, run, images=False))

    def summary(self, results):
        return summary.summary(results, "total")

    def test_scores_whose_intervals_overlap_tie_and_none_is_the_best(self):
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.2), ("b", 0.23), ("c", 0.25))]
        for row in rows:
            row.update(made_up.spread("nrmse", row["nrmse"] - 0.02, row["nrmse"] + 0.02))
        results = self.results(rows)
        self.assertEqual(ranking.score_marks(results, NRMSE, "nrmse"), {"a": "tie", "b": "tie"})
        self.assertEqual(self.summary(results)[0], "Of the total light, lowest nRMSE 0.200 to 0.230, 1 (a) and 2 (b) tie. nRMSE: what nRMSE measures.")
        # Ties that look alike have one number.
        alike = [dict(row, nrmse=0.2 + 0.0001 * i) for i, row in enumerate(rows[:2])]
        self.assertIn("lowest nRMSE 0.200, 1 (a) and 2 (b) tie.", self.summary(self.results(alike))[0])
        # Told apart, and without intervals: one is the best.
        del rows[1]
        self.assertEqual(ranking.score_marks(self.results(rows), NRMSE, "nrmse"), {"a": "best"})
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.2), ("b", 0.2001))]
        self.assertEqual(ranking.score_marks(self.results(rows), NRMSE, "nrmse"), {"a": "best"})

    def test_images_that_are_all_black_are_not_the_best(self):
        rows = [made_up.variant(name, 10, 0.123456789) for name in ("a", "b")]
        for black, marks in ((0.12345678912345, {}), (2, {"a": "best", "b": "best"})):
            reference = made_up.manifest([])["reference"] | {"baselines": {"black": {"nrmse": black}}}
            results = self.results(rows, reference=reference)
            self.assertEqual(ranking.score_marks(results, NRMSE, "nrmse"), marks)

    def test_scores_at_the_noise_floor_tie(self):
        # HDR-FLIP is 0.005, 0.009 and 0.011; a perfect image would score 0.01.
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.01), ("b", 0.018), ("c", 0.022))]
        self.assertEqual(ranking.score_marks(self.results(rows), FLIP, "flip"), {"a": "tie", "b": "tie"})
        self.assertEqual(ranking.score_marks(self.results(rows[1:]), FLIP, "flip"), {"b": "best"})
        self.assertEqual(ranking.score_marks(self.results(rows, reference={}), FLIP, "flip"), {"a": "best"})
        ssim = Metric("ssim", "SSIM", "", "high", "")  # 0.995, 0.991 and 0.97; the floor is 0.98
        rows[2]["ssim"] = 0.97
        self.assertEqual(ranking.score_marks(self.results(rows), ssim, "ssim"), {"a": "tie", "b": "tie"})

    def test_front_is_drawn_through_upper_ends(self):
        # b is slower than a and its interval overlaps: not beaten. c is.
        rows = [made_up.variant(name, ms, error) for name, ms, error in (("a", 10, 0.2), ("b", 20, 0.21), ("c", 30, 0.4))]
        for row in rows:
            row.update(made_up.spread("nrmse", row["nrmse"] - 0.05, row["nrmse"] + 0.05))
        results = self.results(rows)
        points = [(row["frame_ms_median"], interval_of(row, "nrmse")) for _, row in results.ok.iterrows()]
        front = ranking.pareto_front([(cost, high) for cost, (_, high) in points])
        self.assertEqual(front, [0])
        reached = points[0][1][1]
        self.assertEqual([low > reached for _, (low, _) in points], [False, False, True])
        shown = Page(page.render(results))
        self.assertIn("what lies wholly above it is beaten", shown.text)

    def test_best_of_each_direction(self):
        rows = [made_up.variant("bright", 10, 0.1), made_up.variant("dark", 10, 0.2)]
        rows[0]["mean_ratio"], rows[1]["mean_ratio"] = 1.3, 0.8
        results = self.results(rows)
        best = {m.key: [n for n, mark in ranking.score_marks(results, m, m.key).items() if mark == "best"]
                for m in results.metrics}
        self.assertEqual(best.pop("mean_ratio"), ["dark"])  # 0.2 from 1 instead of 0.3
        self.assertEqual(set(map(tuple, best.values())), {("bright",)})

    def test_frame_times_tie_within_the_spread(self):
        # The fastest one's p95 is 10.5 ms.
        rows = [made_up.variant(name, ms, 0.1) for name, ms in (("a", 10.0), ("b", 10.4), ("c", 10.6))]
        marks = ranking.cost_marks(self.results(rows), "frame_ms_median")
        self.assertEqual(marks, {"a": "best", "b": "tie"})

    def test_no_cost_is_the_best_next_to_none(self):
        rows = [made_up.variant(name, 10, 0.1) | {"build_ms": ms} for name, ms in (("paths", 0), ("rays", 20), ("lookup", 10))]
        self.assertEqual(ranking.cost_marks(self.results(rows), "build_ms"), {})
        self.assertEqual(ranking.cost_marks(self.results(rows[1:]), "build_ms"), {"lookup": "best"})
        # Of another scene it says nothing
        records = [{"folder": "a", "variants": ["paths"]}, {"folder": "b", "variants": ["rays", "lookup"]}]
        self.assertEqual(ranking.cost_marks(self.results(rows, references=records), "build_ms"), {"lookup": "best"})
        results = self.results(rows)
        columns = table.columns_of(results, ["total"])
        shown = table.results_table(results, "", columns, dict.fromkeys(results.numbers, "x"))
        index = 2 + [column.key for column in columns].index("build_ms")
        self.assertEqual([row[index].text for row in shown.rows], ["–", "20.0", "10.0"])

    def test_worse_than_a_black_image(self):
        def beaten(metric, value, low=math.nan, high=math.nan):
            row = made_up.variant("a", 10, 0.1) | {metric.key: value}
            results = self.results([row | made_up.spread(metric.key, low, high)])
            return ranking.all_beaten(results, metric, metric.key).get("a", [])

        self.assertEqual(beaten(NRMSE, 1.0), ["constant"])
        self.assertEqual(beaten(NRMSE, 2.0), ["black", "constant"])
        self.assertEqual(beaten(NRMSE, 2.0, 1.2, 2.8), ["constant"])  # The interval holds the black one's 1.6.
        ssim = Metric("ssim", "SSIM", "", "high", "")
        self.assertEqual(beaten(ssim, 0.9), [])
        self.assertEqual(beaten(ssim, -1.0), ["black", "constant"])

    def test_each_variant_is_compared_with_its_own_reference(self):
        # HDR-FLIP's noise is 0.01 and 0.15; a black image has an nRMSE of 1.6 and 0.3.
        first, run = {"folder": "reference", "flip_noise": 0.01, "variants": ["a", "b"]}, made_up.manifest([])
        second = {"folder": "reference.2", "flip_noise": 0.15, "variants": ["c", "d"]}
        first["baselines"] = run["baselines"]
        second["baselines"] = {"black": {"nrmse": 0.3}, "constant": {"nrmse": 0.25}}
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.26), ("b", 0.28), ("c", 0.28), ("d", 0.25))]
        results = self.results(rows, references=[first, second])
        self.assertEqual(ranking.score_marks(results, FLIP, "flip"), {"a": "best", "c": "tie", "d": "tie"})
        self.assertEqual(ranking.all_beaten(results, NRMSE, "nrmse"), {"c": ["constant"]})
        shown = Page(page.render(results))
        for words in ("a black image (reference)", "a black image (reference.2)",
                      "the reference's own noise (reference.2)"):
            self.assertIn(words, shown.text)

    def test_speed_up_at_equal_error(self):
        # Paths' error falls with the root of their time: 1, 0.5 and 0.25 in 10, 40 and 160 ms; 1 is worse than a constant image.
        def said_of(own, filtered=False, width=1.0):
            """@param own (ms, error) of lookups; width of all intervals as a factor"""
            points = [(f"lookup {i}", *point) for i, point in enumerate(own)]
            points += [(f"paths {spp}", 10.0 * spp, spp ** -0.5) for spp in (1, 4, 16)]
            points += [(f"filtered {spp}", 5.0 * spp, spp ** -0.5) for spp in (4, 16)] * filtered
            rows = [made_up.variant(name, ms, error) for name, ms, error in points]
            for row in rows:
                row.update(made_up.spread("nrmse", row["nrmse"] / width, row["nrmse"] * width))
            chains = {"lookup": ["gather"], "paths": ["path_trace"], "filtered": ["path_trace", "filter_irradiance"]}
            graphs = {row["variant"]: [{"pass": kind} for kind in chains[row["variant"].split()[0]]] for row in rows}
            said = self.summary(self.results(rows, variants=graphs))[0]
            return said[said.find("At equal"):said.index(" nRMSE: ")] if "At equal" in said else ""

        reached = "it reaches 2 of 2 errors)."
        self.assertEqual(said_of([(10, 0.2)]), f"At equal nRMSE lookup 0 is 8.0 times as fast as paths ({reached}")
        # Between 10 ms and 40 ms a lookup gets to 0.25 in 20 ms
        self.assertEqual(said_of([(10, 0.5), (40, 0.125)]), f"At equal nRMSE lookup is 5.7 times as fast as paths ({reached}")
        self.assertIn("8.0 times as fast as paths (it reaches 1 of 2 errors).", said_of([(5, 0.4)]))
        self.assertIn("4.0 times as fast as filtered (", said_of([(10, 0.2)], filtered=True))
        self.assertEqual(said_of([(10, 0.6)]), "")  # it gets to neither
        self.assertIn("no method is faster than paths; lookup 0 comes nearest, 0.40 times as fast (" + reached, said_of([(200, 0.2)]))
        # Errors that are a tenth less or more: of lookups time falls with the square of the error, too
        own = [(10.0 * spp, 0.5 * spp ** -0.5) for spp in (0.5, 2, 8)]
        self.assertIn("lookup is 4.0 times as fast as paths (2.7–5.9 within the intervals; " + reached, said_of(own, width=1.1))
        own = [(45.0 * spp, 0.5 * spp ** -0.5) for spp in (0.5, 2, 8)]
        self.assertIn("comes nearest, 0.89 times as fast (0.61–1.3 within the intervals; that leaves open which is faster; " + reached,
                      said_of(own, width=1.1))

    def test_scenes_are_told_one_by_one(self):
        # The hall is slower and harder than the room, path tracing takes 4 and 8 times as long in them; a single setting of
        # it does not tell what the intervals of errors make of that.
        rows = [made_up.variant(f"{scene} {method}", ms, error, name=f"{scene}, {method}", scene=scene, method=method)
                for scene, method, ms, error in (("room", "lookup", 10, 0.1), ("room", "paths", 40, 0.1),
                                                 ("hall", "lookup", 100, 0.3), ("hall", "paths", 800, 0.3), ("hall", "cones", 50, 0.5))]
        for row in rows:
            row.update(made_up.spread("nrmse", row["nrmse"] - 0.01, row["nrmse"] + 0.01))
        records = [{"folder": f"reference.{scene}", "variants": [row["variant"] for row in rows if row["scene"] == scene]}
                   for scene in ("room", "hall")]
        graphs = {row["variant"]: [{"pass": "path_trace" if row["method"] == "paths" else row["method"]}] for row in rows}
        results = self.results(rows, sweep_keys=["scene", "method"], references=records, variants=graphs)
        self.assertEqual(ranking.score_marks(results, NRMSE, "nrmse"),
                         {"room lookup": "best", "room paths": "best", "hall lookup": "best", "hall paths": "best"})
        self.assertEqual(ranking.cost_marks(results, "frame_ms_median"), {"room lookup": "best", "hall cones": "best"})
        self.assertEqual(self.summary(results), [
            "Of the total light, room: lowest nRMSE 0.100, 1 (lookup). At equal nRMSE lookup is 4.0 times as fast as paths (up to "
            "4.0 within the intervals; that leaves open which is faster; it reaches 1 of 1 errors). nRMSE: what nRMSE measures.",
            "hall: lowest nRMSE 0.300, 3 (lookup). At equal nRMSE lookup is 8.0 times as fast as paths (up to 8.0 within the "
            "intervals; that leaves open which is faster; it reaches 1 of 1 errors)."])

    def test_the_cost_of_an_error(self):
        costs, reached = (10, 40, 160), (0.4, 0.2, 0.1)
        for error, expected in ((0.2, 40), (0.4, 10), (0.5, 10), (0.2 * 2 ** -0.5, 80), (0.05, math.nan)):
            np.testing.assert_allclose(np.exp(ranking.log_cost_at(error, costs, reached)), expected)

    def test_pareto_front(self):
        points = [(3, 1), (1, 5), (2, 5), (2, 3), (4, 1), (1, 6)]
        self.assertEqual(ranking.pareto_front(points), [1, 3, 0])


if __name__ == "__main__":
    unittest.main()
