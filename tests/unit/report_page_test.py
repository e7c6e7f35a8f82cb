"""Tests of the report's page: any run's results make a whole, safe one."""

from __future__ import annotations

import re
import tempfile
import unittest
from pathlib import Path

from report_support import NRMSE, Page, ReportTest, made_up, numbers_of

from report import details, page, pages, parts, ranking, setting, style, table
from report.load import load
from PIL import Image


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
        self.assertEqual(self.page.count("div", "plot"), 12 + 2)
        sources = [attrs["src"] for tag, attrs in self.page.tags if tag == "img"]
        self.assertEqual(len(sources), 26)
        self.assertTrue(all(source.startswith("data:image/png;base64,") for source in sources))
        for words in ("6 of 7 variants finished. 1 variant failed", "needs 34.4 GiB", "a constant image",
                      "Of the indirect light, lowest nRMSE 0.300 to 0.310, 3 (resolution 256, light_rays) and 6 (resolution 256, "
                      "rsm) tie.", "0.29–0.31",
                      "64 × 36 pixels", "[{point: [0, 1, 0]}]",
                      "path_trace, 64 samples a pixel"):
            self.assertIn(words, self.page.text)

    def test_variants_are_called_by_what_differs(self):
        results = load(self.directory)
        self.assertEqual(results.full("light_rays-256"), "3 (resolution 256, light_rays)")
        self.assertEqual(results.listed(["light_rays-64", "rsm-64"]),
                         "1 (resolution 64, light_rays) and 4 (resolution 64, rsm)")
        self.assertEqual(results.listed(list(results.numbers)), "1, 2, 3, 4, 5, 6 and 1 more")

    def test_the_table_begins_with_time_error_and_energy(self):
        results = load(self.directory)
        columns = [column.heading for column in table.columns_of(results, ["indirect"])]
        self.assertEqual([heading.split("\u00a0")[0] for heading in columns[:4]],
                         ["frame, ms", "nRMSE", "mean ratio", "relMSE"])

    def test_memory_is_split_by_pass(self):
        results = load(self.directory)
        groups = parts.bar_groups(results, style.pass_colors(results), {name: name for name in results.variants["variant"]})
        memory = groups[-1].bars[0]  # 2^24 bytes for each of 12 ms, five passes with 2^20 each
        self.assertEqual([segment.title for segment in memory.segments][-2:],
                         ["composite: 1.00 MiB", "outside the passes: 187 MiB"])

    def test_begins_with_the_reference_and_variants_by_error(self):
        results = load(self.directory)
        lights = results.lights()
        anchors = {name: f"variant-{number}" for name, number in results.numbers.items()}
        shown = details.variants(results, lights, anchors, set())
        copies = details.copies(results, lights, shown)
        for light, error in (("total", "0.211"), ("indirect", "0.300")):
            own = [copy for copy in copies if copy.light == light]
            self.assertEqual([copy.image for copy in own], [f"reference-{light}", *(f"variant-{i}-{light}" for i in (3, 6, 2, 5, 1, 4))])
            self.assertEqual(own[1].facts, f"60.0 ms · 960 MiB · nRMSE {error}")
        self.assertLess(self.source.index('class="copies'), self.source.index('class="summary'))
        self.assertLessEqual(set(self.page.attributes("data-image")), set(self.page.attributes("id")))

    def test_embeds_each_image_once(self):
        sources = [attrs["src"] for tag, attrs in self.page.tags if tag == "img"]
        self.assertEqual(self.source.count("data:image/png;base64,"), len(sources))

    def test_needs_nothing_else(self):
        own = self.source.replace(pages._own("d3"), "").replace("http://www.w3.org/2000/svg", "")  # names that nothing loads
        self.assertNotRegex(own, r"https?://")
        for _, value in re.findall(r'\b(src|href)="([^"]*)"', self.source):
            self.assertRegex(value, r"^(data:image/png|#)")

    def test_links_lead_somewhere(self):
        targets = {f"#{name}" for name in self.page.attributes("id")}
        of_points = {f"#{variant['anchor']}" for variant in numbers_of(self.source)["variants"]}
        self.assertEqual(len(of_points), 6)
        self.assertLessEqual({*self.page.attributes("href"), *of_points}, targets)

    def test_same_results_make_the_same_page(self):
        self.assertEqual(self.source, page.render(load(self.directory)))


