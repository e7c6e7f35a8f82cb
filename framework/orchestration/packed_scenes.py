"""The files of scenes in a pack: which ones a config reads, their hashes and their licences."""

from __future__ import annotations

import hashlib
import json
import re
import struct
import urllib.parse
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from orchestration.errors import UsageError

SMALL_BYTES = 1 << 20  # A scene whose files together are not larger is packed without being asked for
_LICENCE_FILE = re.compile(r"(licen[cs]e|copying|copyright)\b", re.I)
_QUOTED = re.compile(r"\"([^\"\n]{1,300})\"|'([^'\n]{1,300})'")
_TEXT_SCENES = (".xml", ".pbrt")  # name their files in quotes, files of their own kind among them
_GLB_MAGIC, _GLB_HEADER = b"glTF", struct.Struct("<4sII I4s")  # magic, version, length; the first chunk's length and type


def hash_of(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def names_in(scene: Any) -> Iterator[str]:
    """The files that the block `scene` of a config names."""
    if isinstance(scene, list):
        for entry in scene:
            yield from names_in(entry)
    if not isinstance(scene, dict):
        return
    for key, value in scene.items():
        if isinstance(value, str) and key in ("file", "map", "environment"):
            if value != "none":
                yield value
        else:
            yield from names_in(value)


def scene_names(variants: Iterable[dict]) -> list[str]:
    """The same of all variants of a plan, each once."""
    return list(dict.fromkeys(name for variant in variants for name in names_in(variant["config"]["scene"])))


def find(name: str, folders: Iterable[str]) -> Path | None:
    """Where the program finds a file. @param folders `scene_folders` of a plan."""
    return next((path for path in (Path(folder) / name for folder in folders) if path.is_file()), None)


def gltf_json(path: Path) -> dict:
    """The JSON of a glTF file, {} where there is none that can be read."""
    try:
        if path.suffix == ".gltf":
            return json.loads(path.read_bytes())
        with open(path, "rb") as file:
            magic, _, _, length, _ = _GLB_HEADER.unpack(file.read(_GLB_HEADER.size))
            return json.loads(file.read(length)) if magic == _GLB_MAGIC else {}
    except (ValueError, struct.error):
        return {}


def _named_by(path: Path) -> list[str]:
    """Names of other files in a scene file, as far as they are in the text."""
    if path.suffix in (".gltf", ".glb"):
        found = gltf_json(path)
        uris = [entry.get("uri", "") for kind in ("buffers", "images") for entry in found.get(kind, [])]
        return [urllib.parse.unquote(uri) for uri in uris if uri and not uri.startswith("data:")]
    if path.suffix in _TEXT_SCENES:
        text = path.read_text(encoding="utf-8", errors="replace")
        return [double or single for double, single in _QUOTED.findall(text)]
    return []


def files_of(path: Path) -> list[Path]:
    """A scene's file, then all that it and those name and that lie in its folder."""
    top = path.parent
    found = {path: None}
    waiting = [path]
    while waiting:
        for name in _named_by(waiting.pop()):
            other = top / name
            if not name.startswith("/") and ".." not in Path(name).parts and other not in found and other.is_file():
                found[other] = None
                waiting.append(other)
    return list(found)


def licence_of(path: Path) -> tuple[str, Path | None]:
    """What a scene's file says of its licence, "" for nothing; and the licence's text in the same folder, if it is there."""
    stated = str(gltf_json(path).get("asset", {}).get("copyright", "")) if path.suffix in (".gltf", ".glb") else ""
    text = next((file for file in sorted(path.parent.iterdir()) if file.is_file() and _LICENCE_FILE.match(file.name)), None)
    return stated or (f"see {text.name}" if text else ""), text


def describe(names: Iterable[str], folders: list[str], licences: dict[str, str], packs_all: bool) -> tuple[list[dict], dict[str, Path]]:
    """An entry for each scene, and the files to pack, by their names in the pack.

    @param licences by name, as the user states them
    @throws UsageError for a file whose name others can't have"""
    entries: list[dict] = []
    packed: dict[str, Path] = {}
    for name in names:
        if Path(name).is_absolute() or ".." in Path(name).parts:
            raise UsageError(f"'{name}': others have no such path: name the file below a folder of scenes, which --scenes says")
        path = find(name, folders)
        if path is None:
            raise UsageError(f"'{name}' is in none of {', '.join(folders)}")
        files = files_of(path)
        stated, text = licence_of(path)
        licence = licences.get(name, stated)
        size = sum(file.stat().st_size for file in files)
        is_packed = packs_all or bool(licence) and size <= SMALL_BYTES
        relative = {file: (Path(name).parent / file.relative_to(path.parent)).as_posix() for file in files}
        entries.append({"name": name, "bytes": size, "licence": licence, "packed": is_packed,
                        "files": {relative[file]: hash_of(file) for file in files}})
        if is_packed:
            packed |= {f"scenes/{relative[file]}": file for file in files}
            if text:
                packed[f"scenes/{(Path(name).parent / text.name).as_posix()}"] = text
    return entries, packed


def differences(entry: dict, folders: list[str]) -> list[str]:
    """How the files of a scene here differ from the packed entry's. @throws UsageError where the scene is not here"""
    path = find(entry["name"], folders)
    if path is None:
        raise UsageError(f"scene '{entry['name']}' is not in the pack and in none of {', '.join(folders)}: name its folder with "
                         f"--scenes; its sha256 is {entry['files'][entry['name']]}; licence: {entry['licence'] or 'not stated'}")
    top = Path(str(path)[:-len(entry["name"])])
    return [f"{name} is {'another' if (top / name).is_file() else 'missing'}" for name, wanted in entry["files"].items()
            if not (top / name).is_file() or hash_of(top / name) != wanted]
