"""Tests of the comparison of methods over runs. Needs Debian's Python with pandas, matplotlib and Jinja2."""

import csv
import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "framework"), str(Path(__file__).resolve().parent)]

import report_results as made_up  # noqa: E402
from report import pareto, pareto_page  # noqa: E402
from report.load import load  # noqa: E402
from report.results import ReportError  # noqa: E402

RAYS = ("gbuffer", "voxelize", "inject_light_rays", "gather_rays", "filter_irradiance")
PATHS = ("gbuffer", "path_trace", "filter_irradiance")
CONES = ("gbuffer", "voxelize", "gather_cones", "filter_irradiance")
LOOKUP = ("gbuffer", "voxelize", "inject_light_rays", "gather_irradiance")


class Pareto(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def run_of(self, name, variants, **changes):
        """A run in a folder; variants: name -> (passes, ms, error of the indirect light)."""
        rows = [made_up.variant(key, ms, error, error) for key, (_, ms, error) in variants.items()]
        for row in rows:
            error = row["indirect_nrmse"]
            row.update({f"indirect_{key}": value for key, value in made_up.spread("nrmse", 0.95 * error, 1.05 * error).items()})
        run = made_up.manifest([])
        run["variants"] = {key: [{"pass": kind} for kind in passes] for key, (passes, _, _) in variants.items()}
        run["config"]["scene"] = {"builtin": name}
        run["reference"]["hash"] = name
        run.update(changes)
        return made_up.write_results(self.root / f"{name}{len(list(self.root.iterdir()))}", rows, run, images=False)

    def scenes(self, *folders):
        runs = [load(folder) for folder in folders]
        return pareto.scenes_of(runs, runs[0].metrics[0], "indirect")

    def test_factors_at_equal_error_and_at_equal_time(self):
        # Paths: error falls with the root of time. Rays: a quarter of the time for the same.
        paths = {f"p{ms}": (PATHS, ms, 1 / math.sqrt(ms)) for ms in (100, 400, 1600)}
        rays = {f"r{ms}": (RAYS, ms, 0.5 / math.sqrt(ms)) for ms in (25, 100, 400, 1600)}
        scenes = self.scenes(self.run_of("room", paths | rays))
        self.assertEqual([scene.name for scene in scenes], ["room"])
        method = "inject_light_rays + gather_rays"
        self.assertEqual(scenes[0].methods(), ["path_trace", method])  # Both filter: that tells nothing.
        median, least, reached, of = pareto.median_speed_ups(scenes, "frame")[method]
        self.assertAlmostEqual(median, 4, 3)
        self.assertAlmostEqual(least, 4, 3)
        self.assertEqual((reached, of), (3, 3))
        for factor in pareto.errors_at_equal_time(scenes[0], "frame")[method]:
            self.assertAlmostEqual(factor.value, 0.5, 6)
            self.assertTrue(factor.is_significant)
        self.assertEqual(pareto.dominated(scenes, "frame"), ["path_trace"])

    def test_errors_that_are_not_reached_count_nowhere(self):
        scenes = self.scenes(self.run_of("room", {"p1": (PATHS, 100, 0.2), "p2": (PATHS, 200, 0.1),
                                                  "l": (LOOKUP, 10, 0.15)}))
        entries = pareto.speed_ups(scenes[0], "frame")["inject_light_rays + gather_irradiance"]
        self.assertAlmostEqual(entries[0].value, 10)
        self.assertTrue(math.isnan(entries[1].value))
        self.assertEqual(pareto.median_speed_ups(scenes, "frame")["inject_light_rays + gather_irradiance"][2:], (1, 2))

    def test_runs_are_merged_by_reference_and_times_by_machine(self):
        paths = self.run_of("room", {"p": (PATHS, 100, 0.1)})
        rays = self.run_of("room", {"r": (RAYS, 10, 0.05)})
        gpu = self.run_of("room", {"g": (RAYS, 1, 0.02)}, device="a GPU")
        hall = self.run_of("hall", {"p": (PATHS, 100, 0.1), "r": (RAYS, 400, 0.2)})
        scenes = self.scenes(paths, rays, gpu, hall)
        self.assertEqual([(scene.name, len(scene.measured)) for scene in scenes], [("room", 3), ("hall", 2)])
        # The other machine has no path tracing to be faster than
        self.assertEqual(len(pareto.speed_ups(scenes[0], "frame")["inject_light_rays + gather_rays"]), 1)
        self.assertEqual(pareto.dominated(scenes, "frame"), [])  # Each wins in one scene.
        self.assertEqual(pareto.dominated(scenes[1:], "frame"), ["inject_light_rays + gather_rays"])

    def test_references_of_one_scene_are_told_apart(self):
        folders = [self.run_of("room", {"p": (PATHS, 100, 0.1)}) for _ in range(3)]
        runs = [load(folder) for folder in folders]
        for run, (hash_, name) in zip(runs, (("x", "near"), ("y", "far"), ("z", "far"))):
            run.manifest["reference"]["hash"] = hash_
            run.manifest["config"]["name"] = name
        scenes = pareto.scenes_of(runs, runs[0].metrics[0], "indirect")
        self.assertEqual([scene.name for scene in scenes], ["room (near)", "room (far) 1", "room (far) 2"])

    def test_intervals_that_overlap_beat_nothing(self):
        scenes = self.scenes(self.run_of("room", {"p": (PATHS, 100, 0.1), "r": (RAYS, 90, 0.095)}))
        self.assertEqual(pareto.dominated(scenes, "frame"), [])
        for table in (pareto.speed_ups, pareto.errors_at_equal_time):
            [factor] = table(scenes[0], "frame")["inject_light_rays + gather_rays"]
            self.assertFalse(factor.is_significant, table)

    def test_light_in_each_frame_counts_what_light_changes(self):
        folder = self.run_of("room", {"p": (PATHS, 100, 0.1), "r": (RAYS, 100, 0.05)})
        [scene] = self.scenes(folder)
        rays = next(m for m in scene.measured if not m.is_rival)
        # Of a build of 200 ms `voxelize` takes 140; light does not change voxels
        self.assertAlmostEqual(rays.costs["frame + light"], 100 + 56)

    def test_the_best_method_and_the_best_point(self):
        paths = {f"p{spp}": (PATHS, 25 * spp, 0.4 / math.sqrt(spp)) for spp in (4, 16)}
        runs = [load(self.run_of("room", paths | {"l": (LOOKUP, 10, 0.15), "r": (RAYS, 50, 0.05)}))]
        for entry in ("p4", "p16"):
            runs[0].manifest["variants"][entry][1]["spp"] = int(entry[1:])
        views = [pareto.scenes_of(runs, metric, "indirect") for metric in runs[0].metrics[:2]]
        method, factor = pareto.best_at([scenes[0] for scenes in views], "frame", (4, 16))
        self.assertEqual(method, "inject_light_rays + gather_rays + filter_irradiance")  # Lookups do not get to the error of 16 samples.
        self.assertAlmostEqual(factor.value, 2)
        best, reached, ties = pareto.best_point(views[0][0], "frame")
        self.assertEqual((best.label, reached.bound, ties), ("r", ">", []))
        # Of an error that path tracing never gets to no time is told that could look shorter than the method's
        page = pareto_page.render(runs, runs[0].metrics[0], "indirect")
        self.assertIn("<td>never; its slowest 400</td>", page)
        self.assertNotIn("Not ranked", page)

    def paths(self, *of, root=True):
        """Variants of filtered path tracing with so many samples a pixel; no more accurate by more of them where `root` is not set."""
        return {f"p{spp}": (PATHS, 25 * spp, 0.4 / math.sqrt(spp) if root else 0.1 + 0.001 * spp) for spp in of}

    def loaded(self, name, variants, **changes):
        run = load(self.run_of(name, variants, **changes))
        for key, graph in run.manifest["variants"].items():
            graph[1].update({"spp": int(key[1:])} if key[0] == "p" else {})
        return run

    def test_what_is_not_ranked_is_named_with_its_reason(self):
        rays = {"r": (RAYS, 50, 0.05)}
        runs = [self.loaded(*run) for run in (
            ("hall", {"l": (LOOKUP, 10, 0.15)} | rays), ("attic", self.paths(4) | rays), ("cellar", self.paths(4, 16)),
            ("shed", self.paths(4, 16, root=False) | rays), ("room", self.paths(4, 16) | rays))]
        bare = self.run_of("bare", {"l": (LOOKUP, 10, 0.15)})
        (bare / "results.csv").write_text("variant,status\nl,ok\n", encoding="utf-8")
        runs.append(load(bare))
        page = pareto_page.render(runs, runs[0].metrics[0], "indirect")
        for words in ("no variant of path_trace with filter_irradiance was measured to compare with: hall.",
                      "filtered path tracing was measured with 4 samples a pixel, and 4 and 16 are needed: attic.",
                      "no other method was measured on the machine of filtered path tracing: cellar.",
                      "more samples a pixel did not lower the error of filtered path tracing, of 4 and 16: shed."):
            self.assertIn(f"Not ranked, for {words}", page)
        self.assertIn(f"Not shown, for no variant has nRMSE of the indirect light: {bare}.", page)
        self.assertIn("4 and 16 samples a pixel: inject_light_rays + gather_rays", page)
        self.assertNotIn("No method reaches", page)

    def test_errors_that_no_method_reaches_make_nothing_fastest(self):
        runs = [self.loaded("room", self.paths(1, 4, 16) | {"l": (LOOKUP, 10, 0.3)})]
        page = pareto_page.render(runs, runs[0].metrics[0], "indirect")
        self.assertIn("No method reaches both errors (nRMSE and relMSE) of filtered path tracing with 4 and 16 samples a pixel, so none "
                      "is called fastest there: room.", page)
        self.assertNotIn("fastest at the errors", page)
        self.assertNotIn("filtered path tracing itself", page)
        self.assertNotIn("Best method over", page)
        self.assertNotIn("none.", page)  # Nothing is beaten everywhere: no sentence says so
        self.assertIn("most often on the Pareto front: ", page)

    def test_a_method_is_ranked_over_several_machines(self):
        variants = self.paths(4, 16) | {"r": (RAYS, 50, 0.05)}
        runs = [self.loaded("room", variants), self.loaded("room", variants, device="a GPU")]
        [scene] = pareto.scenes_of(runs, runs[0].metrics[0], "indirect")
        method, factor = pareto.best_at([scene], "frame", (4, 16))
        self.assertEqual((method, factor.value), ("inject_light_rays + gather_rays", 2))

    def test_the_page_and_its_table(self):
        folder = self.run_of("room", {"p": (PATHS, 100, 0.1), "r": (RAYS, 10, 0.05)})
        out = self.root / "out.html"
        self.assertEqual(pareto_page.write(out, [folder], "nrmse", "indirect"), out.with_suffix(".csv"))
        page = out.read_text(encoding="utf-8")
        for words in ("Speed-up over filtered path tracing", "room", "1 of 1", "<svg"):
            self.assertIn(words, page)
        self.assertFalse([line[:80] for line in page.splitlines() if "http:" in line or "https:" in line])
        with open(out.with_suffix(".csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["method"] for row in rows], ["path_trace", "inject_light_rays + gather_rays"])
        self.assertEqual(float(rows[1]["frame"]), 10)

    def test_the_page_opens_with_who_wins(self):
        # Without filtered path tracing of known samples: who is on the front
        runs = [load(self.run_of(name, {"p": (PATHS, 100, error), "r": (RAYS, 90, 0.05)})) for name, error in (("room", 0.1), ("hall", 0.01))]
        metric = runs[0].metrics[0]
        self.assertEqual(pareto.on_front(pareto.scenes_of(runs, metric, "indirect"), "frame"),
                         {"inject_light_rays + gather_rays": 2, "path_trace": 1})
        page = pareto_page.render(runs, metric, "indirect")
        self.assertIn("most often on the Pareto front: inject_light_rays + gather_rays (2 of 2 scenes); path_trace (1 of 2 scenes).", page)
        self.assertNotIn("beaten in every scene", page)

        # At its errors: four times as fast in one scene, a quarter of that in the other
        rays = lambda speed: {f"r{spp}": (RAYS, 25 * spp / speed, 0.4 / math.sqrt(spp)) for spp in (4, 16, 64)}
        cones = {"c": (CONES, 1000, 0.5)}  # beaten by all
        runs = [self.loaded(name, self.paths(4, 16) | cones | rays(speed)) for name, speed in (("attic", 4), ("cellar", 0.25))]
        page = pareto_page.render(runs, metric, "indirect")
        words = ("By the time of one frame, fastest at the errors of filtered path tracing with 4 and 16 samples a pixel: "
                 "inject_light_rays + gather_rays (attic 4.0×); filtered path tracing itself (cellar).")
        self.assertIn(words, page)
        self.assertLess(page.index(words), page.index("By the time of one frame, beaten in every scene by another method: gather_cones."))

    def test_what_cannot_be_read(self):
        folder = self.run_of("room", {"p": (PATHS, 100, 0.1)})
        for results, error, words in (("nowhere", "nrmse", "no such file"), (folder, "ssim", "'ssim' is none of")):
            with self.assertRaisesRegex(ReportError, words):
                pareto_page.write(self.root / "x.html", [results], error, "indirect")
        self.assertFalse((self.root / "x.html").exists())


if __name__ == "__main__":
    unittest.main()
