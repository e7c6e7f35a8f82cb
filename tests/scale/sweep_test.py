"""`voxray sweep`: the parts of an experiment as jobs of Snakemake, through kills of the engine and of its jobs."""
import glob
import os
import random
import re
import shlex
import shutil
import signal
import subprocess
import time
import unittest

import parts_test
from support import PROGRAM

KILLS = int(os.environ.get("VOXRAY_SWEEP_KILLS", "3"))
WORKFLOW = os.path.join("out", "parts", "sweep")
JOB_STATS = r"(?m)^(\w+) +\d+ +(\d+) +(\d+)$"  # Snakemake's table: rule, number of jobs, fewest and most threads of one


def jobs_of(engine):
    """Process ids of parts that run below a process."""
    parents = {}
    for path in glob.glob("/proc/[0-9]*/stat"):
        try:
            with open(path, encoding="utf-8", errors="replace") as file:
                text = file.read()
        except OSError:  # It has ended.
            continue
        parents[int(text.split()[0])] = int(text.rpartition(")")[2].split()[1])
    found = []
    for process in parents:
        above = process
        while above in parents and above != engine:
            above = parents[above]
        if above == engine and process != engine:
            try:
                with open(f"/proc/{process}/cmdline", "rb") as file:
                    words = file.read().split(b"\0")
            except OSError:
                continue
            if words[0] == os.fsencode(PROGRAM) and b"--part" in words:
                found.append(process)
    return found


def kill(process):
    """Whether it was still there."""
    try:
        os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        return False
    return True


