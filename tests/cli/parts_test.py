"""`voxray jobs`, `voxray run --part` and `voxray merge`: an experiment in parts, in many processes."""
import json
import os
import random
import signal
import subprocess
import unittest

from support import PROGRAM, TINY, CommandTest

TIMES = {"build_ms", "frame_ms_median", "frame_ms_p05", "frame_ms_p95", "ms_median", "ms_p05", "ms_p95",
         "tracer_build_ms"}
AT_ONCE = 2


class Parts(CommandTest):
    def setUp(self):
        super().setUp()
        # References are rendered here, not found
        self.environment["VOXRAY_CACHE"] = self.path("cache")
        self.write("tiny.yaml", TINY)

    def jobs(self, *more):
        listed = json.loads(self.expect(0, "jobs", "tiny.yaml", "--json", *more).stdout)
        self.assertEqual(listed["experiment"], "tiny")
        return listed["jobs"]

    def run_part(self, part, *more, out="out", status=0):
        return self.expect(status, "run", "tiny.yaml", "--part", part, "--out", out, *more)

    def run_in_random_order(self, jobs, out, seed):
        """All jobs, AT_ONCE at a time, each once those that it comes after are done."""
        order = random.Random(seed)
        done, running, begun = set(), {}, []
        waiting = {job["id"]: job for job in jobs}
        while waiting or running:
            ready = sorted(name for name, job in waiting.items() if done.issuperset(job["after"]))
            while ready and len(running) < AT_ONCE:
                name = ready.pop(order.randrange(len(ready)))
                job = waiting.pop(name)
                begun.append(name)
                process = subprocess.Popen([PROGRAM, "run", "tiny.yaml", "--part", name, "--out", out],
                                           cwd=self.folder, env=self.environment, text=True, stdin=subprocess.DEVNULL,
                                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
                running[process] = job
            process = next(iter(running))
            errors = process.communicate()[1]
            job = running.pop(process)
            self.assertEqual(process.returncode, 0, (job["id"], errors))
            self.assertTrue(os.path.exists(self.path(out, job["writes"])), job["writes"])
            done.add(job["id"])
        return begun

    def without_times(self, *parts):
        return [{key: value for key, value in row.items() if key not in TIMES} for row in self.rows(*parts)]

    def check_same(self, one, two):
        for table in ("results.csv", "passes.csv"):
            self.assertEqual(self.without_times(one, table), self.without_times(two, table), table)
        for name in ("reference/final_a.exr", "reference/indirect_b.exr", "resolution-8/final.exr"):
            self.assertEqual(self.bytes(one, "images", name), self.bytes(two, "images", name), name)
        self.assertTrue(os.path.exists(self.path(two, "report.html")))


class Jobs(Parts):
    def test_list(self):
        jobs = self.jobs("--reference-parts", "4")
        self.assertEqual([job["kind"] for job in jobs], ["reference"] * 4 + ["variant"] * 2 + ["merge"])
        references = [job["id"] for job in jobs[:4]]
        self.assertRegex(references[0], r"^reference\.[0-9a-f]{12}\.1-of-4$")
        self.assertEqual([job["after"] for job in jobs],
                         [[]] * 4 + [references] * 2 + [["variant.resolution-8", "variant.resolution-16"]])
        # 8 samples of 32 x 24 pixels in four parts; 12 sums in double a pixel. A build and its repeat, 1 + 2 frames.
        self.assertEqual({(job["cost"], job["cost_unit"]) for job in jobs[:4]}, {(2 * 32 * 24, "paths")})
        self.assertEqual({job["memory_bytes"] for job in jobs[:4]}, {12 * 8 * 32 * 24})
        self.assertEqual({(job["cost"], job["cost_unit"]) for job in jobs[4:6]}, {(5, "runs of the graph")})
        self.assertGreater(jobs[5]["memory_bytes"], jobs[4]["memory_bytes"])
        self.assertEqual(self.jobs("--reference-parts", "4"), jobs)
        self.assertFalse(os.path.exists(self.path("results")))

    def test_text_and_mistakes(self):
        text = self.expect(0, "jobs", "tiny.yaml").stdout
        self.assertRegex(text, r"(?m)^reference\.[0-9a-f]{12}\.1-of-1: .* 6144 paths$")
        self.assertIn("variant.resolution-16: ", text)
        self.assertIn("8 samples", self.expect(2, "jobs", "tiny.yaml", "--reference-parts", "9").stderr)
        self.assertIn("'variant.resolution-8'",
                      self.run_part("variant.resolution-9", status=2).stderr)
        self.run_part("merge", "--dry-run", status=2)

    def test_a_variant_that_would_fail_says_so(self):
        jobs = self.jobs("--set", "sweep.voxelize.resolution=[8, 1024]", "--set", "measure.memory_limit_mb=64")
        errors = {job["id"]: job.get("error") for job in jobs if job["kind"] == "variant"}
        self.assertIsNone(errors["variant.resolution-8"])
        self.assertIn("MiB", errors["variant.resolution-1024"])


class RunParts(Parts):
    def test_any_order_two_at_a_time_equals_a_run(self):
        self.expect(0, "run", "tiny.yaml", "--out", "whole", "--no-report")
        for seed, parts in ((1, "4"), (2, "1")):
            self.environment["VOXRAY_CACHE"] = self.path(f"cache-{seed}")
            out = f"parts-{seed}"
            begun = self.run_in_random_order(self.jobs("--reference-parts", parts), out, seed)
            self.assertEqual(begun[-1], "merge")
            self.check_same("whole", out)
            self.assertEqual([name for name in self.files(out) if os.path.basename(name).startswith(".")], [])

    def test_a_variant_comes_after_its_reference(self):
        self.assertRegex(self.run_part("variant.resolution-8", status=2).stderr,
                         r"it comes after all parts of 'reference\.[0-9a-f]{12}', which are not all in out")

    def test_the_same_part_twice_at_once_is_refused(self):
        slow = ("--set", "reference.spp=1048576")
        part = self.jobs(*slow)[0]["id"]
        lock = self.path("out", "parts", f".{part}.lock")
        first = self.start_until(lambda: os.path.exists(lock), "run", "tiny.yaml", *slow, "--part", part, "--out", "out")
        self.assertIn(f"process {first.pid} is writing", self.run_part(part, *slow, status=2).stderr)

        # A whole run and a merge would take the folder away from it
        for arguments in (("run", "tiny.yaml", *slow, "--out", "out"), ("merge", "out", "--out", "out")):
            self.assertIn("is writing", self.expect(2, *arguments).stderr)
        first.send_signal(signal.SIGINT)
        errors = first.communicate()[1]
        self.assertEqual(first.returncode, 130, errors)
        self.assertEqual([name for name in self.files("out") if name.endswith(".sums")], [])

    def test_a_killed_part_keeps_nothing(self):
        slow = ("--set", "reference.spp=1048576")
        part = self.jobs(*slow)[0]["id"]
        lock = self.path("out", "parts", f".{part}.lock")
        first = self.start_until(lambda: os.path.exists(lock), "run", "tiny.yaml", *slow, "--part", part, "--out", "out")
        first.kill()
        first.communicate()

        # A merge needs the folder for itself, and clears up what is left
        self.assertIn("there is no result of 'resolution-8'", self.expect(1, "merge", "out", "--out", "out").stderr)
        self.assertEqual(self.files("out"), ["manifest.json", "passes.csv", "report.html", "results.csv"])


class Merge(Parts):
    def machines(self):
        """A folder for each variant, and one of a whole run."""
        self.expect(0, "run", "tiny.yaml", "--out", "whole", "--no-report")
        for resolution in ("8", "16"):
            self.run_part(f"variant.resolution-{resolution}", out=f"machine-{resolution}")

    def test_folders_of_machines(self):
        self.machines()
        said = self.expect(0, "merge", "machine-16", "machine-8", "--out", "all").stdout
        self.assertIn("2 of 2 variants done", said)
        self.assertIn(os.path.join("all", "report.html"), said)
        self.check_same("whole", "all")

        # One of them alone lacks a variant
        done = self.expect(1, "merge", "machine-16", "--out", "half")
        self.assertIn("there is no result of 'resolution-8'", done.stderr)
        self.assertIn("1 of 2 variants done; 1 missing", done.stdout)
        self.assertIsNone(self.json("half", "manifest.json")["finished"])

    def test_what_differs_is_refused(self):
        self.machines()
        for changes, words in ((("--set", "seed=8"), "config.seed: 7 and 8"),
                               (("--set", "scene.override={grey: {roughness: 0.5}}"), "config.scene.override: nothing and")):
            self.expect(0, "run", "tiny.yaml", "--out", "other", "--no-report", *changes)
            self.assertIn(words, self.expect(2, "merge", "machine-8", "other", "--out", "all").stderr)
            self.assertIn(words, self.run_part("variant.resolution-8", *changes, out="machine-8", status=2).stderr)
        self.assertIn("both hold 'resolution-8'", self.expect(2, "merge", "machine-8", "whole", "--out", "all").stderr)
        self.assertIn("holds no results", self.expect(2, "merge", "machine-8", "cache", "--out", "all").stderr)
        self.assertIn("holds results already", self.expect(2, "merge", "machine-8", "--out", "whole").stderr)
        self.assertFalse(os.path.exists(self.path("all")))


if __name__ == "__main__":
    unittest.main()
