"""Tests of the page of `voxray pareto` in a browser, at two widths, with the keyboard alone and with the pointer."""

from __future__ import annotations

import tempfile
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

import browser
from report_support import made_up
import pareto_results

from report import pareto_page

if not browser.MISSING:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

SCENES = ("cornell", "sponza", "moving")
FOCUS = "return document.activeElement"


@unittest.skipIf(browser.MISSING, browser.MISSING)
class InABrowser(unittest.TestCase):
    """41 variants of 16 methods in each of three scenes."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = Path(folder.name)
        cls.page = cls.root / "methods.html"
        pareto_page.write(cls.page, [pareto_results.write(cls.root / "run", SCENES)], "nrmse", "indirect")
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)
        cls.browser.driver.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(cls.root)})

    def setUp(self):
        self.browser.media()

    def at_both_widths(self):
        for size in ((1400, 900), (400, 800)):
            self.browser.resize(*size)
            self.browser.open(self.page)
            yield size

    def press(self, *keys: str):
        ActionChains(self.browser.driver).send_keys(*keys).perform()

    def tab_to(self, condition: str):
        """Presses Tab until the focused element meets it."""
        for _ in range(80):
            self.press(Keys.TAB)
            if self.browser.run(f"const e = document.activeElement; return {condition}"):
                return self.browser.run(FOCUS)
        self.fail(f"no way by Tab to {condition}")

    def text(self, selector: str) -> str:
        return self.browser.run("return document.querySelector(arguments[0]).textContent", selector)

    def cells(self) -> list[str]:
        return self.browser.run("return [...document.querySelectorAll('#matrix td')].map((cell) => cell.textContent)")

    def downloaded(self, name: str) -> str:
        for _ in range(1000):
            if (self.root / name).is_file():
                return (self.root / name).read_text(encoding="utf-8")
            time.sleep(0.05)
        self.fail(f"no file {name}")

    def test_says_nothing_loads_nothing_and_scrolls_down_alone(self):
        for width, _ in self.at_both_widths():
            self.browser.console()
            self.browser.requests()
            self.browser.open(self.page, "cost=-1&error=x&rival=99")
            self.assertIn("Speed-up over filtered paths at equal nRMSE", self.text("#matrix-title"))
            self.browser.open(self.page, "cost=3&error=2&rival=4")
            self.browser.run("for (const folded of document.querySelectorAll('details')) folded.open = true")
            self.browser.run("window.scrollTo(0, document.body.scrollHeight)")
            self.browser.settle()
            self.assertEqual(self.browser.console(), [])
            asked = set(self.browser.requests()) - {"about:blank"}
            self.assertEqual({address.partition("#")[0] for address in asked}, {self.page.resolve().as_uri()})
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)
            self.assertRegex(self.text("#matrix-title"), "less memory than .* at equal HDR-FLIP")

    def test_the_first_screen_has_sentences_switches_and_the_matrix(self):
        self.browser.resize(1400, 900)
        self.browser.open(self.page)
        bottoms = self.browser.run("return ['.summary', '.toolbar', '#matrix'].map((name) => document.querySelector(name).getBoundingClientRect().bottom)")
        self.assertLess(max(bottoms), 900)
        tops = self.browser.run("return [...document.querySelectorAll('.scene')].map((scene) => scene.getBoundingClientRect().top)")
        self.assertEqual(tops[0], tops[1])  # two in a row
        self.assertGreater(tops[2], tops[0])

    def test_switches_by_keys(self):
        for _ in self.at_both_widths():
            before = self.cells()
            for name, words in (("cost", "by time of one frame with its light injected"), ("error", "at equal relMSE")):
                self.tab_to(f"e.name === '{name}'")
                self.press(Keys.ARROW_RIGHT)
                self.assertIn(words, self.text("#matrix-title"))
                self.assertNotEqual(self.cells(), before)
                before = self.cells()
            self.assertIn("relMSE", self.text(".scene svg .title:last-of-type"))
            self.tab_to("e.name === 'rival'")
            self.press("r")
            self.assertIn("over rays at", self.text("#matrix-title"))
            self.assertNotEqual(self.cells(), before)
            self.assertRegex(self.browser.run("return location.hash"), r"^#cost=1&error=1&rival=[1-9]\d*$")
            # Rows by falling median
            medians = [float(cell) for cell in self.cells()[3::4] if cell != "–"]
            self.assertEqual(medians, sorted(medians, reverse=True))

    def test_a_cell_opens_its_chart_and_images_by_keys(self):
        for _ in self.at_both_widths():
            self.tab_to("e.getAttribute('role') === 'gridcell'")
            self.press(Keys.ARROW_DOWN, Keys.ARROW_RIGHT)
            words = self.text("#cell")
            self.assertRegex(words, r"^.+ in sponza: .+ times as fast as filtered paths at equal nRMSE .+ reaches \d of 6 errors")
            self.assertEqual(self.browser.run(FOCUS).get_attribute("aria-label"), words)
            self.assertIn("+", self.text("#chain") + "+")
            self.press(Keys.ENTER)
            self.browser.settle()
            self.assertIn("sponza", self.browser.run(FOCUS).get_attribute("aria-label"))
            box = self.browser.run("const box = document.querySelector('#scene-1 .plot').getBoundingClientRect(); return [box.top, box.bottom]")
            self.assertTrue(0 <= box[0] < 500, box)
            method = words.partition(" in sponza")[0]
            self.assertEqual(self.browser.run("return [...document.querySelectorAll('#methods .highlighted')].map((e) => e.textContent)"), [method])
            names = self.browser.run("return [...document.querySelectorAll('#scene-1 .strip img')].map((image) => [image.alt, image.complete && image.naturalWidth])")
            self.assertEqual(names, [["reference, sponza", 320], [f"{method}, sponza", 320], ["its error (FLIP), sponza", 320]])
            self.assertTrue(self.text("#scene-1 .said").startswith(f"{method} · "))
            # Every method is shown alike again
            self.tab_to("e.id === 'everything'")
            self.browser.run("document.getElementById('everything').click()")
            self.assertEqual(self.browser.run("return document.querySelectorAll('.faint, .highlighted').length"), 0)

    def test_points_tell_their_interval_by_pointer_and_keys(self):
        for _ in self.at_both_widths():
            mark = self.browser.run("""const mark = document.querySelector('#scene-0 .bold .mark:nth-last-of-type(2)');
                mark.scrollIntoView({block: 'center', behavior: 'instant'}); return mark""")
            ActionChains(self.browser.driver).move_to_element(mark).perform()
            self.browser.settle()
            said = self.text("#scene-0 .said")
            self.assertRegex(said, r"^filtered paths · .+: [\d,.]+ ms, nRMSE [\d.]+ \([\d.]+ to [\d.]+\)$")
            self.assertEqual(self.browser.run("return document.querySelectorAll('#scene-0 .interval').length"), 1)
            self.browser.run("document.querySelector('#methods button:last-of-type').focus(); document.querySelector('#scene-0 .plot').focus()")
            self.press(Keys.ARROW_LEFT)
            left = self.text("#scene-0 .said")
            self.assertNotEqual(left, said)
            self.assertIn("filtered paths · ", left)
            # Another cost: the same point with its own numbers
            self.browser.run("document.getElementsByName('cost')[3].click()")
            self.assertIn(" MiB, nRMSE", self.text("#scene-0 .said"))
            self.browser.run("document.querySelector('#scene-0 .plot').focus()")
            self.press(Keys.ARROW_UP)
            self.assertNotIn("filtered paths · ", self.text("#scene-0 .said"))

    def test_names_switch_methods_off(self):
        for _ in self.at_both_widths():
            button = self.tab_to("e.dataset.method === '3'")
            self.assertEqual((button.text, button.get_attribute("aria-pressed")), ("rays", "true"))
            names = "return [...document.querySelectorAll('#scene-0 .name')].map((name) => name.textContent)"
            self.assertIn("rays", self.browser.run(names))
            self.press(Keys.SPACE)
            self.assertEqual(self.browser.run(FOCUS).get_attribute("aria-pressed"), "false")
            self.assertNotIn("rays", self.browser.run(names))
            self.press(Keys.SPACE)
            self.assertIn("rays", self.browser.run(names))

    def check_names(self, counts: list[int]):
        """Charts have so many names; none covers another one, or leaves the chart."""
        scenes = self.browser.run("""return [...document.querySelectorAll('.scene')].map((scene) => ['svg.chart', '.name'].map((selector) =>
            [...scene.querySelectorAll(selector)].map((part) => { const box = part.getBoundingClientRect(); return [box.left, box.top, box.right, box.bottom]; })))""")
        self.assertEqual([len(names) for _, names in scenes], counts)
        for [chart], names in scenes:
            for i, a in enumerate(names):
                self.assertTrue(chart[0] <= a[0] and a[2] <= chart[2] and chart[1] - 1 <= a[1] and a[3] <= chart[3], (a, chart))
                for b in names[:i]:
                    self.assertFalse(a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3], (a, b))

    def test_names_do_not_cover_each_other(self):
        for _ in self.at_both_widths():
            self.check_names(self.browser.run("return [...document.querySelectorAll('.scene')].map((scene) =>"
                                              " [...scene.querySelectorAll('.curve')].filter((line) => line.getAttribute('d')).length)"))

    def test_names_of_fronts_that_end_at_one_point_do_not_cover_each_other(self):
        rows = [made_up.variant(f"method-{i}", 100 + i, 0.1 + 0.001 * (i % 4), 0.1 + 0.001 * (i % 4), name=f"method of many, {i}") for i in range(14)]
        run = made_up.manifest([]) | {"variants": {row["variant"]: [{"pass": f"gather_{i}"}] for i, row in enumerate(rows)}}
        page = self.root / "crowded.html"
        pareto_page.write(page, [made_up.write_results(self.root / "crowded", rows, run, images=False)], "nrmse", "indirect")
        for size in ((1400, 900), (400, 800)):
            self.browser.resize(*size)
            self.browser.open(page)
            self.check_names([14])

    def test_dragging_zooms_and_escape_shows_all(self):
        ticks = "return [...document.querySelectorAll('#scene-0 .axis text')].map((tick) => tick.textContent)"
        for width, _ in self.at_both_widths():
            before = self.browser.run(ticks)
            plot = self.browser.run("const plot = document.querySelector('#scene-0 .plot'); plot.scrollIntoView({block: 'center', behavior: 'instant'}); return plot")
            ActionChains(self.browser.driver).move_to_element(plot).click_and_hold().move_by_offset(60, 60).release().perform()
            self.assertNotEqual(self.browser.run(ticks), before)
            self.assertEqual(self.browser.run("return getComputedStyle(document.querySelector('#scene-0 .reset')).visibility"), "visible")
            plot.send_keys(Keys.ESCAPE)
            self.assertEqual(self.browser.run(ticks), before)
            plot.send_keys("+")
            self.assertNotEqual(self.browser.run(ticks), before)

    def test_charts_are_saved_as_files(self):
        self.browser.resize(1400, 900)
        self.browser.open(self.page)
        self.tab_to("e.textContent === 'Save SVG'")
        self.press(Keys.ENTER)
        svg = xml.etree.ElementTree.fromstring(self.downloaded("cornell.svg"))
        self.assertEqual(svg.tag, "{http://www.w3.org/2000/svg}svg")
        drawn = self.downloaded("cornell.svg")
        self.assertIn("filtered paths", drawn)
        self.assertNotIn("var(", drawn)

    def test_tables_unfold_sort_and_are_saved(self):
        for width, _ in self.at_both_widths():
            self.tab_to("e.tagName === 'SUMMARY' && e.textContent === 'All variants'")
            self.press(Keys.ENTER)
            folded = "[...document.querySelectorAll('details')].find((e) => e.firstChild.textContent === 'All variants')"
            rows = f"return [...{folded}.querySelectorAll('tbody tr')].map((row) => row.cells[3].textContent.replace(',', ''))"
            self.browser.settle()
            self.assertEqual(len(self.browser.run(rows)), 123)
            self.tab_to("e.textContent === 'frame'")
            self.press(Keys.ENTER)
            costs = [float(cost) for cost in self.browser.run(rows)]
            self.assertEqual(costs, sorted(costs))
            self.press(Keys.ENTER)
            self.assertEqual([float(cost) for cost in self.browser.run(rows)], sorted(costs, reverse=True))
        self.browser.run(f"{folded}.querySelector('button').click()")
        lines = self.downloaded("all-variants.csv").splitlines()
        self.assertEqual(len(lines), 124)
        self.assertTrue(lines[0].startswith("scene,method,variant,frame,"))

    def test_paper_has_charts_and_no_switches(self):
        self.browser.resize(1400, 900)
        self.browser.open(self.page)
        self.browser.media("print", "dark")
        display = "return getComputedStyle(document.querySelector(arguments[0])).display"
        for selector, is_shown in ((".toolbar", False), (".scene .filter", False), ("#matrix", True), (".scene svg.chart", True)):
            self.assertEqual(self.browser.run(display, selector) != "none", is_shown, selector)
        self.assertEqual(self.browser.run("return getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)")

    def test_large_pages_open_soon_and_scroll_down_alone(self):
        for scenes, copies in ((pareto_results.SCENES, 1), (("cornell",), 244)):
            self.browser.resize(1400, 900)
            page = self.root / f"{copies}.html"
            pareto_page.write(page, [pareto_results.write(self.root / str(copies), scenes, copies, images=False)], "nrmse", "indirect")
            print(f"{41 * len(scenes) * copies} variants: {page.stat().st_size / 1e6:.1f} MB, opened in {self.browser.open(page):.1f} s", flush=True)
            self.assertEqual(self.browser.console(), [])
            for width in (1280, 1000):
                self.browser.resize(width, 900)
                self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)


if __name__ == "__main__":
    unittest.main()