@unittest.skipUnless(shutil.which("snakemake"), "snakemake is not installed: scripts/setup-debian.sh sweep installs it")
class Sweep(parts_test.Parts):
    def sweep(self, *more, status=0):
        return self.expect(status, "sweep", "tiny.yaml", "--out", "out", *more)

    def forget_references(self):
        shutil.rmtree(self.path("cache", "references"))

    def finished(self):
        """What parts have written so far: path -> what changes where it is written again."""
        paths = glob.glob(self.path("out", "parts", "*.sums")) + glob.glob(self.path("out", "images", "*", "result.json"))
        stats = {path: os.stat(path) for path in paths}
        return {path: (stat.st_ino, stat.st_mtime_ns) for path, stat in stats.items()}

    def test_equals_a_run(self):
        self.expect(0, "run", "tiny.yaml", "--out", "whole")
        self.forget_references()
        self.sweep("--cores", "2", "--untimed")
        self.check_same("whole", "out")
        self.assertEqual(len(glob.glob(self.path("out", "parts", "*.sums"))), 2)
        self.assertEqual(sorted(os.listdir(self.path(WORKFLOW, "done"))),
                         sorted(job["id"] for job in self.jobs("--reference-parts", "2")))
        told = self.json("out", "manifest.json")["warnings"]
        self.assertTrue(any("--untimed" in warning for warning in told), told)

        # Nothing is left to do; without a result, that part alone
        finished = self.finished()
        self.sweep("--cores", "2", "--untimed")
        self.assertEqual(self.finished(), finished)
        lost = self.path("out", "images", "resolution-8", "result.json")
        os.remove(lost)
        self.sweep("--cores", "2", "--untimed")
        again = self.finished()
        self.assertNotEqual(again.pop(lost), finished.pop(lost))
        self.assertEqual(again, finished)

    def test_timed_variants_have_the_machine_for_themselves(self):
        for options, rule, threads in (((), "timed_variant", 2), (("--untimed",), "variant", 1)):
            done = self.sweep("--cores", "2", *options, "--", "--dry-run", "--quiet", "progress")
            said = done.stdout + done.stderr
            asked = {name: (int(least), int(most)) for name, least, most in re.findall(JOB_STATS, said)}
            self.assertEqual(asked.pop("total"), (1, threads), said)
            self.assertEqual(asked, {"all": (1, 1), "reference": (1, 1), rule: (threads, threads), "merge": (1, 1)}, said)
        self.sweep("--cores", "2")
        told = self.json("out", "manifest.json")["warnings"]
        self.assertFalse(any("--untimed" in warning for warning in told), told)

    def test_a_variant_that_fails_is_a_row(self):
        fails = ("--set", "sweep.voxelize.resolution=[8, 512]", "--set", "measure.memory_limit_mb=64")
        done = self.sweep("--cores", "2", "--untimed", "--retries", "0", *fails, status=1)
        rows = {row["variant"]: row for row in self.rows("out", "results.csv")}
        self.assertEqual(rows["resolution-8"]["status"], "ok")
        self.assertEqual(rows["resolution-512"]["status"], "failed", done.stderr)
        self.assertIn("MiB", rows["resolution-512"]["error"])
        self.assertTrue(os.path.exists(self.path("out", "report.html")))

    def test_kills_lose_nothing_and_repeat_nothing(self):
        resolutions = list(range(8, 8 + 4 * KILLS))
        slow = ("--set", "reference.spp=4096", "--set", f"sweep.voxelize.resolution={resolutions}", "--set", "measure.frames=20")
        self.expect(0, "run", "tiny.yaml", *slow, "--out", "whole")
        self.forget_references()
        order, arguments = random.Random(KILLS), ("sweep", "tiny.yaml", *slow, "--out", "out", "--cores", "2", "--untimed",
                                                  "--reference-parts", "4", "--retries", "20")
        kept, killed, outlived = {}, 0, 0
        for number in range(KILLS):
            engine = self.start_until(lambda: True, *arguments)
            if number == 0:
                while not os.path.exists(self.path(WORKFLOW, "plan.json")) and engine.poll() is None:
                    time.sleep(0.01)
                self.assertIn("is writing", self.expect(2, *arguments).stderr)
            # One engine in four ends while it starts, the others when jobs are at work, which end at random as well
            starts = order.random() < 0.25
            while not starts and not jobs_of(engine.pid) and engine.poll() is None:
                time.sleep(0.02)
            until = time.monotonic() + order.uniform(0, 3)
            while time.monotonic() < until and engine.poll() is None:
                jobs = jobs_of(engine.pid)
                if jobs and order.random() < 0.05:
                    killed += kill(order.choice(jobs))
                time.sleep(0.02)
            self.assertIsNone(engine.poll(), f"the sweep ended before kill {number + 1} of {KILLS}")
            engine.kill()
            engine.communicate()
            outlived += len(kept)
            for path, stamp in kept.items():
                self.assertEqual(self.finished()[path], stamp, path)
            kept |= self.finished()
        print(f"{KILLS} engines and {killed} jobs killed; {len(kept)} parts were finished by then", flush=True)
        self.assertGreater(killed, 0, "no job was killed")
        self.assertGreater(outlived, 0, "nothing was finished before an engine was killed")
        self.expect(0, *arguments)
        for path, stamp in kept.items():
            self.assertEqual(self.finished()[path], stamp, path)
        self.check_same("whole", "out")

    def test_places_and_the_engines_command_line(self):
        for places in ((), ("--cores", "2", "--slurm")):
            self.assertIn("by one of --cores", self.sweep(*places, status=2).stderr)
        self.assertFalse(os.path.exists(self.path("out")))
        said = self.sweep("--slurm", "--partition", "long", "--jobs", "7", "--program", "apptainer exec v.sif voxray",
                          "--print", "--", "--dry-run").stdout
        words = shlex.split(said)
        self.assertEqual(words[0], "snakemake")
        self.assertEqual(words[words.index("--jobs") + 1], "7")
        self.assertEqual(words[-1], "--dry-run")
        plan = self.json(WORKFLOW, "plan.json")
        self.assertEqual(plan["program"], "apptainer exec v.sif voxray")
        self.assertEqual(plan["slurm"], {"slurm_partition": "long"})
        self.assertIsNone(plan["cores"])
        self.assertEqual([job["kind"] for job in plan["jobs"]], ["reference", "variant", "variant", "merge"])


if __name__ == "__main__":
    unittest.main()
