"""Tests of the tables of `voxray stability`, on runs whose numbers are known. Needs Debian's Python with pandas and Jinja2."""

import base64
import csv
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "framework"), str(Path(__file__).resolve().parent)]

import browser  # noqa: E402
import report_results as made_up  # noqa: E402
from exr_writer import exr  # noqa: E402
from report import pages, stability, stability_page, verdict  # noqa: E402
from report.results import ReportError  # noqa: E402
from report_support import Page  # noqa: E402

if not browser.MISSING:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

SHIPPED = Path(__file__).resolve().parents[2] / "configs" / "stability"
LIMITS = """\
profile,scene,measure,methods,limit,scale,why
leak,wall,leak,,0.0001,2,all is black
leak,wall,leak,cones,0.001,2,all is black
bias,room,bias,,0.08,,the plain case
same,bright,image,,0.001,1000,linear
same,bright,mean,,0.001,1000,linear
same,again,image,,0.001,1,the same numbers
moving,path,flicker,,0.02,,an eye
"""
REASONS = """\
scenes,measures,methods,cause
,leak,,mixed
wall; room,leak; mean,cones; marched cones,wide
"""
CAUSES = """\
cause,sentence
mixed,voxels of both sides
wide,wide cones pass
"""


class StabilityTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "out"
        self.limits = Path(folder.name) / "limits.csv"
        self.limits.write_text(LIMITS, encoding="utf-8")
        for name, table in (("reasons", REASONS), ("causes", CAUSES)):
            (Path(folder.name) / f"limits_{name}.csv").write_text(table, encoding="utf-8")

    def profile(self, name, cells):
        """Writes a run; cells: (scene, method), or with a seed, -> an even image's radiance, or a text: why it failed; and scores."""
        rows = []
        for i, (axes, (light, scores)) in enumerate(cells.items()):
            sweep = dict(zip(("scene", "method", "seed"), axes))
            if isinstance(light, str):
                rows.append(made_up.failed(f"v{i}", light, **sweep))
            else:
                rows.append({**made_up.variant(f"v{i}", 1, 0.1, 0.1, **sweep), **scores})
        made_up.write_results(self.root / name, rows, made_up.manifest(["scene", "method", "seed"][:len(axes)] if cells else ["scene", "method"]))
        for row, (light, _) in zip(rows, cells.values()):
            if not isinstance(light, str):
                image = np.broadcast_to(np.asarray(light, np.float32), (6, 8, 3))
                (self.root / name / "images" / row["variant"] / "indirect.exr").write_bytes(exr(image, zipped=True))

    def cells(self):
        rows = stability.read_limits(self.limits)
        reasons = stability.read_reasons(self.limits.with_name("limits_reasons.csv"))
        return {(cell.row.scene, cell.row.measure, cell.method): cell for cell in stability.cells_of(self.root, rows, reasons)}


