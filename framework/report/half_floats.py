"""Radiance of EXR files as half floats for the page, which pixels.js decodes."""

from __future__ import annotations

import base64
import gzip
import struct
import zlib
from pathlib import Path

import numpy as np

from report import exr_pixels
from report.results import ReportError

BYTES_OF_EXR = 0.3  # about what half floats take of the bytes of a float32 EXR file
_LARGEST = 65504.0  # of half floats
_LUMINANCE = (0.2126, 0.7152, 0.0722)  # Rec. 709
_PERCENTILES = (0.1, 99.9)


def read(path: Path) -> np.ndarray:
    """R, G and B, shape (height, width, 3). @throws ReportError where the file is no whole EXR file of these channels."""
    try:
        return exr_pixels.rgb(path)
    except (OSError, ValueError, KeyError, IndexError, struct.error, zlib.error) as error:
        raise ReportError(f"{path}: its pixels cannot be read: {error}") from error


def encode(rgb: np.ndarray) -> str:
    """Base64 of a gzip stream. Planes R, G, B one after another as 16-bit patterns of half floats; of each the difference
    from the one before (modulo 2^16), zigzag-coded; all upper bytes, then all lower bytes."""
    bits = rgb.clip(-_LARGEST, _LARGEST).astype("<f2").transpose(2, 0, 1).reshape(-1).view("<u2")
    steps = np.diff(bits, prepend=np.zeros(1, "<u2")).view("<i2")
    zigzag = ((steps << 1) ^ (steps >> 15)).astype("<u2")
    planes = (zigzag >> 8).astype(np.uint8).tobytes() + (zigzag & 255).astype(np.uint8).tobytes()
    return base64.b64encode(gzip.compress(planes, 6, mtime=0)).decode("ascii")


def luminance_range(rgb: np.ndarray) -> tuple[float, float] | None:
    """The luminances that all but 0.1 % of the lit pixels at either end lie between; None where all are black."""
    luminance = rgb @ _LUMINANCE
    lit = luminance[(luminance > 0) & np.isfinite(luminance)]
    return tuple(np.percentile(lit, _PERCENTILES)) if len(lit) else None
