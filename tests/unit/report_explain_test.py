"""Tests of the parts of an error, on images whose parts are known."""

import csv
import itertools
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "framework"), str(Path(__file__).resolve().parent)]

import browser  # noqa: E402
import report_results as made_up  # noqa: E402
from exr_writer import exr  # noqa: E402
from report import explain, explain_page  # noqa: E402
from report.load import load  # noqa: E402
from report.results import ReportError  # noqa: E402
from report_support import Page  # noqa: E402

SIZE = (64, 48)


def stage(name, *needs):
    return {"name": name, "cure": f"more of {name}", "needs": list(needs), "changes": [f"{name}.n 1 → 9"]}


class Explain(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name) / "run"
        random = np.random.default_rng(5)
        self.noise = [random.standard_normal((SIZE[1], SIZE[0], 3)) for _ in range(4)]

    def write(self, errors, stages, light=2.0):
        """A run in which each stage that is not swapped adds its error, images of mean `light`, to an even reference with noise."""
        names = [entry["name"] for entry in stages]
        needs = {entry["name"]: set(entry["needs"]) for entry in stages}
        sets = [chosen for n in range(len(names) + 1) for chosen in itertools.combinations(names, n)
                if all(needs[name] <= set(chosen) for name in chosen)]
        labels = {" + ".join(chosen) or "as it is": list(chosen) for chosen in sets}
        rows = [made_up.variant(f"v{i}", 1, 0.1, 0.1, explained=label) for i, label in enumerate(labels)]
        run = made_up.manifest(["explained"])
        made_up.write_results(self.directory, rows, run)
        truth = np.full((SIZE[1], SIZE[0], 3), light)
        for row, chosen in zip(rows, sets):
            self.save(row["variant"], "indirect", truth + sum((errors[name] for name in names if name not in chosen), 0 * truth))
        for half, noise in zip("ab", self.noise[2:]):
            self.save("reference", f"indirect_{half}", truth + 0.2 * light * noise)
        (self.directory / "explain.json").write_text(json.dumps({"stages": stages, "variants": labels}), encoding="utf-8")

    def save(self, folder, name, image):
        (self.directory / "images" / folder / f"{name}.exr").write_bytes(exr(image.astype(np.float32), zipped=True))

    def explained(self, label="nRMSE²"):
        stages, images = explain.read(load(self.directory))
        return explain.explain(stages, images, label)

    def make(self):
        return explain_page.write(self.directory)

    def check_is_refused(self, words):
        with self.assertRaisesRegex(ReportError, words):
            self.make()

    def test_independent_errors_add_up(self):
        self.write({"gather": 0.8 * self.noise[0], "injection": 0.4 * self.noise[1]}, [stage("gather"), stage("injection")])
        found = self.explained()
        self.assertAlmostEqual(found.whole, (0.16 + 0.04), delta=0.02)  # In units of the mean, 2.
        gather, injection = found.parts
        self.assertAlmostEqual(gather.share, 0.8, delta=0.05)
        self.assertAlmostEqual(injection.share, 0.2, delta=0.05)
        self.assertTrue(gather.low < 0.8 < gather.high)
        self.assertAlmostEqual(found.rest, 0, delta=0.05)
        self.assertAlmostEqual(found.left, 0, delta=0.05)
        # relMSE of an even image is the squared nRMSE over 1.01
        self.assertAlmostEqual(self.explained("relMSE").whole, found.whole / 1.01, delta=0.02)
        self.assertEqual(explain.sentence(found).split(":")[1], " more of gather (gather.n 1 → 9).")

    def test_biases_that_act_together_are_the_rest(self):
        # (0.3 + 0.1)²: swapped alone 0.15 and 0.07 of 0.16, in either order 0.15 + 0.01 or 0.07 + 0.09
        self.write({"a": np.array(0.6), "b": np.array(0.2)}, [stage("a"), stage("b")])
        found = self.explained()
        a, b = found.parts
        for value, right in ((a.share, 0.15 / 0.16), (b.share, 0.07 / 0.16), (found.rest, -0.06 / 0.16), (a.least, 0.09 / 0.16),
                             (a.most, 0.15 / 0.16), (a.mean, 0.12 / 0.16), (b.least, 0.01 / 0.16)):
            self.assertAlmostEqual(value, right, delta=0.03)
        self.assertAlmostEqual(a.mean + b.mean + found.left, 1, 6)
        self.make()
        page = Page((self.directory / "explain.html").read_text(encoding="utf-8"))
        self.assertIn("do not add up: −3", page.text)

    def test_stages_are_swapped_along_with_those_that_they_need(self):
        # An error that cancels the other's can be seen without it alone
        self.write({"a": 0.8 * self.noise[0], "b": -0.8 * self.noise[0] + 0.4 * self.noise[1]}, [stage("a"), stage("b", "a")])
        found = self.explained()
        self.assertLess(found.parts[0].share, 0)
        self.assertAlmostEqual(found.parts[0].share + found.parts[1].share, 1, delta=0.05)

    def test_page_and_table(self):
        self.write({"gather": 0.8 * self.noise[0], "injection": 0.4 * self.noise[1]}, [stage("gather"), stage("injection")])
        self.assertRegex(self.make(), r"^\d\d % of relMSE is the gather: more of gather")
        page = Page((self.directory / "explain.html").read_text(encoding="utf-8"))
        self.assertEqual(page.count("div", "bar-track"), 2)
        self.assertEqual(page.count("img", "sharp"), 1 + 2 + 1 + 3)  # Whole, parts, rest; previews.
        self.assertFalse([source for source in page.attributes("src") if not source.startswith("data:")])
        self.assertFalse(page.attributes("href"))
        with open(self.directory / "explain.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["stage"] for row in rows[:5]], ["whole", "gather", "injection", "rest", "all swapped"])
        parts = [float(row["part"]) for row in rows[1:4]]
        self.assertTrue(math.isclose(sum(parts), float(rows[0]["part"]), rel_tol=1e-6))

    @unittest.skipIf(browser.MISSING, browser.MISSING)
    def test_parts_below_0_stand_before_the_others(self):
        self.write({"a": 0.8 * self.noise[0], "b": -0.2 * self.noise[0]}, [stage("a"), stage("b")])
        self.make()
        window = browser.Browser()
        self.addCleanup(window.close)
        for width in (1400, 400):
            window.resize(width, 800)
            window.open(self.directory / "explain.html")
            parts = window.run("return [...document.querySelector('.bar-track').children].map((part) =>"
                               " [part.title.split(':')[0], part.className, part.getBoundingClientRect().width])")
            self.assertEqual([part[:2] for part in parts], [["b", "below"], ["a", ""], ["rest", ""]])
            # Of (0.8 - 0.2)² swapping b brings 0.36 - 0.64, swapping a 0.36 - 0.04; the rest is what these leave, 0.32
            for (*_, length), part in zip(parts, (0.28, 0.32, 0.32)):
                self.assertAlmostEqual(length / sum(width for *_, width in parts), part / 0.92, delta=0.03)
            self.assertLessEqual(window.run("return document.documentElement.scrollWidth"), width)
        self.assertEqual(window.console(), [])

    def test_what_is_no_whole_run_is_refused(self):
        self.write({"a": 0.8 * self.noise[0]}, [stage("a")])
        plan = self.directory / "explain.json"
        listed = json.loads(plan.read_text(encoding="utf-8"))
        plan.unlink()
        self.check_is_refused("no run of voxray explain")
        listed["variants"]["b"] = ["b"]
        plan.write_text(json.dumps(listed), encoding="utf-8")
        self.check_is_refused("no finished variant 'b'; run it again with --resume")
        del listed["variants"]["b"]
        plan.write_text(json.dumps(listed), encoding="utf-8")
        (self.directory / "images" / "v0" / "indirect.exr").unlink()
        self.check_is_refused("must write 'indirect'")

    def test_noise_of_the_reference_is_no_error(self):
        self.write({"a": np.array(0.0)}, [stage("a")])
        for half, sign in zip("ab", (1, -1)):  # Halves whose product is negative everywhere.
            self.save("reference", f"indirect_{half}", 2 + sign * 0.5 * np.ones((SIZE[1], SIZE[0], 3)))
        self.check_is_refused("raise reference.spp")


if __name__ == "__main__":
    unittest.main()
