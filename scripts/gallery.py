#!/usr/bin/python3
"""Renders the gallery: runs configs, composes a picture of each, and writes their numbers into a page.

gallery.py [CONFIG...] [--out DIR] [--pictures DIR] [--page PAGE] [--program PROGRAM]

CONFIG: a config of one variant with a reference, those of configs/gallery where none is named. Each is run into DIR/NAME,
NAME being its file's; what an earlier call finished there stays. Its picture, NAME.jpg, has the variant's image on top, and
below it a part of the reference and of the variant at full size, the part in which the relative error is largest, and the
relative error of the whole image. PAGE has a line "<!-- gallery: NAME -->" and below it "<!-- end -->" for each: what stands
between is replaced by the picture, its numbers and the config's graph.

Relative error: the difference of luminance over the mean of both images', of blocks of 8 x 8 pixels, so that the reference's
noise shows less than in single pixels; the part is chosen by its square, freed of that noise as nRMSE is (docs/units.md).
"""
import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "framework"))
import numpy as np  # noqa: E402
from image_sheet import GAP, path_of, sheet  # noqa: E402
from PIL import Image, ImageDraw  # noqa: E402
from report import exr_pixels, images, pages  # noqa: E402
from report.load import load  # noqa: E402
from report.results import ReportError  # noqa: E402
from report.rows import markdown_table  # noqa: E402
from report.text import figures, size  # noqa: E402

TILES, QUALITY = 3, 88  # tiles below an image, of the JPEG
BLOCK, SHOWN = 8, 0.25  # pixels; relative error at the ends of the colors


