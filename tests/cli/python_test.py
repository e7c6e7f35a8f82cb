"""The Python module: its images, tables and errors against those of the command."""
import csv
import json
import os
import random
import sys
import tempfile
import warnings
from pathlib import Path

import matplotlib
import numpy as np
from support import PROGRAM, SOURCE, TINY, CommandTest

matplotlib.use("Agg")
sys.path[:0] = [os.path.join(SOURCE, "framework", "python"), os.path.join(SOURCE, "tests", "unit")]
import pareto_results  # noqa: E402
import voxray  # noqa: E402
import voxray.exr  # noqa: E402
import voxray.session  # noqa: E402
from matplotlib import pyplot  # noqa: E402
from report import exr_pixels  # noqa: E402


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
            self.assertEqual(voxray.score(second, second.indirect)["value"]["nrmse"], 0)
            self.assertEqual(voxray.compare(second, first, first, light="total")["better"]["nrmse"], "b")
            with self.assertRaisesRegex(voxray.VoxrayError, "^voxelize.resolution"):
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
            with self.assertWarnsRegex(UserWarning, "'resolution 8' takes the place of what was set: gather_irradiance$"):
                study.select("resolution 8")
            self.assertEqual(study.config["name"], "tiny")
            np.testing.assert_array_equal(study.render().final, first.final)
        with self.assertRaisesRegex(voxray.VoxrayError, "closed"):
            study.render()

    def test_what_was_set_is_kept_in_another_variant(self):
        with voxray.Session(self.config, program=PROGRAM) as study, warnings.catch_warnings():
            warnings.simplefilter("error")
            study.set("inject.bounces", 1)
            study.set("inject", {"pass": "inject_light_rays", "rays_per_light": 2048})
            study.set("inject.bounces", 1)
            study.select("resolution-16", keep=True)
            self.assertEqual([entry.get("bounces") for entry in study.config["graph"] if entry.get("id") == "inject"], [1])
            study.select("resolution-8", keep=False)
            self.assertEqual([entry["bounces"] for entry in study.config["graph"] if entry.get("id") == "inject"], [2])
            study.kernel("own", "vec3 shade(ivec2 pixel, ivec2 texel) { return kernel.values; }", values=[1, 2, 3])
            with self.assertRaisesRegex(UserWarning, "what was set: graph$"):
                study.select("resolution-16", keep=True)

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
            self.assertRegex(repr(second), f"^Reference of {second.samples} of 256 samples a pixel, noise [0-9.]+% .nRMSE.$")
            shown = rendering._repr_html_()
            for words in ("HDR-FLIP, final", "reference, indirect", f"{second.samples} of 256 samples", "indirect_nrmse_low"):
                self.assertIn(words, shown)
            early = study.score()
            self.assertLess(early["nrmse_low"], early["nrmse_high"])

            whole = study.reference()
            self.assertTrue(whole.is_whole)
            self.assertLess(whole.noise["indirect_nrmse"], second.noise["indirect_nrmse"])
            self.assertLess(study.score()["flip_noise"], early["flip_noise"])
            self.assertIn("FLIP", rendering._repr_html_())
            study.set("voxelize.resolution", 12)
            self.assertNotIn("FLIP", rendering._repr_html_())  # The session is elsewhere
            before = study.score()
            self.assertNotIn("FLIP", rendering._repr_html_())
            self.assertIn("FLIP", study.render()._repr_html_())
            self.assertEqual(study.score(), before)
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
        with self.assertWarnsRegex(UserWarning, "out: replaced 2 finished variants of an earlier run"):
            voxray.run(self.config, set={"image.width": 16, "measure.frames": 1}, out=self.path("out"), program=PROGRAM)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            voxray.run(self.config, set={"image.width": 16, "measure.frames": 1}, out=self.path("out"), options=["--resume"], program=PROGRAM)
        with self.assertRaisesRegex(voxray.VoxrayError, "image.wide"):
            voxray.run(self.config, set={"image.wide": 16}, out=self.path("out"), program=PROGRAM)

    def test_a_kernel(self):
        with voxray.Session(self.config, program=PROGRAM) as study:
            before = study.render().final
            study.kernel("own", "vec3 shade(ivec2 pixel, ivec2 texel) { return 2.0 * texelOf(finalImage, pixel).rgb; }")
            np.testing.assert_array_equal(study.render().final, 2 * before)
            study.kernel("own", "vec3 shade(ivec2 pixel, ivec2 texel) { return kernel.values; }", after="composite", values=[1, 2, 3])
            np.testing.assert_array_equal(study.render().final[5, 7], [1, 2, 3])
            study.kernel("own", "vec3 shade(ivec2 pixel, ivec2 texel) {\n    return wait;\n}")
            with self.assertRaisesRegex(voxray.VoxrayError, "source:2: 'wait' : undeclared identifier"):
                study.render()
            with self.assertRaisesRegex(voxray.VoxrayError, "did you mean 'composite'"):
                study.kernel("other", "", after="composit")


