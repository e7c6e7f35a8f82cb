"""Reads the pixels of OpenEXR files as Voxray writes them: one part, scan lines, no compression or ZIP."""
import struct
import zlib

import numpy

PIXEL_TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
LINES_OF_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP


def _unzip(data):
    """Undoes ZIP: deflate, differences of neighboring bytes, then even bytes before odd ones."""
    raw = numpy.frombuffer(zlib.decompress(data), numpy.uint8)
    steps = raw.astype(numpy.int64)
    steps[1:] -= 128
    raw = (numpy.cumsum(steps) & 255).astype(numpy.uint8)
    out = numpy.empty_like(raw)
    half = (len(raw) + 1) // 2
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return out.tobytes()


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def _header(data):
    """Attributes by name, as raw bytes, and where they end."""
    if data[:4] != b"\x76\x2f\x31\x01" or data[5] & 0x1A:
        raise ValueError("not an OpenEXR file of one part with scan lines")
    attributes, at = {}, 8
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def rgb(path):
    """R, G and B in double precision, shape (height, width, 3). Raises as read(), KeyError where one of them is missing."""
    channels = read(path)
    return numpy.stack([channels[name].astype(float) for name in "RGB"], axis=-1)


def read(path):
    """Channels by name, each of shape (height, width). Raises ValueError for files of another kind."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = _header(data)
    compression = attributes["compression"][0]
    if compression not in LINES_OF_BLOCK:
        raise ValueError(f"{path}: compression {compression}; only none and ZIP are read")
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1

    types, i = [], 0
    while attributes["channels"][i]:
        name, i = _text(attributes["channels"], i)
        types.append((name, PIXEL_TYPES[struct.unpack_from("<i", attributes["channels"], i)[0]], (width,)))
        i += 16

    line, step, blocks = numpy.dtype(types), LINES_OF_BLOCK[compression], []
    for offset in struct.unpack_from(f"<{-(-height // step)}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        block = data[offset + 8:offset + 8 + size]
        blocks.append(_unzip(block) if size < min(step, y1 + 1 - y) * line.itemsize else block)
    lines = numpy.frombuffer(b"".join(blocks), line)
    return {name: lines[name] for name, *_ in types}
