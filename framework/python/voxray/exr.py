"""Writes OpenEXR files for the program to read; `report.exr_pixels` reads those that it writes."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

_FLOAT = 2  # type of pixels: 32 bits


def write(path: Path, rgb: np.ndarray) -> None:
    """rgb: shape (height, width, 3), stored as 32-bit floats, without compression."""
    height, width, _ = rgb.shape
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iiii", _FLOAT, 0, 1, 1) for name in "BGR") + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = b"\x76\x2f\x31\x01" + struct.pack("<i", 2)
    for name, kind, value in (("channels", "chlist", channels), ("compression", "compression", b"\0"), ("dataWindow", "box2i", window),
                              ("displayWindow", "box2i", window), ("lineOrder", "lineOrder", b"\0"),
                              ("pixelAspectRatio", "float", struct.pack("<f", 1)), ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
                              ("screenWindowWidth", "float", struct.pack("<f", 1))):
        header += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    # A line is its number, its bytes, and one channel after another
    lines = np.ascontiguousarray(rgb[..., ::-1].transpose(0, 2, 1), dtype="<f4")
    line_bytes = 8 + lines[0].nbytes
    offsets = struct.pack(f"<{height}Q", *(len(header) + 8 * height + y * line_bytes for y in range(height)))
    body = b"".join(struct.pack("<ii", y, lines[y].nbytes) + lines[y].tobytes() for y in range(height))
    path.write_bytes(header + offsets + body)
