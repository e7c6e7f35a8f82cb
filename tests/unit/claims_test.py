"""Claims of packs: tolerances that two independent results keep, and that a change of brightness does not."""
import os
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
FRAMEWORK = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "framework")
sys.path[:0] = [FRAMEWORK, os.path.join(FRAMEWORK, "python")]
import voxray.exr  # noqa: E402
from orchestration import claims  # noqa: E402

SEED = 11


class Intervals(unittest.TestCase):
    def test_standard_errors(self):
        """Quantiles of the normal distribution, by tables."""
        self.assertAlmostEqual(claims.standard_errors(), 1.9600, places=4)
        self.assertAlmostEqual(claims.standard_errors(5), 2.5758, places=4)
        self.assertAlmostEqual(claims.standard_errors(50), 3.2905, places=4)

    def not_confirmed(self, count, tolerances, studies=2000, error=0.01):
        """Share of studies of which another machine, with other random numbers, would not confirm each of `count` claims."""
        numbers = np.random.default_rng(SEED)
        wrong = 0
        for _ in range(studies):
            first, second = numbers.normal(1, error, (2, count))
            spread = claims.standard_errors() * error
            stated = tolerances([claims.Claim("v", str(i), x, x - spread, x + spread, is_interval=True) for i, x in enumerate(first)])
            wrong += any(claim.verdict(float(found)) == "not" for claim, found in zip(stated, second))
        return wrong / studies

    def test_two_results_are_confirmed_in_95_percent_of_studies(self):
        for count in (1, 10, 50):
            share = self.not_confirmed(count, claims.of_two_results)
            self.assertLess(share, 0.065, count)
            self.assertGreater(share, 0.035, count)
        self.assertGreater(self.not_confirmed(50, list), 0.9)  # Intervals of the first result alone

    def test_other_claims_keep_their_ends(self):
        floor = claims.Claim("v", "flip", 0.2, 0.1, 0.3)
        text = claims.Claim("v", claims.STATUS, "ok")
        interval = claims.Claim("v", "nrmse", 1.0, 0.9, 1.2, is_interval=True)
        made = claims.of_two_results([floor, text, interval])
        self.assertEqual(made[:2], [floor, text])
        widened = 2 ** 0.5 * claims.standard_errors(2) / claims.standard_errors()
        self.assertAlmostEqual(made[2].low, 1 - 0.1 * widened)
        self.assertAlmostEqual(made[2].high, 1 + 0.2 * widened)
        self.assertNotIn("is_interval", made[2].record())

    def test_what_is_never_negative_stays_so(self):
        for low, expected in ((0.0, 0), (0.5, 1 - 0.5 * 2 ** 0.5), (-0.5, 1 - 1.5 * 2 ** 0.5)):
            made, = claims.of_two_results([claims.Claim("v", "nrmse", 1.0, low, 1.1, is_interval=True)])
            self.assertAlmostEqual(made.low, expected)


class Reference(unittest.TestCase):
    """A reference of 64 x 36 pixels with noise of a tenth of its radiance in each half."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.numbers = np.random.default_rng(SEED)
        self.light = self.numbers.uniform(0.2, 2, (36, 64, 3))

    def render(self, name, image):
        (self.folder / name).mkdir()
        for light in claims.LIGHT_OF_FILE:
            for half in "ab":
                noisy = image * self.numbers.normal(1, 0.1, (36, 64, 1))  # Channels deviate together
                voxray.exr.write(self.folder / name / f"{light}_{half}.exr", noisy.astype(np.float32))
        return self.folder / name

    def verdicts(self, image):
        first, second = self.render("reference", self.light), self.render("again", image)
        stated = claims.of_two_results(claims.reference_claims(first))
        found = claims.found_of_reference(first, second, claims.toleranced(stated))
        return {(claim.of, claim.what): claim.verdict(found[claim.of, claim.what]) for claim in stated}

    def test_other_random_numbers_are_within_tolerance(self):
        self.assertEqual(set(self.verdicts(self.light).values()), {"within tolerance"})

    def test_a_change_of_1_percent_is_not(self):
        found = self.verdicts(1.01 * self.light)
        for light in claims.LIGHT_OF_FILE.values():
            self.assertEqual(found[f"reference, {light} light", claims.MEAN], "not")

    def test_another_view_is_not(self):
        found = self.verdicts(self.light[:, ::-1])
        for light in claims.LIGHT_OF_FILE.values():
            self.assertEqual(found[f"reference, {light} light", claims.IMAGE], "not")

    def test_the_standard_error_of_a_mean_is_that_of_many_means(self):
        folders = [self.render(str(i), self.light) for i in range(200)]
        read = [claims.read_light(folder, "final") for folder in folders]
        of_many = np.std([one.mean for one in read]) / np.mean([one.mean for one in read])
        self.assertAlmostEqual(np.mean([one.relative_error for one in read]) / of_many, 1, delta=0.12)


if __name__ == "__main__":
    unittest.main()
