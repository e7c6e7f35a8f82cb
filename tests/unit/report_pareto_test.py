"""Tests of the comparison of methods over runs. Needs Debian's Python with pandas, matplotlib and Jinja2."""

import csv
import json
import math
import re
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "framework"), str(Path(__file__).resolve().parent)]

import pareto_results  # noqa: E402
import report_results as made_up  # noqa: E402
from report import methods, pages, pareto, pareto_page  # noqa: E402
from report.load import load  # noqa: E402
from report.pareto_page import Comparison  # noqa: E402
from report.results import ReportError  # noqa: E402

RAYS = ("gbuffer", "voxelize", "inject_light_rays", "gather_rays", "filter_irradiance")
PATHS = ("gbuffer", "path_trace", "filter_irradiance")
CONES = ("gbuffer", "voxelize", "gather_cones", "filter_irradiance")
LOOKUP = ("gbuffer", "voxelize", "inject_light_rays", "gather_irradiance")


def data_of(page: str) -> dict:
    """The numbers that a page shows."""
    return json.loads(re.search(r'<script type="application/json" id="data">(.*)</script>', page)[1])


class Pareto(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)

    def run_of(self, name, variants, **changes):
        """A run in a folder; variants: name -> (passes, ms, error of the indirect light)."""
        rows = [made_up.variant(key, ms, error, error) for key, (_, ms, error) in variants.items()]
        for row in rows:
            for key in ("indirect_nrmse", "indirect_relmse"):
                row.update(made_up.spread(key, 0.95 * row[key], 1.05 * row[key]))
        run = made_up.manifest([])
        run["variants"] = {key: [{"pass": kind} for kind in passes] for key, (passes, _, _) in variants.items()}
        run["config"]["scene"] = {"builtin": name}
        run["reference"]["hash"] = name
        run.update(changes)
        return made_up.write_results(self.root / f"{name}{len(list(self.root.iterdir()))}", rows, run, images=False)

    def compare(self, *folders) -> Comparison:
        return Comparison.of([load(folder) for folder in folders], "nrmse", "indirect")

    def index(self, compared, passes):
        return [method.chain for method in compared.methods].index(tuple(name for name in passes if name not in ("gbuffer", "voxelize")))

    def cell(self, compared, passes, scene=0, cost=0, error=0):
        """Factor over filtered path tracing, its ends, errors that were reached, and of how many."""
        found = compared.speed_ups
        self.assertEqual(found.rivals[0], self.index(compared, PATHS))
        return *found.factors[0, cost, error, scene, self.index(compared, passes)], found.count[0, cost, error, scene]

    def ratios(self, compared, passes):
        return pareto.errors_at_equal_cost(compared.scenes[0], compared.rival, self.index(compared, passes), 0, 0)

    def paths(self, *of):
        """Variants of filtered path tracing with so many samples a pixel."""
        return {f"p{spp}": (PATHS, 25 * spp, 0.4 / math.sqrt(spp)) for spp in of}

    def test_factors_at_equal_error_and_at_equal_time(self):
        # Paths: error falls with the root of time. Rays: a quarter of the time for the same.
        paths = {f"p{ms}": (PATHS, ms, 1 / math.sqrt(ms)) for ms in (100, 400, 1600)}
        rays = {f"r{ms}": (RAYS, ms, 0.5 / math.sqrt(ms)) for ms in (25, 100, 400, 1600)}
        compared = self.compare(self.run_of("room", paths | rays))
        self.assertEqual([scene.name for scene in compared.scenes], ["room"])
        value, low, high, reached, of = self.cell(compared, RAYS)
        self.assertAlmostEqual(value, 4, 3)
        self.assertEqual((reached, of), (3, 3))
        # Both intervals are 5 % wide on each end, and error goes with the root of time
        self.assertAlmostEqual(low, 4 * (0.95 / 1.05) ** 2, 3)
        self.assertAlmostEqual(high, 4 * (1.05 / 0.95) ** 2, 3)
        # The other way round, at the errors of rays; of the least one paths have no variant
        r, p = compared.speed_ups.rivals.index(self.index(compared, RAYS)), self.index(compared, PATHS)
        self.assertAlmostEqual(compared.speed_ups.factors[r, 0, 0, 0, p, 0], 0.25, 3)
        self.assertEqual(compared.speed_ups.factors[r, 0, 0, 0, p, 3], 3)
        for value, low, high in self.ratios(compared, RAYS):
            self.assertAlmostEqual(value, 0.5, 6)
            self.assertLess(high, 1)

    def test_errors_that_are_not_reached_count_nowhere(self):
        compared = self.compare(self.run_of("room", {"p1": (PATHS, 100, 0.2), "p2": (PATHS, 200, 0.1), "l": (LOOKUP, 10, 0.15), "c": (CONES, 10, 0.5)}))
        np.testing.assert_allclose(self.cell(compared, LOOKUP), (10, 10, 10, 1, 2))
        self.assertEqual(self.cell(compared, CONES)[3:], (0, 2))
        data = data_of(pareto_page.render(compared))
        self.assertEqual(data["factors"][0][0][0][0][self.index(compared, LOOKUP)], [10, 10, 10, 1])
        self.assertEqual(data["factors"][0][0][0][0][self.index(compared, CONES)], 0)

    def test_the_median_over_scenes_takes_what_is_not_reached_for_slower(self):
        rooms = [self.run_of(name, self.paths(4) | {"l": (LOOKUP, 10, error)}) for name, error in (("a", 0.1), ("b", 0.3), ("c", 0.15))]
        rooms.append(self.run_of("d", {"r": (RAYS, 10, 0.1)}))  # without path tracing
        compared = self.compare(*rooms)
        medians = compared.speed_ups.medians(compared.measured)[0, 0, 0]
        self.assertAlmostEqual(medians[self.index(compared, LOOKUP)], 10)
        self.assertTrue(math.isnan(medians[self.index(compared, RAYS)]))

    def test_scenes_are_of_one_reference_and_one_machine(self):
        folders = [self.run_of("room", {"p": (PATHS, 100, 0.1)}), self.run_of("room", {"r": (RAYS, 10, 0.05)}),
                   self.run_of("room", {"g": (RAYS, 1, 0.02)}, device="a GPU"), self.run_of("hall", {"p": (PATHS, 100, 0.1), "r": (RAYS, 400, 0.2)})]
        compared = self.compare(*folders)
        self.assertEqual([(scene.name, len(scene.labels)) for scene in compared.scenes],
                         [("room (llvmpipe)", 2), ("room (a GPU)", 1), ("hall", 2)])
        self.assertAlmostEqual(self.cell(compared, RAYS)[0], 10)
        self.assertEqual(self.cell(compared, RAYS, 1)[3:], (0, 0))  # No path tracing there to be faster than

    def test_references_of_one_scene_are_told_apart(self):
        runs = [load(self.run_of("room", {"p": (PATHS, 100, 0.1)})) for _ in range(3)]
        for run, (hash_, name) in zip(runs, (("x", "near"), ("y", "far"), ("z", "far"))):
            run.manifest["reference"]["hash"] = hash_
            run.manifest["config"]["name"] = name
        scenes = Comparison.of(runs, "nrmse", "indirect").scenes
        self.assertEqual([scene.name for scene in scenes], ["room (near)", "room (far) 1", "room (far) 2"])

    def test_intervals_that_overlap_leave_it_open(self):
        compared = self.compare(self.run_of("room", {"p": (PATHS, 100, 0.1), "r": (RAYS, 90, 0.095)}))
        for value, low, high in (self.cell(compared, RAYS)[:3], *self.ratios(compared, RAYS)):
            self.assertTrue(low <= value <= high and low <= 1 <= high, (value, low, high))

    def test_costs_and_errors(self):
        compared = self.compare(self.run_of("room", {"p": (PATHS, 100, 0.1), "r": (RAYS, 100, 0.05)}))
        [scene] = compared.scenes
        # Of a build of 200 ms `voxelize` takes 140; light does not change voxels
        np.testing.assert_allclose(scene.costs[:4, 1], (100, 156, 300, 2**24 * 100))
        # An older run does not tell which passes depend on light
        old = load(self.run_of("hall", {"p": (PATHS, 100, 0.1)}))
        del old.manifest["light_independent"]
        [scene_of_old] = Comparison.of([old], "nrmse", "indirect").scenes
        np.testing.assert_allclose(scene_of_old.costs[:4, 0], (100, math.nan, 300, 2**24 * 100))
        switches = [re.findall(r'name="cost" value="(\d)"', pareto_page.render(Comparison.of(runs, "nrmse", "indirect"))) for runs in ([old], [old, compared.runs[0]])]
        self.assertEqual(switches, [["0", "2", "3"], ["0", "1", "2", "3"]])
        self.assertEqual([error.label for error in compared.errors], ["nRMSE", "relMSE", "HDR-FLIP", "1 − SSIM"])
        np.testing.assert_allclose(scene.errors[:, 0, 1], (0.05, 0.0025, 0.025, 0.025))
        np.testing.assert_allclose(scene.errors[0, :, 1], (0.05, 0.0475, 0.0525))

    def test_errors_that_a_run_has_not_are_empty(self):
        both = [load(self.run_of(name, {"p": (PATHS, 100, 0.1), "r": (RAYS, 10, 0.05)})) for name in ("room", "hall")]
        both[1].metrics = both[1].metrics[:1]
        compared = Comparison.of(both, "nrmse", "indirect")
        self.assertEqual(np.isfinite(compared.scenes[1].errors[:, 0]).all(axis=1).tolist(), [True, False, False, False])
        self.assertEqual(self.cell(compared, RAYS, 1, error=1)[3:], (0, 0))
        pareto_page.render(compared)
        # Whichever run comes first
        self.assertEqual([error.metric.key for error in Comparison.of(both[::-1], "relmse", "indirect").errors], ["nrmse", "relmse", "flip", "ssim"])

    def test_images_worse_than_black_are_on_no_front(self):
        compared = self.compare(self.run_of("room", {"p": (PATHS, 100, 0.1), "r": (RAYS, 1, 1.9)}))
        [scene] = compared.scenes
        self.assertEqual(scene.front_of_all(0, 0).tolist(), [0])
        self.assertEqual(self.cell(compared, RAYS)[3:], (0, 1))

    def test_methods_are_called_as_their_variants_are(self):
        run = load(pareto_results.write(self.root / "compare", images=False))
        found, [members] = methods.methods_of([run])
        self.assertEqual([method.name for method in found], list(pareto_results.METHODS))
        self.assertEqual(found[members["sponza-rays-16-a-pixel"]].name, "rays")
        self.assertEqual([method.name for method in found if method.is_rival], ["filtered paths"])
        self.assertEqual(found[5].chain, ("inject_light_rays", "filter_voxels (dense)", "gather_cones"))
        # Where variants' names have no words in common, by the gather and by what tells them apart
        rows = [made_up.variant(name, 1, 0.1, 0.1) for name in ("a", "b", "c", "d", "e")]
        run = made_up.manifest([])
        chains = (RAYS, RAYS, (*RAYS, "merge_voxels"), CONES, (*PATHS, "accumulate"))
        run["variants"] = {row["variant"]: [{"pass": kind} for kind in chain] for row, chain in zip(rows, chains)}
        found, _ = methods.methods_of([load(made_up.write_results(self.root / "plain", rows, run, images=False))] * 2)
        self.assertEqual([method.name for method in found], ["gather rays, filtered", "c", "d", "e"])
        # Numbers that a sweep varies name no method
        rows = [made_up.variant(f"spp-{spp}", 1, 0.1, 0.1, name=f"spp {spp}", spp=spp) for spp in (1, 4)]
        run = {**made_up.manifest(["spp"]), "variants": {row["variant"]: [{"pass": kind} for kind in PATHS] for row in rows}}
        numbers, _ = methods.methods_of([load(made_up.write_results(self.root / "numbers", rows, run, images=False))])
        self.assertEqual([method.name for method in numbers], ["path trace, filtered"])
        found[0].names, found[1].names = [], []
        methods._give_names(found)
        self.assertEqual([method.name for method in found], ["gather rays, filtered", "gather rays, filtered (merge voxels)", "d", "e"])

    def test_the_best_point(self):
        compared = self.compare(self.run_of("room", self.paths(4, 16) | {"l": (LOOKUP, 10, 0.15), "r": (RAYS, 50, 0.05)}))
        i, spent, bound, ties = pareto.best_point(compared.scenes[0], compared.rival, {compared.rival}, 0, 0)
        self.assertEqual((compared.scenes[0].labels[i], spent, bound, ties), ("r", 400, ">", []))
        # Of an error that path tracing never gets to no time is told that could look shorter than the method's
        table = pareto_page._rival_tables(compared)[0]
        self.assertEqual([getattr(cell, "text", cell) for cell in table.rows[0][:5]], ["room", "r", "0", "50.0", "never"])
        # Nor is one that path tracing would need more than where its cheapest variant has less error already
        coarse = self.compare(self.run_of("hall", self.paths(4, 16) | {"l": (LOOKUP, 10, 0.3)}))
        cell = pareto_page._rival_tables(coarse)[0].rows[0][4]
        self.assertEqual(cell.text, "<100")
        self.assertAlmostEqual(float(cell.sort), 100)

    def test_sentences_say_what_to_take_for_what(self):
        # At its errors: four times as fast in one scene, a quarter of that in the other; with light and build slower
        rays = lambda speed: {f"r{spp}": (RAYS, 25 * spp / speed, 0.4 / math.sqrt(spp)) for spp in (4, 16, 64)}
        folders = [self.run_of(name, self.paths(4, 16) | {"c": (CONES, 1000, 0.5)} | rays(speed)) for name, speed in (("attic", 4), ("cellar", 0.25))]
        compared = self.compare(*folders)
        self.assertEqual(pareto_page.sentences(compared), [
            "Still light (frame): take gather rays, filtered in attic (4.0×).",
            "Light that changes (frame + light): take gather rays, filtered in attic (4.0×).",
            "Surfaces that move (build + frame): take gather rays, filtered in attic (4.0×).",
            "Filtered paths stay ahead at most of their errors: still light (frame) in cellar; light that changes (frame + light) in cellar; surfaces that move (build + frame) in cellar."])
        self.assertIn(["c", "gather_cones + filter_irradiance", "2"], pareto_page._method_table(compared).rows)

    def test_a_method_that_reaches_less_than_half_of_the_errors_is_not_recommended(self):
        compared = self.compare(self.run_of("room", self.paths(1, 4, 16) | {"l": (LOOKUP, 10, 0.3)}))
        self.assertEqual(self.cell(compared, LOOKUP)[3:], (1, 3))
        self.assertEqual(len(pareto_page.sentences(compared)), 1)
        self.assertIn("Filtered paths stay ahead at most of their errors: still light (frame) in room;", pareto_page.sentences(compared)[0])

    def test_without_path_tracing_nothing_is_recommended(self):
        bare = self.run_of("bare", {"l": (LOOKUP, 10, 0.15)})
        (bare / "results.csv").write_text("variant,status\nl,ok\n", encoding="utf-8")
        compared = self.compare(*(self.run_of(name, {"c": (CONES, 100, error), "r": (RAYS, 90, 0.05)}) for name, error in (("room", 0.1), ("hall", 0.01))), bare)
        self.assertEqual(pareto_page.sentences(compared), [])
        page = pareto_page.render(compared)
        for words in (f"Not shown, for no variant has nRMSE of the indirect light: {bare}.", "to compare with: room, hall."):
            self.assertIn(words, page)

    def test_the_page_and_its_table(self):
        folder = self.run_of("room", {"p": (PATHS, 100, 0.1), "r": (RAYS, 10, 0.05)})
        out = self.root / "out.html"
        self.assertEqual(pareto_page.write(out, [folder], "relmse", "indirect"), out.with_suffix(".csv"))
        page = out.read_text(encoding="utf-8")
        self.assertIn("default-src 'none'", page)
        self.assertRegex(page, 'name="error" value="1" checked')
        with open(out.with_suffix(".csv"), newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["method"] for row in rows], ["p", "r"])
        self.assertEqual(list(rows[0])[11:14], ["relmse", "relmse_low", "relmse_high"])
        self.assertEqual([float(rows[1][key]) for key in ("frame", "nrmse_low", "one_minus_ssim")], [10, 0.0475, 0.025])

    def test_images_are_of_all_variants_or_of_those_on_a_front(self):
        size = (640, 360)
        pareto_results.write(self.root / "few", scenes=("cornell",), size=size)
        compared = self.compare(self.root / "few")
        [few] = pareto_page._pictures(compared)
        self.assertEqual(len(few), 42)
        self.assertEqual((compared.scenes[0].labels[0], compared.scenes[0].pictures[0][1]), ("cornell, lookup, links", "cornell-lookup-links"))
        self.assertTrue(all(uri.startswith("data:image/jpeg;base64,") for uris in few.values() for uri in uris))
        with mock.patch.object(pareto_page, "_MAX_PICTURES", 40):
            self.assertTrue(5 < len(pareto_page._pictures(compared)[0]) < 40)
        self.assertNotIn("data:image", pareto_page.render(compared, with_images=False))

    def test_pages_of_many_variants_are_small(self):
        for scenes, copies, most in ((pareto_results.SCENES, 1, 6e6), (pareto_results.SCENES[:1], 244, 15e6)):
            folder = pareto_results.write(self.root / str(copies), scenes, copies, images=False)
            self.assertLess(len(pareto_page.render(self.compare(folder)).encode()), most)

    def test_figures_have_embedded_fonts_and_their_data(self):
        folder = pareto_results.write(self.root / "run", scenes=("cornell", "sponza"), images=False)
        out = self.root / "figures"
        pareto_page.write(self.root / "out.html", [folder], "nrmse", "indirect", figures_to=out)
        names = {f"{what}-{cost}" for what in ("matrix", "cornell", "sponza") for cost in ("frame", "frame-light", "build-frame", "memory")}
        self.assertEqual({path.name for path in out.iterdir()}, {f"{name}.{kind}" for name in names for kind in ("svg", "pdf", "csv")})
        for name, width in (("cornell-frame", 84.5), ("matrix-frame", 178)):
            pdf = (out / f"{name}.pdf").read_bytes()
            self.assertIn(b"/FontFile2", pdf)
            self.assertNotIn(b"/Type3", pdf)
            box = re.search(rb"/MediaBox \[ *0 0 ([\d.]+)", pdf)
            self.assertAlmostEqual(float(box[1]) / 72 * 25.4, width, delta=0.1)
            self.assertNotIn("<text", (out / f"{name}.svg").read_text(encoding="utf-8"))
        with open(out / "cornell-frame.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 41)
        self.assertEqual(list(rows[0]), ["method", "name", "frame", "nrmse", "nrmse_low", "nrmse_high", "on front"])

    def test_what_cannot_be_read(self):
        folder = self.run_of("room", {"p": (PATHS, 100, 0.1)})
        for results, error, words in (("nowhere", "nrmse", "no such file"), (folder, "psnr_db", "'psnr_db' is none of nrmse, relmse, flip, ssim")):
            with self.assertRaisesRegex(ReportError, words):
                pareto_page.write(self.root / "x.html", [results], error, "indirect")
        self.assertFalse((self.root / "x.html").exists())

    def test_numbers_in_a_page_are_short(self):
        self.assertEqual(pages.json_text({"a": [1.23456, 2.0, math.nan, np.float64(1e-7), np.int64(3), "<b"], "b": np.array([[0.5]])}),
                         '{"a":[1.235,2,null,1e-07,3,"\\u003cb"],"b":[[0.5]]}')


if __name__ == "__main__":
    unittest.main()
