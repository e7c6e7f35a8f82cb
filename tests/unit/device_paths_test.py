"""scripts/device_paths.py: the excess of a mean and its z; framework/bench/rivals.py: times over path tracing at equal error."""
import math
import os
import sys
import unittest
from types import SimpleNamespace

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
sys.path += [os.path.join(ROOT, "scripts"), os.path.join(ROOT, "framework")]
import device_paths  # noqa: E402
from bench import rivals  # noqa: E402


class Means(unittest.TestCase):
    def test_excess_and_standard_errors(self):
        # Differences 1, 2, 3: mean 2, deviation 1
        excess, z = device_paths.compared([11, 22, 33], [10, 20, 30])
        self.assertAlmostEqual(excess, 0.1)
        self.assertAlmostEqual(z, 2 * math.sqrt(3))
        self.assertTrue(math.isnan(device_paths.compared([1, 2], [1, 2])[1]))
        self.assertTrue(math.isnan(device_paths.compared([1], [2])[1]))


def variant(name, passes, frame, build, error):
    result = {"frame_ms": [frame, frame, frame], "build_ms": build, "scores": {"indirect_nrmse": error}, "tracer": "ray_pipeline"}
    return SimpleNamespace(name=name, kinds={str(i): each for i, each in enumerate(passes)}, result=result)


class Rivals(unittest.TestCase):
    PATHS = [variant("1", ["path_trace_device", "filter_irradiance"], 10, 0, 0.4),
             variant("4", ["path_trace_device", "filter_irradiance"], 40, 0, 0.2)]

    def over(self, frame, build, error):
        run = SimpleNamespace(variants=[variant("voxels", ["gather_rays", "filter_irradiance"], frame, build, error),
                                        variant("host", ["path_trace", "filter_irradiance"], 1, 0, 0.1), *self.PATHS])
        rows = rivals.rows(run)
        self.assertEqual([row["variant"] for row in rows], ["1", "4", "voxels"])
        self.assertEqual(rows[1]["over"]["indirect_nrmse"], {"frame": 1, "whole": 1, "at": ""})
        return rows[2]["over"]["indirect_nrmse"]

    def test_between_numbers_of_samples(self):
        # Half way, logarithm over logarithm: 20 ms
        over = self.over(5, 15, math.sqrt(0.4 * 0.2))
        self.assertAlmostEqual(over["frame"], 0.25)
        self.assertAlmostEqual(over["whole"], 1)
        self.assertEqual(over["at"], "")

    def test_beyond_them(self):
        self.assertEqual(self.over(5, 5, 0.5), {"frame": 0.5, "whole": 1, "at": "least"})
        self.assertEqual(self.over(20, 20, 0.1), {"frame": 0.5, "whole": 1, "at": "most"})

    def test_without_paths_there_is_nothing_to_compare_with(self):
        self.assertEqual(rivals.rows(SimpleNamespace(variants=[variant("voxels", ["gather_rays"], 1, 1, 0.1)])), [])


if __name__ == "__main__":
    unittest.main()
