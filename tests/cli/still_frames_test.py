"""Where nothing changes, frames move no bytes between host and device, but for counts that passes read back to go on."""
import unittest

from support import CommandTest

STILL = """\
name: still
scene:
  builtin: cornell
  lights: point
  add: [{builtin: furnace, transform: {translate: [-0.1, 1.25, -0.5], scale: 0.3}, material: {metallic: 1, roughness: 0}}]
image: {width: 24, height: 18}
seed: 7
graph:
  - {pass: gbuffer}
  - {pass: voxelize, resolution: 16}
  - {pass: inject_light_rays, rays_per_light: 4096, bounces: 2}
  - {pass: direct_shadow_rays}
  - {pass: gather_irradiance, id: indirect}
  - {pass: composite}
sweep:
  indirect:
    lookup: [gather_irradiance]
    cones dense: [{pass: filter_voxels, layout: dense}, {pass: gather_cones, stride: 4, visibility: voxels}]
    cones octree: [{pass: filter_voxels, layout: svo}, {pass: gather_cones, stride: 4}]
    surfels: [place_surfels, link_surfels, inject_radiosity, smooth_surfels, gather_surfels]
    virtual lights: [{pass: sample_vpls, vpls_per_bounce: 16, bounces: 2}, gather_vpls, filter_irradiance]
    accumulated: [{pass: sample_vpls, vpls_per_bounce: 16, bounces: 2}, gather_vpls, {pass: accumulate, history: 2}, filter_irradiance]
    gather rays: [{pass: trace_gather_rays, rays_per_block: 16, block: 8}, gather_rays, filter_irradiance]
    mirrors: [gather_irradiance, gather_mirror]
    paths: [{pass: path_trace_device, spp: 1, light: indirect}, filter_irradiance]
measure: {frames: 2, warmup: 1, build_repeats: 0}
"""


METHODS = {"lookup", "cones dense", "cones octree", "surfels", "virtual lights", "accumulated", "gather rays", "mirrors", "paths"}

# Bytes that a pass moves, and how often its host waits, in a frame that is like the one before it. How many rays go on, or start at
# mirrors, only the device knows: the host reads their number in order to launch as many. That is 12 bytes of gather rays, of the first
# hits and of those of up to three steps, and of mirrors 4 bytes of the rays and 24 of each bounce. Paths need no count to go on: the rays
# of the frame are read when it is done, and then all memory is freed that is there while they are traced: 2 waits. (A variant's last pass
# has the id of the list that it stands in.)
COUNTS_READ = {("gather rays", "gather_rays"): (48, 3), ("mirrors", "indirect"): (28, 2), ("paths", "path_trace_device"): (8, 2)}


class StillFrames(CommandTest):
    def test_no_bytes_move_but_counts(self):
        self.write("still.yaml", STILL)
        self.expect(0, "run", "still.yaml", "--tracer", "ray_query", "--out", "out", "--no-report")
        frames = [row for row in self.rows("out", "passes.csv") if row["phase"] == "frame"]
        moved = {(row["variant"].replace("-", " "), row["pass"]): (int(row["host_bytes"]), int(row["host_waits"]))
                 for row in frames}
        self.assertEqual({method for method, _ in moved}, METHODS)
        self.assertEqual({key: value for key, value in moved.items() if value != (0, 0)}, COUNTS_READ)
        self.assertTrue(all(int(row["dispatches"]) > 0 for row in frames))


if __name__ == "__main__":
    unittest.main()
