"""`voxray look`: the passes of the graph in its page, their parameters and times."""
import unittest

import look_test
import numpy as np

if not look_test.browser.MISSING:
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select


class Passes(look_test.Browsed):
    def test_what_is_refused_is_said_and_not_shown(self):
        before = self.config()
        self.type("voxelize.resolution", "1e6")
        self.assertIn("voxelize.resolution: 1000000", self.error())
        self.assertEqual(self.config(), before)
        self.assertEqual(self.find("input[type=number][name='voxelize.resolution']").get_attribute("value"), "8")
        # The next change takes the words away
        self.type("voxelize.resolution", "12")
        self.assertEqual(self.error(), "")
        self.assertEqual(self.entry("voxelize")["resolution"], 12)

    def test_each_pass_that_is_offered_can_be_planned(self):
        first = self.config()
        missing = self.swap_of("gather_irradiance").options
        [cones] = [option for option in missing if option.get_attribute("value") == "gather_cones"]
        self.assertFalse(cones.is_enabled())
        self.assertIn("needs radiance", cones.text)
        for name in [entry.get("id", entry["pass"]) for entry in first["graph"]]:
            for other in [option.get_attribute("value") for option in self.swap_of(name).options if option.is_enabled()]:
                self.swap_of(name).select_by_value(other)
                self.settle()
                if other == "inject_rsm":  # The scene's light forbids it, which ports do not tell
                    self.assertIn("emissive surfaces", self.error())
                    continue
                self.assertEqual(self.error(), "", f"{other} in place of {name}")
                self.assertEqual(self.entry(name)["pass"], other)
            self.choose("variant", "resolution 8")
        self.assertEqual(self.config(), first)

    def test_a_pass_is_written_in_the_page(self):
        self.swap_of("composite").select_by_value("glsl")
        self.settle()
        text = self.find("textarea[name='composite.source']")
        self.assertIn("vec3 shade(", text.get_attribute("value"))
        albedo = self.shown()
        text.send_keys(Keys.CONTROL + "a")
        text.send_keys("vec3 shade(ivec2 pixel, ivec2 texel) { return 2.0 * texelFetch(albedo, texel, 0).rgb; }" + Keys.TAB)
        self.settle()
        self.assertEqual(self.error(), "")
        self.assertGreater(self.shown().mean(), 1.1 * albedo.mean())
        np.testing.assert_array_equal(self.shown(), self.downloaded_runs())
        # A mistake is told, and can be mended
        text.send_keys(Keys.CONTROL + "a")
        text.send_keys("vec3 shade(ivec2 pixel) { return vec3(1); }" + Keys.TAB)
        self.settle()
        self.assertIn("defines 'vec3 shade(ivec2 pixel)'", self.error())
        self.assertIn("ivec2 pixel) {", text.get_attribute("value"))

    def test_scene_and_reference(self):
        before = self.shown()
        self.type("reference.spp", "16")
        self.assertEqual(self.config()["reference"]["spp"], 16)
        np.testing.assert_array_equal(self.shown(), before)
        Select(self.find("select[name='scene.materials']")).select_by_value("lambert")
        self.settle()
        self.assertEqual(self.config()["scene"]["materials"], "lambert")
        self.assertEqual(self.error(), "")

    def test_shows_the_passes_of_the_graph(self):
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('#passes section')].map((card) => card.dataset.id)"),
                         [one.get("id", one["pass"]) for one in self.config()["graph"]])
        self.assertGreater(len(self.browser.run("return document.querySelector('.parameter').title")), 10)
        self.assertIn("ms", self.browser.run("return document.getElementById('status').textContent"))
        self.assertEqual(self.browser.run("return document.querySelectorAll('#times .bar-name').length"), len(self.config()["graph"]))
        Select(self.browser.driver.find_element(By.NAME, "variant")).select_by_value("resolution-16")
        self.settle()
        self.assertEqual(self.entry("voxelize")["resolution"], 16)
        dark = self.shown().mean()
        self.browser.driver.find_element(By.NAME, "exposure").send_keys(Keys.ARROW_RIGHT * 2)
        self.settle()
        self.assertEqual(self.config()["image"]["exposure_stops"], 1)
        self.assertGreater(self.shown().mean(), 1.1 * dark)
        for width in (400, 1400):
            self.browser.resize(width, 800)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)


if __name__ == "__main__":
    unittest.main()
