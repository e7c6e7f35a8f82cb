"""Writes OpenEXR files as Voxray does, for tests of what reads them."""
import struct
import zlib

import numpy


def exr(image, zipped, names=("B", "G", "R")):
    """The bytes of an OpenEXR file; `image` has the shape (height, width, channels), the last channel that of the first
    name. Names are sorted, as the format wants it."""
    height, width, _ = image.shape
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    channels = b"".join(name.encode() + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) for name in names) + b"\0"
    header = (b"\x76\x2f\x31\x01" + struct.pack("<i", 2) + attribute("channels", "chlist", channels) +
              attribute("compression", "compression", bytes([3 if zipped else 0])) +
              attribute("dataWindow", "box2i", struct.pack("<4i", 0, 0, width - 1, height - 1)) + b"\0")
    lines = 16 if zipped else 1
    blocks = []
    for y in range(0, height, lines):
        data = image[y:y + lines, :, ::-1].transpose(0, 2, 1).astype("<f4").tobytes()
        if zipped:
            raw = numpy.frombuffer(data[0::2] + data[1::2], numpy.uint8).astype(int)
            raw[1:] = (raw[1:] - raw[:-1] + 128) & 255
            packed = zlib.compress(raw.astype(numpy.uint8).tobytes())
            data = packed if len(packed) < len(data) else data
        blocks.append(struct.pack("<ii", y, len(data)) + data)
    offsets, at = [], len(header) + 8 * len(blocks)
    for block in blocks:
        offsets.append(at)
        at += len(block)
    return header + struct.pack(f"<{len(blocks)}Q", *offsets) + b"".join(blocks)
