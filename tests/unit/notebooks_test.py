"""Notebooks run whole, as scripts, on results that are made up."""

from __future__ import annotations

import csv
import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
from exr_writer import exr
from PIL import Image
from report_support import ROOT, made_up


class Notebooks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name)

    def run_notebook(self, name: str, *arguments) -> str:
        done = subprocess.run([sys.executable, ROOT / "notebooks" / f"{name}.py", *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def assert_picture(self, path: Path):
        with Image.open(path) as image:
            self.assertGreater(image.size[0], 500)

    def test_results_are_read_and_charted(self):
        made_up.write_results(self.directory, made_up.sweep_of_two_keys(), made_up.manifest(["voxelize.resolution", "inject"]), images=False)
        picture = self.directory / "chart.png"
        said = self.run_notebook("read_results", self.directory, picture)
        self.assertLess(said.index("resolution 256, light_rays"), said.index("resolution 64, rsm"))  # by rising error
        self.assert_picture(picture)

    def test_memory_of_the_octree_is_drawn_of_a_benchmark(self):
        runs = [{"name": f"octreeBuild/resolution:{r}/directions:1/process_time", "voxels": 6.0 * r * r, "MB": r * r / 1e4,
                 "bytes_per_voxel": 16.7, "grid_voxels": float(r ** 3)} for r in (64, 128)]
        measured, picture = self.directory / "octree.json", self.directory / "octree.png"
        measured.write_text(json.dumps({"benchmarks": runs}), encoding="utf-8")
        self.assertIn("24576.0", self.run_notebook("octree_memory", measured, picture))
        self.assert_picture(picture)

    def test_a_papers_figure_is_drawn_of_its_run(self):
        rows = [made_up.variant(f"{resolution}-{iterations}", 10, 0.3, **{"voxelize.resolution": resolution, "cluster": "by distance",
                                                                         "cluster.iterations": iterations})
                for resolution in (64, 128) for iterations in (1, 2, 10)]
        run = made_up.manifest(["voxelize.resolution", "cluster", "cluster.iterations"])
        run["config"]["name"] = "cosin2022_clusters_vs_iterations"
        made_up.write_results(self.directory, rows, run, images=False)
        counted = [{"variant": row["variant"], "pass": "cluster", "name": "clusters", "frame": "", "value": 1234 + i}
                   for i, row in enumerate(rows)]
        made_up.write_csv(self.directory / "values.csv", list(counted[0]), counted)
        picture = self.directory / "figure.png"
        said = self.run_notebook("paper_figures", self.directory, picture)
        for number in ("1234", "1239"):
            self.assertIn(number, said)
        self.assert_picture(picture)

    def test_a_papers_figure_may_be_of_words_and_scores(self):
        rows = [made_up.variant(f"m = {m}", 10, 1 / m, mirror=f"m = {m}") for m in (2, 4, 8)]
        for row in rows:
            row["nrmse@mirror"] = row["nrmse"]
        run = made_up.manifest(["mirror"])
        run["config"] |= {"name": "seok2021_grid_resolution", "measure": {"masks": {"mirror": {"min_metallic": 0.9}}}}
        made_up.write_results(self.directory, rows, run, images=False)
        picture = self.directory / "figure.png"
        self.assertIn("0.125", self.run_notebook("paper_figures", self.directory, picture))
        self.assert_picture(picture)

    def test_every_paper_figure_is_of_a_config(self):
        names = {line.split(": ", 1)[1] for path in (ROOT / "configs/papers").rglob("*.yaml")
                 for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("name: ")}
        source = (ROOT / "notebooks/paper_figures.py").read_text(encoding="utf-8")
        figures = eval(source[source.index("FIGURES = ") + len("FIGURES = "):source.index("\n\nresults =")])
        self.assertLessEqual(set(figures), names)

    def test_the_pareto_chart_is_drawn_of_the_table_of_many_runs(self):
        measured, picture = self.directory / "methods.csv", self.directory / "chart.png"
        columns = ["scene", "method", "machine", "name", "frame", "rays", "nrmse", "nrmse_low", "nrmse_high"]
        rows = [dict(zip(columns, (scene, method, "a CPU", f"{method}-{ms}", ms, 1000, error, 0.9 * error, 1.1 * error)))
                for scene in ("cornell", "sponza")
                for method, ms, error in (("cones", 10, 0.5), ("cones", 30, 0.4), ("rays", 20, 0.3), ("rays", 40, 0.2))]
        with measured.open("w", newline="", encoding="utf-8") as out:
            writer = csv.DictWriter(out, columns)
            writer.writeheader()
            writer.writerows(rows)
        said = self.run_notebook("pareto_chart", measured, picture)
        for name in ("cones-10", "rays-20", "rays-40"):
            self.assertEqual(said.count(name), 2)
        self.assertNotIn("cones-30", said)  # rays are faster and better
        self.assert_picture(picture)

    def test_ones_own_metric_knows_light_that_is_twice_as_bright(self):
        rows = [made_up.variant(name, 10, 0.3) for name in ("same", "twice")]
        made_up.write_results(self.directory, rows, made_up.manifest([]), indirect=False)
        image = numpy.full((20, 24, 3), 2.0)
        for folder, names, factor in (("reference", ("final", "final_a", "final_b"), 1), ("same", ("final",), 1), ("twice", ("final",), 2)):
            for name in names:
                (self.directory / "images" / folder / f"{name}.exr").write_bytes(exr(factor * image, zipped=True))
        target = self.directory / "scores.csv"
        self.run_notebook("own_metric", self.directory, target)
        with target.open(newline="", encoding="utf-8") as file:
            scores = {row["variant"]: row for row in csv.DictReader(file)}
        self.assertEqual(float(scores["same"]["stops_off"]), 0)
        self.assertAlmostEqual(float(scores["twice"]["stops_off"]), math.log2((4 + 0.02) / (2 + 0.02)), places=6)
        self.assertEqual(float(scores["twice"]["of_noise"]), 0)


if __name__ == "__main__":
    unittest.main()
