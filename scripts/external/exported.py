"""Hands over images that another renderer left next to the scenes of `voxray stability --export`: the program of its matrix.yaml.

    exported.py SIDECAR

It runs in the export's folder, takes the scene there, and of a sequence the frame, that is what the side-car asks for, and copies its
direct.exr, indirect.exr and time.json. Where there is no indirect.exr it is final.exr, of all light, less direct.exr.
"""

import shutil
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / part) for part in ("framework", "framework/python")]
import voxray.exr  # noqa: E402
from orchestration.exported_scene import ExportedScene  # noqa: E402
from report import exr_pixels  # noqa: E402


def lacking(folder: Path) -> list[str]:
    """Names of images that have to be there and are not."""
    both = [name for name in ("direct.exr", "time.json") if not (folder / name).is_file()]
    either = any((folder / name).is_file() for name in ("indirect.exr", "final.exr"))
    return both if either else [*both, "indirect.exr or final.exr"]


def main(asked: Path) -> None:
    wanted, target = ExportedScene(asked), asked.parent
    folders = [sidecar.parent for sidecar in sorted(Path().rglob("scene.json")) if ExportedScene(sidecar).is_as(wanted)]
    if not folders:
        sys.exit("no scene of this export is the one that is asked for: export the matrix again")
    folder = min(folders, key=lambda found: len(lacking(found)))
    if lacking(folder):
        sys.exit(f"{folder}: lacks {', '.join(lacking(folder))}")
    for name in ("direct.exr", "time.json"):
        shutil.copyfile(folder / name, target / name)
    if (folder / "indirect.exr").is_file():
        shutil.copyfile(folder / "indirect.exr", target / "indirect.exr")
    else:
        voxray.exr.write(target / "indirect.exr", exr_pixels.rgb(folder / "final.exr") - exr_pixels.rgb(folder / "direct.exr"))


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
