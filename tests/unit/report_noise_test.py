"""Tests of what the report says of bias and noise."""

from __future__ import annotations

import unittest

from report_support import ReportTest, made_up


class BiasAndNoise(ReportTest):
    def test_a_second_seed_tells_which_errors_are_noise(self):
        rows = [made_up.variant(name, 10, error) for name, error in (("smooth", 0.2), ("grainy", 0.4), ("rough", 0.5))]
        for row, bias, noise in zip(rows, (0.19, 0.1, 0.3), (0.06, 0.39, 0.4)):
            row.update(bias_nrmse=bias, noise_nrmse=noise)
        run = made_up.manifest([])
        shown = self.make(rows, run, indirect=False)
        for words in ("bias\u00a0↓", "noise\u00a0↓", "0.390",
                      "Noise is the larger part of the error of 2 (grainy) and 3 (rough). ./voxray passes PASS",
                      "Bias is the larger part of the others' error: more rays don't lower it.", "./voxray passes PASS says what makes a pass noisy", "what noise measures"):
            self.assertIn(words, shown.text)

        # The parameters that lower it, of the noisy variants alone, with their values
        run["variants"] = {name: [{"pass": "place_surfels", "id": "place_surfels", "points_per_voxel": 4},
                                  {"pass": "inject_voxel_rays", "id": "inject", "paths_per_point": paths}]
                           for name, paths in (("smooth", 64), ("grainy", 1), ("rough", 2))}
        run["noise_parameters"] = {
            "final": {"smooth": ["smooth.rays"], "grainy": ["place_surfels.points_per_voxel", "inject.paths_per_point"],
                      "rough": ["inject.paths_per_point", "odd.rays"]},
            "indirect": {"grainy": ["indirect.rays"]}}
        shown = self.make(rows, run, indirect=False)
        self.assertIn("(rough); it falls as these rise: place_surfels.points_per_voxel (now 4), "
                      "inject.paths_per_point (now 1 to 2), odd.rays.", shown.text)
        # A pass that has another id in each variant is named by its kind
        run["variants"] |= {"grainy": [{"pass": "path_trace", "id": "indirect", "spp": 4}], "rough": [{"pass": "path_trace", "spp": 1}]}
        run["noise_parameters"]["final"] |= {"grainy": ["indirect.spp"], "rough": ["path_trace.spp"]}
        self.assertIn("as these rise: path_trace.spp (now 1 to 4).", self.make(rows, run, indirect=False).text)
        for row in rows:
            row.update(noise_nrmse=0.01)
        self.assertIn("Bias is the larger part of every variant's error",
                      self.make(rows, run, indirect=False).text)

    def test_a_filter_blurs_less_with_less_noise(self):
        rows = [made_up.variant(name, 10, 0.2) for name in ("cones", "filtered", "paths")]
        for row, noise in zip(rows, (0.1, 0.1, 0.3)):
            row.update(bias_nrmse=0.2, noise_nrmse=noise)
        run, never = made_up.manifest([]), "more rays don't lower it."
        for kind in ("filter_irradiance", "accumulate"):
            run["variants"] = {"cones": [{"pass": "gather_cones"}], "filtered": [{"pass": "gather_rays"}, {"pass": kind, "id": "f"}]}
            shown = self.make(rows, run, indirect=False).text
            self.assertIn("Bias is the larger part of the others' error: more rays don't lower it. Part of that of 2 (filtered) "
                          "is their filter's blur, which gets less where there is less noise.", shown)
            shown = self.make(rows[1:2], run, indirect=False).text
            self.assertIn("Bias is the larger part of every variant's error: more rays lower it only as far as a filter blurs less", shown)
            self.assertNotIn(never, shown)
        self.assertIn(never, self.make(rows[:1], run, indirect=False).text)

    def test_without_a_second_seed_bias_and_noise_are_not_told_apart(self):
        rows, run = [made_up.variant(name, 10, 0.3, 0.4) for name in ("a", "b")], made_up.manifest([])
        said = "Bias and noise are not told apart: set measure.second_seed: true."
        self.assertNotIn(said, self.make(rows, run).text)  # No pass is noisy
        run["noise_parameters"] = {"final": {"b": ["direct.light_samples"]}, "indirect": {"a": [], "b": []}}
        shown = self.make(rows, run)
        self.assertEqual(shown.text.count(said), 1)  # Of the total light alone
        run["noise_parameters"]["indirect"]["a"] = ["gather.rays"]
        self.assertEqual(self.make(rows, run).text.count(said), 2)


if __name__ == "__main__":
    unittest.main()
