"""scripts/mirror_borders.py on images made by hand: its pairs of pixels, steps and gradients."""
import os
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import numpy  # noqa: E402
import mirror_borders  # noqa: E402


def ends(cells):
    cells = numpy.array(cells, float)
    zero = numpy.zeros_like(cells)
    return {"ends.triangles": 1 - cells, "ends.cells": cells, "ends.cones": zero, "ends.nowhere": zero}


class Borders(unittest.TestCase):
    truth = numpy.full((4, 8), 2.0)
    halves = [[0, 0, 0, 0, 1, 1, 1, 1]] * 4

    def test_a_step_of_cells_is_found_at_their_border_alone(self):
        image = self.truth - 0.5 * numpy.array(self.halves)
        found, count = mirror_borders.measure(image, self.truth, ends(self.halves))
        self.assertEqual(count, 4)
        self.assertAlmostEqual(found["step"], -0.25)
        self.assertAlmostEqual(found["borders"], 0.25)
        self.assertEqual((found["triangles"], found["cells"]), (0, 0))

    def test_a_side_makes_no_difference(self):
        image = self.truth - 0.5 * numpy.array(self.halves)
        found, count = mirror_borders.measure(image.T, self.truth.T, ends(numpy.array(self.halves).T))
        self.assertEqual(count, 4)
        self.assertAlmostEqual(found["step"], -0.25)

    def test_what_the_truth_shows_is_no_step(self):
        truth = self.truth + numpy.arange(8)
        found, _ = mirror_borders.measure(truth.copy(), truth, ends(self.halves))
        self.assertEqual((found["step"], found["borders"]), (0, 0))

    def test_pixels_of_both_kinds_and_others_than_mirrors_are_left_out(self):
        mixed = ends([[0, 0, 0.5, 1, 1]])
        found, count = mirror_borders.measure(numpy.ones((1, 5)), numpy.ones((1, 5)), mixed)
        self.assertEqual(count, 0)
        self.assertTrue(numpy.isnan(found["step"]))
        mixed["ends.triangles"][:] = mixed["ends.cells"][:] = 0
        mixed["ends.triangles"][0, 0] = mixed["ends.cells"][0, 1] = 1
        self.assertEqual(mirror_borders.measure(numpy.ones((1, 5)), numpy.ones((1, 5)), mixed)[1], 1)


if __name__ == "__main__":
    unittest.main()
