"""The Python module: its images, tables and errors against those of the command."""
import os
import random
import sys

import numpy as np
from support import PROGRAM, SOURCE, TINY, CommandTest

sys.path.insert(0, os.path.join(SOURCE, "framework", "python"))
import voxray  # noqa: E402
import voxray.session  # noqa: E402


class Module(CommandTest):
    def setUp(self):
        super().setUp()
        self.config = self.write("tiny.yaml", TINY)

    def test_a_session(self):
        with voxray.Session(self.config, program=PROGRAM) as study:
            self.assertEqual(study.variants, {"resolution-8": "resolution 8", "resolution-16": "resolution 16"})
            first = study.render()
            self.assertEqual(first.final.shape, (24, 32, 3))
            self.assertFalse(first.passes["reused"].any())
            study.set("gather_irradiance", [{"pass": "trace_gather_rays", "rays_per_block": 4}, "gather_rays"])
            second = study.render()
            self.assertEqual(list(second.passes["id"][second.passes["reused"]]), ["voxelize", "inject"])
            self.assertGreater(np.abs(second.indirect - first.indirect).max(), 0)
            self.assertGreater(study.score()["nrmse"], 0)
            with self.assertRaisesRegex(voxray.VoxrayError, "voxelize.resolution"):
                study.set("voxelize.resolution", "many")
            views = study.views.set_index("name")
            self.assertEqual(study.view("gbuffer.N").shape, (24, 32, 3))
            self.assertEqual([study.view("gbuffer.Z").shape, views["shape"]["gbuffer.Z"]], [(24, 32), [24, 32]])
            np.testing.assert_array_equal(study.view("composite.final"), second.final.astype(np.float32))
            occupancy = study.view("voxelize.voxel occupancy")
            self.assertEqual([occupancy.dtype, list(occupancy.shape)], [np.uint32, views["shape"]["voxelize.voxel occupancy"]])
            self.assertEqual(study.view("show_voxels", show="irradiance").shape, (24, 32, 3))
            picture = study.view_picture("gbuffer.id")
            self.assertEqual([picture.size, picture.mode], [(32, 24), "RGB"])
            self.assertIn("number", picture.info["legend"])
            with self.assertRaisesRegex(voxray.VoxrayError, "no view 'gbuffer.M'"):
                study.view("gbuffer.M")
            study.select("resolution-8")
            self.assertEqual(study.config["name"], "tiny")
            np.testing.assert_array_equal(study.render().final, first.final)
        with self.assertRaisesRegex(voxray.VoxrayError, "closed"):
            study.render()

    def test_a_reference(self):
        with voxray.Session(self.config, program=PROGRAM) as study:
            study.set("seed", random.getrandbits(40))  # Not cached
            study.set("reference.spp", 256)
            rendering = study.render()
            none = study.reference(seconds=0)
            self.assertEqual((none.samples, none.of, none.final, none.noise), (0, 256, None, {}))
            self.assertNotIn("FLIP", rendering._repr_html_())
            first, second = study.reference(seconds=0.002), study.reference(seconds=0.002)
            self.assertLess(first.samples, second.samples)
            self.assertEqual((second.final.shape, second.is_whole), ((24, 32, 3), False))
            self.assertIn(f"{second.samples} of 256 samples", second._repr_html_())
            shown = rendering._repr_html_()
            for words in ("HDR-FLIP, final", "reference, indirect", f"{second.samples} of 256 samples", "indirect_nrmse_low"):
                self.assertIn(words, shown)
            early = study.score()
            self.assertLess(early["nrmse_low"], early["nrmse_high"])

            whole = study.reference()
            self.assertTrue(whole.is_whole)
            self.assertLess(whole.noise["indirect_nrmse"], second.noise["indirect_nrmse"])
            self.assertLess(study.score()["flip_noise"], early["flip_noise"])
            study.render()
            self.assertNotIn("FLIP", rendering._repr_html_())  # Another one was rendered since
            study.set("reference", None)
            last = study.render()
            self.assertNotIn("FLIP", last._repr_html_())
            with self.assertRaisesRegex(voxray.VoxrayError, "no reference"):
                study.reference(seconds=1)

    def test_a_config_that_is_wrong(self):
        self.write("wrong.yaml", TINY.replace("voxelize, res", "voxelise, res"))
        with self.assertRaisesRegex(voxray.VoxrayError, "voxelise"):
            voxray.Session(self.path("wrong.yaml"), program=PROGRAM)

    def test_a_run(self):
        results = voxray.run(self.config, set={"image.width": 16, "measure.frames": 1}, out=self.path("out"), program=PROGRAM)
        self.assertEqual(list(results.variants["variant"]), ["resolution-8", "resolution-16"])
        self.assertTrue((results.variants["nrmse"] > 0).all())
        with self.assertRaisesRegex(voxray.VoxrayError, "image.wide"):
            voxray.run(self.config, set={"image.wide": 16}, out=self.path("out"), program=PROGRAM)
