#!/usr/bin/python3
"""Writes an environment map of a clear sky with a sun, over dark ground: an equirectangular EXR file.

sun_sky.py OUT.exr [--towards X Y Z] [--width W]: `towards` is the direction of the sun as seen from the scene. The sky's
radiance is about 1 W/(m² sr); the sun, a disc of 3° across, brings 20 W/m² to a surface that faces it.
"""
import argparse
import struct
import zlib

import numpy

SUN_IRRADIANCE, SUN_RADIUS = 20.0, numpy.radians(1.5)
SUN, ZENITH, HORIZON, GROUND = (1.0, 0.9, 0.75), (0.35, 0.6, 1.2), (1.2, 1.25, 1.3), (0.12, 0.1, 0.08)


def sky(width, towards):
    """Radiance; row 0 is straight up, and the center looks along -Z."""
    height, inner = width // 2, 8  # Samples along each edge of a texel
    rows, columns = numpy.meshgrid((numpy.arange(height * inner) + 0.5) / (height * inner),
                                   (numpy.arange(width * inner) + 0.5) / (width * inner), indexing="ij")
    theta, phi = numpy.pi * rows, 2 * numpy.pi * (columns - 0.5)
    y = numpy.cos(theta)
    directions = numpy.stack((numpy.sin(theta) * numpy.sin(phi), y, -numpy.sin(theta) * numpy.cos(phi)), axis=-1)
    angle = numpy.arccos(numpy.clip(directions @ (towards / numpy.linalg.norm(towards)), -1, 1))
    up = numpy.sqrt(numpy.clip(y, 0, 1))[..., None]
    glow = 1.5 * numpy.exp(-angle / 0.25)[..., None]
    above = (numpy.array(HORIZON) * (1 - up) + numpy.array(ZENITH) * up) * (1 + glow)
    image = numpy.where(y[..., None] > 0, above, numpy.array(GROUND))
    sun = SUN_IRRADIANCE / (2 * numpy.pi * (1 - numpy.cos(SUN_RADIUS)))
    image = image + numpy.where(angle < SUN_RADIUS, sun, 0.0)[..., None] * numpy.array(SUN)
    return image.reshape(height, inner, width, inner, 3).mean(axis=(1, 3))


def exr(image):
    """The bytes of a file of 32-bit floats, compressed by lines (ZIPS)."""
    height, width, _ = image.shape
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    header = b"\x76\x2f\x31\x01" + struct.pack("<i", 2) + b"".join((
        attribute("channels", "chlist", channels), attribute("compression", "compression", b"\2"),
        attribute("dataWindow", "box2i", box), attribute("displayWindow", "box2i", box),
        attribute("lineOrder", "lineOrder", b"\0"), attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)))) + b"\0"
    # 8 bits of each mantissa, which is enough and compresses
    words = (image.astype("<f4").view("<u4") + 0x4000) & 0xffff8000
    lines = []
    for y in range(height):
        data = words[y, :, ::-1].T.tobytes()
        raw = numpy.frombuffer(data[0::2] + data[1::2], numpy.uint8).astype(int)
        raw[1:] = (raw[1:] - raw[:-1] + 128) & 255
        packed = zlib.compress(raw.astype(numpy.uint8).tobytes(), 9)
        packed = packed if len(packed) < len(data) else data
        lines.append(struct.pack("<ii", y, len(packed)) + packed)
    offsets, at = [], len(header) + 8 * height
    for line in lines:
        offsets.append(at)
        at += len(line)
    return header + struct.pack(f"<{height}Q", *offsets) + b"".join(lines)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("--towards", type=float, nargs=3, default=(0.887, 0.289, 0.360))
    parser.add_argument("--width", type=int, default=256)
    arguments = parser.parse_args()
    with open(arguments.out, "wb") as file:
        file.write(exr(sky(arguments.width, numpy.array(arguments.towards))))
