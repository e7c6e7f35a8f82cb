"""The file of a pack: pack.json says what is in it, with a hash of each other file.

config.json     what was run, with profile, --set and --only in place
original/       the config as it was written
results/        tables and manifest of the run, and of each reference both halves of its total and of its indirect light
scenes/         scenes that are packed, and texts of their licences"""

from __future__ import annotations

import hashlib
import json
import zipfile
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from orchestration.errors import UsageError
from orchestration.packed_scenes import hash_of

FORMAT = 1
RECORD = "pack.json"
_TIME = (1980, 1, 1, 0, 0, 0)  # of all files: equal studies make equal packs


def write(path: Path, record: dict, files: dict[str, Path | str]) -> None:
    """@param files paths or texts by their names in the pack"""
    contents = {name: source.encode() if isinstance(source, str) else source.read_bytes() for name, source in sorted(files.items())}
    record = {"format": FORMAT, **record, "files": {name: hashlib.sha256(data).hexdigest() for name, data in contents.items()}}
    contents = {RECORD: (json.dumps(record, indent=1, ensure_ascii=False) + "\n").encode()} | contents
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(f".{path.name}.tmp")
    with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in contents.items():
            entry = zipfile.ZipInfo(name, _TIME)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    unfinished.replace(path)


@dataclass
class Pack:
    """An unpacked pack. damaged: what is not as it was packed, a line each."""

    folder: Path
    record: dict
    damaged: list[str]

    @property
    def config(self) -> Path:
        return self.folder / "config.json"

    @property
    def results(self) -> Path:
        return self.folder / "results"


def unpack(path: Path, into: Path) -> Pack:
    """@throws UsageError for a file that is no pack"""
    try:
        with zipfile.ZipFile(path) as archive:
            names = archive.namelist()
            for name in names:
                if PurePosixPath(name).is_absolute() or ".." in PurePosixPath(name).parts:
                    raise UsageError(f"{path}: '{name}' would be written elsewhere: no pack of Voxray")
            archive.extractall(into)
        record = json.loads((into / RECORD).read_bytes())
        listed, version = record["files"], record["format"]
    except FileNotFoundError as error:
        raise UsageError(f"{path}: {'no such file' if error.filename == str(path) else f'it has no {RECORD}: no pack of Voxray'}") from error
    except (zipfile.BadZipFile, ValueError, KeyError, TypeError) as error:
        raise UsageError(f"{path}: no pack of Voxray, or a damaged one: {error}") from error
    if version != FORMAT:
        raise UsageError(f"{path}: a pack of format {version}; this Voxray reads format {FORMAT}")
    damaged = [f"{name}: not what was packed" for name, wanted in listed.items()
               if not (into / name).is_file() or hash_of(into / name) != wanted]
    damaged += [f"{name}: added to the pack" for name in names if name not in listed and name != RECORD and not name.endswith("/")]
    return Pack(into, record, damaged)
