"""`voxray stability --export`: the still scenes of a matrix as files for another renderer, and a matrix that scores its images."""

from __future__ import annotations

import copy
import csv
import os
from pathlib import Path
from typing import Any

from orchestration.errors import UsageError
from orchestration.program import Program, assignment
from orchestration.yaml_text import yaml_lines
from report.rows import read_rows

STILL = ("leak", "energy", "bias", "mean", "image")  # measures of one image a scene
METHOD = "other renderer"
HANDS_OVER = Path(__file__).resolve().parents[2] / "scripts" / "external" / "exported.py"
_HEADER = """\
# Scores the images of another renderer in the scenes of {source}:
#   ./voxray stability --config {target}
# Each scene's folder has scene.glb and its side-car scene.json; the renderer's direct.exr, indirect.exr and time.json go next to them
# (docs/external.md). Limits are in matrix.csv.
"""


def folder_name(name: str) -> str:
    """A scene's name as that of a folder."""
    return "".join(letter if letter.isalnum() or letter in ".-" else "_" for letter in name)


def _still_rows(limits: Path, profiles: list[str], scenarios: list[str]) -> list[dict[str, str]]:
    rows = [row for row in read_rows(limits) if row["profile"] in profiles]
    moving = {row["profile"] for row in rows if row["measure"] not in STILL}
    return [row for row in rows if row["profile"] not in moving and (not scenarios or row["scene"] in scenarios)]


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


def _matrix(base: dict[str, Any], profiles: dict[str, dict[str, Any]], program: str) -> dict[str, Any]:
    """A config with the other renderer as its one method."""
    images = {"pass": "external", "command": ["/usr/bin/python3", program], "light": "parts", "bounces": base["reference"]["bounces"]}
    scenes = next(iter(profiles.values()))["sweep.scene"]
    sweep = {key: value for key, value in base["sweep"].items() if key == "seed"} | {"scene": scenes, "method": {METHOD: images}}
    return {"name": "exported", "scene": next(iter(scenes.values())), **{key: base[key] for key in ("image", "reference", "measure")},
            "graph": [{**images, "id": "method"}], "sweep": sweep, "profiles": profiles}


def export(program: Program, config: str, limits: Path, profiles: list[str], scenarios: list[str], out: Path) -> int:
    """Writes PROFILE/SCENE/scene.glb with its side-car for each still scene, matrix.yaml and matrix.csv into `out`.

    @return the number of scenes. @throws UsageError where there is none, ProgramEnded where one can't be exported."""
    rows = _still_rows(limits, profiles, scenarios)
    if not rows:
        raise UsageError(f"{limits}: none of these scenes is still")
    written: dict[str, dict[str, Any]] = {}
    for profile in dict.fromkeys(row["profile"] for row in rows):
        own = program.replace(profile=profile)
        plan = own.plan(config)["config"]
        scenes = _scenes(plan, Path(config).parent, {row["scene"] for row in rows if row["profile"] == profile})
        for name, scene in scenes.items():
            folder = out / profile / folder_name(name)
            folder.mkdir(parents=True, exist_ok=True)
            own.export_scene(config, str(folder / "scene.glb"), [assignment("scene", None), assignment("scene", scene)])
        written[profile] = {"reference": plan.get("reference"), "measure": plan["measure"], "sweep.scene": scenes}
    matrix = _matrix(program.replace(profile=None).plan(config)["config"], written, os.path.relpath(HANDS_OVER, out))
    text = _HEADER.format(source=config, target=out / "matrix.yaml") + "\n".join(yaml_lines(matrix)) + "\n"
    (out / "matrix.yaml").write_text(text, encoding="utf-8")
    with open(out / "matrix.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(row for row in rows if not row["methods"])
    return sum(len(own["sweep.scene"]) for own in written.values())
