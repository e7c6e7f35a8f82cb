"""Tests of half-float images: what the page embeds, and how viewers show and tell them in a browser."""

from __future__ import annotations

import base64
import gzip
import re
import tempfile
import unittest
from pathlib import Path

import browser
import numpy as np
from report_support import ReportTest, made_up

from report import images, make_report

if not browser.MISSING:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys

SIZE = (64, 36)
STOPS = -1.0  # the config's exposure
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def srgb(linear: np.ndarray) -> np.ndarray:
    """Bytes, IEC 61966-2-1."""
    linear = linear.clip(0, 1)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def pbr_neutral(color: np.ndarray) -> np.ndarray:
    """The formulas of the PBR Neutral specification."""
    x = color.min(-1, keepdims=True)
    color = color - np.where(x <= 0.08, x - x * x / 0.16, 0.04)
    p = color.max(-1, keepdims=True)
    p_n = 1 - 0.24 ** 2 / (np.maximum(p, 0.76) + 1 - 2 * 0.76)
    g = 1 / (0.15 * (p - p_n) + 1)
    return np.where(p <= 0.76, color, color * p_n / np.maximum(p, 1e-9) * g + p_n * (1 - g))


def in_halfs(error: float) -> np.ndarray:
    return made_up.radiance(error, SIZE).astype(np.float16).astype(float)


