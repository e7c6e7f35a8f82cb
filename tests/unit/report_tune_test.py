"""Tests of the page of `voxray tune`."""

from __future__ import annotations

import unittest
from pathlib import Path

import browser
from report_support import Page, ReportTest, made_up

from report import tune_page

if not browser.MISSING:
    from selenium.webdriver.common.keys import Keys

SENTENCE = "Chosen: rays 16: indirect_relmse 0.35, ms 20, after 5 trials for indirect_relmse=0.4."
TRAIL = [["small", "rays 4", "1.5", "8", "1"], ["small", "rays 16", "0.8", "21", "2"], ["full", "rays 64", "0.5", "70", "70"],
         ["small", "rays 1", "", "", ""], ["full", "rays 16", "0.875", "20", "20"]]


class Tune(ReportTest):
    """Five trials, of which one failed; the last one, at full size, is chosen."""

    def write(self, **options) -> Path:
        rows = [made_up.variant(name.replace(" ", "-"), ms, error, error, tuned=name) for name, ms, error in (("rays 64", 70, 0.2), ("rays 16", 20, 0.35))]
        made_up.write_results(self.directory / "full", rows, made_up.manifest(["tuned"]), **options)
        return tune_page.write(self.directory, TRAIL, "ms", "rays 16", "tuned", "indirect", SENTENCE)

    def test_says_what_was_chosen_and_lists_all_trials(self):
        page = Page(self.write().read_text(encoding="utf-8"))
        self.assertIn(SENTENCE, page.text)
        self.assertEqual(page.count("div", "plot"), 1)
        images = [(attributes["alt"], attributes["src"][:15]) for tag, attributes in page.tags if tag == "img"]
        self.assertEqual(images, [(name, "data:image/png;") for name in ("reference", "rays 16", "its error (FLIP)")])
        rows = page.text[page.text.index("ms of the trial"):].split("\n")
        self.assertEqual("".join(rows).count("small"), 3)
        self.assertIn("rays 64", page.text)
        self.assertFalse(page.attributes("href"))

    def test_images_that_trials_did_not_keep_are_left_out(self):
        page = Page(self.write(images=False).read_text(encoding="utf-8"))
        self.assertNotIn("img", [tag for tag, _ in page.tags])

    @unittest.skipIf(browser.MISSING, browser.MISSING)
    def test_trials_are_joined_in_order_and_told_by_keys(self):
        path = self.write()
        window = browser.Browser()
        self.addCleanup(window.close)
        for width in (1400, 400):
            window.resize(width, 800)
            window.open(path)
            self.assertLessEqual(window.run("return document.documentElement.scrollWidth"), width)
            names = window.run("return [...document.querySelectorAll('.name')].map((name) => name.textContent)")
            self.assertEqual(sorted(names), ["1", "2", "3", "5 chosen"])
            self.assertEqual(window.run("return document.querySelector('text.level').textContent"), "target")
            # The chosen one, of more cost and error than the second trial's: right of it, and below the target's line
            box = "const box = document.querySelector(arguments[0]).getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]"
            (first, chosen), target = (window.run(box, f".series{css} .mark") for css in (":nth-of-type(2)", ".bold")), window.run(box, "path.level")
            self.assertGreater(chosen[0], first[0])
            self.assertTrue(first[1] < target[1] < chosen[1], (first, target, chosen))
            # One line over all trials that did not fail
            lines = window.run("return [...document.querySelectorAll('.curve')].map((line) => line.getAttribute('d').split(/[ML]/).length - 1)")
            self.assertEqual(lines, [4, 0, 0, 0])
            plot = window.driver.find_element("id", "trials")
            said = "return document.querySelector('.said').textContent"
            for keys, words in ((Keys.HOME, "Trial 1 (small): rays 4: 8 ms, 1.5 times"), (Keys.ARROW_RIGHT, "Trial 2 (small): rays 16: 21 ms"),
                                (Keys.END, "Trial 5 (chosen): rays 16: 20 ms, 0.875 times")):
                plot.send_keys(keys)
                self.assertTrue(window.run(said).startswith(words), window.run(said))
        self.assertEqual(window.console(), [])


if __name__ == "__main__":
    unittest.main()
