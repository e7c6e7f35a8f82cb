"""Images as data URIs: previews, error maps in false colors, films, and radiance as half floats, which pixels.js decodes."""

from __future__ import annotations

import base64
import gzip
import io
import re
import struct
import zlib
from dataclasses import dataclass, replace
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image, UnidentifiedImageError

from report import exr_pixels
from report.pages import data_uri
from report.results import IMAGES, ReportError, Results

ERROR_COLORS = "magma"  # as FLIP's authors show it: black is no error, light yellow is the largest
LUMINANCE_COLORS = "viridis"
SIGNED_ERROR_COLORS = "RdBu_r"  # blue is too dark, white is right, red is too bright

BYTES_OF_EXR = 0.3  # about what half floats take of the bytes of a float32 EXR file
_LARGEST = 65504.0  # of half floats
LUMINANCE = (0.2126, 0.7152, 0.0722)  # of linear R, G and B, Rec. 709
_PERCENTILES = (0.1, 99.9)

_FILM_QUALITY = 90  # of WebP, 0 to 100: frames pass by, so that they need not be exact
_FILM_MILLISECONDS = 100  # a frame
_FILM_OF_PNG = 0.25  # about what WebP takes of the frames' bytes


@dataclass(frozen=True)
class Picture:
    """An image to embed, with its size in pixels."""

    uri: str
    width: int
    height: int
    floats: str = ""  # its radiance, as encode() makes it
    luminance: tuple[float, float] | None = None  # range of the radiance's luminance


def embed(path: Path) -> Picture:
    """The PNG as it is. @throws ReportError where it is no PNG."""
    data = path.read_bytes()
    return Picture(data_uri(data), *open_png(path, data).size)


def with_floats(picture: Picture, exr: Path) -> Picture:
    """The preview with the radiance of its EXR file. @throws ReportError where that cannot be read."""
    try:
        rgb = exr_pixels.rgb(exr)
    except (OSError, ValueError, KeyError, IndexError, struct.error, zlib.error) as error:
        raise ReportError(f"{exr}: its pixels cannot be read: {error}") from error
    if rgb.shape[:2] != (picture.height, picture.width):
        raise ReportError(f"{exr}: has another size than its preview")
    return replace(picture, floats=encode(rgb), luminance=luminance_range(rgb))


def encode(rgb: np.ndarray) -> str:
    """Half floats, as base64 of a gzip stream. Planes R, G, B one after another as 16-bit patterns; of each the difference
    from the one before (modulo 2^16), zigzag-coded; all upper bytes, then all lower bytes."""
    bits = rgb.clip(-_LARGEST, _LARGEST).astype("<f2").transpose(2, 0, 1).reshape(-1).view("<u2")
    steps = np.diff(bits, prepend=np.zeros(1, "<u2")).view("<i2")
    zigzag = ((steps << 1) ^ (steps >> 15)).astype("<u2")
    planes = (zigzag >> 8).astype(np.uint8).tobytes() + (zigzag & 255).astype(np.uint8).tobytes()
    return base64.b64encode(gzip.compress(planes, 6, mtime=0)).decode("ascii")


def luminance_range(rgb: np.ndarray) -> tuple[float, float] | None:
    """The luminances that all but 0.1 % of the lit pixels at either end lie between; None where all are black."""
    luminance = rgb @ LUMINANCE
    lit = luminance[(luminance > 0) & np.isfinite(luminance)]
    return tuple(np.percentile(lit, _PERCENTILES)) if len(lit) else None


def embed_error(path: Path) -> Picture:
    """An 8-bit grey error map (0 to 1) in false colors. @throws ReportError where it is no PNG."""
    # A palette image stays as small as the grey one.
    palette = Image.fromarray(np.asarray(open_png(path).convert("L")), mode="P")
    palette.putpalette(colors(ERROR_COLORS, np.arange(256)).tobytes())
    return embed_image(palette)


def embed_image(image: Image.Image, kind: str = "PNG", **options) -> Picture:
    """The image as a file of a kind that Pillow writes."""
    out = io.BytesIO()
    image.save(out, kind, **(options or {"optimize": True}))
    return Picture(data_uri(out.getvalue(), f"image/{kind.lower()}"), *image.size)


def frames_of(results: Results, folder: str, light: str) -> list[Path]:
    """The previews of a variant's compared frames, by their number; [] where fewer than two were kept."""
    stem = IMAGES[light][0].removesuffix(".png")
    first = results.image(folder, f"frames/{stem}.0.png")
    if not first:
        return []
    numbered = [(int(match[1]), path) for path in first.parent.iterdir()
                if (match := re.fullmatch(rf"{stem}\.(\d+)\.png", path.name))]
    return [path for _, path in sorted(numbered)] if len(numbered) > 1 else []


def film_bytes(results: Results, folder: str, light: str) -> float:
    """About the size of film()."""
    return _FILM_OF_PNG * sum(path.stat().st_size for path in frames_of(results, folder, light))


def film(paths: list[Path]) -> Picture:
    """The frames as an animated WebP that loops. @throws ReportError where one is no PNG."""
    first, *others = [open_png(path).convert("RGB") for path in paths]
    return embed_image(first, "WEBP", save_all=True, append_images=others, duration=_FILM_MILLISECONDS, loop=0,
                       quality=_FILM_QUALITY)


def colors(name: str, values: np.ndarray) -> np.ndarray:
    """8-bit sRGB of matplotlib's color map `name`, shape (..., 3), for entries of the map or for values from 0 to 1."""
    return (matplotlib.colormaps[name](values)[..., :3] * 255).round().astype(np.uint8)


def gradient(name: str, steps: int = 9) -> str:
    """A color map from 0 to 1 as the stops of a CSS gradient."""
    stops = colors(name, np.linspace(0, 255, steps).astype(int))
    return ", ".join(f"#{r:02x}{g:02x}{b:02x}" for r, g, b in stops)


def open_png(path: Path, data: bytes | None = None) -> Image.Image:
    """A PNG file, or what was read of it, decoded. @throws ReportError where it is no PNG."""
    try:
        image = Image.open(io.BytesIO(path.read_bytes() if data is None else data), formats=("PNG",))
        image.load()
        return image
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise ReportError(f"{path}: is not a whole PNG file") from error
