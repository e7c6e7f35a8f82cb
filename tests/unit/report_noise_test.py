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
        for words in ("bias\u00a0↓", "noise\u00a0↓", "0.390", "Noise is the larger part of the error of 2 (grainy) and 3 (rough).",
                      "what noise measures"):
            self.assertIn(words, shown.text)

        # The parameters that lower it, of the noisy variants alone
        run["noise_parameters"] = {
            "final": {"smooth": ["smooth.rays"], "grainy": ["place_surfels.points_per_voxel", "inject.paths_per_point"],
                      "rough": ["inject.paths_per_point", "odd.rays"]},
            "indirect": {"grainy": ["indirect.rays"]}}
        shown = self.make(rows, run, indirect=False)
        self.assertIn("(rough); it falls as these rise: place_surfels.points_per_voxel, inject.paths_per_point, odd.rays.", shown.text)
        for row in rows:
            row.update(noise_nrmse=0.01)
        self.assertIn("Bias is the larger part of every variant's error.", self.make(rows, run, indirect=False).text)

    def test_without_a_second_seed_nothing_is_said_of_noise(self):
        shown = self.make([made_up.variant(name, 10, 0.3, 0.4) for name in ("a", "b")], made_up.manifest([])).text
        self.assertNotIn("larger part", shown)


if __name__ == "__main__":
    unittest.main()
