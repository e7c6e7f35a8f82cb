"""scripts/growth.py: its fit, its tables, and the spheres and configs that it writes."""
import base64
import json
import os
import struct
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import growth  # noqa: E402


class Fit(unittest.TestCase):
    def test_finds_the_power(self):
        for power in (0, 1, 1.5, -2):
            self.assertAlmostEqual(growth.exponent([(x, 7 * x**power) for x in (1, 10, 50, 1000)]), power)

    def test_is_the_slope_of_the_fitted_line(self):
        self.assertAlmostEqual(growth.exponent([(1, 1), (10, 10), (100, 10)]), 0.5)

    def test_needs_two_sizes_with_positive_values(self):
        self.assertIsNone(growth.exponent([(10, 3), (10, 4)]))
        self.assertIsNone(growth.exponent([(10, 3), (100, 0)]))


class Table(unittest.TestCase):
    def test_tells_ends_exponent_and_target(self):
        text = growth.table([("pixels", 100, "frame ms", 2), ("pixels", 10000, "frame ms", 200), ("rays", 10, "build ms", 5)])
        self.assertIn("| pixels | frame ms | 2 at 100 | 200 at 10,000 | 1.00 | at most 1.02 |", text)
        self.assertIn("| rays | build ms | 5 at 10 | 5 at 10 |  |  |", text)


class Lights(unittest.TestCase):
    def test_cost_is_time_at_equal_error(self):
        results = [{"variant": "0", "chain": "a", "nrmse": "0.2", "frame_ms_median": "3"},
                   {"variant": "1", "chain": "b", "nrmse": "0.05", "frame_ms_median": "17"}]
        passes = [{"variant": "1", "pass": "gbuffer", "ms_median": "9"}, {"variant": "1", "pass": "direct_shadow_rays", "ms_median": "8"}]
        found = {measure: value for _, _, measure, value in growth.light_costs(10, results, passes)}
        self.assertAlmostEqual(found["a, equal nRMSE ms"], 12)
        self.assertAlmostEqual(found["b, equal nRMSE ms"], 2)
        self.assertEqual(found["b ms"], 8)


class Inputs(unittest.TestCase):
    def test_a_sphere_is_closed_and_faces_outwards(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "s.gltf"
            count = growth.sphere(path, 2000)
            document = json.loads(path.read_text())
        data = base64.b64decode(document["buffers"][0]["uri"].split(",")[1])
        points = list(struct.iter_unpack("<3f", data[:document["bufferViews"][0]["byteLength"]]))
        indices = list(struct.iter_unpack("<3I", data[document["bufferViews"][0]["byteLength"]:]))
        self.assertEqual(len(indices), count)
        self.assertLess(abs(count / 2000 - 1), 0.1)
        volume = 0
        for a, b, c in ([points[i] for i in triangle] for triangle in indices):
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        self.assertAlmostEqual(volume, 4.18879, delta=0.06)

    def test_each_axis_varies_what_it_names(self):
        self.assertEqual(growth.config("pixels", (320, 180), Path("."))[1], 57600)
        self.assertEqual(growth.config("lights", 10, Path("."))[0]["scene"]["count"], 10)
        self.assertEqual(len(growth.config("variants", 100, Path("."))[0]["sweep"]["inject.rays_per_light"]), 100)


if __name__ == "__main__":
    unittest.main()
