"""Counterparts of stages: every pass is in the table, the graphs that it makes are whole, what it lacks is refused."""
import os
import sys
import unittest
from types import SimpleNamespace

from support import PROGRAM, SOURCE, CommandTest

sys.dont_write_bytecode = True
sys.path.append(os.path.join(SOURCE, "framework"))
from orchestration import counterparts, explain  # noqa: E402
from orchestration.errors import UsageError  # noqa: E402
from orchestration.program import Program  # noqa: E402

PASSES = Program(PROGRAM, SimpleNamespace()).passes
TABLE = counterparts.read_table()
REFERENCE = "reference: {pass: path_trace, spp: 64, bounces: 8}\n"
LIGHT_RAYS = "{pass: voxelize, resolution: 64}, {pass: inject_light_rays, id: inject, rays_per_light: 65536, bounces: 7}, "
RAYS = "{pass: trace_gather_rays, rays_per_block: 16, block: 8}, {pass: gather_rays}, {pass: filter_irradiance}"


class Counterparts(CommandTest):
    def swaps_of(self, passes, start="{pass: gbuffer, samples_per_pixel_edge: 2}, ", end=", {pass: direct_shadow_rays}, {pass: composite}"):
        """Of a config of one variant: a g-buffer and `passes`, direct light and the sum of both."""
        path = self.write("x.yaml", f"name: x\nscene: {{builtin: cornell}}\ngraph: [{start}{passes}{end}]\n{REFERENCE}")
        program = Program(PROGRAM, SimpleNamespace())
        plan = program.plan(path)
        swaps = counterparts.plan_swaps(plan["variants"][0], PASSES, TABLE)
        swept = program.replace(set=explain.assignments(plan, plan["variants"][0], swaps)).plan(path)
        self.assertEqual([variant["values"] for variant in swept["variants"]], [[label] for label in swaps.sets])
        return swaps

    def stages_of(self, passes):
        return [stage.name for stage in self.swaps_of(passes).stages]

    def test_the_table_knows_every_pass_once(self):
        staged = {name for stage in TABLE["stages"].values() for name in stage["passes"]}
        self.assertEqual(sorted([*TABLE["exact"], *TABLE["unknown"], *staged]), sorted(PASSES),
                         "a new pass belongs into passes/common/counterparts.toml, into one of stages, exact and unknown")

    def test_gather_rays(self):
        swaps = self.swaps_of(LIGHT_RAYS + RAYS)
        stages = swaps.stages
        self.assertEqual([stage.name for stage in stages], ["injection", "gather", "voxelization", "filter", "upsampling"])
        self.assertEqual(stages[0].changes, ["inject.rays_per_light 65536 → 1048576"])
        self.assertEqual(stages[1].changes, ["trace_gather_rays.rays_per_block 16 → 1024", "trace_gather_rays.block 8 → 1"])
        self.assertEqual(stages[2].changes, ["voxelize.resolution 64 → 256", "inject.rays_per_light 1048576 → 4194304"])
        self.assertEqual(stages[2].needs, ["injection", "gather"])
        self.assertEqual(stages[3].changes, ["without filter_irradiance"])
        # Without injection or gather; the filter with gather; voxels, filter and texels with both
        self.assertEqual(len(swaps.sets), 2 + 2 + 8)
        self.assertEqual(next(iter(swaps.sets.values())), [])

    def test_other_methods(self):
        trace = "{pass: trace_gather_rays, rays_per_block: 16}, "
        for passes, stages in (
                (LIGHT_RAYS + "{pass: filter_voxels, layout: clipmap, clipmap_resolution: 32}, "
                 "{pass: gather_cones, cones: 6, stride: 4, specular: 0}",
                 ["injection", "gather", "voxelization", "visibility", "upsampling"]),
                (LIGHT_RAYS + "{pass: gather_irradiance}", ["injection", "voxelization", "upsampling"]),
                ("{pass: path_trace, spp: 1, light: indirect}, {pass: filter_irradiance}", ["gather", "filter", "upsampling"]),
                ("{pass: update_radiance_cache, rays_per_image: 65536}, " + trace + "{pass: gather_rays, source: radiance_cache}",
                 ["injection", "gather", "voxelization", "upsampling"]),
                (LIGHT_RAYS + "{pass: merge_voxels}, " + trace + "{pass: gather_rays, source: merged_voxels}",
                 ["injection", "gather", "voxelization", "upsampling"]),
                ("{pass: sample_vpls, vpls_per_bounce: 64}, {pass: gather_vpls, visibility: exact, bound: 0}",
                 ["injection", "gather", "upsampling"])):
            self.assertEqual(self.stages_of(passes), stages, passes)
        for inject in ("inject_rsm", "inject_voxel_rays", "inject_camera_rays"):
            swaps = self.swaps_of(f"{{pass: voxelize}}, {{pass: place_surfels}}, {{pass: {inject}, bounces: 5}}, {{pass: gather_irradiance}}")
            self.assertEqual(swaps.stages[0].changes, [f"inject_light_rays in place of {inject}"])
            self.assertIn({"pass": "inject_light_rays", "rays_per_light": 16777216, "bounces": 5, "id": inject}, swaps.graphs["injection"])

    def test_rays_through_hybrid_leaves_give_way_to_the_ray_tracer(self):
        stages = self.swaps_of(LIGHT_RAYS + "{pass: filter_voxels}, {pass: gather_irradiance}, {pass: build_hybrid_leaves}, "
                               "{pass: gather_mirror, walk: hierarchical, wide_rays: cones}").stages
        self.assertEqual([stage.name for stage in stages], ["injection", "gather", "voxelization", "visibility", "upsampling"])
        self.assertEqual(stages[1].changes, ["gather_mirror.rays 1 → 64", "gather_mirror.light_samples 1 → 16"])
        self.assertEqual(stages[3].needs, ["gather"])
        self.assertEqual(stages[3].changes.count("without build_hybrid_leaves"), 1)
        self.assertEqual(stages[3].changes.count("gather_mirror.walk hierarchical → exact"), 1)

    def test_what_is_as_fine_already_is_no_stage(self):
        self.assertEqual(self.stages_of("{pass: voxelize, resolution: 512}, {pass: inject_light_rays, rays_per_light: 33554432}, "
                                        "{pass: gather_irradiance}"), ["upsampling"])
        # A number beyond the most that a counterpart takes stays
        stages = self.swaps_of("{pass: voxelize, resolution: 300}, {pass: inject_light_rays, rays_per_light: 4194304}, "
                               "{pass: gather_irradiance}").stages
        self.assertEqual(stages[1].changes, ["voxelize.resolution 300 → 512"])

    def test_what_cannot_be_explained_is_refused(self):
        with self.assertRaisesRegex(UsageError, r"x.yaml:3: 'accumulate'"):
            self.swaps_of(LIGHT_RAYS + RAYS + ", {pass: accumulate}")
        with self.assertRaisesRegex(UsageError, "x.yaml:3: "):
            self.swaps_of("{pass: path_trace, spp: 5000}", "", "")
        self.write("y.yaml", f"name: y\nscene: {{builtin: cornell}}\ngraph: [{{pass: gbuffer}}, {LIGHT_RAYS}{{pass: gather_irradiance}}, "
                   "{pass: direct_shadow_rays}, {pass: composite}]\n")
        self.assertIn("y.yaml:1: ", self.expect(2, "explain", "y.yaml").stderr)


if __name__ == "__main__":
    unittest.main()