class Stability(StabilityTest):
    def test_leaks_are_parts_of_the_lit_side_and_cones_have_a_limit_of_their_own(self):
        self.profile("leak", {("wall", "rays"): (0.001, {}), ("wall", "cones dense"): (0.001, {}), ("wall", "lookup"): (0.0, {}),
                              ("wall", "cones octree"): (0.004, {})})
        cells = self.cells()
        self.assertAlmostEqual(cells["wall", "leak", "rays"].value, 0.0005)
        self.assertTrue(cells["wall", "leak", "rays"].fails)
        self.assertFalse(cells["wall", "leak", "cones dense"].fails)
        self.assertEqual(cells["wall", "leak", "lookup"].value, 0)
        self.assertEqual(cells["wall", "leak", "lookup"].reason, "")
        self.assertEqual(cells["wall", "leak", "rays"].reason, "voxels of both sides")
        self.assertEqual(cells["wall", "leak", "cones octree"].reason, "wide cones pass")

    def test_images_are_compared_with_the_profiles_first_scene_by_the_same_method(self):
        noisy = 2000 + np.where(np.arange(8) % 2, 100, -100)[None, :, None]
        self.profile("same", {("plain", "rays"): (2.0, {}), ("plain", "cones"): (3.0, {}), ("bright", "rays"): (noisy, {}),
                              ("bright", "cones"): (3000 * 1.01, {}), ("again", "rays"): (2.0, {})})
        cells = self.cells()
        self.assertAlmostEqual(cells["bright", "image", "rays"].value, 0.05, 6)
        self.assertAlmostEqual(cells["bright", "mean", "rays"].value, 0, 6)
        self.assertAlmostEqual(cells["bright", "image", "cones"].value, 0.01, 6)
        self.assertAlmostEqual(cells["bright", "mean", "cones"].value, 0.01, 6)
        self.assertEqual(cells["again", "image", "rays"].value, 0)
        self.assertEqual(cells["bright", "mean", "cones"].reason, stability.UNKNOWN)
        self.assertTrue(cells["bright", "mean", "cones"].truth.match("v1/indirect.png"))

    def test_scores_come_from_the_results_and_what_did_not_run_fails(self):
        self.profile("bias", {("room", "rays"): (1.0, {"indirect_bias_nrmse": 0.05}), ("room", "cones"): ("no room left", {})})
        self.profile("moving", {("path", "rays"): (1.0, {"indirect_temporal_flicker": 0.03})})
        cells = self.cells()
        self.assertEqual(cells["room", "bias", "rays"].value, 0.05)
        self.assertFalse(cells["room", "bias", "rays"].fails)
        self.assertTrue(cells["room", "bias", "cones"].fails)
        self.assertIn("no room left", cells["room", "bias", "cones"].reason)
        self.assertTrue(cells["path", "flicker", "rays"].fails)
        # A score that is not there fails, too.
        self.profile("bias", {("room", "rays"): (1.0, {})})
        self.assertTrue(self.cells()["room", "bias", "rays"].fails)

    def test_verdicts_ask_whether_the_interval_holds_the_limit_and_how_wide_it_is(self):
        def bias(value, low, high):
            return 1.0, {"indirect_bias_nrmse": value, "indirect_bias_nrmse_low": low, "indirect_bias_nrmse_high": high}
        self.profile("bias", {("room", "rays"): bias(0.09, 0.07, 0.11), ("room", "cones"): bias(0.09, 0.085, 0.11),
                              ("room", "lookup"): bias(0.09, 0.05, 0.13), ("room", "surfels"): bias(0.02, 0, 0.079)})
        cells = self.cells()
        verdicts = {method: cells["room", "bias", method].verdict for method in ("rays", "cones", "lookup", "surfels")}
        self.assertEqual(verdicts, {"rays": "undecided", "cones": "fails", "lookup": "noise", "surfels": "holds"})
        self.assertEqual(cells["room", "bias", "rays"].reason, "undecided: the interval of 95 %, 7 to 11 %, holds the limit")
        self.assertEqual(cells["room", "bias", "lookup"].reason, "noise: the interval of 95 %, 5 to 13 %, holds the limit")
        self.assertEqual(cells["room", "bias", "cones"].reason, stability.UNKNOWN)
        self.assertEqual(cells["room", "bias", "surfels"].reason, "")
        tables = stability_page.write(self.root, self.limits)
        self.assertEqual(tables.summary, "1 of 4 cells fail; 1 undecided; 1 with too much noise to tell")
        self.assertEqual(tables.failing, {"bias": {"cones": ["room"]}})
        self.assertIn("| 9.0 ? | **9.0** | 9.0 ~ | 2.0 |", tables.markdown)

    def test_seeds_give_the_mean_and_the_interval_of_a_cell(self):
        # Of four values of standard deviation s, Student's t gives 3.182 s / 2 on either side of the mean.
        light = {seed: radiance for seed, radiance in zip((5, 6, 7, 8), (0.0008, 0.0010, 0.0010, 0.0012))}
        self.profile("leak", {("wall", "rays", seed): (value, {}) for seed, value in light.items()})
        cell = self.cells()["wall", "leak", "rays"]
        half = 3.182 * np.std(list(light.values()), ddof=1) / 2 / 2
        self.assertAlmostEqual(cell.value, 0.0005)
        self.assertAlmostEqual(cell.estimate.low, 0.0005 - half)
        self.assertAlmostEqual(cell.estimate.high, 0.0005 + half)
        # Errors are added as squares, and each seed is compared with its own image of the first scene.
        self.profile("moving", {("path", "rays", seed): (1.0, {"indirect_temporal_flicker": value}) for seed, value in ((5, 0.03), (6, 0.04))})
        self.profile("same", {("plain", "rays", 5): (2.0, {}), ("plain", "rays", 6): (4.0, {}),
                              ("bright", "rays", 5): (2040.0, {}), ("bright", "rays", 6): (3920.0, {})})
        cells = self.cells()
        self.assertAlmostEqual(cells["path", "flicker", "rays"].value, np.sqrt((0.03**2 + 0.04**2) / 2))
        self.assertAlmostEqual(cells["bright", "mean", "rays"].value, 0)  # + 2 % and - 2 %
        self.assertEqual(cells["bright", "mean", "rays"].verdict, "noise")
        self.assertAlmostEqual(cells["bright", "image", "rays"].value, 0.02)
        # Where one seed does not run, the cell fails.
        self.profile("leak", {("wall", "rays", 5): (0.0, {}), ("wall", "rays", 6): ("out of memory", {})})
        self.assertTrue(self.cells()["wall", "leak", "rays"].fails)

    def test_bias_is_what_the_errors_of_seeds_have_in_common(self):
        noise = 0.2 * np.random.default_rng(1).standard_normal((4, 6, 8, 3))
        reference = self.root / "bias" / "images" / "reference"
        self.profile("bias", {("room", "rays", seed): (2.2 + noise[seed], {}) for seed in range(4)})
        (reference / "indirect.exr").write_bytes(exr(np.full((6, 8, 3), 2, np.float32), zipped=True))
        cell = self.cells()["room", "bias", "rays"]
        products = [np.mean((0.2 + noise[a]) * (0.2 + noise[b])) for a in range(4) for b in range(a)]
        self.assertAlmostEqual(cell.value, np.sqrt(np.mean(products)) / 2, 5)
        self.assertLess(cell.estimate.low, 0.1)
        self.assertGreater(cell.estimate.high, 0.1)
        # What noise alone makes negative is 0; images that are alike have no noise.
        self.assertEqual(verdict.shared_error_of([np.ones((1, 1, 3)), -np.ones((1, 1, 3)), np.zeros((1, 1, 3))]).value, 0)
        self.assertEqual(verdict.shared_error_of([np.full((1, 1, 3), 0.2)] * 2), verdict.Estimate(0.2, 0, np.inf))
        alike = verdict.shared_error_of([np.full((2, 2, 3), 0.3)] * 3)
        for part in (alike.value, alike.low, alike.high):
            self.assertAlmostEqual(part, 0.3)

    def test_the_interval_of_a_shared_error_holds_the_true_one_in_95_of_100(self):
        random = np.random.default_rng(2)
        pattern = random.standard_normal((20, 30, 3))
        pattern *= 0.1 / np.sqrt(np.mean(pattern**2))
        found = [verdict.shared_error_of(list(pattern + 0.3 * random.standard_normal((4, 20, 30, 3)))) for _ in range(200)]
        held = np.mean([estimate.low <= 0.1 <= estimate.high for estimate in found])
        self.assertGreater(held, 0.88)
        self.assertLess(held, 0.995)
        self.assertAlmostEqual(np.sqrt(np.mean([estimate.value**2 for estimate in found])), 0.1, 2)

    def test_a_mask_chooses_the_pixels_that_count(self):
        self.limits.write_text("profile,scene,measure,methods,limit,scale,why\nleak,wall,leak@left,,0.01,2,half of it\n"
                               "energy,room,energy@left,,0.01,,half of it\n", encoding="utf-8")
        halves = np.repeat(np.repeat([[[1.0]] * 4 + [[5.0]] * 4], 6, 0), 3, 2)
        self.profile("leak", {("wall", "rays"): (halves, {})})
        self.profile("energy", {("room", "rays"): (halves, {"indirect_mean_ratio": 9})})
        (self.root / "energy" / "images" / "reference" / "indirect.exr").write_bytes(exr(np.full((6, 8, 3), 2, np.float32), zipped=True))
        with self.assertRaisesRegex(ReportError, "no mask 'left'"):
            self.cells()
        (self.limits.parent / "masks").mkdir()
        # A mask of another size is scaled to the image's
        Image.fromarray(np.repeat([[255, 0]], 3, 0).astype(np.uint8)).save(self.limits.parent / "masks" / "left.png")
        cells = self.cells()
        self.assertAlmostEqual(cells["wall", "leak@left", "rays"].value, 0.5)
        self.assertAlmostEqual(cells["room", "energy@left", "rays"].value, 0.5)

    def test_a_cause_needs_its_sentence(self):
        self.limits.with_name("limits_causes.csv").write_text("cause,sentence\nmixed,voxels of both sides\n", encoding="utf-8")
        with self.assertRaisesRegex(ReportError, "limits_causes.csv has no cause 'wide'"):
            self.cells()

    def test_remedies_say_what_lowers_a_cell_that_fails(self):
        bias = {"indirect_bias_nrmse": 0.2}
        self.profile("bias", {("room", "rays"): (1.0, bias), ("room", "cones"): (1.0, bias), ("room", "lookup"): (1.0, {"indirect_bias_nrmse": 0.01})})
        self.profile("moving", {("path", "rays"): (1.0, {"indirect_temporal_flicker": 0.01})})
        for name, rays, cones in (("finer_voxels", 0.1, 0.19), ("more_rays", 0.05, 0.21)):
            self.profile(f"remedies/{name}/rays/bias", {("room", "rays"): (1.0, {"indirect_bias_nrmse": rays})})
            self.profile(f"remedies/{name}/cones/bias", {("room", "cones"): (1.0, {"indirect_bias_nrmse": cones})})
        self.profile("remedies/finer_voxels/rays/moving", {})  # begun, nothing finished
        tables = stability_page.write(self.root, self.limits, with_remedies=True)
        self.assertEqual(tables.summary, "2 of 4 cells fail; 2 empty; a remedy lowers 1 of these, 1 of them below their limit")
        with open(self.root / "stability.csv", newline="", encoding="utf-8") as file:
            reasons = {(row["scene"], row["method"]): row["reason"] for row in csv.DictReader(file)}
        self.assertEqual(reasons, {("room", "rays"): "5.0 % with more rays, 10 % with finer voxels",
                                   ("room", "cones"): "not known; no remedy lowers it by a tenth: 19 % with finer voxels, 21 % with more rays",
                                   ("room", "lookup"): "", ("path", "rays"): ""})
        self.assertEqual(json.loads((self.root / "failing.json").read_text(encoding="utf-8")),
                         {"bias": {"rays": ["room"], "cones": ["room"]}})

    def test_the_tables_show_every_cell(self):
        self.profile("leak", {("wall", "rays"): (0.001, {}), ("wall", "cones"): ("out of memory", {})})
        self.profile("bias", {("room", "rays"): (1.0, {"indirect_bias_nrmse": 0.05})})
        self.assertEqual(stability_page.write(self.root, self.limits).summary, "2 of 3 cells fail; 1 empty")
        self.assertEqual((self.root / "stability.md").read_text(encoding="utf-8"),
                         "| scene | measure | limit, % | rays | cones |\n| --- | --- | --- | --- | --- |\n"
                         "| wall | leak | 0.010; 0.10 for cones | **0.050** | **does not run** |\n"
                         "| room | bias | 8.0 | 5.0 |  |\n")
        with open(self.root / "stability.csv", newline="", encoding="utf-8") as file:
            table = list(csv.DictReader(file))
        self.assertEqual([(row["method"], row["value"], row["verdict"]) for row in table],
                         [("rays", "0.0005", "fails"), ("cones", "", "fails"), ("rays", "0.05", "holds")])
        source = (self.root / "stability.html").read_text(encoding="utf-8")
        page = Page(source)
        self.assertEqual(page.count("td", "worse"), 2)
        self.assertIn("does not run: out of memory", page.text)
        self.assertNotIn("http", source.replace(pages._own("d3"), "").replace("http-equiv", ""))

    def test_what_can_not_be_read_is_said_in_a_line(self):
        for text, part in (("scene,limit\nroom,1\n", "expected the columns"),
                           (LIMITS.replace("bias,room,bias", "bias,room,bais"), "no measure 'bais'"),
                           (LIMITS.replace("0.08", "-1"), "a limit is 0 or more"),
                           (LIMITS.replace("path,flicker", "path,flicker@rim"), "'flicker' is of the whole image"),
                           (LIMITS.replace("leak,,0.0001", "leak,rays,0.0001"), "the first limit is that of all methods")):
            self.limits.write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(ReportError, part):
                stability.read_limits(self.limits)
        self.limits.write_text(LIMITS, encoding="utf-8")
        with self.assertRaisesRegex(ReportError, "no profile of the limits has results there"):
            stability_page.write(self.root, self.limits)

    def test_the_shipped_limits_and_reasons_fit_together(self):
        rows = stability.read_limits(SHIPPED / "matrix.csv")
        self.assertGreater(len(rows), 30)
        for reason in stability.read_reasons(SHIPPED / "matrix_reasons.csv"):
            for scene in reason.scenes or ("",):
                for kind in reason.measures or ("",):
                    self.assertTrue(any(scene in ("", row.scene) and kind in ("", row.kind) for row in rows), (scene, kind, reason))
        self.assertEqual(stability_page.limits(rows[0]), "0.015")


