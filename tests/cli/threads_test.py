"""Images and clusters don't depend on how many threads software Vulkan has."""
import unittest

from support import CommandTest

THREADS = """\
name: threads
scene: {builtin: cornell, lights: point}
image: {width: 24, height: 24}
seed: 7
graph:
  - {pass: gbuffer}
  - {pass: voxelize, resolution: 16}
  - {pass: gather_irradiance, id: gather}
  - {pass: direct_shadow_rays}
  - {pass: composite}
reference: {pass: path_trace, spp: 4, bounces: 2}
sweep:
  gather:
    light rays: [{pass: inject_light_rays, rays_per_light: 65536, bounces: 2}, gather_irradiance]
    clusters, nearest: [place_surfels, {pass: cluster_voxels, target: 100}, find_patches, {pass: cluster_visibility, rays: 32},
                        {pass: inject_clusters, direct: shadow_rays, bounces: 1}, gather_clusters, gather_irradiance]
    clusters, first: [place_surfels, {pass: cluster_voxels, initial: 500, assign: first}, find_patches,
                      {pass: cluster_visibility, rays: 32}, {pass: inject_clusters, direct: shadow_rays, bounces: 1},
                      gather_clusters, gather_irradiance]
measure: {frames: 1, warmup: 0, build_repeats: 0}
"""


class Threads(CommandTest):
    def test_one_and_five_give_the_same(self):
        self.write("threads.yaml", THREADS)
        images, values = [], []
        for threads in ("1", "5"):
            self.environment["LP_NUM_THREADS"] = threads
            self.expect(0, "run", "threads.yaml", "--out", threads, "--no-report")
            names = [name for name in self.files(threads, "images") if name.endswith(".exr")]
            self.assertTrue(any(name.endswith("indirect.exr") for name in names), names)
            images.append({name: self.bytes(threads, "images", name) for name in names})
            values.append(self.rows(threads, "values.csv"))
        self.assertEqual(sorted(images[0]), sorted(images[1]))
        for name, data in images[0].items():
            self.assertEqual(data, images[1][name], name)
        self.assertEqual(*values)
        self.assertTrue(any(row["name"] == "clusters" for row in values[0]), values[0][:3])


if __name__ == "__main__":
    unittest.main()
