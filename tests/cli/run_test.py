"""`voxray run`, end to end, on a chain of seconds: its files, resuming, interruption, disks that refuse."""
import functools
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from support import PROGRAM, TINY, CommandTest

COST_COLUMNS = ["variant", "name", "status", "error", "device", "tracer", "voxelize.resolution", "build_ms",
                "frame_ms_median", "frame_ms_p05", "frame_ms_p95", "memory_bytes", "peak_bytes", "rays"]
PASS_COLUMNS = ["variant", "pass", "phase", "ms_median", "ms_p05", "ms_p95", "rays", "voxel_steps", "memory_bytes",
                "scratch_bytes", "dispatches", "host_waits", "host_bytes"]
VARIANTS = ["resolution-8", "resolution-16"]

# As TINY, but each variant takes long enough to be interrupted.
SLOW = TINY.replace("frames: 2", "frames: 40").replace("[8, 16]", "[8, 12, 16, 24]")

# The reference as a method: nothing of it runs on a device.
PATHS = """\
name: paths
scene: {builtin: cornell}
image: {width: 32, height: 24}
seed: 7
graph: [{pass: path_trace, id: paths, bounces: 2}]
reference: {pass: path_trace, spp: 8, bounces: 2}
sweep: {paths.spp: [1, 4]}
measure: {frames: 2, warmup: 1}
"""


@functools.cache
def finished_run():
    """A folder with a finished run of TINY in 'out'; made once, for copies of it."""
    folder = tempfile.TemporaryDirectory(prefix="voxray-cli-")
    with open(os.path.join(folder.name, "tiny.yaml"), "w", encoding="utf-8") as file:
        file.write(TINY)
    subprocess.run([PROGRAM, "run", "tiny.yaml", "--out", "out", "--no-report"], cwd=folder.name, check=True,
                   capture_output=True)
    return folder


class Run(CommandTest):
    def run_tiny(self, out="out", *more, report=False):
        self.write("tiny.yaml", TINY)
        return self.expect(0, "run", "tiny.yaml", "--out", out, *more, *([] if report else ["--no-report"]))

    def copy_finished_run(self, out="out"):
        self.write("tiny.yaml", TINY)
        shutil.copytree(os.path.join(finished_run().name, "out"), self.path(out))

    def header(self, *parts):
        return self.bytes(*parts).split(b"\n")[0].decode().strip().split(",")

    def marker(self, variant, out="out"):
        return self.path(out, "images", variant, "result.json")

    def check_whole(self, out="out"):
        """Whatever lies in a results folder is whole: no temporary files, no variant without its result."""
        self.assertEqual([name for name in self.files(out) if re.search(r"\.(tmp|part)|~$|(^|/)\.", name)], [])
        for row in self.rows(out, "results.csv") if os.path.exists(self.path(out, "results.csv")) else []:
            if row["status"] != "ok":
                continue
            for name in ("final.exr", "indirect.exr", "final.png", "flip.png", "result.json"):
                self.assertTrue(os.path.getsize(self.path(out, "images", row["variant"], name)) > 0, row["variant"])
            self.assertTrue(all(row[column] for column in ("build_ms", "nrmse", "indirect_nrmse")), row)


