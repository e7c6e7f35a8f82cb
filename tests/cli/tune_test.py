"""`voxray tune`, end to end: the choice against the whole sweep, by rays, which no machine changes."""
import os
import unittest

from support import CommandTest

# Six numbers of gather rays and two of voxels: few rays are cheap and noisy.
CONFIG = """\
name: room
scene: {builtin: cornell, lights: point}
image: {width: 96, height: 96}
seed: 3
graph:
  - {pass: gbuffer}
  - {pass: voxelize, resolution: 16}
  - {pass: inject_light_rays, id: inject, rays_per_light: 16384, bounces: 2}
  - {pass: trace_gather_rays, id: trace, rays_per_block: 16, block: 4}
  - {pass: gather_rays, id: gather}
  - {pass: direct_shadow_rays}
  - {pass: composite}
reference: {pass: path_trace, spp: 64, bounces: 3}
sweep:
  voxelize.resolution: [16, 32]
  inject.rays_per_light: [4096, 16384, 65536]
  trace.rays_per_block: [16, 32, 64, 128, 256, 512]
measure: {frames: 1, warmup: 0, build_repeats: 0}
"""


class Tune(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("room.yaml", CONFIG)

    def tune(self, status, *arguments):
        return self.expect(status, "tune", "room.yaml", "--tracer", "embree", "--minimize", "rays", "--out", "out",
                           *arguments)

    def test_the_choice_is_near_the_sweeps_best_for_a_fifth_of_its_cost(self):
        done = self.tune(0, "--target", "indirect_relmse=0.4", "--every")
        print(done.stdout)
        trail = self.rows("out", "trail.csv")
        sweep = {row["variant"]: row for row in self.rows("out", "sweep.csv")}
        self.assertEqual(len(sweep), 36)
        met = [float(row["rays"]) for row in sweep.values() if float(row["excess"]) <= 1]
        full = [row for row in trail if row["size"] == "full" and float(row["excess"]) <= 1]
        chosen = min(float(row["rays"]) for row in full)
        self.assertLessEqual(chosen, 1.15 * min(met))
        spent, whole = sum(float(row["spent"]) for row in trail), sum(float(row["rays"]) for row in sweep.values())
        self.assertLessEqual(spent, whole / 5)
        self.assertIn(f"{spent / whole:.3f} of the sweep", done.stdout)
        for row in full:  # The same images as in the sweep
            self.assertEqual(row["excess"], sweep[row["variant"]]["excess"])

        self.assertIn("Page: out/tune.html", done.stdout)
        self.assertIn(f"after {len(trail)} trials".encode(), self.bytes("out", "tune.html"))

        # The chosen config is one that runs, without a sweep, and gives what the search found
        self.expect(0, "run", "out/chosen.yaml", "--tracer", "embree", "--out", "again", "--quiet", "--no-report")
        rows = self.rows("again", "results.csv")
        self.assertEqual(len(rows), 1)
        self.assertEqual(float(rows[0]["rays"]), chosen)
        self.assertLessEqual(float(rows[0]["indirect_relmse"]), 0.4)
        self.assertFalse(os.path.exists(self.path("again", "report.html")))

        # Nothing runs twice
        before = self.bytes("out", "trail.csv")
        again = self.tune(0, "--target", "indirect_relmse=0.4", "--resume")
        self.assertEqual(self.bytes("out", "trail.csv"), before)
        self.assertEqual(again.stdout, done.stdout[:done.stdout.index("The sweep")])

    def test_what_nothing_meets_is_told_with_what_comes_closest(self):
        done = self.tune(1, "--target", "indirect_relmse=1e-6", "--set", "image.width=32", "--set", "image.height=32",
                         "--set", "sweep.trace.rays_per_block=[16, 64]", "--set", "sweep.voxelize.resolution=null")
        self.assertIn("Closest: ", done.stdout)
        self.assertIn("voxray explain out/chosen.yaml", done.stderr)

    def test_parameters_take_values_from_their_schema(self):
        done = self.tune(0, "--target", "indirect_relmse=20", "--set", "sweep=null", "--vary", "trace.rays_per_block",
                         "--set", "image.width=16", "--set", "image.height=16")
        self.assertIn("7 variants", done.stdout)

    def test_mistakes_are_told_before_anything_runs(self):
        for status, arguments, message in (
                (2, ("--target", "indirect_relmse"), "NAME=VALUE"),
                (2, ("--target", "nrms=0.2"), "'nrmse'"),
                (2, ("--target", "nrmse=0"), "nrmse=0"),
                (2, ("--target", "flip=0.1", "--vary", "trace.rays"), "'rays_per_block'"),
                (2, ("--target", "flip=0.1", "--vary", "tracer.rays"), "'tracer'"),
                (2, ("--target", "flip=0.1", "--set", "reference=null"), "'reference'"),
                (2, ("--target", "flip=0.1", "--set", "sweep.seed=[1, 2]"), "'seed'")):
            self.assertIn(message, self.tune(status, *arguments).stderr)
            self.assertFalse(os.path.exists(self.path("out")), "a mistake leaves nothing")


if __name__ == "__main__":
    unittest.main()
