"""Tests of the report: what it reads and concludes, and that any run's results make a whole, safe page."""

from __future__ import annotations

import base64
import contextlib
import io
import json
import math
import re
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from unittest import mock

sys.dont_write_bytecode = True
_ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(_ROOT / "framework"), str(_ROOT / "tests" / "unit")]

import report_results as made_up  # noqa: E402
from report import images, make_report, page, ranking, text  # noqa: E402
from report.load import Metric, ReportError, interval_of, load  # noqa: E402
from PIL import Image  # noqa: E402

_VOID = {"meta", "img", "input", "br", "wbr", "path", "rect", "use", "hr", "link"}
_NRMSE = Metric("nrmse", "nRMSE", "", "low", "", True)
_FLIP = Metric("flip", "HDR-FLIP", "", "low", "")


class Page(HTMLParser):
    """A parsed page; fails on a tag that is not closed and on an id that stands twice."""

    def __init__(self, source: str):
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict]] = []
        self.text = ""
        self.feed(source)
        self.close()
        assert not self.open, f"not closed: {self.open}"
        ids = self.attributes("id")
        assert len(ids) == len(set(ids)), "an id stands twice"

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag not in _VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        if tag not in _VOID:
            assert self.open and self.open[-1] == tag, f"</{tag}> closes {self.open[-1:]}"
            self.open.pop()

    def handle_data(self, data):
        if self.open and self.open[-1] not in ("style", "script"):
            self.text += data

    def attributes(self, name: str) -> list[str]:
        return [attrs[name] for _, attrs in self.tags if name in attrs]

    def count(self, tag: str, css_class: str) -> int:
        return sum(t == tag and css_class in (a.get("class") or "").split() for t, a in self.tags)


class ReportTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name) / "run"

    def run_program(self) -> tuple[int, str]:
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(io.StringIO()):
            status = make_report.main([str(self.directory)])
        return status, errors.getvalue()

    def make(self, rows, run=None, **options) -> Page:
        made_up.write_results(self.directory, rows, run, **options)
        status, errors = self.run_program()
        self.assertEqual((status, errors), (0, ""))
        return Page((self.directory / "report.html").read_text(encoding="utf-8"))


