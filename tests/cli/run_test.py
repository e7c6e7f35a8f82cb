"""`voxray run`, end to end, on a chain of seconds: its files, with and without a device."""
import os
import unittest

from run_support import VARIANTS, Run
from support import TINY

COST_COLUMNS = ["variant", "name", "status", "error", "device", "tracer", "voxelize.resolution", "build_ms",
                "frame_ms_median", "frame_ms_p05", "frame_ms_p95", "memory_bytes", "peak_bytes", "rays",
                "tracer_build_ms", "tracer_bytes"]
PASS_COLUMNS = ["variant", "pass", "phase", "ms_median", "ms_p05", "ms_p95", "rays", "voxel_steps", "memory_bytes",
                "scratch_bytes", "dispatches", "host_waits", "host_bytes", "clock"]

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


if __name__ == "__main__":
    unittest.main()