def blocks(path):
    """Luminance of an EXR file, means over blocks; what is left over at the right and at the bottom is left out."""
    luminance = exr_pixels.rgb(path) @ images.LUMINANCE
    rows, columns = (length // BLOCK for length in luminance.shape)
    return luminance[:rows * BLOCK, :columns * BLOCK].reshape(rows, BLOCK, columns, BLOCK).mean(axis=(1, 3))


def relative(difference, scale):
    """The difference over the scale; 0 where the scale is 0."""
    return np.divide(difference, scale, out=np.zeros_like(difference), where=scale > 0)


def worst_window(error, width, height):
    """Left and top of the window of that size in which the mean of `error`, shape (rows, columns), is largest."""
    sums = np.pad(error.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    means = sums[height:, width:] - sums[:-height, width:] - sums[height:, :-width] + sums[:-height, :-width]
    top, left = np.unravel_index(means.argmax(), means.shape)
    return int(left), int(top)


def compose(ours, reference, lights):
    """The image, and the tiles below it. `lights`: block luminances of the variant and of both halves of the reference."""
    width = (ours.width + GAP) // TILES - GAP
    height = width * ours.height // ours.width
    x, a, b = lights
    r = (a + b) / 2
    left, top = (BLOCK * at for at in worst_window(relative((x - a) * (x - b), ((x + r) / 2) ** 2), width // BLOCK, height // BLOCK))
    box = (left, top, left + width, top + height)
    shown = 0.5 + relative(x - r, (x + r) / 2).clip(-SHOWN, SHOWN) / (2 * SHOWN)
    whole = Image.fromarray(images.colors(images.SIGNED_ERROR_COLORS, shown)).resize(ours.size, Image.NEAREST)
    ImageDraw.Draw(whole).rectangle((left, top, box[2] - 1, box[3] - 1), outline="black", width=max(1, ours.width // 640))
    below = sheet([("path-traced, where the error is largest", reference.crop(box)), ("voxels, the same part", ours.crop(box)),
                   (f"red: too bright, blue: too dark, up to {100 * SHOWN:g} %", whole.resize((width, height), Image.LANCZOS))], TILES)
    picture = Image.new("RGB", (ours.width, ours.height + GAP + below.height), "white")
    picture.paste(ours, (0, 0))
    picture.paste(below, (0, ours.height + GAP))
    return picture


def picture_of(results):
    """The run's picture. @throws ReportError where it has not exactly one variant, or no reference."""
    if len(results.ok) != 1:
        raise ReportError(f"{results.directory}: {len(results.ok)} finished variants; a picture shows one")
    variant = results.ok["variant"].iloc[0]
    ours, reference = (images.open_png(path_of(results, folder, "final.png")).convert("RGB") for folder in (variant, "reference"))
    lights = [blocks(path_of(results, *place)) for place in ((variant, "final.exr"), ("reference", "final_a.exr"), ("reference", "final_b.exr"))]
    return compose(ours, reference, lights)


def numbers(results):
    """A table of what the variant costs, its errors, and what its reference took."""
    row = results.ok.iloc[0]
    reference = results.reference_of(row["variant"])
    flip = f"{figures(row['flip'], 2)} ({figures(results.noise('flip', reference), 2)})"

    def nrmse(prefix):
        ends = (figures(row[f"{prefix}nrmse{end}"], 2) for end in ("_low", "_high"))
        return f"{figures(row[prefix + 'nrmse'], 2)} ({' to '.join(ends)})"
    columns = {"frame": f"{figures(row['frame_ms_median'] / 1000)} s", "build": f"{figures(row['build_ms'] / 1000)} s",
               "memory": size(row["memory_bytes"]), "nRMSE": nrmse(""), "nRMSE of indirect light": nrmse("indirect_"),
               "FLIP": flip, "reference": f"{reference['spp']} samples a pixel, {figures(reference['seconds'])} s"}
    return "\n".join(markdown_table(columns, [columns.values()]))


def graph_of(config):
    """The lines of a config's graph as they stand."""
    lines = re.search(r"^graph:\n(?:[ #].*\n)+", config.read_text(encoding="utf-8"), re.M)
    if lines is None:
        raise ReportError(f"{config}: no lines of a graph")
    return lines[0]


def section(config, results, picture, page):
    """What the page says of a config."""
    link = os.path.relpath(picture, page.parent)
    alt = config.stem.replace("_", " ").capitalize()
    title = f"{alt}: by voxels, a part of it next to the path-traced reference, and the error"
    return f"![{title}]({link})\n\n{numbers(results)}\n\n```yaml\n{graph_of(config)}```\n"


def replace(page, name, text):
    """Puts a section into the page. @throws ReportError where the page has no place for it."""
    begin, end = f"<!-- gallery: {name} -->\n", "<!-- end -->"
    before, found, after = page.read_text(encoding="utf-8").partition(begin)
    _, closed, rest = after.partition(end)
    if not found or not closed:
        raise ReportError(f"{page}: no lines '{begin.strip()}' and '{end}'")
    pages.write_whole(page, f"{before}{begin}{text}{end}{rest}")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("configs", metavar="CONFIG", nargs="*", type=Path)
    parser.add_argument("--out", default=ROOT / "results" / "gallery", type=Path, metavar="DIR")
    parser.add_argument("--pictures", default=ROOT / "docs" / "images" / "gallery", type=Path, metavar="DIR")
    parser.add_argument("--page", default=ROOT / "docs" / "gallery.md", type=Path)
    parser.add_argument("--program", default=str(ROOT / "voxray"))
    options = parser.parse_args(arguments)
    options.pictures.mkdir(parents=True, exist_ok=True)
    for config in options.configs or sorted((ROOT / "configs" / "gallery").glob("*.yaml")):
        out, picture = options.out / config.stem, options.pictures / f"{config.stem}.jpg"
        run = subprocess.run([options.program, "run", str(config), "--out", str(out), "--resume"], check=False)
        if run.returncode != 0:
            return run.returncode
        try:
            results = load(out)
            picture_of(results).save(picture, quality=QUALITY, optimize=True, progressive=True)
            replace(options.page, config.stem, section(config, results, picture, options.page))
        except ReportError as error:
            print(f"gallery.py: error: {error}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
