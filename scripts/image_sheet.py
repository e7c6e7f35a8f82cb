#!/usr/bin/python3
"""Writes one picture of a run: the reference, where it has one, and each variant that finished, named, in the order of the
report's table.

image_sheet.py RUN SHEET [--image NAME] [--columns N]

RUN: a results folder, of at most one reference. SHEET: the file to write, PNG of 256 colors or, for gradients, .jpg.
NAME: indirect.png (the default) or final.png.
"""
import argparse
import os
import sys
import textwrap

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "framework"))
from matplotlib import font_manager
from PIL import Image, ImageDraw, ImageFont
from report.load import load
from report.results import ReportError

GAP, LINE, FONT_SIZE, COLORS, QUALITY = 4, 17, 13, 256, 90  # pixels, pixels, pixels, of the palette, of a JPEG


def path_of(results, folder, name):
    """The path of one of a run's images. @throws ReportError where it is missing"""
    path = results.image(folder, name)
    if path is None:
        raise ReportError(f"{results.directory}: no images/{folder}/{name}")
    return path


def tiles(results, image):
    """Names and images of the reference, where the run has one, and of the variants. @throws ReportError where one is missing."""
    folders = {variant: results.names[variant] for variant in results.ok["variant"]}
    if results.manifest.get("reference"):
        folders = {"reference": "reference", **folders}
    found = []
    for folder, name in folders.items():
        with Image.open(path_of(results, folder, image)) as picture:
            found.append((name, picture.convert("RGB")))
    return found


def sheet(named, columns):
    """Images of one size on white, each above its name."""
    font = ImageFont.truetype(font_manager.findfont("DejaVu Sans"), FONT_SIZE)
    width, height = named[0][1].size
    lines = [textwrap.wrap(name, max(1, int(width / font.getlength("n")))) for name, _ in named]
    step = height + GAP + LINE * max(map(len, lines))
    columns = min(columns, len(named))
    whole = Image.new("RGB", (columns * (width + GAP) - GAP, -(-len(named) // columns) * step), "white")
    draw = ImageDraw.Draw(whole)
    for i, ((_, picture), words) in enumerate(zip(named, lines)):
        x, y = i % columns * (width + GAP), i // columns * step
        whole.paste(picture, (x, y))
        for k, line in enumerate(words):
            draw.text((x + GAP, y + height + k * LINE), line, "black", font)
    return whole


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", metavar="RUN")
    parser.add_argument("sheet", metavar="SHEET")
    parser.add_argument("--image", default="indirect.png", metavar="NAME")
    parser.add_argument("--columns", type=int, default=4, metavar="N")
    options = parser.parse_args(arguments)
    try:
        whole = sheet(tiles(load(options.run), options.image), max(1, options.columns))
    except ReportError as error:
        print(f"image_sheet.py: error: {error}", file=sys.stderr)
        return 1
    is_jpeg = options.sheet.endswith(".jpg")
    (whole if is_jpeg else whole.quantize(COLORS)).save(options.sheet, optimize=True, **({"quality": QUALITY} if is_jpeg else {}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