@unittest.skipIf(browser.MISSING, browser.MISSING)
class InABrowser(StabilityTest):
    """Two methods in two scenes; one cell is empty, one method does not run in a scene."""

    def setUp(self):
        super().setUp()
        self.profile("leak", {("wall", "rays"): (0.001, {}), ("wall", "cones"): ("out of memory", {})})
        self.profile("bias", {("room", "rays"): (1.0, {"indirect_bias_nrmse": 0.09, "indirect_bias_nrmse_low": 0.07,
                                                       "indirect_bias_nrmse_high": 0.11})})
        stability_page.write(self.root, self.limits)
        self.browser = browser.Browser()
        self.addCleanup(self.browser.close)

    def text(self, selector):
        return self.browser.run("return document.querySelector(arguments[0]).textContent", selector)

    def press(self, *keys):
        ActionChains(self.browser.driver).send_keys(*keys).perform()

    def test_the_map_is_read_by_keys_and_by_pointer(self):
        for width in (1400, 400):
            self.browser.resize(width, 800)
            self.browser.console()
            self.browser.open(self.root / "stability.html")
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)
            cells = self.browser.run("return [...document.querySelectorAll('#matrix tbody tr')].map((row) =>"
                                     " [...row.cells].map((cell) => [cell.textContent, cell.className]))")
            # 0.05 % of 0.01 %, and 9 % of 8 %, whose interval holds the limit; by the number of scenes that a method fails in
            self.assertEqual(cells, [[["cones", ""], ["✗", "fails"], ["", "empty"], ["1/1", "total"]],
                                     [["rays", ""], ["✗5.0", "fails"], ["?1.1", "undecided"], ["1/2", "total"]]])
            # Both names and symbols, not colors alone, tell of failing; the colors are on two sides of the scale's middle
            self.press(Keys.TAB)
            while self.browser.run("return document.activeElement.getAttribute('role')") != "gridcell":
                self.press(Keys.TAB)
            self.press(Keys.ARROW_DOWN)
            self.assertEqual(self.text("#cell"), "rays in wall: fails: leak 0.050 %, limit 0.010 % (voxels of both sides).")
            self.assertEqual(self.browser.run("return document.activeElement.getAttribute('aria-label')"), self.text("#cell"))
            images = "return [...document.querySelectorAll('#cell-images img')].map((image) => [image.alt, image.complete && image.naturalWidth])"
            self.assertEqual(self.browser.run(images), [["what should be shown: rays, wall", 64], ["what is shown: rays, wall", 64]])
            self.press(Keys.ARROW_UP, Keys.ARROW_RIGHT)
            self.assertEqual(self.text("#cell"), "cones in room: not measured.")
            self.assertEqual(self.browser.run(images), [])
            cell = self.browser.run("return document.querySelectorAll('#matrix tbody tr')[1].cells[2]")
            ActionChains(self.browser.driver).move_to_element(cell).perform()
            self.assertIn("undecided", self.text("#cell"))
            self.assertEqual(self.browser.console(), [])

    def test_tables_are_folded_and_the_map_is_printed(self):
        self.browser.open(self.root / "stability.html")
        heights = "return [...document.querySelectorAll('.folded:last-of-type table, #matrix')].map((table) => table.checkVisibility())"
        self.assertEqual(self.browser.run(heights), [True, False])
        self.browser.run("document.querySelector('.folded:last-of-type').open = true")
        rows = "return [...document.querySelectorAll('.folded:last-of-type tbody tr')].slice(0, 2).map((row) => row.cells[0].textContent)"
        self.assertEqual(self.browser.run(rows), ["wall", "wall"])
        self.browser.run("document.querySelector('.folded:last-of-type th button').click()")
        self.assertEqual(self.browser.run(rows), ["room", "wall"])
        # On paper the map has a page across
        pdf = base64.b64decode(self.browser.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"])
        self.assertTrue(any(int(width) > int(height) for width, height in re.findall(rb"/MediaBox \[0 0 (\d+) (\d+)\]", pdf)))
        self.browser.media("print")
        self.assertEqual(self.browser.run(heights), [True, True])


if __name__ == "__main__":
    unittest.main()
