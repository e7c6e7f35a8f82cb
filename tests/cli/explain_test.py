"""`voxray explain`, end to end: an error that one stage makes on purpose is that stage's."""
import re
import shutil
import unittest

from support import CommandTest

# A wall that fills the view: edges take no part. Every stage has but a small error.
CONFIG = """\
name: room
scene:
  builtin: cornell
  lights: point
  boxes: false
  camera: {position: [0, 1, 0.9], target: [0, 1, -1], fov_deg: 40}
image: {width: 16, height: 12}
seed: 3
graph:
  - {pass: gbuffer}
  - {pass: voxelize, resolution: 32}
  - {pass: inject_light_rays, id: inject, rays_per_light: 32768, bounces: 3}
  - {pass: trace_gather_rays, id: trace, rays_per_block: 256, block: 1}
  - {pass: gather_rays, id: indirect}
  - {pass: direct_shadow_rays}
  - {pass: composite}
reference: {pass: path_trace, spp: 16384, bounces: 4}
"""

LOOKUP = "indirect=gather_irradiance"


class Explain(CommandTest):
    def explain(self, *changes):
        self.write("room.yaml", CONFIG)
        settings = [word for change in changes for word in ("--set", change)]
        done = self.expect(0, "explain", "room.yaml", "--tracer", "embree", "--out", "out", "--quiet", *settings)
        rows = {row["stage"]: row for row in self.rows("out", "explain.csv") if row["error"] == "relMSE"}
        return done.stdout, rows

    def check_is_from(self, stage, *changes):
        said, rows = self.explain(*changes)
        shares = {name: float(row["share"]) for name, row in rows.items()}
        print(f"{changes}: {shares}")
        self.assertRegex(said, rf"^\d+ % of relMSE is the {stage}: ")
        self.assertGreater(shares[stage], 0.7, shares)
        self.assertLess(abs(shares["rest"]), 0.25, shares)  # 0.19 of few light rays: finer voxels would need more.

    def test_one_ray_a_pixel(self):
        change = "trace.rays_per_block=1"
        self.check_is_from("gather", change)

        # Stopped before its end, it goes on to the same page
        page = self.bytes("out", "explain.html")
        shutil.rmtree(self.path("out", "images", "gather"))
        done = self.expect(0, "explain", "room.yaml", "--tracer", "embree", "--out", "out", "--resume", "--set", change)
        finished, all_of_them = re.search(r"(\d+) of (\d+) variants were finished already", done.stdout).groups()
        self.assertEqual(int(finished), int(all_of_them) - 1)
        self.assertEqual(self.bytes("out", "explain.html"), page)

    def test_few_light_rays(self):
        self.check_is_from("injection", LOOKUP, "inject.rays_per_light=1000")


class Usage(CommandTest):
    def test_variants_are_chosen(self):
        self.write("room.yaml", CONFIG + "sweep: {voxelize.resolution: [8, 16]}\n")
        said = self.expect(2, "explain", "room.yaml", "--dry-run").stderr
        self.assertIn("--variant resolution-16", said)
        said = self.expect(2, "explain", "room.yaml", "--dry-run", "--variant", "resolution-61").stderr
        self.assertIn("'resolution-16'", said)
        self.expect(0, "explain", "room.yaml", "--dry-run", "--variant", "8")
        self.expect(2, "explain", "room.yaml", "--dry-run", "--variant", "6")
        listed = self.expect(0, "explain", "room.yaml", "--dry-run", "--variant", "resolution-8").stdout
        for name in ("as it is", "injection", "gather", "injection + gather", "injection + gather + voxelization + upsampling"):
            self.assertIn(name, listed)

    def test_what_has_no_counterpart_is_refused(self):
        self.write("room.yaml", CONFIG.replace("  - {pass: gather_rays, id: indirect}", "  - {pass: gather_rays, id: indirect}\n  - {pass: accumulate}"))
        self.assertIn("room.yaml:15: 'accumulate'", self.expect(2, "explain", "room.yaml").stderr)
        self.assertIn("'explain'", self.expect(2, "explian", "room.yaml").stderr)


if __name__ == "__main__":
    unittest.main()
