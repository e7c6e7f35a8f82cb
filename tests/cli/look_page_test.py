"""`voxray look`: its page in a browser."""
import contextlib
import os
import signal
import time
import unittest

import look_test
import numpy as np

if not look_test.browser.MISSING:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select


class Page(look_test.Browsed):
    def test_what_is_shown_is_what_run_renders(self):
        first = self.shown()
        # Fly with a key and turn with the mouse
        canvas = self.browser.driver.find_element(By.ID, "image")
        ActionChains(self.browser.driver).click(canvas).key_down("w").pause(0.4).key_up("w").perform()
        ActionChains(self.browser.driver).move_to_element(canvas).click_and_hold().move_by_offset(40, 10).move_by_offset(20, 0).release().perform()
        self.settle()
        self.assertGreater(self.browser.run("return window.look.latencies.length"), 1)
        flown = self.shown()
        self.assertGreater(np.abs(flown.astype(int) - first).mean(), 1)
        # Slide a parameter
        slider = self.browser.driver.find_element(By.CSS_SELECTOR, "input[type=range][name='inject.bounces']")
        slider.send_keys(Keys.HOME)
        self.settle()
        self.assertEqual(self.entry("inject")["bounces"], 0)
        self.assertGreater(np.abs(self.shown().astype(int) - flown).mean(), 0.1)
        # Swap a pass
        swap = self.browser.driver.find_element(By.CSS_SELECTOR, "[data-id=gather_irradiance] select")
        Select(swap).select_by_value("path_trace")
        self.settle()
        self.assertEqual(self.error(), "")
        self.assertEqual(self.entry("gather_irradiance")["pass"], "path_trace")
        np.testing.assert_array_equal(self.shown(), self.downloaded_runs())
        # It can be swapped back, and the changed variant chosen anew, which keeps the camera
        swap = self.browser.driver.find_element(By.CSS_SELECTOR, "[data-id=gather_irradiance] select")
        self.assertIn("gather_irradiance", [option.get_attribute("value") for option in Select(swap).options])
        camera = self.config()["scene"]["camera"]
        self.choose("variant", "resolution 8")
        self.assertEqual(self.entry("gather_irradiance")["pass"], "gather_irradiance")
        self.assertEqual(self.config()["scene"]["camera"], camera)
        self.assertEqual(self.browser.console(), [])

    def test_two_pages_and_the_programs_end(self):
        self.browser.driver.switch_to.new_window("tab")
        self.addCleanup(self.browser.driver.switch_to.window, self.browser.driver.window_handles[0])
        self.addCleanup(self.browser.driver.close)
        self.browser.driver.get(self.address)
        self.settle()
        first = self.shown()
        self.browser.driver.find_element(By.CSS_SELECTOR, "input[type=range][name='inject.bounces']").send_keys(Keys.HOME)
        self.settle()
        self.browser.driver.switch_to.window(self.browser.driver.window_handles[0])
        self.browser.driver.find_element(By.NAME, "exposure").send_keys(Keys.ARROW_RIGHT)
        self.settle()
        self.assertEqual((self.entry("inject")["bounces"], self.config()["image"]["exposure_stops"]), (0, 0.5))
        self.assertGreater(np.abs(self.shown().astype(int) - first).mean(), 1)
        self.process.kill()
        self.process.wait()
        self.browser.driver.find_element(By.NAME, "exposure").send_keys(Keys.ARROW_RIGHT)
        while not self.error():
            time.sleep(0.05)
        self.assertIn("Start voxray look again", self.error())
        self.browser.driver.switch_to.window(self.browser.driver.window_handles[1])

    def configs(self):
        return self.browser.run("return window.look.configs")

    def edited(self):
        return self.browser.run("return [...document.querySelectorAll('figcaption [aria-pressed=true]')].map((one) => one.textContent)")

    def test_two_sides(self):
        first = self.shown()
        self.choose("compare", "resolution 16")
        self.assertEqual([one["graph"][1]["resolution"] for one in self.configs()], [8, 16])
        np.testing.assert_array_equal(self.shown(), first)
        second = self.shown("other")
        self.assertGreater(np.abs(second.astype(int) - first).mean(), 0.1)
        # One of them is edited: by a key or a click
        self.assertEqual(self.edited(), ["A: resolution 8 (being edited)"])
        self.find("#image").send_keys("x")
        self.assertEqual(self.edited(), ["B: resolution 16 (being edited)"])
        self.assertIn("resolution 16", self.find("#times-title").text)
        self.find("input[type=range][name='inject.bounces']").send_keys(Keys.HOME)
        self.settle()
        self.assertEqual([one["graph"][2]["bounces"] for one in self.configs()], [2, 0])
        self.assertEqual(self.edited(), ["B: resolution 16, changed (being edited)"])
        np.testing.assert_array_equal(self.shown(), first)
        self.assertGreater(np.abs(self.shown("other").astype(int) - second).mean(), 0.1)
        self.find("figcaption button").click()
        self.assertEqual(self.edited(), ["A: resolution 8 (being edited)"])
        self.assertEqual(self.find("input[type=number][name='voxelize.resolution']").get_attribute("value"), "8")
        # Camera and exposure are those of both
        latencies = self.browser.run("return window.look.latencies.length")
        self.find("#image").send_keys("")
        self.hold("w", 0.4)
        self.find("input[name=exposure]").send_keys(Keys.ARROW_RIGHT)
        self.settle()
        for one in self.configs():
            self.assertEqual(one["image"]["exposure_stops"], 0.5)
            self.assertEqual(one["scene"]["camera"], self.configs()[0]["scene"]["camera"])
        drafted = self.browser.run("return window.look.latencies.slice(arguments[0]).map((one) => one.side)", latencies)
        self.assertEqual(set(drafted), {0, 1})
        self.assertGreater(np.abs(self.shown("other").astype(int) - self.shown()).mean(), 0.1)
        # The config is that of the edited side
        self.press("x")
        self.press("x")
        np.testing.assert_array_equal(self.shown(), self.downloaded_runs())
        # A refusal says whose it is
        self.type("voxelize.resolution", "1e6")
        self.assertRegex(self.error(), "^A: resolution 8\n.*voxelize.resolution")
        self.choose("compare", "none")
        self.assertEqual(len(self.configs()), 1)
        self.assertFalse(self.find("#other").is_displayed())
        self.assertEqual(self.browser.console(), [])

    def test_a_state_is_pinned_and_the_image_is_split(self):
        self.find("input[type=range][name='inject.bounces']").send_keys(Keys.HOME)
        self.choose("compare", "this state")
        np.testing.assert_array_equal(self.shown("other"), self.shown())
        pinned = self.configs()[1]
        self.assertEqual(pinned, self.configs()[0])
        self.find("input[type=range][name='inject.bounces']").send_keys(Keys.END)
        self.settle()
        self.assertEqual(self.configs()[1], pinned)
        self.assertGreater(np.abs(self.shown("other").astype(int) - self.shown()).mean(), 0.1)
        # The slider over the image: by mouse, by keys
        camera = self.config()["scene"]
        slider = self.find("input[name=split]")
        self.assertEqual(slider.get_attribute("value"), "50")
        ActionChains(self.browser.driver).move_to_element(slider).click_and_hold().move_by_offset(150, 0).release().perform()
        self.settle()
        dragged = float(slider.get_attribute("value"))
        self.assertGreater(dragged, 55)
        self.assertEqual(self.config()["scene"], camera)
        slider.send_keys(Keys.ARROW_LEFT)
        self.assertEqual(float(slider.get_attribute("value")), dragged - 0.5)
        at = "const [x, y] = arguments, box = document.getElementById('images').getBoundingClientRect(); " \
             "return document.elementFromPoint(box.x + x * box.width, box.y + y * box.height).id"
        self.assertEqual([self.browser.run(at, x, 0.8) for x in (0.1, 0.9)], ["image", "other"])
        # Letters fly while it is in focus
        self.hold("d", 0.3)
        self.settle()
        self.assertNotEqual(self.config()["scene"], camera)
        self.choose("layout", "side by side")
        self.assertFalse(slider.is_displayed())
        left, right = (self.find(name).rect for name in ("#image", "#other"))
        self.assertLess(left["x"] + left["width"], right["x"])
        for width in (400, 1400):
            self.browser.resize(width, 800)
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)

    def test_a_path_is_recorded(self):
        before = self.config()
        self.press("r")
        self.assertEqual(self.find("#record").text, "End path")
        self.hold("w", 0.4)
        self.hold(Keys.ARROW_LEFT, 0.3)
        self.press("r")
        self.settle()
        path = self.config()["scene"]["camera"]["path"]
        frames = self.config()["measure"]["frames"]
        self.assertEqual(path[-1]["frame"], frames - 1)
        self.assertGreater(frames, 15)
        self.assertLess(len(path), frames - 1)
        self.assertIn(f"{frames} frames", self.find("#path").text)
        image = self.shown()
        np.testing.assert_array_equal(image, self.downloaded_runs())
        [variant] = [name for name in os.listdir(self.path("run", "images")) if name != "reference"]
        self.assertEqual(len([name for name in os.listdir(self.path("run", "images", variant, "frames")) if name.startswith("final")]), frames)
        # The camera leaves it and goes back
        self.hold("s", 0.3)
        self.settle()
        self.assertNotIn("path", self.config()["scene"]["camera"])
        self.assertEqual(self.config()["measure"], before["measure"])
        back = self.find("#path button:last-child")
        back.click()
        self.settle()
        self.assertEqual(self.config()["scene"]["camera"]["path"], path)
        # It is played in drafts
        latencies = self.browser.run("return window.look.latencies.length")
        self.find("#path button").click()
        time.sleep(0.2)
        self.settle()
        self.assertGreater(self.browser.run("return window.look.latencies.length"), latencies)
        self.assertEqual(self.config()["scene"]["camera"]["path"], path)
        np.testing.assert_array_equal(self.shown(), image)
        # A page that is loaded anew has it, too
        self.browser.driver.refresh()
        self.settle()
        self.assertIn(f"{frames} frames", self.find("#path").text)
        self.hold("s", 0.3)
        self.settle()
        self.assertNotIn("path", self.config()["scene"]["camera"])
        self.find("#path button:last-child").click()
        self.settle()
        self.assertEqual(self.config()["scene"]["camera"]["path"], path)
        self.assertEqual(self.browser.console(), [])

    def test_the_keyboard_reaches_everything(self):
        self.choose("compare", "resolution 16")
        reached = self.browser.driver.execute_async_script("""
            const done = arguments[0], controls = "button, select, input, summary, canvas, a[href]";
            document.body.focus();
            done([...document.querySelectorAll(controls)].filter((one) => one.checkVisibility() && !one.disabled).length);""")
        self.browser.run("document.activeElement.blur(); window.reached = new Set(); window.unmarked = []")
        for _ in range(reached + 3):
            self.press(Keys.TAB)
            self.browser.run("""const one = document.activeElement;
                if (one !== document.body) window.reached.add(one);
                if (one !== document.body && getComputedStyle(one).outlineStyle === "none") window.unmarked.push(one.outerHTML)""")
        self.assertEqual(self.browser.run("return window.reached.size"), reached)
        self.assertEqual(self.browser.run("return window.unmarked"), [])
        # What is typed into a box is no flight
        camera = self.config()["scene"].get("camera")
        box = self.find("input[type=number][name='voxelize.resolution']")
        box.send_keys(Keys.CONTROL + "a")
        box.send_keys("1e1")
        box.send_keys(Keys.ARROW_UP + Keys.ENTER)
        self.settle()
        self.assertEqual(self.entry("voxelize")["resolution"], 11)
        self.assertEqual(self.config()["scene"].get("camera"), camera)
        self.find("#download").send_keys("x")
        self.assertEqual(self.edited(), ["B: resolution 16 (being edited)"])

    def test_shows_every_kind_of_view(self):
        image = self.shown()
        select = Select(self.find("select[name=show]"))
        for name, legend in (("gbuffer.N", "direction"), ("gbuffer.P", "percentile"), ("gbuffer.id", "each number"), ("gbuffer.albedo", "sRGB"),
                             ("gather_irradiance.indirect", "exposure"), ("voxelize.voxel occupancy", "each value")):
            select.select_by_value(name)
            self.settle()
            self.assertEqual(self.error(), "", name)
            self.assertGreater(self.shown().mean(), 5, name)
            self.assertIn(legend, self.find("#legend").text, name)
        before = None
        select.select_by_value("show_voxels")
        for show in ("irradiance", "normal", "albedo"):
            Select(self.find("select[name='show_voxels.show']")).select_by_value(show)
            self.settle()
            self.assertEqual(self.error(), "", show)
            self.assertGreater(self.shown().mean(), 5, show)
            self.assertTrue(before is None or (before != self.shown()).any(), show)
            before = self.shown()
        self.assertFalse(self.find("select[name='show_voxels.show'] option[value=radiance]").is_enabled())
        self.assertIn("culled", self.find("#passes [data-id=gather_irradiance]").get_attribute("class"))
        # Flying and parameters work as in the image
        self.find("#image").click()
        self.hold("w", 0.4)
        self.settle()
        self.assertGreater(np.abs(self.shown().astype(int) - before).mean(), 1)
        slider = self.find("input[type=range][name='voxelize.resolution']")
        slider.send_keys(Keys.ARROW_RIGHT * 3)
        self.settle()
        self.assertEqual(self.error(), "")
        select.select_by_value("image")
        self.settle()
        self.assertGreater(np.abs(self.shown().astype(int) - image).mean(), 1)
        self.assertEqual(self.find("#legend").text, "")
        self.assertFalse(self.find("#voxels").is_displayed())
        np.testing.assert_array_equal(self.shown(), self.downloaded_runs())
        self.assertEqual(self.browser.console(), [])

    def test_the_variant_is_right_after_a_reload(self):
        self.choose("variant", "resolution 16")
        self.browser.driver.refresh()
        self.settle()
        self.assertEqual(self.variant(), "resolution 16")
        # What a page changed is told the next one
        self.find("input[type=range][name='inject.bounces']").send_keys(Keys.HOME)
        self.hold("w", 0.3)
        self.settle()
        self.browser.driver.refresh()
        self.settle()
        self.assertEqual(self.variant(), "resolution 16, changed")
        self.type("inject.bounces", "2")
        self.assertEqual(self.variant(), "resolution 16")
        # The next variant keeps camera and exposure
        self.find("input[name=exposure]").send_keys(Keys.ARROW_RIGHT)
        self.settle()
        camera = self.config()["scene"]["camera"]
        self.choose("variant", "resolution 8")
        self.assertEqual((self.config()["scene"]["camera"], self.config()["image"]["exposure_stops"]), (camera, 0.5))

    def test_keys_fly_after_the_mouse_has_used_a_list(self):
        for is_by_mouse in (True, False):
            self.browser.run("""const list = document.querySelector("select[name=show]");
                list.dispatchEvent(arguments[0] ? new PointerEvent("pointerdown", { bubbles: true }) : new KeyboardEvent("keydown", { bubbles: true }));
                list.focus();
                list.dispatchEvent(new Event("change", { bubbles: true }));""", is_by_mouse)
            self.assertEqual(self.browser.run("return document.activeElement.tagName"), "CANVAS" if is_by_mouse else "SELECT")

    def test_a_killed_browser_takes_nothing_with_it(self):
        self.type("inject.bounces", "1")
        shown, config = self.shown(), self.config()
        other = look_test.browser.Browser()
        self.addCleanup(other.driver.service.stop)
        other.driver.get(self.address)
        look_test.settle(other)
        # In the middle of a whole image, and of a flight
        other.run("""document.body.dispatchEvent(new KeyboardEvent("keydown", { code: "KeyW", bubbles: true }));
            fetch("image", { method: "POST", body: JSON.stringify({ page: "slow", changes: [{ path: "inject.rays_per_light", value: 1 << 22 }] }) });""")
        time.sleep(0.3)
        for process in look_test.descendants(other.driver.service.process.pid):
            with contextlib.suppress(ProcessLookupError):  # It ended with another one
                os.kill(process, signal.SIGKILL)
        self.assertIsNone(self.process.poll())
        answer, png = self.image(page="another", config=config)
        self.assertEqual(answer["config"], config)
        np.testing.assert_array_equal(look_test.pixels(png), shown)
        self.browser.driver.refresh()
        self.settle()
        self.assertEqual(self.config(), config)
        np.testing.assert_array_equal(self.shown(), shown)


if __name__ == "__main__":
    unittest.main()
