"""scripts/rivals_table.py on a made-up run: speed-ups at equal error, and the best point that is no slower than the rival."""
import csv
import os
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import rivals_table  # noqa: E402


def write(folder, variants):
    """variants: (name, nRMSE, {pass: ms of a frame}, {pass: ms of the build})."""
    with open(os.path.join(folder, "results.csv"), "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["variant", "status", "scene", "indirect", "indirect_nrmse", "indirect_relmse", "indirect_mean_ratio"])
        for name, error, _, _ in variants:
            rows.writerow([name, "ok", "room", name, error, error, 1])
    with open(os.path.join(folder, "passes.csv"), "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["variant", "pass", "phase", "ms_median"])
        for name, _, frame, build in variants:
            rows.writerows([name, each, "frame", ms] for each, ms in frame.items())
            rows.writerows([name, each, "build", ms] for each, ms in build.items())


class Table(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        lookup = {"gbuffer": 10, "gather_surfels": 40, "direct": 1000}
        write(self.folder, [
            ("filtered paths, 4", 0.2, {"gbuffer": 10, "paths": 90, "indirect": 100}, {}),
            ("filtered paths, 16", 0.1, {"gbuffer": 10, "paths": 690, "indirect": 100}, {}),
            ("lookup, coarse", 0.2, lookup, {"inject_radiosity": 50, "link_surfels": 1000}),
            ("lookup, fine", 0.05, {"gbuffer": 10, "gather_surfels": 190}, {"inject_radiosity": 200}),
        ])

    def test_speed_ups_at_equal_error(self):
        lines = list(rivals_table.table(self.folder))
        self.assertEqual(lines[0], "| scene | spp | ms | nRMSE / relMSE | looked up | looked up, new light |")
        # 50 ms have the error of 4 samples; that of 16 lies half way to 200 ms, on logarithmic axes. Light that is new takes
        # 100 and 400 ms.
        self.assertEqual(lines[2], "| room | 4 | 200 | 0.200 / 0.200 | >4.0 / >4.0 | >2.0 / >2.0 |")
        self.assertEqual(lines[3], "| room | 16 | 800 | 0.100 / 0.100 | 8.0 / 8.0 | 4.0 / 4.0 |")

    def test_of_many_runs_the_least_time_of_each_pass_counts(self):
        with tempfile.TemporaryDirectory() as again:
            write(again, [("filtered paths, 4", 0.2, {"gbuffer": 20, "paths": 50, "indirect": 100}, {}),
                          ("filtered paths, 16", 0.1, {"gbuffer": 10, "paths": 890, "indirect": 100}, {}),
                          ("lookup, coarse", 0.2, {"gbuffer": 10, "gather_surfels": 30}, {"inject_radiosity": 90, "link_surfels": 9}),
                          ("lookup, fine", 0.05, {"gbuffer": 10, "gather_surfels": 190}, {"inject_radiosity": 200})])
            lines = list(rivals_table.table(self.folder, again))
        self.assertEqual(lines[2], "| room | 4 | 160 | 0.200 / 0.200 | >4.0 / >4.0 | >1.8 / >1.8 |")
        self.assertEqual(lines[3].split("|")[3].strip(), "800")

    def test_rays_alone_leave_out_what_both_sides_share(self):
        write(self.folder, [("filtered paths, 4", 0.2, {"gbuffer": 10, "paths": 90, "indirect": 100, "direct": 1000}, {}),
                            ("rays, 1 a pixel", 0.2, {"gbuffer": 10, "gather_rays": 20, "indirect": 100}, {"inject": 1000})])
        lines = list(rivals_table.table(self.folder))
        self.assertEqual([cell.strip() for cell in lines[0].split("|")[5:7]], ["voxels", "voxels, rays alone"])
        self.assertEqual([cell.strip() for cell in lines[2].split("|")[5:7]], [">1.5 / >1.5", ">4.5 / >4.5"])

    def test_probes_are_found_by_what_fills_them(self):
        # What looks them up has the id of the sweep's axis
        write(self.folder, [("filtered paths, 4", 0.2, {"gbuffer": 10, "paths": 90, "indirect": 100}, {}),
                            ("probes, 8", 0.2, {"gbuffer": 10, "indirect": 40}, {"update_probes": 50})])
        lines = list(rivals_table.table(self.folder))
        self.assertEqual([cell.strip() for cell in lines[0].split("|")[5:7]], ["probes", "probes, new light"])
        self.assertEqual([cell.strip() for cell in lines[2].split("|")[5:7]], [">4.0 / >4.0", ">2.0 / >2.0"])

    def test_the_best_point_is_no_slower_than_path_tracing(self):
        self.assertEqual(list(rivals_table.best(self.folder))[2:],
                         ["| room | looked up | lookup, fine | 200 | 0.050 / 0.0500 / 1.000 |"])
        # Path tracing gets to 0.14 in about 400 ms, to 0.2 in 200.
        self.assertTrue(rivals_table.is_no_slower(390, 0.1414, [(200, 0.2), (800, 0.1)]))
        self.assertFalse(rivals_table.is_no_slower(410, 0.1414, [(200, 0.2), (800, 0.1)]))
        self.assertFalse(rivals_table.is_no_slower(210, 0.3, [(200, 0.2), (800, 0.1)]))
        self.assertTrue(rivals_table.is_no_slower(5000, 0.05, [(200, 0.2), (800, 0.1)]))


if __name__ == "__main__":
    unittest.main()