class PartOfARun(ReportTest):
    def test_without_indirect_light(self):
        rows = [made_up.variant("a", 10, 0.3), made_up.variant("b", 20, 0.2)]
        shown = self.make(rows, made_up.manifest([]), indirect=False)
        self.assertEqual(shown.count("div", "plot"), 6 + 1)
        self.assertNotIn("Indirect", shown.text)

    def test_without_reference(self):
        rows = [made_up.variant("a", 10, 0.3), made_up.variant("b", 20, 0.2)]
        shown = self.make(rows, made_up.manifest([]) | {"reference": None}, reference=False, indirect=False)
        self.assertIn("The reference's image is missing", shown.text)

    def test_single_variant(self):
        shown = self.make([made_up.variant("only", 10, 0.3)], made_up.manifest([]), indirect=False)
        self.assertEqual(shown.count("td", "best"), 0)  # nothing to be better than
        self.assertEqual(shown.count("div", "plot"), 6 + 1)

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

    def test_what_is_missing_of_a_run_that_was_cut_short_is_named(self):
        rows = [made_up.variant("a", 10, 0.3), made_up.failed("b", "lost device")]
        run = made_up.manifest([]) | {"finished": None, "variants": {name: [] for name in "abcdefghij"}}
        shown = self.make(rows, run, images=False)
        for words in ("had not ended when this page was made. 1 of 10 variants are finished; missing: c, d, e, f, g, h and 2 more.",
                      "1 variant failed; the reason"):
            self.assertIn(words, shown.text)
        self.assertNotIn("1 of 2", shown.text)
        run["variants"] = {"a": [], "b": [], "c": []}
        self.assertIn("1 of 3 variants are finished; missing: c.", self.make(rows, run, images=False).text)
        self.assertNotIn("missing: ", self.make(rows, run | {"finished": "2026-01-01T10:03:00Z"}, images=False).text)

    def test_times_of_several_sessions_are_told(self):
        rows = [made_up.variant("a", 10, 0.3), made_up.variant("b", 20, 0.2), made_up.failed("c", "lost device")]
        run = made_up.manifest([])
        sessions = [{"started": f"2026-01-0{day}T10:00:00Z", "variants": list(names)} for day, names in ((1, "a"), (2, "bc"))]
        shown = self.make(rows, run | {"sessions": sessions}, indirect=False)
        for words in ("Times come from 2 processes, for the run was resumed or done in parts: compare", "session of 2026-01-02T10:00:00Z"):
            self.assertIn(words, shown.text)
        # One session, one of which nothing is left, a manifest without them
        for of in (sessions[:1], [sessions[0], {"started": "", "variants": ["c"]}], []):
            self.assertNotIn("processes, for", self.make(rows, run | {"sessions": of}, indirect=False).text)

    def test_words_of_the_sweep_stand_in_names_alone(self):
        rows = [made_up.variant(f"{n}-{word}", n, 0.3, size=n, method=word) for n in (8, 16) for word in ("a", "b")]
        results = load(made_up.write_results(self.directory, rows, made_up.manifest(["size", "method"]), images=False))
        self.assertEqual([column.key for column in table.columns_of(results, [])][-2:], ["rays", "size"])

    def test_zero_and_infinite_scores_are_named_not_drawn(self):
        perfect = made_up.variant("perfect", 10, 0.0)
        perfect["psnr_db"] = "inf"
        shown = self.make([perfect, made_up.variant("good", 20, 0.1)], made_up.manifest([]))
        self.assertIn("1 (perfect) (nRMSE, total)", shown.text)
        self.assertIn("∞", shown.text)

    def test_broken_images_are_named(self):
        made_up.write_results(self.directory, [made_up.variant("a", 10, 0.3)], made_up.manifest([]))
        (self.directory / "images/a/final.png").write_bytes(b"\x89PNG\r\n\x1a\nbroken")
        self.assertEqual(self.run_program()[0], 0)
        self.assertIn("is not a whole PNG file", Page((self.directory / "report.html").read_text(encoding="utf-8")).text)

    def test_a_cell_without_a_number_has_no_key_to_sort_by(self):
        self.assertEqual([table.number(value).sort for value in (0.25, float("nan"))], ["0.25", "none"])

    def test_reported_values_have_a_table_and_a_chart_over_frames(self):
        rows = [made_up.variant(name, 10, 0.3) for name in ("a", "b")]
        self.assertNotIn("What passes report", self.make(rows, made_up.manifest([])).text)
        (self.directory / "values.csv").write_text(
            "variant,pass,name,frame,value\na,compare,missed,,1234567\na,probe,change,0,0.25\na,probe,change,1,0.75\n"
            "b,compare,missed,,40\na,cache,dropped,0,0\na,cache,dropped,1,0\n")
        self.assertEqual(self.run_program()[0], 0)
        shown = Page((self.directory / "report.html").read_text(encoding="utf-8"))
        for words in ("What passes report", "compare: missed", "1\u202f234\u202f567", "0.500 (most 0.750)"):
            self.assertIn(words, shown.text)
        charts = numbers_of((self.directory / "report.html").read_text(encoding="utf-8"))["charts"]
        self.assertEqual([chart["text"] for chart in charts if "lines" in chart], ["probe: change over frames; a: 0.500 on average"])
        self.assertIn("cache: dropped", shown.text)  # It stays as it was: the table says so.

    def test_passes_are_coloured_by_kind_whatever_their_ids(self):
        run = made_up.manifest([])
        run["variants"] = {"a": [{"pass": "gather_cones", "id": "gather"}], "b": [{"pass": "gather_rays", "id": "gather"}]}
        shown = self.make([made_up.variant("a", 10, 0.2), made_up.variant("b", 10, 0.3)], run, indirect=False)
        for words in ("gather (gather_cones)", "gather (gather_rays)"):
            self.assertIn(words, shown.text)
        legend = shown.text[shown.text.index("pass voxelize"):][:120]
        self.assertIn("gather_cones", legend)
        self.assertIn("gather_rays", legend)

    def test_sequences_have_a_table_and_charts_over_frames(self):
        rows = [made_up.variant(name, 10, error) for name, error in (("calm", 0.2), ("restless", 0.4))]
        frames = made_up.with_sequence(rows, 3)
        made_up.write_results(self.directory, rows, made_up.manifest([]), indirect=False)
        made_up.write_csv(self.directory / "frames.csv", list(frames[1]), frames)
        self.assertEqual(self.run_program()[0], 0)
        shown = Page((self.directory / "report.html").read_text(encoding="utf-8"))
        for words in ("Over frames", "temporal bias", "0.080–0.12"):
            self.assertIn(words, shown.text)
        lines = numbers_of((self.directory / "report.html").read_text(encoding="utf-8"))["charts"][-3]
        self.assertEqual(lines["lines"], [[0, [0, 1, 2], [0.2, 0.22, 0.24]], [1, [0, 1, 2], [0.4, 0.44, 0.48]]])
        self.assertEqual(shown.count("div", "plot"), 6 + 1 + 3)

    def test_each_scene_has_its_own_charts_over_frames(self):
        rows = [made_up.variant(f"{scene}-{name}", 10, error) for scene in ("hall", "yard") for name, error in (("a", 0.2), ("b", 0.4))]
        for row in rows:
            row["scene"], row["gather"] = row["variant"].split("-")
        frames = made_up.with_sequence(rows, 3)
        made_up.write_results(self.directory, rows, made_up.manifest(["scene", "gather"]), indirect=False)
        made_up.write_csv(self.directory / "frames.csv", list(frames[1]), frames)
        self.assertEqual(self.run_program()[0], 0)
        drawn = [chart for chart in numbers_of((self.directory / "report.html").read_text(encoding="utf-8"))["charts"]
                 if chart.get("xLabel") == "measured frame"]
        labels = [chart["yLabel"] for chart in drawn]
        self.assertEqual(labels[:2], ["nRMSE, total light, hall", "nRMSE, total light, yard"])
        self.assertEqual([line[0] for line in drawn[0]["lines"]], [0, 1])
        self.assertEqual([line[0] for line in drawn[1]["lines"]], [2, 3])
        self.assertEqual(len(labels), 6)

    def test_the_scene_as_the_config_has_it_and_which_frames_are_compared_are_in_the_header(self):
        rows, run = [made_up.variant("a", 10, 0.2)], made_up.manifest(["scene.camera.move", "voxelize.resolution"])
        for row in rows:
            row.update({"scene.camera.move": "[0, 0, 1]", "voxelize.resolution": "64"})
        run["config"]["scene"] = {"builtin": "cornell", "lights": [{"point": [0, 1, 0], "move": [0.1, 0, 0]}], "time_step": 0.1}
        self.assertNotIn("Temporal error", self.make(rows, run, images=False).text)
        found = dict(setting.setting_of(load(self.directory)))
        self.assertEqual({key: found[key] for key in list(found)[:4]}, {
            "scene": "cornell", "lights": "[{point: [0, 1, 0], move: [0.1, 0, 0]}]", "time step": "0.1", "the sweep varies": "scene.camera.move"})
        self.assertNotIn("scores", found)

        # Frames that are compared: the first two and the last of many
        for frames, words in ((3, "0, 1, 2"), (9, "0, 1, …, 8")):
            table = made_up.with_sequence(rows, frames)
            made_up.write_results(self.directory, rows, run, images=False)
            made_up.write_csv(self.directory / "frames.csv", list(table[1]), table)
            self.assertEqual(self.run_program()[0], 0)
            shown = Page((self.directory / "report.html").read_text(encoding="utf-8"))
            self.assertIn(f"of frame 0 in the table, of frames {words} under “Over frames”", shown.text)
            self.assertIn("#frames", shown.attributes("href"))

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
        self.assertEqual(ranking.score_marks(results, NRMSE, "nrmse@floor"), {"a": "tie", "b": "tie"})
        self.assertEqual(ranking.all_beaten(results, NRMSE, "nrmse@floor"), {"a": ["black"]})

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
        self.assertIn("- {pass: gbuffer}", shown.text)