class Results(Run):
    def test_files(self):
        done = self.run_tiny("out", "--validate", "--aovs", report=True)
        self.assertIn("report.html", done.stdout)
        self.assertNotIn("replaces", done.stdout)
        self.assertRegex(done.stdout, r"resolution 8: build [\d.]+ ms, frame [\d.]+ ms, indirect nRMSE [\d.]+ \(total [\d.]+\), ")
        manifest = self.json("out", "manifest.json")
        self.assertTrue(manifest["validation"])
        self.assertEqual([metric["name"] for metric in manifest["metrics"]], self.metrics())
        scores = [metric["name"] + end for metric in manifest["metrics"]
                  for end in (("", "_low", "_high") if metric["interval"] else ("",))]
        self.assertEqual(self.header("out", "results.csv"),
                         COST_COLUMNS + scores + ["indirect_" + score for score in scores])
        self.assertIn("nrmse_low", scores)
        self.assertEqual(self.header("out", "passes.csv"), PASS_COLUMNS)
        rows = self.rows("out", "results.csv")
        self.assertEqual([row["name"] for row in rows], ["resolution 8", "resolution 16"])
        self.assertEqual(manifest["names"], dict(zip(VARIANTS, ["resolution 8", "resolution 16"])))
        self.assertEqual([row["variant"] for row in rows], VARIANTS)
        self.assertEqual([row["voxelize.resolution"] for row in rows], ["8", "16"])
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        for row in rows:
            self.assertGreater(float(row["frame_ms_median"]), 0)
            self.assertLessEqual(float(row["frame_ms_p05"]), float(row["frame_ms_p95"]))
            self.assertGreater(int(row["memory_bytes"]), 0)
            self.assertGreater(float(row["mean_ratio"]), 0)
        layers = self.bytes("out", "images", VARIANTS[0], "aovs.gbuffer.exr")
        for channel in ("P.X", "N.Z", "Ng.X", "albedo.R", "emission.B", "roughness", "Z", "id", "material_id"):
            self.assertIn(channel.encode() + b"\0", layers)
        phases = {row["pass"]: row["phase"] for row in self.rows("out", "passes.csv")}
        self.assertEqual((phases["inject"], phases["composite"]), ("build", "frame"))
        self.check_whole()

        manifest = self.json("out", "manifest.json")
        self.assertEqual(manifest["seed"], 7)
        self.assertEqual(manifest["sweep_keys"], ["voxelize.resolution"])
        self.assertEqual(set(manifest["baselines"]), {"black", "constant"})
        self.assertIn("tracer", manifest["auto"])
        self.assertEqual([name for name in ("voxelize", "inject_light_rays") if name in manifest["light_independent"]], ["voxelize"])
        self.assertEqual(manifest["noise_parameters"], {
            "indirect": dict.fromkeys(VARIANTS, ["inject.rays_per_light"]),
            "final": dict.fromkeys(VARIANTS, ["inject.rays_per_light", "direct_shadow_rays.light_samples"])})
        page = self.bytes("out", "report.html").decode()
        self.assertIn("resolution 16", page)
        self.assertIn("Bias and noise are not told apart: set measure.second_seed: true.", page)
        self.assertNotRegex(page, r"(src|href)=[\"']https?:")

    def test_two_runs_are_bit_identical(self):
        self.copy_finished_run("one")
        self.run_tiny("two")
        kept = ["variant"] + [light + metric for light in ("", "indirect_") for metric in self.metrics()]
        one, two = ([[row[column] for column in kept] for row in self.rows(out, "results.csv")]
                    for out in ("one", "two"))
        self.assertEqual(one, two)
        for variant in VARIANTS + ["reference"]:
            for name in ("final.exr", "indirect.exr", "final.png"):
                one, two = (self.bytes(out, "images", variant, name) for out in ("one", "two"))
                self.assertEqual(one, two, (variant, name))

    def test_dry_run_renders_nothing(self):
        done = self.run_tiny("out", "--dry-run")
        for variant in VARIANTS:
            self.assertIn(variant.replace("-", " "), done.stdout)
        self.assertFalse(os.path.exists(self.path("out", "results.csv")))

    def test_dry_run_warns_as_a_run_does(self):
        self.write("tiny.yaml", TINY.replace("builtin: cornell", "builtin: cornell, keep_file_lights: false"))
        words = "voxray: warning: tiny.yaml"
        dry, said = (self.expect(0, "run", "tiny.yaml", "--out", "out", *more).stderr for more in (["--dry-run"], ["--no-report"]))
        self.assertIn(words, dry)
        self.assertEqual([line for line in dry.splitlines() if words in line],
                         [line for line in said.splitlines() if words in line])

    def test_profile_and_set(self):
        self.run_tiny("out", "--profile", "smaller", "--set", "measure.frames=1")
        self.assertEqual(self.json("out", "manifest.json")["image"], {"width": 16, "height": 12})
        self.assertIn("'smaller'",
                      self.expect(2, "run", "tiny.yaml", "--profile", "smalller").stderr)
        self.assertIn("'width'", self.expect(2, "run", "tiny.yaml", "--set", "image.widht=3").stderr)

    def test_build_timed_at_its_only_run(self):
        self.run_tiny("once", "--profile", "smaller", "--set", "measure.build_repeats=0")
        self.run_tiny("again", "--profile", "smaller")
        once, again = self.rows("once", "results.csv")[0], self.rows("again", "results.csv")[0]
        self.assertGreater(float(once["build_ms"]), 0)
        self.assertEqual(once["nrmse"], again["nrmse"])
        self.assertEqual(once["rays"], again["rays"])

    def test_default_folder_and_quiet(self):
        self.write("tiny.yaml", TINY)
        done = self.expect(0, "run", "tiny.yaml", "--quiet", "--profile", "smaller")
        # What a machine that is not idle makes of times is all that it may say
        self.assertEqual([line for line in done.stderr.splitlines() if "times were disturbed" not in line], [])
        self.assertTrue(os.path.exists(self.path("results", "tiny", "report.html")))

    def test_unknown_device_and_missing_feature(self):
        self.write("tiny.yaml", TINY)
        self.assertIn("no-such-device", self.expect(2, "run", "tiny.yaml", "--device", "no-such-device").stderr)
        self.assertIn("embree", self.expect(2, "run", "tiny.yaml", "--tracer", "embre").stderr)

    def test_failed_variant_keeps_the_others(self):
        # 512³ voxels don't fit into the limit, 8³ do.
        self.write("tiny.yaml", TINY.replace("[8, 16]", "[8, 512]").replace("warmup: 1", "warmup: 1, memory_limit_mb: 64"))
        self.expect(1, "run", "tiny.yaml", "--out", "out", "--no-report")
        rows = {row["variant"]: row for row in self.rows("out", "results.csv")}
        self.assertEqual(rows["resolution-8"]["status"], "ok")
        self.assertEqual(rows["resolution-512"]["status"], "failed")
        self.assertIn("MiB", rows["resolution-512"]["error"])
        self.check_whole()


