"""Scenes that were written for another renderer, and whether two of them are the same."""

from __future__ import annotations

import copy
import functools
import json
import struct
from pathlib import Path

import numpy as np

_ROUNDINGS = 4  # of coordinates as large as the scene's, by which places may differ


def places_of(glb: Path) -> tuple[dict, list[bytes], np.ndarray]:
    """A glTF file without its places, and these: vertices and nodes, shape (count, 3)."""
    data = glb.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    scene, binary = json.loads(data[20:20 + length]), data[20 + length + 8:]
    vertices = {mesh_part["attributes"]["POSITION"] for mesh in scene.get("meshes", []) for mesh_part in mesh["primitives"]}
    views = {scene["accessors"][number]["bufferView"] for number in vertices}
    places = [np.array(node["translation"], float)[None] for node in scene["nodes"] if "translation" in node]
    rest = []
    for number, view in enumerate(scene["bufferViews"]):
        part = binary[view.get("byteOffset", 0):][:view["byteLength"]]
        if number in views:
            places.append(np.frombuffer(part, "<f4").reshape(-1, 3).astype(float))
        else:
            rest.append(part)
    for number in vertices:
        scene["accessors"][number] |= {"min": None, "max": None}
    for node in scene["nodes"]:
        node.pop("translation", None)
    return scene, rest, np.concatenate(places)


class ExportedScene:
    """What tells an exported scene and its view from others, wherever its origin is, since a run renders what is far from the
    world's origin near its own. The rest of a side-car is what is asked of a program."""

    def __init__(self, sidecar: Path) -> None:
        record = json.loads(sidecar.read_text(encoding="utf-8"))
        seen = copy.deepcopy({key: record.get(key) for key in ("image", "camera", "lights", "materials", "environment", "frame")})
        seen["environment"] = (record["environment"] or {}).get("radiance")
        self._camera = np.array(seen["camera"].pop("position"))
        self._lights = np.array([light.pop("position") for light in seen["lights"] if "position" in light]).reshape(-1, 3)
        self._seen, self._record, self._folder = seen, record, sidecar.parent

    @functools.cached_property
    def _scene(self) -> tuple[dict, list[bytes], np.ndarray]:
        return places_of(self._folder / self._record["scene"])

    @functools.cached_property
    def _sky(self) -> bytes:
        name = (self._record["environment"] or {}).get("map")
        return (self._folder / name).read_bytes() if name else b""

    @property
    def _places(self) -> np.ndarray:
        """Relative to the camera."""
        return np.concatenate([self._scene[2], self._lights]) - self._camera

    @property
    def _rounding(self) -> float:
        return _ROUNDINGS * np.spacing(np.float32(np.abs(self._scene[2]).max()))

    def is_as(self, other: ExportedScene) -> bool:
        if self._seen != other._seen or self._sky != other._sky or self._scene[:2] != other._scene[:2]:
            return False
        if self._places.shape != other._places.shape:
            return False
        return bool(np.abs(self._places - other._places).max() <= max(self._rounding, other._rounding))