class OfARun(CommandTest):
    """One run for all tests."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory(prefix="voxray-cli-")
        cls.addClassCleanup(folder.cleanup)
        config = Path(folder.name, "tiny.yaml")
        config.write_text(TINY, encoding="utf-8")
        cls.results = voxray.run(config, set={"image.exposure_stops": 1, "measure.frames": 1}, out=Path(folder.name, "out"), program=PROGRAM)

    def test_images_of_a_variant(self):
        variant = self.results["resolution 8"]
        self.assertEqual(variant.id, "resolution-8")
        truth = variant.reference("total")
        self.assertEqual(variant.final.shape, (24, 32, 3))
        np.testing.assert_allclose(np.mean(truth.halves, axis=0), truth.mean, rtol=1e-5, atol=1e-6)
        with self.assertRaisesRegex(voxray.VoxrayError, "no variant 'resolution-9'"):
            self.results["resolution-9"]
        for shown in (self.results, variant):
            self.assertIn("data:image/png", shown._repr_html_())

    def test_scores_are_those_of_the_run(self):
        variant = self.results["resolution-16"]
        for light, prefix in (("total", ""), ("indirect", "indirect_")):
            scores = voxray.score(variant, light=light)
            for metric in scores.index:
                self.assertAlmostEqual(scores["value"][metric], variant.row[prefix + metric], places=5)
            self.assertAlmostEqual(scores["high"]["nrmse"], variant.row[f"{prefix}nrmse_high"], places=5)
        # As files, as arrays, and by the command
        truth = variant.reference()
        said = json.loads(self.expect(0, "compare", str(variant.file()), str(truth.file), "--json").stdout)
        for image, reference in ((variant.file(), truth.file), (variant.indirect, truth)):
            scores = voxray.score(image, reference)
            self.assertAlmostEqual(scores["value"]["ssim"], said["scores"]["ssim"], places=6)
            self.assertAlmostEqual(scores["low"]["relmse"], said["scores"]["relmse_low"], places=6)
        self.assertTrue(np.isnan(voxray.score(variant.indirect, truth.mean)["low"]["nrmse"]))
        with self.assertRaisesRegex(voxray.VoxrayError, "no reference"):
            voxray.score(variant.indirect)
        with self.assertRaisesRegex(voxray.VoxrayError, "one size"):
            voxray.score(np.zeros((4, 4, 3)), truth)

    def test_two_variants_side_by_side(self):
        coarse, fine = self.results["resolution-8"], self.results["resolution-16"]
        table = voxray.compare(coarse, fine)
        for metric in ("nrmse", "ssim", "mean_ratio"):
            self.assertAlmostEqual(table["a"][metric], coarse.row[f"indirect_{metric}"], places=5)
            self.assertAlmostEqual(table["b"][metric], fine.row[f"indirect_{metric}"], places=5)
        self.assertEqual(table["better"]["ssim"], "a" if table["a"]["ssim"] > table["b"]["ssim"] else "b")
        self.assertEqual(table["better"]["nrmse"] == "\u2248", table["a_low"]["nrmse"] <= table["b_high"]["nrmse"] and
                         table["b_low"]["nrmse"] <= table["a_high"]["nrmse"])
        self.assertEqual(set(voxray.compare(fine, fine)["better"]), {"\u2248"})
        truth = fine.reference()
        self.assertEqual(voxray.compare(truth.mean, 3 * truth.mean, truth)["better"]["nrmse"], "a")

    def test_two_runs(self):
        table = voxray.compare(self.results, self.results)
        self.assertEqual(list(table.index.get_level_values("variant").unique()), ["resolution-8", "resolution-16"])
        self.assertEqual(set(table["better"]), {"\u2248"})

    def test_a_metric_of_ones_own(self):
        def error(image, reference):
            return float(np.abs(image - reference).mean())
        scores = self.results.metric(error, "total").set_index("variant")
        variant = self.results["resolution-8"]
        truth = variant.reference("total")
        self.assertEqual(scores["value"]["resolution-8"], error(variant.final, truth.mean))
        self.assertEqual(scores["high"]["resolution-8"], max(error(variant.final, image) for image in (truth.mean, *truth.halves)))
        self.assertAlmostEqual(scores["floor"]["resolution-8"], error(truth.halves[0], truth.halves[1]) / 2)
        for halves in Path(self.results.directory, "images", "reference").glob("*_[ab].exr"):
            halves.rename(halves.with_suffix(".away"))
        try:
            self.assertEqual(list(self.results.metric(error, "total")), ["variant", "name", "value"])
        finally:
            for halves in Path(self.results.directory, "images", "reference").glob("*.away"):
                halves.rename(halves.with_suffix(".exr"))


class Files(CommandTest):
    def test_methods_as_pareto_has_them(self):
        pareto_results.write(Path(self.path("results")), ("cornell", "sponza"), images=False)
        self.expect(0, "pareto", self.path("results"), "--out", self.path("page.html"), "--no-images")
        with open(self.path("page.csv"), newline="", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["scene"] == "sponza"]
        results = voxray.load(self.path("results"))
        pyplot.close("all")
        table = results.pareto("sponza", cost="build + frame")
        self.assertEqual(len(pyplot.get_fignums()), 1)
        # Errors are named as in the table of variants, from which they are
        light = "indirect_" if "indirect_nrmse" in results.variants else ""
        self.assertEqual([column.removeprefix(light) for column in table][:-1], list(rows[0]))
        of_run = results.variants.set_index("variant")[f"{light}nrmse"]
        np.testing.assert_allclose(table[f"{light}nrmse"], of_run[table["variant"]], rtol=1e-8)
        for column in ("variant", "method", "name"):
            self.assertEqual(list(table[column]), [row[column] for row in rows])
        for column in ("frame", "memory", "nrmse", "nrmse_high", "flip"):
            shown = table[column if column in table else light + column]
            np.testing.assert_array_equal(shown, [float(row[column]) for row in rows])
        front = table[table["front"]].sort_values("build + frame")
        self.assertTrue((np.diff(front[f"{light}nrmse"]) < 0).all())
        for scene, cost, error, said in ((None, "frame", "nrmse", "several scenes"), ("kitchen", "frame", "nrmse", "no scene 'kitchen'"),
                                         ("sponza", "price", "nrmse", "cost 'price'"), ("sponza", "frame", "beauty", "'beauty' is none of")):
            with self.assertRaisesRegex(voxray.VoxrayError, said):
                results.pareto(scene, cost=cost, error=error)

    def test_a_folder_without_results(self):
        with self.assertRaisesRegex(voxray.VoxrayError, "name the folder that a run wrote"):
            voxray.load(self.folder)

    def test_exr_files_are_read_as_they_were_written(self):
        image = np.random.default_rng(1).normal(size=(5, 7, 3)).astype(np.float32)
        voxray.exr.write(Path(self.path("image.exr")), image)
        np.testing.assert_array_equal(exr_pixels.rgb(self.path("image.exr")), image)
