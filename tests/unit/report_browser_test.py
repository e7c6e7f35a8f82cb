"""Tests of the report's page in a browser: what can be clicked, typed and dragged, and what it looks like."""

from __future__ import annotations

import tempfile
import unittest
import unittest.mock
from pathlib import Path

import browser
import numpy as np
from PIL import Image
from report_support import made_up

from report import make_report, page
from report.load import load

if not browser.MISSING:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys

SIZE = (320, 180)
FRAMES = 3
VISIBLE = "return [...document.querySelectorAll(arguments[0])].filter((e) => e.offsetParent).length"
ROWS = ("return [...document.querySelector('#results .results').tBodies[0].rows].filter((row) => !row.hidden)"
        ".map((row) => row.cells[0].textContent)")


def pixels(path: Path) -> np.ndarray:
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB"), dtype=float) / 255


def brighter(display: np.ndarray, stops: float) -> np.ndarray:
    """sRGB of so many stops more light (IEC 61966-2-1)."""
    linear = np.where(display <= 0.04045, display / 12.92, ((display + 0.055) / 1.055) ** 2.4) * 2.0 ** stops
    linear = linear.clip(0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


@unittest.skipIf(browser.MISSING, browser.MISSING)
class InABrowser(unittest.TestCase):
    """Six finished variants of a sequence and a failed one."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        rows = made_up.sweep_of_two_keys()
        cls.directory = made_up.write_results(Path(folder.name), rows, made_up.manifest(["voxelize.resolution", "inject"]), size=SIZE)
        for row in rows[:-1]:
            for frame in range(FRAMES):
                made_up.save_image(cls.directory / "images" / row["variant"] / f"frames/indirect.{frame}.png", 0.2 * frame, SIZE)
        assert make_report.main([str(cls.directory)]) == 0
        cls.page = cls.directory / "report.html"
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.resize(1400, 900)
        self.browser.media()
        self.open()

    def open(self, address: str = ""):
        self.browser.open(self.page, address)

    def shown(self) -> dict:
        return self.browser.run("return {...document.documentElement.dataset, ...voxray.state}")

    def press(self, *keys: str):
        ActionChains(self.browser.driver).send_keys(*keys).perform()

    def image(self, variant: str, name: str = "indirect") -> np.ndarray:
        return pixels(self.directory / "images" / variant / f"{name}.png")

    def stage_of(self, number: int) -> str:
        return f"#variant-{number} .viewer .canvas"

    def test_says_nothing_and_loads_nothing(self):
        self.browser.console()
        self.browser.requests()
        self.open("light=total&show=error&zoom=2&exposure=1&filter=rsm&against=variant-2")
        self.press("f", "l", "z", "s", "e", "c", "+", "-")
        self.browser.run("window.scrollTo(0, document.body.scrollHeight)")
        self.browser.settle()
        self.assertEqual(self.browser.console(), [])
        asked = set(self.browser.requests()) - {"about:blank"}
        self.assertEqual({address.partition("#")[0] for address in asked}, {self.page.resolve().as_uri()})

    def test_headings_sort_and_failed_variants_stay_last(self):
        heading = self.browser.run("return [...document.querySelectorAll('#results th.only-indirect button')]"
                                   ".find((b) => b.textContent.startsWith('nRMSE'))")
        for order in ("3625147", "4152637"):
            heading.click()
            self.assertEqual("".join(self.browser.run(ROWS)), order)
        self.assertEqual(self.browser.run("return document.querySelectorAll('#results th[aria-sort]').length"), 1)

    def test_the_filter_keeps_rows_and_what_shows_their_variants(self):
        field = self.browser.driver.find_element(By.NAME, "filter")
        self.press("/")
        self.assertEqual(self.browser.driver.switch_to.active_element, field)
        field.send_keys("RSM  resolution")
        self.assertEqual(self.browser.run(ROWS), ["4", "5", "6", "7"])
        self.assertEqual(self.browser.run("return document.querySelector('.filter output').textContent"), "4 of 7 variants")
        self.assertEqual(self.browser.run(VISIBLE, "#variants article"), 4)
        self.assertEqual(self.browser.run(VISIBLE, "#images .copy"), 4)  # with the reference
        field.clear()
        field.send_keys("nrmse<0.55")
        self.assertEqual(self.browser.run(ROWS), ["2", "3", "6"])
        self.press("l")  # A letter of the filter, no key
        self.assertEqual(self.shown()["light"], "indirect")
        field.send_keys(Keys.ESCAPE)
        self.assertEqual(len(self.browser.run(ROWS)), 7)
        # Of the light that is shown
        self.open("light=total&filter=nrmse%3C0.3")
        self.assertEqual(self.browser.run(ROWS), ["3", "6"])

    def test_rows_past_the_limit_are_a_click_away(self):
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.object(page, "_MAX_ROWS", 3):
            path = Path(folder) / "report.html"
            path.write_text(page.render(load(self.directory)), encoding="utf-8")
            self.browser.open(path, "")
            self.assertEqual(len(self.browser.run(ROWS)), 3)
            self.browser.run("document.querySelector('#results .all-rows').click()")
            self.assertEqual(len(self.browser.run(ROWS)), 7)

    def test_keys_change_the_page_and_its_address(self):
        for key, name, value in (("f", "show", "variant"), ("f", "show", "other"), ("e", "show", "error"), ("s", "show", "slider"),
                                 ("l", "light", "total"), ("l", "light", "indirect"), ("z", "zoom", "2"), ("+", "exposure", "1"),
                                 ("-", "exposure", "0"), ("-", "exposure", "-1"),
                                 ("c", "colors", "pbr_neutral"), ("c", "colors", "luminance"), ("c", "colors", "srgb")):
            self.press(key)
            self.assertEqual(self.shown()[name], value, key)
        self.assertEqual(self.browser.run("return location.hash"), "#exposure=-1&zoom=2")
        self.press(*["-"] * 12)
        self.assertEqual(self.shown()["exposure"], "-10")

    def test_the_slider_is_dragged_and_moved_by_keys(self):
        stage = self.browser.driver.find_element(By.CSS_SELECTOR, "#variant-2 .only-indirect .viewer")
        self.browser.run("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", stage)
        width = stage.size["width"]
        actions = ActionChains(self.browser.driver)
        actions.move_to_element(stage).click_and_hold().move_by_offset(-int(width / 4), 0).release().perform()
        self.assertAlmostEqual(float(self.shown()["split"]), 25, delta=1)
        self.browser.driver.find_element(By.NAME, "split").send_keys(Keys.ARROW_RIGHT * 2)
        self.assertAlmostEqual(float(self.shown()["split"]), 27, delta=1)
        # All viewers have it
        self.open("split=100")
        right = self.browser.picture(self.stage_of(1))[:, 20:-20].mean(axis=(0, 1))
        self.open("split=0")
        left = self.browser.picture(self.stage_of(1))[:, 20:-20].mean(axis=(0, 1))
        np.testing.assert_allclose(right, self.image("light_rays-64").mean(axis=(0, 1)), atol=0.02)
        np.testing.assert_allclose(left, self.image("reference").mean(axis=(0, 1)), atol=0.02)

    def test_images_are_shown_in_turns(self):
        test, reference = self.image("rsm-64"), self.image("reference")
        for show, expected in (("variant", test), ("other", reference)):
            self.open(f"show={show}")
            np.testing.assert_allclose(self.browser.picture(self.stage_of(4)).mean(axis=(0, 1)), expected.mean(axis=(0, 1)),
                                       atol=0.015, err_msg=show)
        self.assertGreater(abs(test - reference).mean(), 0.05)

    def test_any_two_variants_are_compared(self):
        self.open("show=error&against=variant-4")
        white = self.browser.picture(self.stage_of(4))
        self.assertLess(np.ptp(white), 0.01)
        self.assertGreater(white.min(), 0.9)
        self.assertGreater(np.ptp(self.browser.picture(self.stage_of(1))), 0.5)
        self.open("show=other&against=variant-4")
        np.testing.assert_allclose(self.browser.picture(self.stage_of(1)).mean(axis=(0, 1)), self.image("rsm-64").mean(axis=(0, 1)), atol=0.015)

    def test_exposure_scales_linear_light_of_all_images(self):
        for stops in (2, -2):
            for show, image in (("variant", "light_rays-64"), ("other", "reference")):
                self.open(f"show={show}&exposure={stops}")
                np.testing.assert_allclose(self.browser.picture(self.stage_of(1)).mean(axis=(0, 1)),
                                           brighter(self.image(image), stops).mean(axis=(0, 1)), atol=0.02)

    def test_zoomed_images_move_together(self):
        self.open("zoom=4")
        moved = self.browser.run("""
            const stages = [...document.querySelectorAll(".stage")].filter((stage) => stage.checkVisibility());
            stages[2].dispatchEvent(new Event("pointerenter"));
            stages[2].scrollTo({ left: 200, top: 100, behavior: "instant" });
            return stages.length;""")
        self.browser.settle()
        places = self.browser.run("""return [...document.querySelectorAll(".stage")].filter((stage) => stage.checkVisibility())
            .map((stage) => [stage.scrollLeft / (stage.scrollWidth - stage.clientWidth), stage.scrollTop / (stage.scrollHeight - stage.clientHeight)])""")
        self.assertEqual(moved, 2 * 6)
        np.testing.assert_allclose(places, [places[2]] * len(places), atol=0.01)
        self.assertGreater(places[0][0], 0.05)

    def test_points_of_charts_say_their_name_and_lead_to_their_variant(self):
        self.browser.run("document.querySelector('#speed').scrollIntoView({behavior: 'instant'})")
        plots = [plot for plot in self.browser.driver.find_elements(By.CSS_SELECTOR, "#speed .plot") if plot.is_displayed()]
        self.assertEqual(len(plots), 3)
        marks = plots[0].find_elements(By.CSS_SELECTOR, ".mark")
        point = max(marks, key=lambda mark: mark.location["x"])  # the slowest
        ActionChains(self.browser.driver).move_to_element(point).perform()
        said = plots[0].find_element(By.XPATH, "following-sibling::output").text
        self.assertRegex(said, r"^3 \(resolution 256, light_rays\): 60 ms, 0.3 \(0.291 to 0.309\)$")
        ActionChains(self.browser.driver).click().perform()
        self.browser.settle()
        self.assertEqual(self.browser.run("return location.hash"), "#variant-3")
        top = self.browser.run("return document.getElementById('variant-3').getBoundingClientRect().top")
        self.assertTrue(0 <= top < 300, top)
        # By keys, and faint where the filter leaves a variant out
        plots[0].send_keys(Keys.HOME, Keys.ENTER)
        self.assertEqual(self.browser.run("return location.hash"), "#variant-4")
        self.open("filter=rsm")
        self.assertEqual(self.browser.run(VISIBLE.replace("e.offsetParent", "e.getBoundingClientRect().width"), "#speed .mark.faint"), 3 * 3)

    def test_names_in_charts_do_not_cover_each_other(self):
        # Those of lines for the noise, a black and a constant image among them
        for width in (1400, 400):
            self.browser.resize(width, 900)
            self.open()
            boxes = self.browser.run("""return [...document.querySelectorAll('#speed .plot')].filter((plot) => plot.offsetParent).map((plot) =>
                [...plot.querySelectorAll('.name, text.level')].map((name) => {
                const box = name.getBoundingClientRect(); return [box.left, box.top, box.right, box.bottom]; }))""")
            self.assertEqual([len(names) for names in boxes], [8, 8, 9])
            for names in boxes:
                for i, a in enumerate(names):
                    for b in names[:i]:
                        self.assertFalse(a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3], (width, a, b))

    def test_sequences_play_in_a_loop(self):
        self.assertEqual(self.browser.run(VISIBLE, ".film img"), 6)
        self.assertTrue(self.browser.run("return [...document.querySelectorAll('.film img')].every((i) => i.complete && i.naturalWidth === 320)"))
        before = self.browser.picture("#variant-1 .film img")
        changes = [abs(self.browser.picture("#variant-1 .film img") - before).max() for _ in range(20)]
        self.assertGreater(max(changes), 0.05)

    def test_images_and_their_chart_are_the_first_screen(self):
        self.browser.resize(1280, 800)
        self.open()
        bottoms = self.browser.run("""return ['#images .copies', '#images .plot'].map((selector) =>
            Math.max(...[...document.querySelectorAll(selector)].map((e) => e.getBoundingClientRect().bottom)))""")
        self.assertLess(max(bottoms), 800)
        copies = self.browser.run("return [...document.querySelectorAll('#images .copy')].filter((e) => e.offsetParent)"
                                  ".map((e) => [e.querySelector('span').textContent, e.querySelector('img').offsetWidth])")
        self.assertEqual([name[:1] for name, _ in copies], list("r362514"))  # the reference, then by error
        self.assertGreater(min(width for _, width in copies), 200)
        self.assertLess(max(bottoms), self.browser.run(
            "return [...document.querySelectorAll('.summary')].find((e) => e.offsetParent).getBoundingClientRect().top"))
        self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 1280)

    def test_a_phone_shows_two_images_in_a_row_and_scrolls_down_alone(self):
        self.browser.resize(400, 800)
        self.open()
        self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 400)
        boxes = self.browser.run("return [...document.querySelectorAll('#images .copy img')].filter((e) => e.offsetParent).slice(0, 3)"
                                 ".map((e) => { const box = e.getBoundingClientRect(); return [box.top, box.right, box.bottom]; })")
        self.assertEqual(boxes[0][0], boxes[1][0])
        self.assertTrue(boxes[1][1] <= 400 and boxes[2][2] < 800, boxes)
        size = self.browser.run("return parseFloat(getComputedStyle(document.querySelector('#results td')).fontSize)")
        self.assertGreaterEqual(size, 11)

    def test_a_phone_has_every_choice_by_keys(self):
        self.browser.resize(400, 800)
        self.open()
        left, found = "return document.activeElement.getBoundingClientRect()", set()
        for _ in range(20):
            self.press(Keys.TAB)
            name = self.browser.run("return document.activeElement.name ?? ''")
            if not name or name == "filter":
                continue
            found.add(name)
            box = self.browser.run(left)
            self.assertTrue(-1 <= box["x"] and box["x"] + box["width"] <= 401, (name, box))
            if name == "exposure":
                self.press(Keys.ARROW_RIGHT)
        self.assertEqual(self.shown()["exposure"], "0.5")
        self.assertLessEqual({"light", "exposure", "colors", "show", "split", "against", "zoom"}, found)

    def test_warnings_and_temporal_error_are_a_click_away(self):
        rows, run = made_up.sweep_of_two_keys(), made_up.manifest(["voxelize.resolution", "inject"])
        run["warnings"] = ["times were disturbed", "the reference is noisy", "a light is off"]
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        directory = Path(folder.name)
        frames = made_up.with_sequence(rows[:-1], FRAMES)
        made_up.write_results(directory, rows, run, size=SIZE)
        made_up.write_csv(directory / "frames.csv", list(frames[1]), frames)
        self.assertEqual(make_report.main([str(directory)]), 0)
        in_sight = "const box = document.querySelector(arguments[0]).getBoundingClientRect(); return box.height > 0 && box.top >= 0 && box.top < 400"
        for width, height, link, target in ((400, 800, ".to-warnings", "#warnings li"), (1400, 900, ".to-warnings", "#warnings li"), (400, 800, '.jumps a[href="#frames"]', "#frames h2"),
                                            (1400, 900, '.jumps a[href="#frames"]', "#frames h2")):
            self.browser.resize(width, height)
            self.browser.open(directory / "report.html")
            self.assertTrue(self.browser.run(in_sight, link), (width, link))
            self.assertFalse(self.browser.run(in_sight, target), (width, target))
            self.browser.driver.find_element(By.CSS_SELECTOR, link).click()
            self.browser.settle()
            self.assertTrue(self.browser.run(in_sight, target), (width, target))
        self.assertEqual(self.browser.run(VISIBLE, ".to-warnings"), 1)

    def test_the_dark_scheme_is_dark_and_paper_is_white(self):
        def brightness(selector, key):
            color = self.browser.run("return getComputedStyle(document.querySelector(arguments[0]))[arguments[1]]", selector, key)
            return sum(int(part) for part in color[color.index("(") + 1:-1].split(",")[:3]) / 3 / 255
        for scheme, low, high in (("light", 0.9, 1), ("dark", 0, 0.2)):
            self.browser.media(scheme=scheme)
            self.assertTrue(low <= brightness("body", "backgroundColor") <= high, scheme)
            self.assertGreater(abs(brightness("body", "color") - brightness("body", "backgroundColor")), 0.6)
        self.browser.media("print", "dark")
        self.assertGreater(brightness("body", "backgroundColor"), 0.9)
        self.assertEqual(self.browser.run("return getComputedStyle(document.querySelector('.toolbar')).display"), "none")


if __name__ == "__main__":
    unittest.main()
