"""`voxray bench gpu` with the built program: its page, its numbers, and what it makes of runs that fail, crash or take too long."""
import json
import os
import re
import stat
import subprocess
import sys
import time
import unittest
from pathlib import Path

from support import PROGRAM, SOURCE, CommandTest

sys.path.append(os.path.join(SOURCE, "framework"))
from bench import devices, parts, processes, runs, tables  # noqa: E402

SCRIPT = os.path.join(SOURCE, "scripts", "bench_gpu.py")

# A program that runs nothing by Embree: the first such run says why, the second crashes.
BROKEN = """\
#!/usr/bin/env bash
case "$*" in
  *gpu_parity*embree*) echo "voxray: error: the tracer is broken" >&2; exit 3 ;;
  *gpu_passes*embree*) kill -SEGV $$ ;;
esac
exec "{program}" "$@"
"""


class BenchGpu(CommandTest):
    def bench(self, *arguments, program=PROGRAM):
        return subprocess.run([sys.executable, SCRIPT, "--program", program, "--profile", "ci", "--limit", "86400",
                               "--out", self.path("out"), *arguments],
                              cwd=self.folder, env=self.environment, capture_output=True, text=True)

    def parts(self):
        return {part["name"]: part for part in self.json("out", "gpu.json")["parts"]}

    def test_the_page_names_the_device_and_has_every_number(self):
        done = self.bench("--only", "devices", "parity", "--tracer", "ray_query")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        data = self.json("out", "gpu.json")
        self.assertEqual({part["status"] for part in data["parts"]}, {"done"})
        page = self.bytes("out", "gpu.html").decode()
        self.assertTrue(f"<title>Voxray on {data['device']}</title>" in page)
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:image/png)[^"]*', page), [])

        # Two methods and paths by two tracers, and the first tracer twice
        pairs = {(row["pair"], row["method"]): row for row in data["parity"]}
        self.assertEqual(len(pairs), 8)
        for (pair, _), row in pairs.items():
            self.assertNotIn("error", row)
            self.assertEqual(len(row["errors"]), 2)
            if pair == "ray_query again against ray_query":
                self.assertTrue(row["same_bytes"])
                self.assertEqual(row["pixels_apart"], 0)
            self.assertLess(row["nrmse"], min(row["errors"]))
        self.assertTrue('src="data:image/png;base64,' in page)

        # Each method's time over that of paths on the device
        over = data["over_paths"]
        self.assertEqual([row["is_rival"] for row in over], [True, True, False, False])
        self.assertTrue(all(row["over"]["indirect_nrmse"]["frame"] > 0 for row in over))
        self.assertTrue("Methods over path tracing on this device" in page)
        self.assertEqual([name for name in self.files("out") if name.endswith(".exr")], [])

        # Each pass that ran has its times; the others are named
        kinds = {row["kind"] for row in data["passes"]}
        self.assertLessEqual({"gbuffer", "voxelize", "inject_light_rays", "gather_rays", "composite"}, kinds)
        self.assertEqual(kinds | set(data["not_covered"]), set(data["all_passes"]))
        self.assertIn("show_voxels", data["not_covered"])
        table = self.bytes("out", "gpu.md").decode()
        for name in kinds:
            self.assertIn(f"| {name} |", table)
        self.assertTrue(any(row["rays_per_s"] for row in data["passes"] if row["tracer"] == "ray_query"))

    def test_what_fails_is_told_and_stops_nothing(self):
        broken = self.write("broken", BROKEN.format(program=PROGRAM))
        os.chmod(broken, os.stat(broken).st_mode | stat.S_IXUSR)
        done = self.bench("--tracer", "embree", "--benches", self.folder, "--only", "devices", "parity", "passes", "throughput",
                          program=broken)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        parts = self.parts()
        self.assertEqual({name: part["status"] for name, part in parts.items()},
                         {"devices": "done", "parity": "failed", "passes": "failed", "throughput": "skipped"})
        self.assertIn("the tracer is broken", parts["parity"]["ran"][0]["last"])
        self.assertIn("SIGSEGV", parts["passes"]["ran"][0]["last"])
        page = self.bytes("out", "gpu.html").decode()
        self.assertTrue("the tracer is broken" in page)
        self.assertTrue("SIGSEGV" in page)
        self.assertEqual(self.json("out", "gpu.json")["passes"], [])
        self.assertTrue("Passes that did not run" in page)

    def test_without_time_or_a_device_it_says_so(self):
        self.assertEqual(self.bench("--only", "passes", "--limit", "1").returncode, 1)
        self.assertEqual(self.parts()["passes"]["status"], "skipped")
        self.assertEqual(self.bench("--only", "devices", "--device", "no such device").returncode, 1)
        self.assertIn("no such device", self.parts()["devices"]["why"])

    def test_mistakes(self):
        for words in (["--only", "nothing"], ["--program", "gone"], ["--scenes", "gone"], ["--tracer", "fast"]):
            done = self.bench(*words)
            self.assertEqual(done.returncode, 2, words)


class Processes(unittest.TestCase):
    def test_what_takes_too_long_is_interrupted_and_keeps_what_it_said(self):
        done = processes.run(["/bin/sh", "-c", "echo begun; sleep 60"], 0.5)
        self.assertEqual((done.status, done.code, done.output), ("out of time", None, "begun\n"))
        self.assertLess(done.seconds, 20)

    def test_what_gets_no_further_has_failed(self):
        done = processes.run(["/bin/sleep", "60"], 20, progress=lambda: 1, patience=1)
        self.assertEqual((done.status, done.code, done.last), ("failed", None, "got no further for 1 s"))
        for progress in (time.monotonic, lambda: 0):  # it gets on, or has not begun
            self.assertEqual(processes.run(["/bin/sleep", "2"], 20, progress=progress, patience=1).status, "done")

    def test_what_is_not_there(self):
        self.assertEqual(processes.run(["/nowhere/program"], 1).status, "failed")

    def test_a_part_never_outlasts_the_whole(self):
        self.assertLessEqual(processes.Clock(2).part(10).left, 2)


class Reading(unittest.TestCase):
    LISTING = """\
Fast GPU 9000 (GPU)
  driver            1.2
  ray tracers       ray_pipeline, embree
Old GPU (GPU)
  driver            0.1
  does not qualify  it lacks shaderInt64
llvmpipe (LLVM 15) (CPU)
  ray tracers       ray_query, ray_pipeline, embree
"""

    def test_devices(self):
        found = devices.parse(self.LISTING)
        self.assertEqual([device.name for device in found], ["Fast GPU 9000", "Old GPU", "llvmpipe (LLVM 15)"])
        self.assertEqual(devices.chosen(found, "").own_tracers, ["ray_pipeline"])
        self.assertIsNone(devices.chosen(found, "old"))
        self.assertEqual(devices.software(found, found[0]).name, "llvmpipe (LLVM 15)")
        self.assertIsNone(devices.software(found, found[2]))

    def test_headlines_name_what_their_configs_have(self):
        for line in parts.HEADLINES:
            text = Path(SOURCE, "configs", "papers", f"{line.config}.yaml").read_text(encoding="utf-8")
            if line.profile != "full":
                self.assertIn(f"\n  {line.profile}:", text.partition("\nprofiles:")[2], line.config)

    def test_ways_of_writing_stand_over_the_plain_store_of_their_pass_and_voxels(self):
        def variant(kind, voxels, write, ms):
            graph = [{"pass": "voxelize", "resolution": voxels}, {"pass": kind, "id": "inject", "rays_per_light": 9, "write": write}]
            costs = [{"pass": "voxelize", "phase": "build", "ms": [9, 9, 9]}, {"pass": "inject", "phase": "build", "ms": [ms, ms, ms]}]
            return runs.Variant(write, graph, {"passes": costs} if ms else None, "")
        done = [variant("a", "64", "none", 2), variant("a", "64", "max", 3), variant("a", "128", "none", 0), variant("a", "128", "max", 4),
                variant("b", "64", "max", 8), variant("b", "64", "none", 4)]
        rows = tables.write_rows(runs.Run("writes", "", "", None, None, done))
        self.assertEqual([(row["kind"], row["voxels"], row["write"], row["over_none"]) for row in rows],
                         [("a", 64, "none", 1), ("a", 64, "max", 1.5), ("a", 128, "max", None), ("b", 64, "max", 2), ("b", 64, "none", 1)])

    def test_benchmarks_of_a_program_that_was_stopped(self):
        entry = {"name": "scan", "real_time": 2.0, "time_unit": "ms", "words": 3.0}
        whole = json.dumps({"benchmarks": [entry, entry]}, indent=1)
        self.assertEqual(len(tables.finished_entries(whole)), 2)
        self.assertEqual(tables.finished_entries(whole[:whole.rindex('"words"')]), [entry])
        self.assertEqual(tables.finished_entries(""), [])
