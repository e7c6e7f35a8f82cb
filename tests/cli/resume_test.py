"""Runs that are resumed, and runs that a signal interrupts or another run in the same folder."""
import os
import random
import signal
import time
import unittest

from run_support import VARIANTS, Run
from support import TINY

# As TINY, but each variant takes long enough to be interrupted.
SLOW = TINY.replace("frames: 2", "frames: 40").replace("[8, 16]", "[8, 12, 16, 24]")


class Resume(Run):
    def times(self, out="out"):
        return {variant: os.stat(self.marker(variant, out)).st_mtime_ns for variant in os.listdir(self.path(out, "images"))
                if os.path.exists(self.marker(variant, out))}

    def test_nothing_twice(self):
        self.copy_finished_run()
        before = self.times()
        self.assertEqual(sorted(before), sorted(VARIANTS))
        self.run_tiny("out", "--resume")
        self.assertEqual(self.times(), before)
        self.assertIn("replaces 2 finished variants of an earlier run; --resume", self.run_tiny().stdout)
        self.assertTrue(all(self.times()[variant] > before[variant] for variant in VARIANTS))

    def test_two_runs_in_one_folder(self):
        self.write("slow.yaml", SLOW)
        arguments = ("run", "slow.yaml", "--out", "out", "--quiet", "--no-report")

        # While one writes the other is refused, with the number of the process
        first = self.start_until(lambda: os.path.exists(self.path("out", ".lock")), *arguments)
        self.assertIn(f"process {first.pid} is writing", self.expect(2, *arguments).stderr)
        first.communicate()
        self.assertEqual(first.returncode, 0)

        # Whichever takes the lock first, its results are whole, and those of the other one, too, where it begins after the
        # first has ended (VOXRAY_DOUBLE_RUNS=20 tries more offsets)
        offsets = random.Random(17)
        for _ in range(int(os.environ.get("VOXRAY_DOUBLE_RUNS", "1"))):
            first = self.start_until(lambda: True, *arguments)
            time.sleep(offsets.uniform(0, 1.5))
            second = self.voxray(*arguments)
            first.communicate()
            self.assertIn(sorted((first.returncode, second.returncode)), ([0, 0], [0, 2]), second.stderr)
            self.assertEqual([row["status"] for row in self.rows("out", "results.csv")], ["ok"] * 4)
            self.check_whole()

    def test_another_experiment_is_refused(self):
        self.copy_finished_run()
        self.write("tiny.yaml", TINY.replace("seed: 7", "seed: 8"))
        before = self.files("out")
        self.assertIn("seed", self.expect(2, "run", "tiny.yaml", "--out", "out", "--resume").stderr)
        # Of a graph the parameter that differs
        self.write("tiny.yaml", TINY.replace("rays_per_light: 4096", "rays_per_light: 8192"))
        self.assertIn("another graph (rays_per_light: 4096, now rays_per_light: 8192)",
                      self.expect(2, "run", "tiny.yaml", "--out", "out", "--resume").stderr)
        self.assertEqual(self.files("out"), before)

    def interrupt(self, number, status):
        self.write("slow.yaml", SLOW)
        process = self.start_until(lambda: os.path.exists(self.marker("resolution-8")),
                                   "run", "slow.yaml", "--out", "out")
        process.send_signal(number)
        said, errors = process.communicate()
        self.assertEqual(process.returncode, status, errors)
        finished = self.times()
        self.assertTrue(finished)
        self.assertNotIn("resolution-24", finished, "the run was over before it was interrupted")
        return finished, said

    def finish(self, finished):
        self.expect(0, "run", "slow.yaml", "--out", "out", "--resume", "--no-report")
        self.assertEqual(len(self.rows("out", "results.csv")), 4)
        after = self.times()
        self.assertEqual({variant: after[variant] for variant in finished}, finished)
        self.check_whole()

    def test_another_text_of_a_kernel_is_refused(self):
        kernel = "vec3 shade(ivec2 pixel, ivec2 texel) {{ return {} * texelOf(finalImage, pixel).rgb; }}\n"
        self.write("kernel.yaml", TINY.replace("  - {pass: composite}\n", "  - {pass: composite}\n  - {pass: glsl, file: own.glsl}\n"))
        self.write("own.glsl", kernel.format("1.0"))
        arguments = ("run", "kernel.yaml", "--out", "out", "--quiet", "--no-report")
        self.expect(0, *arguments)
        self.expect(0, *arguments, "--resume")
        self.write("own.glsl", kernel.format("2.0"))
        self.assertIn("another graph", self.expect(2, *arguments, "--resume").stderr)

    def test_ctrl_c(self):
        finished, said = self.interrupt(signal.SIGINT, 130)
        self.check_whole()
        self.assertIn(f"{len(finished)} of 4 variants done\n", said)
        self.assertTrue(os.path.exists(self.path("out", "report.html")), "a report of what was finished")
        self.finish(finished)

    def test_ctrl_c_within_a_reference(self):
        self.write("tiny.yaml", TINY)
        process = self.start_until(lambda: os.path.exists(self.path("out", "manifest.json")),
                                   "run", "tiny.yaml", "--out", "out", "--set", "reference.spp=1048576")
        time.sleep(1)  # Its paths would take hours.
        process.send_signal(signal.SIGINT)
        errors = process.communicate()[1]
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("voxray: stopping; a second Ctrl-C ends the program at once\n", errors)
        self.check_whole()

    def interrupt_report(self, signals):
        """Signals to the whole process group, as a terminal's Ctrl-C, while the report of a whole run is made: which takes two
        seconds longer, so that it isn't over before."""
        os.mkdir(self.path("slow"))
        self.write(os.path.join("slow", "sitecustomize.py"), "import time\ntime.sleep(2)\n")
        self.environment = {**self.environment, "PYTHONPATH": self.path("slow")}
        self.write("tiny.yaml", TINY)
        manifest = self.path("out", "manifest.json")
        process = self.start_until(lambda: os.path.exists(manifest) and self.json("out", "manifest.json")["finished"],
                                   "run", "tiny.yaml", "--out", "out", start_new_session=True)
        for _ in range(signals):
            time.sleep(0.5)  # Two signals that come before the first is handled are one.
            os.killpg(process.pid, signal.SIGINT)
        said = process.communicate()[1]
        self.assertEqual([row["status"] for row in self.rows("out", "results.csv")], ["ok"] * 2)
        self.assertEqual("voxray: ended\n" in said, signals == 2, said)
        self.wait_for_group(process.pid)
        return process.returncode

    def wait_for_group(self, group):
        """Until all processes of a group are over."""
        for _ in range(400):
            try:
                os.killpg(group, 0)
            except ProcessLookupError:
                return
            time.sleep(0.05)
        self.fail("the report's script outlasts its run by 20 s")

    def test_ctrl_c_while_the_report_is_made(self):
        self.assertEqual(self.interrupt_report(1), 130)
        self.assertTrue(os.path.exists(self.path("out", "report.html")), "the report is finished first")
        self.check_whole()

    def test_ctrl_c_twice_while_the_report_is_made(self):
        self.assertEqual(self.interrupt_report(2), -signal.SIGINT)
        self.assertFalse(os.path.exists(self.path("out", "report.html")))
        before = self.times()
        self.expect(0, "run", "tiny.yaml", "--out", "out", "--resume")
        self.assertTrue(os.path.exists(self.path("out", "report.html")))
        self.assertEqual(self.times(), before)
        self.check_whole()

    def test_kill(self):
        finished, _ = self.interrupt(signal.SIGKILL, -signal.SIGKILL)
        # A killed process can't take its temporary file along; the next run does
        self.write("out/.results.1.tmp.csv", "variant,sta")
        self.finish(finished)

    def test_killed_before_its_first_file(self):
        os.makedirs(self.path("out", "images"))
        self.write("out/.manifest.1.tmp.json", "{")
        self.run_tiny()
        self.check_whole()


if __name__ == "__main__":
    unittest.main()