class FullRun(unittest.TestCase):
    """Six finished variants and a failed one, with everything that a run can write."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.directory = made_up.write_results(Path(folder.name), made_up.sweep_of_two_keys(),
                                              made_up.manifest(["voxelize.resolution", "inject"]))
        cls.source = page.render(load(cls.directory))
        cls.page = Page(cls.source)

    def test_shows_every_part(self):
        # 2 lights x 2 times x 3 errors; 6 finished variants x 2 lights x (image, error map) and 2 references.
        self.assertEqual(self.page.count("svg", "chart"), 12)
        sources = [attrs["src"] for tag, attrs in self.page.tags if tag == "img"]
        self.assertEqual(len(sources), 26)
        self.assertTrue(all(source.startswith("data:image/png;base64,") for source in sources))
        for words in ("6 of 7 variants finished. 1 variant failed", "needs 34.4 GiB", "a constant image",
                      "light_rays-256 and rsm-256 cannot be told apart, from 0.3 to 0.31", "0.29–0.31",
                      "Fastest frame: rsm-64 with 9 ms"):
            self.assertIn(words, self.page.text)

    def test_embeds_each_image_once(self):
        sources = [attrs["src"] for tag, attrs in self.page.tags if tag == "img"]
        self.assertEqual(self.source.count("data:image/png;base64,"), len(sources))

    def test_needs_nothing_else(self):
        self.assertNotRegex(self.source, r"https?://")
        for _, value in re.findall(r'\b(src|href)="([^"]*)"', self.source):
            self.assertRegex(value, r"^(data:image/png|#)")

    def test_links_lead_somewhere(self):
        targets = {f"#{name}" for name in self.page.attributes("id")}
        links = self.page.attributes("href") + self.page.attributes("xlink:href")
        self.assertGreater(len(links), 12 * 6)
        self.assertLessEqual(set(links), targets)

    def test_notebook_reads_the_same_results(self):
        picture = self.directory / "chart.png"
        notebook = _ROOT / "notebooks/read_results.py"
        done = subprocess.run([sys.executable, notebook, self.directory, picture],
                              capture_output=True, text=True, check=True)
        self.assertLess(done.stdout.index("light_rays-256"), done.stdout.index("rsm-64"))  # by rising error
        with Image.open(picture) as image:
            self.assertGreater(image.size[0], 500)

    def test_notebook_of_the_octree_reads_a_benchmark(self):
        runs = [{"name": f"octreeBuild/resolution:{r}/directions:1/process_time", "voxels": 6.0 * r * r, "MB": r * r / 1e4,
                 "bytes_per_voxel": 16.7, "grid_voxels": float(r ** 3)} for r in (64, 128)]
        measured, picture = self.directory / "octree.json", self.directory / "octree.png"
        measured.write_text(json.dumps({"benchmarks": runs}), encoding="utf-8")
        done = subprocess.run([sys.executable, _ROOT / "notebooks/octree_memory.py", measured, picture],
                              capture_output=True, text=True, check=True)
        self.assertIn("24576.0", done.stdout)
        with Image.open(picture) as image:
            self.assertGreater(image.size[0], 500)

    def test_same_results_make_the_same_page(self):
        self.assertEqual(self.source, page.render(load(self.directory)))


class PartOfARun(ReportTest):
    def test_without_indirect_light(self):
        rows = [made_up.variant("a", 10, 0.3), made_up.variant("b", 20, 0.2)]
        shown = self.make(rows, made_up.manifest([]), indirect=False)
        self.assertEqual(shown.count("svg", "chart"), 6)
        self.assertNotIn("Indirect", shown.text)

    def test_without_reference_and_manifest(self):
        rows = [made_up.variant("a", 10, 0.3), made_up.variant("b", 20, 0.2)]
        shown = self.make(rows, reference=False, indirect=False)
        self.assertIn("The reference's image is missing", shown.text)
        self.assertIn("manifest.json cannot be read", shown.text)
        self.assertIn("scores are left out", shown.text)
        self.assertEqual(shown.count("svg", "chart"), 0)

    def test_single_variant(self):
        shown = self.make([made_up.variant("only", 10, 0.3)], made_up.manifest([]), indirect=False)
        self.assertEqual(shown.count("td", "best"), 0)  # nothing to be better than
        self.assertEqual(shown.count("svg", "chart"), 6)

    def test_all_failed(self):
        shown = self.make([made_up.failed("a", "lost device"), made_up.failed("b", "")], made_up.manifest([]))
        self.assertIn("0 of 2 variants finished. 2 variants failed", shown.text)
        self.assertIn("there is nothing to draw", shown.text)
        self.assertIn("status is 'failed', with no error text", shown.text)

    def test_nothing_finished_yet(self):
        run = made_up.manifest([])
        del run["finished"]
        shown = self.make([], run)
        self.assertIn("No variant has finished yet", shown.text)
        self.assertIn("had not ended", shown.text)

    def test_zero_and_infinite_scores_are_named_not_drawn(self):
        perfect = made_up.variant("perfect", 10, 0.0)
        perfect["psnr_db"] = "inf"
        shown = self.make([perfect, made_up.variant("good", 20, 0.1)], made_up.manifest([]))
        self.assertIn("perfect (nRMSE, total)", shown.text)
        self.assertIn("∞", shown.text)

    def test_broken_files_are_named(self):
        made_up.write_results(self.directory, [made_up.variant("a", 10, 0.3)], made_up.manifest([]))
        (self.directory / "images/a/final.png").write_bytes(b"\x89PNG\r\n\x1a\nbroken")
        (self.directory / "passes.csv").write_text("what,is\nthis,here\n")
        (self.directory / "manifest.json").write_text('{"commit": ')
        self.assertEqual(self.run_program()[0], 0)
        shown = Page((self.directory / "report.html").read_text(encoding="utf-8"))
        for message in ("is not a whole PNG file", "passes.csv lacks a column", "manifest.json cannot be"):
            self.assertIn(message, shown.text)

    def test_reported_values_have_a_table_and_a_chart_over_frames(self):
        rows = [made_up.variant(name, 10, 0.3) for name in ("a", "b")]
        self.assertNotIn("What passes report", self.make(rows, made_up.manifest([])).text)
        (self.directory / "values.csv").write_text(
            "variant,pass,name,frame,value\na,compare,missed,,1234567\na,probe,change,0,0.25\na,probe,change,1,0.75\n"
            "b,compare,missed,,40\n")
        self.assertEqual(self.run_program()[0], 0)
        shown = Page((self.directory / "report.html").read_text(encoding="utf-8"))
        for words in ("What passes report", "compare: missed", "1\u202f234\u202f567", "0.500 (most 0.750)", "a: 0.500 on average"):
            self.assertIn(words, shown.text)
        self.assertEqual(shown.attributes("aria-label").count("probe: change"), 1)
        (self.directory / "values.csv").write_text("what,is\nthis,here\n")
        self.assertEqual(self.run_program()[0], 0)
        self.assertIn("values.csv lacks a column", Page((self.directory / "report.html").read_text(
            encoding="utf-8")).text)

    def test_sequences_have_a_table_and_charts_over_frames(self):
        rows = [made_up.variant(name, 10, error) for name, error in (("calm", 0.2), ("restless", 0.4))]
        frames = made_up.with_sequence(rows, 3)
        made_up.write_results(self.directory, rows, made_up.manifest([]), indirect=False)
        made_up.write_csv(self.directory / "frames.csv", list(frames[1]), frames)
        self.assertEqual(self.run_program()[0], 0)
        shown = Page((self.directory / "report.html").read_text(encoding="utf-8"))
        for words in ("Over frames", "temporal bias", "0.080–0.12", "calm: 0.220 on average"):
            self.assertIn(words, shown.text)
        self.assertEqual(shown.count("svg", "chart"), 6 + 3)
        (self.directory / "frames.csv").write_text("what,is\nthis,here\n")
        self.assertEqual(self.run_program()[0], 0)
        self.assertIn("frames.csv lacks a column", (self.directory / "report.html").read_text(encoding="utf-8"))

    def test_masks_have_their_own_scores_noise_and_picture(self):
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.2), ("b", 0.4))]
        for row, value in zip(rows, (0.7, 0.609)):
            row["nrmse@floor"] = value
            row.update({"nrmse_low@floor": value - 0.06, "nrmse_high@floor": value + 0.06, "flip@floor": 0.2})
        run = made_up.manifest([])
        run["config"]["measure"] = {"masks": {"floor": {"material": "stone"}}}
        run["reference"] |= {"flip@floor_noise": 0.123, "mask_fractions": {"floor": 0.25}}
        run["baselines"]["black"]["nrmse@floor"] = 0.63
        path = self.directory / "images/reference/mask.floor.png"
        path.parent.mkdir(parents=True)
        Image.new("L", (4, 2), 255).save(path)
        shown = self.make(rows, run, indirect=False)
        for words in ("Under masks", "material stone", "25.0 % of the pixels", "0.609", "0.700", "0.64–0.76", "0.123"):
            self.assertIn(words, shown.text)
        self.assertEqual(shown.text.count("a black image"), 2)  # in both tables
        # Their intervals overlap; black is below that of a alone.
        results = load(self.directory)
        self.assertEqual(ranking.score_marks(results, _NRMSE, "nrmse@floor"), {"a": "tie", "b": "tie"})
        beaten = [ranking.beaten_by(results, _NRMSE, "nrmse@floor", row) for _, row in results.ok.iterrows()]
        self.assertEqual(beaten, [["black"], []])

    def test_each_variant_is_shown_next_to_its_own_reference(self):
        run = made_up.manifest([])
        run["references"] = [{**run["reference"], "folder": "reference", "variants": ["a"]},
                             {**run["reference"], "folder": "reference.2", "variants": ["b"]}]
        run["variants"] = {"a": [{"pass": "gbuffer"}]}
        rows = [made_up.variant(name, 10, 0.3) for name in ("a", "b", "c")]
        made_up.save_image(self.directory / "images/reference.2/final.png", 0.5, made_up.SIZE)
        shown = self.make(rows, run, indirect=False)
        self.assertEqual(shown.attributes("data-reference"),
                         ["reference-total", "reference.2-total", "-total"])
        self.assertLessEqual({"reference-total", "reference.2-total"}, set(shown.attributes("id")))
        self.assertIn("2 different references", shown.text)
        self.assertIn("- pass: gbuffer", shown.text)

    def test_manifest_of_odd_types(self):
        run = {"config": [1], "baselines": 3, "metrics": [3, {"name": "nrmse", "better": "yellow"}], "reference": None, "sweep_keys": "x", "warnings": {"a": 1},
               "image": [], "finished": True, "device": None}
        shown = self.make([made_up.variant("a", 10, 0.3), made_up.variant("b", 10, 0.3)], run)
        self.assertIn("2 of 2 variants finished", shown.text)


class HostileText(ReportTest):
    NAMES = ('<script>alert(1)', 'a"onload="x', "$\\frac{x}$", "_hidden", "größe=½ 体素", "nan", "001")

    def test_text_from_files_stays_text(self):
        rows = [made_up.variant(name, 10 + i, 0.1 + 0.1 * i, **{"<b>key</b>": name})
                for i, name in enumerate(self.NAMES)]
        rows.append(made_up.failed("<i>bad</i>", "</script><script>alert(2)</script>", **{"<b>key</b>": "x"}))
        run = made_up.manifest(["<b>key</b>"])
        run.update({"warnings": ["<img src=x>"], "device": "<u>GPU</u>", "config": {"name": "</title><b>"}})
        shown = self.make(rows, run, images=False)
        self.assertEqual([tag for tag, _ in shown.tags if tag == "script"], ["script"])
        self.assertNotIn("onload", [name for _, attrs in shown.tags for name in attrs])
        self.assertFalse({"u", "img"} & {tag for tag, _ in shown.tags})
        for name in self.NAMES:
            self.assertIn(name, shown.text)

    def test_variant_cannot_reach_outside_its_images(self):
        results = load(made_up.write_results(self.directory, [made_up.variant("a", 10, 0.3)], None))
        Image.new("L", (2, 2)).save(self.directory / "final.png")
        self.assertIsNotNone(results.image("a", "final.png"))
        for folder in ("..", "../../run", str(self.directory), "a\0b", "x" * 5000):
            self.assertIsNone(results.image(folder, "final.png"), folder[:20])


class Reading(ReportTest):
    def test_names_stay_text_and_scores_become_numbers(self):
        rows = [made_up.variant("001", 10, 0.3, resolution="064"),
                made_up.variant("None", 20, 0.2, resolution="1e2")]
        results = load(made_up.write_results(self.directory, rows, made_up.manifest(["resolution"]), images=False))
        self.assertEqual(list(results.variants["variant"]), ["001", "None"])
        self.assertEqual(list(results.variants["resolution"]), ["064", "1e2"])
        self.assertEqual(results.sweep_keys, ["resolution"])
        self.assertEqual(results.variants["nrmse"][1], 0.2)
        self.assertTrue(math.isnan(results.variants["indirect_nrmse"][0]))

    def test_last_of_repeated_rows_holds(self):
        rows = [made_up.failed("a", "killed"), made_up.variant("b", 20, 0.2), made_up.variant("a", 10, 0.3)]
        results = load(made_up.write_results(self.directory, rows, made_up.manifest([]), images=False))
        self.assertEqual(list(results.variants["status"]), ["ok", "ok"])
        self.assertTrue(any("repeated" in warning for warning in results.warnings))

    def test_no_results(self):
        self.directory.mkdir(parents=True)
        with self.assertRaisesRegex(ReportError, "no such file"):
            load(self.directory)
        (self.directory / "results.csv").write_bytes(b"\xff\xfe\x00")
        self.assertEqual(self.run_program()[0], 2)
        (self.directory / "results.csv").write_text("a,b\n1,2\n")
        status, errors = self.run_program()
        self.assertEqual(status, 2)
        self.assertRegex(errors, "no column 'variant'")
        self.assertEqual(errors.count("\n"), 1)


class Comparing(ReportTest):
    def results(self, rows, **changes):
        run = made_up.manifest([])
        run.update(changes)
        return load(made_up.write_results(self.directory, rows, run, images=False))

    def test_scores_whose_intervals_overlap_tie_and_none_is_the_best(self):
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.2), ("b", 0.23), ("c", 0.25))]
        for row in rows:
            row.update(made_up.spread("nrmse", row["nrmse"] - 0.02, row["nrmse"] + 0.02))
        results = self.results(rows)
        self.assertEqual(ranking.score_marks(results, _NRMSE, "nrmse"), {"a": "tie", "b": "tie"})
        self.assertIn("Lowest nRMSE of the total light: a and b cannot be told apart, from 0.2 to 0.23.",
                      ranking.summary(results, "total"))
        # Told apart, and without intervals: one is the best.
        del rows[1]
        self.assertEqual(ranking.score_marks(self.results(rows), _NRMSE, "nrmse"), {"a": "best"})
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.2), ("b", 0.2001))]
        self.assertEqual(ranking.score_marks(self.results(rows), _NRMSE, "nrmse"), {"a": "best"})

    def test_scores_at_the_noise_floor_tie(self):
        # HDR-FLIP is 0.005, 0.009 and 0.011; a perfect image would score 0.01.
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.01), ("b", 0.018), ("c", 0.022))]
        self.assertEqual(ranking.score_marks(self.results(rows), _FLIP, "flip"), {"a": "tie", "b": "tie"})
        self.assertEqual(ranking.score_marks(self.results(rows[1:]), _FLIP, "flip"), {"b": "best"})
        self.assertEqual(ranking.score_marks(self.results(rows, reference={}), _FLIP, "flip"), {"a": "best"})
        ssim = Metric("ssim", "SSIM", "", "high", "")  # 0.995, 0.991 and 0.97; the floor is 0.98
        rows[2]["ssim"] = 0.97
        self.assertEqual(ranking.score_marks(self.results(rows), ssim, "ssim"), {"a": "tie", "b": "tie"})

    def test_front_is_drawn_through_upper_ends(self):
        # b is slower than a and its interval overlaps: not beaten. c is.
        rows = [made_up.variant(name, ms, error) for name, ms, error in (("a", 10, 0.2), ("b", 20, 0.21), ("c", 30, 0.4))]
        for row in rows:
            row.update(made_up.spread("nrmse", row["nrmse"] - 0.05, row["nrmse"] + 0.05))
        results = self.results(rows)
        points = [(row["frame_ms_median"], interval_of(row, "nrmse")) for _, row in results.ok.iterrows()]
        front = ranking.pareto_front([(cost, high) for cost, (_, high) in points])
        self.assertEqual(front, [0])
        reached = points[0][1][1]
        self.assertEqual([low > reached for _, (low, _) in points], [False, False, True])
        shown = Page(page.render(results))
        self.assertIn("what lies wholly above it is beaten", shown.text)

    def test_best_of_each_direction(self):
        rows = [made_up.variant("bright", 10, 0.1), made_up.variant("dark", 10, 0.2)]
        rows[0]["mean_ratio"], rows[1]["mean_ratio"] = 1.3, 0.8
        results = self.results(rows)
        best = {m.key: [n for n, mark in ranking.score_marks(results, m, m.key).items() if mark == "best"]
                for m in results.metrics}
        self.assertEqual(best.pop("mean_ratio"), ["dark"])  # 0.2 from 1 instead of 0.3
        self.assertEqual(set(map(tuple, best.values())), {("bright",)})

    def test_frame_times_tie_within_the_spread(self):
        # The fastest one's p95 is 10.5 ms.
        rows = [made_up.variant(name, ms, 0.1) for name, ms in (("a", 10.0), ("b", 10.4), ("c", 10.6))]
        marks = ranking.cost_marks(self.results(rows), "frame_ms_median")
        self.assertEqual(marks, {"a": "best", "b": "tie"})

    def test_worse_than_a_black_image(self):
        def beaten(metric, value, low=math.nan, high=math.nan):
            row = made_up.variant("a", 10, 0.1) | {metric.key: value}
            results = self.results([row | made_up.spread(metric.key, low, high)])
            return ranking.beaten_by(results, metric, metric.key, results.ok.iloc[0])

        self.assertEqual(beaten(_NRMSE, 1.0), ["constant"])
        self.assertEqual(beaten(_NRMSE, 2.0), ["black", "constant"])
        self.assertEqual(beaten(_NRMSE, 2.0, 1.2, 2.8), ["constant"])  # The interval holds the black one's 1.6.
        ssim = Metric("ssim", "SSIM", "", "high", "")
        self.assertEqual(beaten(ssim, 0.9), [])
        self.assertEqual(beaten(ssim, -1.0), ["black", "constant"])

    def test_each_variant_is_compared_with_its_own_reference(self):
        # HDR-FLIP's noise is 0.01 and 0.15; a black image has an nRMSE of 1.6 and 0.3.
        first, run = {"folder": "reference", "flip_noise": 0.01, "variants": ["a", "b"]}, made_up.manifest([])
        second = {"folder": "reference.2", "flip_noise": 0.15, "variants": ["c", "d"]}
        first["baselines"] = run["baselines"]
        second["baselines"] = {"black": {"nrmse": 0.3}, "constant": {"nrmse": 0.25}}
        rows = [made_up.variant(name, 10, error) for name, error in (("a", 0.26), ("b", 0.28), ("c", 0.28), ("d", 0.25))]
        results = self.results(rows, references=[first, second])
        self.assertEqual(ranking.score_marks(results, _FLIP, "flip"), {"c": "tie", "d": "tie"})
        beaten = [ranking.beaten_by(results, _NRMSE, "nrmse", row) for _, row in results.ok.iterrows()]
        self.assertEqual(beaten, [[], [], ["constant"], []])
        shown = Page(page.render(results))
        for words in ("a black image (reference)", "a black image (reference.2)",
                      "the reference's own noise (reference.2)"):
            self.assertIn(words, shown.text)

    def test_pareto_front(self):
        points = [(3, 1), (1, 5), (2, 5), (2, 3), (4, 1), (1, 6)]
        self.assertEqual(ranking.pareto_front(points), [1, 3, 0])


class Writing(ReportTest):
    def test_failed_writing_keeps_the_old_page(self):
        self.make([made_up.variant("a", 10, 0.3)], made_up.manifest([]), images=False)
        old = (self.directory / "report.html").read_bytes()
        before = sorted(self.directory.iterdir())
        with mock.patch("os.fsync", side_effect=OSError(28, "No space left on device")):
            status, errors = self.run_program()
        self.assertEqual(status, 1)
        self.assertIn("No space left on device", errors)
        self.assertEqual(old, (self.directory / "report.html").read_bytes())
        self.assertEqual(before, sorted(self.directory.iterdir()))

    def test_error_map_in_false_colours(self):
        self.directory.mkdir(parents=True)
        path = self.directory / "flip.png"
        grey = Image.new("L", (3, 1))
        grey.putdata([0, 128, 255])
        grey.save(path)
        picture = images.embed_error(path)
        self.assertEqual((picture.width, picture.height), (3, 1))
        data = io.BytesIO(base64.b64decode(picture.uri.split(",")[1]))
        # Magma's ends are (0.001462, 0.000466, 0.013866) and (0.987053, 0.991438, 0.749504).
        colors = list(Image.open(data).convert("RGB").getdata())
        self.assertEqual((colors[0], colors[2]), ((0, 0, 4), (252, 253, 191)))

    def test_numbers_for_a_reader(self):
        self.assertEqual([text.figures(x) for x in (0.0123456, 12.345, 1234.5, 0, math.nan, math.inf, 1e-9)],
                         ["0.0123", "12.3", "1\u202f234", "0", "–", "∞", "1.00e-09"])
        self.assertEqual(text.size(3 * 2**20), "3.00 MiB")
        self.assertEqual(text.count(262144), "262 k")
        self.assertEqual(text.breakable("a.b=<i>"), "a.<wbr>b=<wbr>&lt;i&gt;")

    def test_config_as_yaml_like_text(self):
        config = {"name": "x y", "image": {"width": 8}, "list": [1, 2], "graph": [{"pass": "a", "n": 1}],
                  "none": None, "quoted": "a: b", "empty": {}}
        self.assertEqual(text.yaml_like(config), 'name: x y\nimage:\n  width: 8\nlist: [1, 2]\ngraph:\n'
                         '  - pass: a\n    n: 1\nnone: null\nquoted: "a: b"\nempty: {}')
        self.assertEqual(text.yaml_like(["null", "true", None]), '["null", "true", null]')


if __name__ == "__main__":
    unittest.main()