class HostileText(ReportTest):
    NAMES = ('<script>alert(1)', 'a"onload="x', "$\\frac{x}$", "_hidden", "größe=½ 体素", "nan", "001")

    def test_text_from_files_stays_text(self):
        rows = [made_up.variant(name, 10 + i, 0.1 + 0.1 * i, **{"<b>key</b>": name})
                for i, name in enumerate(self.NAMES)]
        rows.append(made_up.failed("<i>bad</i>", "</script><script>alert(2)</script>", **{"<b>key</b>": "x"}))
        run = made_up.manifest(["<b>key</b>"])
        run.update({"warnings": ["<img src=x>"], "device": "<u>GPU</u>", "config": {"name": "</title><b>"}})
        shown = self.make(rows, run, images=False)
        self.assertEqual([tag for tag, _ in shown.tags if tag == "script"], ["script", "script"])  # data and ours
        self.assertNotIn("onload", [name for _, attrs in shown.tags for name in attrs])
        self.assertFalse({"u", "img"} & {tag for tag, _ in shown.tags})
        for name in self.NAMES:
            self.assertIn(name, shown.text)

    def test_variant_cannot_reach_outside_its_images(self):
        results = load(made_up.write_results(self.directory, [made_up.variant("a", 10, 0.3)], made_up.manifest([])))
        Image.new("L", (2, 2)).save(self.directory / "final.png")
        self.assertIsNotNone(results.image("a", "final.png"))
        for folder in ("..", "../../run", str(self.directory), "a\0b", "x" * 5000):
            self.assertIsNone(results.image(folder, "final.png"), folder[:20])


if __name__ == "__main__":
    unittest.main()
