"""Images of linear radiance as pictures."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from PIL import Image
from report import images


def picture(radiance: np.ndarray, stops: float = 0) -> Image.Image:
    """8-bit sRGB of linear radiance, shape (height, width, 3), times 2^stops; clipped, as `image.tone: clip` does."""
    linear = np.clip(radiance * 2**stops, 0, 1)
    srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return Image.fromarray((255 * srgb).round().astype(np.uint8))


def strip(pictures: Mapping[str, Image.Image], width: int = 320) -> str:
    """HTML of pictures side by side, by their captions. width: of each, CSS pixels."""
    figures = (f'<figure style="margin:0"><img src="{images.embed_image(shown).uri}" width="{width}" alt="{caption}">'
               f"<figcaption>{caption}</figcaption></figure>" for caption, shown in pictures.items())
    return f'<div style="display:flex;flex-wrap:wrap;gap:.5em">{"".join(figures)}</div>'


def error_picture(error: np.ndarray) -> Image.Image:
    """An error map, shape (height, width), from 0 (black) to 1 (light yellow)."""
    return Image.fromarray(images.colors(images.ERROR_COLORS, np.clip(error, 0, 1)))
