"""`voxray stability --export`: the scenes of a matrix as files for another renderer, and a matrix that scores its images."""

from __future__ import annotations

import copy
import csv
import os
import shutil
from pathlib import Path
from typing import Any

from orchestration.errors import UsageError
from orchestration.exported_scene import ExportedScene
from orchestration.program import Program, assignment
from orchestration.yaml_text import yaml_lines
from report.rows import read_rows

STILL = ("leak", "energy", "bias", "mean", "image")  # measures of one image a scene
METHOD = "other renderer"
HANDS_OVER = Path(__file__).resolve().parents[2] / "scripts" / "external" / "exported.py"
_HEADER = """\
# Scores the images of another renderer in the scenes of {source}:
#   ./voxray stability --config {target}
# Each scene's folder, or that of each of its frames, has scene.glb and its side-car scene.json; the renderer's direct.exr,
# indirect.exr and time.json go next to them (docs/external.md). Limits are in matrix.csv, masks in masks.
"""


def folder_name(name: str) -> str:
    """A scene's name as that of a folder."""
    return "".join(letter if letter.isalnum() or letter in ".-" else "_" for letter in name)


def _rows(limits: Path, profiles: list[str], scenarios: list[str]) -> list[dict[str, str]]:
    return [row for row in read_rows(limits) if row["profile"] in profiles and (not scenarios or row["scene"] in scenarios)]


def _next_to(scene: dict[str, Any], folder: Path) -> dict[str, Any]:
    """The scene with files that are relative to the folder written whole."""
    whole = copy.deepcopy(scene)
    environment = whole.get("environment")
    for owner, key in ((whole, "file"), (whole, "environment"), (environment, "map")):
        if isinstance(owner, dict) and isinstance(owner.get(key), str) and (folder / owner[key]).is_file():
            owner[key] = str((folder / owner[key]).resolve())
    return whole


def _scenes(plan: dict[str, Any], folder: Path, wanted: set[str]) -> dict[str, dict[str, Any]]:
    """Of a profile, the first scene, which others are compared with, and those that are wanted."""
    scenes = plan["sweep"]["scene"]
    return {name: _next_to(scene, folder) for name, scene in scenes.items() if name in wanted or name == next(iter(scenes))}


def _frames(plan: dict[str, Any], rows: list[dict[str, str]], profile: str) -> int:
    """How many frames of each scene are measured: 1 in a profile that has measures of one image alone."""
    if all(row["measure"].partition("@")[0] in STILL for row in rows if row["profile"] == profile):
        return 1
    if "frames" not in plan.get("measure", {}):
        raise UsageError(f"{plan['name']}: profile '{profile}' is a sequence: write measure.frames, so that all of them are exported")
    return plan["measure"]["frames"]


def _images(bounces: int, program: str, frames: int) -> dict[str, Any]:
    """The pass that takes the other renderer's images."""
    found = {"pass": "external", "command": ["/usr/bin/python3", program], "light": "parts", "bounces": bounces}
    return {**found, "each_frame": True} if frames > 1 else found


def _profile(plan: dict[str, Any], scenes: dict[str, Any], images: dict[str, Any]) -> dict[str, Any]:
    """What a profile changes. Warm-up is the other renderer's own: it is asked for measured frames alone."""
    return {"reference": plan.get("reference"), "measure": {**plan.get("measure", {}), "warmup": 0}, "sweep.scene": scenes,
            **({"sweep.seed": plan["sweep"]["seed"]} if "seed" in plan["sweep"] else {}), "sweep.method": {METHOD: images}}


def _matrix(base: dict[str, Any], profiles: dict[str, dict[str, Any]], images: dict[str, Any]) -> dict[str, Any]:
    """A config with the other renderer as its one method."""
    scenes = next(iter(profiles.values()))["sweep.scene"]
    sweep = {key: value for key, value in base["sweep"].items() if key == "seed"} | {"scene": scenes, "method": {METHOD: images}}
    return {"name": "exported", "scene": next(iter(scenes.values())), **{key: base[key] for key in ("image", "reference", "measure")},
            "graph": [{**images, "id": "method"}], "sweep": sweep, "profiles": profiles}


def _export_scene(program: Program, config: str, folder: Path, scene: dict[str, Any], frames: int) -> None:
    """Into the folder, or where there are several frames into its folders frame_000 and so on."""
    changes = [assignment("scene", None), assignment("scene", scene)]
    for frame in range(frames):
        own = folder / f"frame_{frame:03}" if frames > 1 else folder
        own.mkdir(parents=True, exist_ok=True)
        program.export_scene(config, str(own / "scene.glb"), changes, frame if frames > 1 else None)


def _without_repeats(folder: Path, scenes: dict[str, Any]) -> dict[str, Any]:
    """Still scenes without those that are an earlier one again, as the program of `external` sees them: their files are removed."""
    kept: dict[str, Any] = {}
    seen: list[ExportedScene] = []
    for name, scene in scenes.items():
        own = ExportedScene(folder / folder_name(name) / "scene.json")
        if any(own.is_as(other) for other in seen):
            shutil.rmtree(folder / folder_name(name))
        else:
            kept[name] = scene
            seen.append(own)
    return kept


def _write_table(out: Path, limits: Path, rows: list[dict[str, str]]) -> None:
    """matrix.csv, and the masks that it names."""
    with open(out / "matrix.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    for name in dict.fromkeys(row["measure"].partition("@")[2] for row in rows):
        mask = limits.parent / "masks" / f"{name}.png"
        if mask.is_file():
            (out / "masks").mkdir(exist_ok=True)
            shutil.copyfile(mask, out / "masks" / mask.name)


def export(program: Program, config: str, limits: Path, profiles: list[str], scenarios: list[str], out: Path) -> int:
    """Writes PROFILE/SCENE/scene.glb with its side-car for each scene, or PROFILE/SCENE/frame_000/scene.glb and so on for each
    frame of a sequence, and matrix.yaml, matrix.csv and masks, into `out`.

    @return the number of scenes. @throws UsageError where there is none, ProgramEnded where one can't be exported."""
    rows = _rows(limits, profiles, scenarios)
    if not rows:
        raise UsageError(f"{limits}: has no limit for these scenes")
    hands_over = os.path.relpath(HANDS_OVER, out)
    base = program.replace(profile=None).plan(config)["config"]
    bounces = base["reference"]["bounces"]
    written: dict[str, dict[str, Any]] = {}
    for profile in dict.fromkeys(row["profile"] for row in rows):
        own = program.replace(profile=profile)
        plan = own.plan(config)["config"]
        scenes = _scenes(plan, Path(config).parent, {row["scene"] for row in rows if row["profile"] == profile})
        frames = _frames(plan, rows, profile)
        for name, scene in scenes.items():
            _export_scene(own, config, out / profile / folder_name(name), scene, frames)
        kept = scenes if frames > 1 else _without_repeats(out / profile, scenes)
        written[profile] = _profile(plan, kept, _images(bounces, hands_over, frames))
    matrix = _matrix(base, written, _images(bounces, hands_over, 1))
    text = _HEADER.format(source=config, target=out / "matrix.yaml") + "\n".join(yaml_lines(matrix)) + "\n"
    (out / "matrix.yaml").write_text(text, encoding="utf-8")
    _write_table(out, limits, [row for row in rows if not row["methods"] and row["scene"] in written[row["profile"]]["sweep.scene"]])
    return sum(len(own["sweep.scene"]) for own in written.values())
