"""The compared frames of a sequence as one image that plays in a loop."""

from __future__ import annotations

import io
import re
from pathlib import Path

from report import images, pages
from report.results import IMAGES, Results

_QUALITY = 90  # of WebP, 0 to 100: frames pass by, so that they need not be exact
_MILLISECONDS = 100  # a frame
_PART_OF_PNG = 0.25  # about what WebP takes of the frames' bytes


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
    return _PART_OF_PNG * sum(path.stat().st_size for path in frames_of(results, folder, light))


def film(paths: list[Path]) -> images.Picture:
    """An animated WebP that loops. @throws ReportError where a frame is no PNG."""
    frames = [images.open_png(path).convert("RGB") for path in paths]
    out = io.BytesIO()
    frames[0].save(out, "WEBP", save_all=True, append_images=frames[1:], duration=_MILLISECONDS, loop=0, quality=_QUALITY)
    return images.Picture(pages.data_uri(out.getvalue(), "image/webp"), *frames[0].size)
