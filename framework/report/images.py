"""Images as data URIs, and the colours of an error map."""

from __future__ import annotations

import io
from dataclasses import dataclass, replace
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image, UnidentifiedImageError

from report import half_floats
from report.pages import data_uri
from report.results import ReportError

ERROR_COLORS = "magma"  # as FLIP's authors show it: black is no error, light yellow is the largest
LUMINANCE_COLORS = "viridis"
SIGNED_ERROR_COLORS = "RdBu_r"  # blue is too dark, white is right, red is too bright


@dataclass(frozen=True)
class Picture:
    """An image to embed, with its size in pixels."""

    uri: str
    width: int
    height: int
    floats: str = ""  # its radiance, as half_floats.encode() makes it
    luminance: tuple[float, float] | None = None  # range of the radiance's luminance


def embed(path: Path) -> Picture:
    """The PNG as it is. @throws ReportError where it is no PNG."""
    data = path.read_bytes()
    return Picture(data_uri(data), *open_png(path, data).size)


def with_floats(picture: Picture, exr: Path) -> Picture:
    """The preview with the radiance of its EXR file. @throws ReportError where that cannot be read."""
    rgb = half_floats.read(exr)
    if rgb.shape[:2] != (picture.height, picture.width):
        raise ReportError(f"{exr}: has another size than its preview")
    return replace(picture, floats=half_floats.encode(rgb), luminance=half_floats.luminance_range(rgb))


def embed_error(path: Path) -> Picture:
    """An 8-bit grey error map (0 to 1) in false colours. @throws ReportError where it is no PNG."""
    # A palette image stays as small as the grey one.
    grey = open_png(path).convert("L")
    palette = Image.fromarray(np.asarray(grey), mode="P")
    palette.putpalette(colors(ERROR_COLORS, np.arange(256)).tobytes())
    return embed_image(palette)


def embed_image(image: Image.Image) -> Picture:
    """The image as PNG."""
    out = io.BytesIO()
    image.save(out, "PNG", optimize=True)
    return Picture(data_uri(out.getvalue()), *image.size)


def colors(name: str, values: np.ndarray) -> np.ndarray:
    """8-bit sRGB of matplotlib's colour map `name`, shape (..., 3), for entries of the map or for values from 0 to 1."""
    return (matplotlib.colormaps[name](values)[..., :3] * 255).round().astype(np.uint8)


def gradient(name: str, steps: int = 9) -> str:
    """A colour map from 0 to 1 as the stops of a CSS gradient."""
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
