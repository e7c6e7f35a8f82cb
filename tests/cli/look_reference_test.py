"""`voxray look`: a reference that gets better while nothing is asked, error maps and scores against it."""
import json
import re
import time
import unittest

import look_test
import numpy as np

if not look_test.browser.MISSING:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By

SECONDS = 60  # Within which what is waited for has to be there
MANY = 1 << 18  # Samples that take longer than a test
CAMERA = {"path": "scene.camera", "value": {"position": [0.2, 1, 3], "target": [0, 1, 0], "fov_deg": 50}}


def with_samples(count):
    return look_test.CONFIG.replace("spp: 8", f"spp: {count}")


class About(look_test.Look):
    """What the server says of the reference."""

    yaml = with_samples(MANY)

    def about(self, **request):
        status, body = self.ask("POST", "reference", json.dumps(request))
        self.assertEqual(status, 200, body)
        line, _, png = body.partition(b"\n")
        return json.loads(line), png

    def hash_of(self, answer):
        """Of the reference."""
        return answer["state"].split()[0]

    def about_at(self, samples, **request):
        """The first answer with so many samples."""
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            answer, png = self.about(**request)
            if answer["samples"] >= samples:
                return answer, png
            time.sleep(0.05)
        self.fail(f"{answer['samples']} samples after {SECONDS} s")

    def test_it_grows_while_nothing_is_asked(self):
        self.image()
        early, _ = self.about_at(4)
        self.assertEqual(early["of"], MANY)
        late, picture = self.about_at(4 * early["samples"], show="reference")
        self.assertLess(late["noise"]["nrmse"], 0.8 * early["noise"]["nrmse"])
        self.assertLess(late["scores"]["flip_noise"], early["scores"]["flip_noise"])
        self.assertLessEqual(late["scores"]["indirect_nrmse_low"], late["scores"]["indirect_nrmse"])
        self.assertEqual(look_test.pixels(picture).shape, (48, 64, 3))
        _, errors = self.about(show="error")
        self.assertEqual(np.ptp(look_test.pixels(errors), axis=2).max(), 0)  # Grey
        self.assertGreater(look_test.pixels(errors).max(), 0)

    def test_passes_keep_it_and_the_camera_begins_it_anew(self):
        self.image()
        before, _ = self.about_at(20)
        self.image(changes=[{"path": "inject.bounces", "value": 0}])
        kept, _ = self.about()
        self.assertGreaterEqual(kept["samples"], before["samples"])
        self.assertEqual(self.hash_of(kept), self.hash_of(before))
        self.assertNotEqual(kept["scores"]["indirect_nrmse"], before["scores"]["indirect_nrmse"])
        self.image(changes=[CAMERA])
        anew, _ = self.about()
        self.assertNotEqual(self.hash_of(anew), self.hash_of(kept))

    def test_an_image_comes_first(self):
        answer, _ = self.image()
        self.about_at(1)
        alone = []
        for _ in range(5):
            time.sleep(0.3)  # A slice is rendered
            start = time.monotonic()
            self.image(shrink=4)
            alone.append(time.monotonic() - start)
        self.assertLess(sorted(alone)[2], 1, alone)
        answer, _ = self.about()
        self.assertIn("scores", answer)

    def test_what_is_known_is_not_told_again(self):
        self.image(changes=[{"path": "reference.spp", "value": 8}])
        answer, picture = self.about_at(8, show="error")
        self.assertTrue(picture)
        again, nothing = self.about(show="error", known=answer["state"])
        self.assertEqual((again["samples"], nothing, again.get("scores")), (8, b"", None))
        self.assertTrue(self.about(show="reference", known=answer["state"])[1])
        self.image(changes=[{"path": "reference", "value": None}])
        self.assertEqual(self.about(), ({}, b""))
        self.assertEqual(self.about(side=1), ({}, b""))

    def test_malformed_requests_are_refused_with_a_word(self):
        for body in ("", "[1]", '{"show": "image"}', '{"side": 2}', '{"changes": []}', '{"known": [1]}'):
            status, answer = self.ask("POST", "reference", body)
            self.assertEqual(status, 400, body)
            self.assertIn(b"request", answer)


@unittest.skipIf(look_test.browser.MISSING, look_test.browser.MISSING)
class Shown(look_test.Browsed):
    yaml = with_samples(MANY)

    def samples(self):
        found = re.search(rf"(\d+) of {MANY} samples", self.find("#reference").text)
        return int(found[1]) if found else 0

    def wait_for(self, condition):
        end = time.monotonic() + SECONDS
        while not condition():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.05)

    def differs(self, image):
        return lambda: self.shown().shape == image.shape and np.abs(self.shown().astype(int) - image).mean() > 1

    def test_it_gets_better_and_the_error_map_shows(self):
        self.wait_for(lambda: self.samples() > 2)
        early = self.samples()
        self.wait_for(lambda: self.samples() > early)
        names, *rows = self.browser.run("return [...document.querySelectorAll('#reference tr')].map((row) => [...row.cells].map((cell) => cell.innerText))")
        self.assertEqual([row[0] for row in rows], ["all light", "indirect"])
        self.assertIn(" to ", rows[0][names.index("nRMSE")])
        self.assertIn("perfect", rows[1][names.index("HDR-FLIP")])

        image = self.shown()
        self.choose("show", "error (HDR-FLIP)")
        self.wait_for(lambda: np.abs(self.shown()[..., 0].astype(int) - self.shown()[..., 1]).max() > 60)  # Magma
        self.wait_for(self.differs(image))
        errors = self.shown()
        self.choose("show", "error of indirect light (HDR-FLIP)")
        self.wait_for(self.differs(errors))
        self.choose("show", "reference")
        self.wait_for(self.differs(errors))
        self.wait_for(lambda: np.abs(self.shown().astype(int) - image).mean() < 20)
        self.choose("show", "image")
        self.wait_for(lambda: np.array_equal(self.shown(), image))

        # A drag begins it anew
        many = self.samples()
        canvas = self.browser.driver.find_element(By.ID, "image")
        ActionChains(self.browser.driver).move_to_element(canvas).click_and_hold().move_by_offset(40, 10).release().perform()
        self.settle()
        self.wait_for(lambda: 0 < self.samples() < many)
        self.assertEqual(self.error(), "")
        self.assertEqual(self.browser.console(), [])

    def test_two_sides_share_it(self):
        self.wait_for(lambda: self.samples() > 2)
        self.choose("compare", "resolution 16")
        self.wait_for(lambda: "B, indirect" in self.find("#reference").text)
        rows = self.browser.run("return [...document.querySelectorAll('#reference tbody tr')].map((row) => [...row.cells].map((cell) => cell.innerText))")
        self.assertEqual([row[0] for row in rows], ["A, all light", "A, indirect", "B, all light", "B, indirect"])
        self.assertNotEqual(rows[1][1], rows[3][1])
        before = self.samples()
        self.wait_for(lambda: self.samples() > before)
        self.choose("compare", "none")
        self.wait_for(lambda: "B, indirect" not in self.find("#reference").text)

    def test_a_config_without_one_says_so(self):
        self.image(changes=[{"path": "reference", "value": None}])
        self.browser.driver.refresh()
        self.settle()
        self.wait_for(lambda: "has no reference" in self.find("#reference").text)


if __name__ == "__main__":
    unittest.main()
