#!/usr/bin/python3
"""Writes masks of the stability matrix: pixels of a scene whose surface lies in a part of the floor.

stability_mask.py: all masks of configs/stability/masks

A pixel is under the mask where the centers of its four quarters see the part: the plane y = 0 within a rectangle, which nothing hides.
"""
from pathlib import Path

import numpy as np
from PIL import Image

MASKS = Path(__file__).resolve().parents[1] / "configs" / "stability" / "masks"
WIDTH, HEIGHT = 128, 72
# Of each mask: the camera of its scene (position, target, vertical field of view in degrees), and the corners of its part of the floor,
# (x, z) in metres. `rim`: 10 cm inside the shadow from the far edge of the sunlit patch in `edge of a shadow`, where the sun, 40 degrees
# high and 25 degrees off the window's axis, passes the upper edge of the window (x from -1 to 1, y = 2.2, z = 2 to 2.2) of window_room.
PARTS = {"rim": (((0, 1.2, 0.2), (0.1, 0, -0.4), 45), ((0.108, -0.276), (2.015, -0.176)))}


def floor_points(position: np.ndarray, target: np.ndarray, fov_deg: float, width: int, height: int) -> np.ndarray:
    """Where the rays through the centers of pixels meet y = 0: x and z, shape (height, width, 2); NaN where they don't."""
    forward = (target - position) / np.linalg.norm(target - position)
    right = np.cross(forward, (0, 1, 0))
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    half = np.tan(np.radians(fov_deg) / 2)
    x = ((np.arange(width) + 0.5) / width * 2 - 1) * half * width / height
    y = (1 - (np.arange(height) + 0.5) / height * 2) * half
    rays = forward + x[None, :, None] * right + y[:, None, None] * up
    with np.errstate(all="ignore"):
        distance = np.where(rays[..., 1] < 0, -position[1] / rays[..., 1], np.nan)
    return (position + distance[..., None] * rays)[..., ::2]


def mask(camera: tuple, low: tuple, high: tuple) -> np.ndarray:
    position, target, fov_deg = camera
    points = floor_points(np.array(position, float), np.array(target, float), fov_deg, 2 * WIDTH, 2 * HEIGHT)
    inside = np.all((points >= low) & (points <= high), axis=-1)
    return inside.reshape(HEIGHT, 2, WIDTH, 2).all(axis=(1, 3))


def main() -> None:
    MASKS.mkdir(exist_ok=True)
    for name, (camera, (low, high)) in PARTS.items():
        Image.fromarray(np.where(mask(camera, low, high), 255, 0).astype(np.uint8)).save(MASKS / f"{name}.png")


if __name__ == "__main__":
    main()