class Encoding(ReportTest):
    def test_streams_hold_half_floats(self):
        rgb = np.array([[[0, 1, -2], [6.1e-5, 1e9, 0.1]], [[3e-8, 1e-9, 65504], [-1e9, 5, 1 / 3]]])
        data = np.frombuffer(gzip.decompress(base64.b64decode(images.encode(rgb))), np.uint8).astype(int)
        zigzag = data[:12] * 256 + data[12:]
        bits = np.cumsum(np.where(zigzag % 2, -(zigzag + 1) // 2, zigzag // 2)) & 0xffff
        halfs = bits.astype("<u2").view("<f2").reshape(3, 2, 2).transpose(1, 2, 0)
        np.testing.assert_array_equal(halfs, rgb.clip(-65504, 65504).astype(np.float16))

    def test_the_range_of_luminance_leaves_out_outliers(self):
        rgb = np.full((100, 100, 3), 2.0)
        rgb[0, 0], rgb[1] = 1e6, 0
        self.assertEqual([round(edge, 6) for edge in images.luminance_range(rgb)], [2, 2])
        self.assertIsNone(images.luminance_range(np.zeros((2, 2, 3))))

    def test_damaged_files_are_warned_of_and_their_previews_shown(self):
        rows = [made_up.variant("a", 10, 0.3), made_up.variant("b", 20, 0.2)]
        made_up.write_results(self.directory, rows, made_up.manifest([]), indirect=False, floats=True)
        whole = self.directory / "images" / "a" / "final.exr"
        whole.write_bytes(whole.read_bytes()[:-3000])
        status, errors = self.run_program()
        self.assertEqual((status, errors), (0, ""))
        source = (self.directory / "report.html").read_text(encoding="utf-8")
        self.assertIn("a/final.exr: its pixels cannot be read", source)
        self.assertEqual(source.count(" data-floats="), 2)
        self.assertIn('id="variant-1-total"', source)

    def test_thirteen_variants_take_less_than_15_MB(self):
        rows = [made_up.variant(f"v{i}", 10 + i, 0.5 - 0.02 * i, 0.5) for i in range(13)]
        made_up.write_results(self.directory, rows, made_up.manifest([]), size=(320, 180))
        noise = np.random.default_rng(7)
        for path in self.directory.glob("images/*/*.png"):
            if path.stem in ("final", "indirect"):
                noisy = made_up.radiance(0.2, (320, 180)) * noise.lognormal(0, 0.2, (180, 320, 1))
                path.with_suffix(".exr").write_bytes(made_up.exr(noisy.astype(np.float32), zipped=True))
        self.assertEqual(self.run_program(), (0, ""))
        page = self.directory / "report.html"
        self.assertEqual(page.read_text(encoding="utf-8").count(" data-floats="), 2 * 14)
        self.assertLess(page.stat().st_size, 15e6)


@unittest.skipIf(browser.MISSING, browser.MISSING)
class InABrowser(unittest.TestCase):
    """Three variants with half floats."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.errors = {"a": 0.6, "b": 0.3, "c": 0.1}
        rows = [made_up.variant(name, 10 * i + 10, error) for i, (name, error) in enumerate(cls.errors.items())]
        run = made_up.manifest([]) | {"exposure_stops": STOPS, "tone": "pbr_neutral"}
        directory = made_up.write_results(Path(folder.name), rows, run, indirect=False, floats=True, size=SIZE)
        assert make_report.main([str(directory)]) == 0
        cls.page = directory / "report.html"
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def open(self, address: str = ""):
        self.browser.open(self.page, address)
        self.browser.run("document.getElementById('variant-1').scrollIntoView({block: 'start', behavior: 'instant'})")
        self.browser.settle()

    def drawn(self, selector: str = "#variant-1 .viewer canvas") -> np.ndarray:
        """The bytes of a canvas, shape (height, width, 3)."""
        self.browser.settle()
        data = self.browser.run("""const canvas = document.querySelector(arguments[0]);
            return [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data]""", selector)
        return np.array(data, dtype=float).reshape(SIZE[1], SIZE[0], 4)[..., :3]

    def said(self, selector: str) -> str:
        self.browser.settle()
        return self.browser.run("return document.querySelector(arguments[0]).textContent", selector)

    def test_pixels_are_those_of_the_exr_files(self):
        self.open()
        data = self.browser.run("return voxray.pixelsOf(document.getElementById('variant-1-total')).then((pixels) => [...pixels.data])")
        np.testing.assert_array_equal(np.reshape(data, (3, SIZE[1], SIZE[0])).transpose(1, 2, 0), in_halfs(0.6))

    def test_exposure_and_tone_curves_show_the_whole_range(self):
        self.browser.console()
        for stops in (-5, 0, 4.5):
            light = in_halfs(0.6) * 2 ** (STOPS + stops)
            for colors, expected in (("srgb", srgb(light)), ("pbr_neutral", srgb(pbr_neutral(light)))):
                self.open(f"exposure={stops}&colors={colors}")
                np.testing.assert_allclose(self.drawn(), expected, atol=1.01, err_msg=f"{colors} {stops}")
                np.testing.assert_allclose(self.drawn("#variant-1 .viewer canvas.ref"), srgb(
                    (pbr_neutral if colors == "pbr_neutral" else np.asarray)(in_halfs(0) * 2 ** (STOPS + stops))), atol=1.01)
        self.assertEqual(self.browser.console(), [])

    def test_begins_with_the_curve_of_the_config(self):
        self.open()
        self.assertEqual(self.browser.run("return document.querySelector('[name=colors]').value"), "pbr_neutral")
        np.testing.assert_allclose(self.drawn(), srgb(pbr_neutral(in_halfs(0.6) * 2 ** STOPS)), atol=1.01)

    def test_luminance_is_shown_on_a_log_scale(self):
        self.open("colors=luminance")
        low, high = self.browser.run("const { low, high } = document.querySelector('.only-luminance i').dataset; return [Number(low), Number(high)]")
        luminance = np.maximum(in_halfs(0.6) @ LUMINANCE, 1e-30)
        self.assertTrue(10.0 ** low < np.median(luminance) < luminance.max() <= 10.0 ** high, (low, high))
        part = ((np.log10(luminance) - low) / (high - low)).clip(0, 1)
        np.testing.assert_allclose(self.drawn(), images.colors(images.LUMINANCE_COLORS, (255 * part).round().astype(int)), atol=4)
        self.assertTrue(self.browser.run("return document.querySelector('.only-luminance').checkVisibility()"))

    def test_errors_have_a_sign_and_do_not_clip(self):
        self.open("show=error")
        a, b = (in_halfs(error) @ LUMINANCE for error in (0.6, 0))
        error = (a - b) / np.maximum(a + b, 1e-30)
        part = 0.5 + 0.5 * np.sign(error) * abs(error) ** 0.5
        np.testing.assert_allclose(self.drawn(), images.colors(images.SIGNED_ERROR_COLORS, (255 * part).round().astype(int)), atol=6)

    def test_controls_are_named_inputs(self):
        self.open()
        for name in ("split", "exposure", "colors"):
            control = self.browser.driver.find_element(By.NAME, name)
            self.assertTrue(control.accessible_name, name)
        self.browser.driver.find_element(By.NAME, "exposure").send_keys(Keys.ARROW_RIGHT)
        np.testing.assert_allclose(self.drawn(), srgb(pbr_neutral(in_halfs(0.6) * 2 ** (STOPS + 0.5))), atol=1.01)

    def numbers(self, error: float, x: int, y: int) -> str:
        return " ".join(f"{value:.4g}" for value in in_halfs(error)[y, x])

    def test_arrow_keys_read_pixels_next_to_the_references(self):
        self.open()
        self.browser.driver.find_element(By.CSS_SELECTOR, "#variant-1 .viewer").send_keys(Keys.ARROW_RIGHT, Keys.ARROW_DOWN * 2)
        x, y = SIZE[0] // 2 + 1, SIZE[1] // 2 + 2
        said = self.said("#variant-1 .readout")
        self.assertIn(f"x {x}, y {y} · variant {self.numbers(0.6, x, y)} · reference {self.numbers(0, x, y)} · luminance × ", said)
        self.assertEqual(self.browser.run("return document.querySelector('#variant-1 .readout').ariaLive"), "polite")
        # The next viewer goes on from the same pixel, and stops at the edge
        self.browser.driver.find_element(By.CSS_SELECTOR, "#variant-2 .viewer").send_keys(Keys.SHIFT, Keys.ARROW_UP * 9)
        self.assertIn(f"x {x}, y 0 · variant {self.numbers(0.3, x, 0)}", self.said("#variant-2 .readout"))
        self.assertTrue(self.browser.run("return document.querySelector('#variant-2 .cursor').checkVisibility()"))

    def test_the_pointer_reads_pixels_of_both_sides(self):
        self.open("against=variant-3")
        stage = self.browser.driver.find_element(By.CSS_SELECTOR, "#variant-2 .viewer")
        self.browser.run("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", stage)
        ActionChains(self.browser.driver).move_to_element(stage).perform()
        said = self.said("#variant-2 .readout")
        x, y = map(int, re.match(r"x (\d+), y (\d+)", said).groups())
        self.assertTrue(abs(x - SIZE[0] / 2) <= 1 and abs(y - SIZE[1] / 2) <= 1, said)
        self.assertIn(f"variant {self.numbers(0.3, x, y)} · 3 c {self.numbers(0.1, x, y)}", said)

    def test_images_of_other_sizes_are_compared_by_position(self):
        self.open()
        small, large = {"width": 4, "height": 2}, {"width": 8, "height": 6}
        found = self.browser.run("return [0, 7, 20, 47].map((i) => voxray.indexIn(arguments[0], arguments[1], i))", small, large)
        self.assertEqual(found, [0, 3, 2, 7])
        self.assertEqual(self.browser.run("return voxray.indexIn(arguments[0], arguments[0], 29)", large), 29)

    def test_images_out_of_sight_have_no_pixels(self):
        self.open()
        self.browser.run("document.body.style.paddingBottom = '9000px'; scrollTo(0, 1e6)")
        self.browser.settle()
        self.assertEqual(self.browser.run("return document.querySelector('#variant-1 .viewer canvas').width"), 0)
        self.open()
        self.assertEqual(self.browser.run("return document.querySelector('#variant-1 .viewer canvas').width"), SIZE[0])

    def test_browsers_that_cannot_unpack_show_previews(self):
        self.open()
        data = self.browser.run("""const image = document.getElementById("variant-1-total").cloneNode();
            delete window.DecompressionStream;
            return voxray.pixelsOf(image).then((pixels) => [pixels.isExact, ...pixels.data.slice(0, 3)])""")
        preview = made_up.sphere(0.6, SIZE)[0].clip(0, 1)[0, :3, 0]
        self.assertFalse(data[0])
        np.testing.assert_allclose(srgb(np.array(data[1:]) * 2 ** STOPS), (255 * preview).astype(np.uint8), atol=0.01)


if __name__ == "__main__":
    unittest.main()