class WithoutVulkan(Run):
    def run_paths(self, out, *more):
        self.write("paths.yaml", PATHS)
        return self.expect(0, "run", "paths.yaml", "--out", out, "--no-report", *more)

    def test_paths_are_the_same_without_a_device(self):
        self.run_paths("with")
        self.take_drivers_away()
        self.environment["VOXRAY_CACHE"] = self.path("cache")  # The reference is rendered once more, too.
        self.run_paths("without")
        rows = self.rows("without", "results.csv")
        self.assertEqual([(row["status"], row["device"], row["tracer"]) for row in rows],
                         [("ok", "no Vulkan device", "embree")] * 2)
        for row in rows:
            self.assertGreater(float(row["frame_ms_median"]), 0)
            self.assertGreaterEqual(int(row["memory_bytes"]), 32 * 24 * 16)
        scores = [[row[name] for name in self.metrics()] for row in rows]
        self.assertEqual(scores, [[row[name] for name in self.metrics()] for row in self.rows("with", "results.csv")])
        for name in ("reference/final.exr", "spp-1/final.exr", "spp-4/indirect.exr"):
            self.assertEqual(self.bytes("without", "images", name), self.bytes("with", "images", name), name)
        self.check_whole("without")

    def test_what_asks_for_a_device_wants_one(self):
        self.take_drivers_away()
        self.write("paths.yaml", PATHS)
        for more in (("--device", "llvmpipe"), ("--validate",)):
            self.assertIn("no Vulkan device found", self.expect(1, "run", "paths.yaml", *more).stderr)


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
            time.sleep(0.05)
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


class Disk(Run):
    def test_unwritable_folder(self):
        self.write("file", "")
        self.write("tiny.yaml", TINY)
        done = self.expect(2, "run", "tiny.yaml", "--out", "file/out")
        self.assertIn("file/out", done.stderr)
        self.assertEqual(self.bytes("file"), b"")

    def test_unwritable_cache(self):
        self.write("file", "")
        self.environment["VOXRAY_CACHE"] = self.path("file", "cache")
        said = self.run_tiny().stderr
        self.assertEqual(said.count("are not cached"), 1, said)
        self.assertIn("file/cache: Not a directory", said)
        self.assertEqual([row["status"] for row in self.rows("out", "results.csv")], ["ok", "ok"])

    def test_full_disk_loses_no_finished_variant(self):
        self.copy_finished_run()
        before = {name: self.bytes("out", name) for name in self.files("out") if name.startswith("images/resolution-8/")}
        shutil.rmtree(self.path("out", "images", "resolution-16"))
        os.remove(self.path("out", "results.csv"))

        # No file may grow beyond 2 KiB: every larger one fails in the center of being written.
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (2048, 2048))

        done = self.expect(1, "run", "tiny.yaml", "--out", "out", "--resume", preexec_fn=limit, restore_signals=False)
        self.assertIn("voxray: error: ", done.stderr)
        self.assertIn("1 of 2 variants kept; there is no room for a report of them; --resume goes on", done.stderr)
        self.assertEqual({name: self.bytes("out", name) for name in before}, before)
        self.check_whole()

        self.run_tiny("out", "--resume")
        self.assertEqual([row["status"] for row in self.rows("out", "results.csv")], ["ok", "ok"])
        self.check_whole()

    def test_full_disk_is_told_with_what_is_kept(self):
        self.write("tiny.yaml", TINY.replace("[8, 16]", "[4, 5, 6, 7, 8, 9, 10, 11]"))
        os.mkdir(self.path("out"))
        for size, kept in (("300k", r", [1-7] of 8 variants kept; (report: out/report.html|there is no room for a report of them)"
                                    "; --resume goes on"), ("32k", ", 0 of 8 variants kept$")):
            # A disk of that size, which goes with the process; without the right to mount nothing is to be told
            script = f'mount -t tmpfs -o size={size} tmpfs out || exit 77; "$0" "$@"'
            done = subprocess.run(["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", script, PROGRAM, "run",
                                   "tiny.yaml", "--out", "out"], cwd=self.folder, env=self.environment,
                                  capture_output=True, text=True)
            if done.returncode == 77 or done.stderr.startswith("unshare:"):
                return
            with self.subTest(size):
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertRegex(done.stderr.strip().splitlines()[-1], r"^voxray: error: disk full: out(/\S+)?" + kept)


if __name__ == "__main__":
    unittest.main()
