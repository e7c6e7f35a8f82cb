"""Reports of many variants: how large a page is, which a test holds, and how long it takes, which is printed."""

from __future__ import annotations

import os
import tempfile
import time
import unittest
from pathlib import Path

import browser
import numpy as np
from PIL import Image
from report_support import made_up

from report import make_report

MAX_BYTES = 60e6
SIZE = (640, 360)


def noise(path: Path, channels: int) -> None:
    """A picture that does not compress: the largest that a run can leave."""
    shape = (SIZE[1], SIZE[0], channels) if channels > 1 else (SIZE[1], SIZE[0])
    Image.fromarray(np.random.default_rng(1).integers(0, 256, shape, dtype=np.uint8)).save(path)


def write(directory: Path, count: int) -> None:
    """Variants of two keys with errors of both lights and all images, which are the reference's: links to its folder."""
    random = np.random.default_rng(2)
    sizes = (32, 64, 128, 256, 512)
    rows = []
    for i in range(count):
        ms = 10 ** random.uniform(0, 3)
        error = 0.5 * ms**-0.3 * 10 ** random.uniform(0, 1)
        row = made_up.variant(f"resolution-{sizes[i % 5]}-method-{i // 5}", ms, error, 1.3 * error,
                              **{"voxelize.resolution": sizes[i % 5], "method": f"method {i // 5}"})
        for key in ("nrmse", "relmse", "indirect_nrmse", "indirect_relmse"):
            row.update(made_up.spread(key, 0.9 * row[key], 1.1 * row[key]))
        rows.append(row)
    run = made_up.manifest(["voxelize.resolution", "method"])
    graph = [{"pass": name, "id": name, "rays": 16, "bounces": 7} for name in ("voxelize", "inject", "gbuffer", "gather", "composite")]
    run["variants"] = {row["variant"]: graph for row in rows}
    made_up.write_results(directory, rows, run, images=False)
    images = directory / "images"
    (images / "reference").mkdir(parents=True)
    for name, channels in (("final", 3), ("indirect", 3), ("flip", 1), ("indirect_flip", 1)):
        noise(images / "reference" / f"{name}.png", channels)
    for row in rows:
        os.symlink(images / "reference", images / row["variant"])


class ManyVariants(unittest.TestCase):
    def report(self, count: int, *arguments: str) -> str:
        """Makes a page, holds its size and prints what it takes to make and to open."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        directory = Path(folder.name)
        write(directory, count)
        start = time.monotonic()
        self.assertEqual(make_report.main([str(directory), *arguments]), 0)
        seconds = time.monotonic() - start
        page = directory / "report.html"
        size = page.stat().st_size
        said = f"{count} variants: {size / 1e6:.1f} MB, drawn in {seconds:.1f} s"
        if not browser.MISSING:
            window = browser.Browser()
            try:
                said += f", opened in {window.open(page):.1f} s"
                self.assertEqual(window.console(), [])
            finally:
                window.close()
        print(said, flush=True)
        self.assertLess(size, MAX_BYTES)
        source = page.read_text(encoding="utf-8")
        self.assertEqual(source.count(' id="row-'), count)
        return source

    def test_200_variants(self):
        self.assertGreater(self.report(200).count('class="stage viewer"'), 10)

    def test_10000_variants_with_images_of_the_front(self):
        self.assertGreater(self.report(10000, "--images", "front").count('class="stage viewer"'), 2)


if __name__ == "__main__":
    unittest.main()
