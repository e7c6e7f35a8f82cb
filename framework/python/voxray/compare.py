"""Scores of images as `./voxray compare` says them."""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path
from typing import Protocol

import numpy as np
import pandas as pd

from voxray import exr
from voxray.errors import VoxrayError
from voxray.results import LIGHTS, Reference, Results, Variant
from voxray.session import PROGRAM


class Images(Protocol):
    """Both lights, such as a rendering has: radiance, shape (height, width, 3); None where one is not there."""

    final: np.ndarray | None
    indirect: np.ndarray | None


Image = str | Path | np.ndarray | Images | Variant | Reference
TIE = "≈"  # as in a report


def score(image: Image, reference: Image | None = None, *, light: str | None = None, exposure_stops: float | None = None) -> pd.DataFrame:
    """Every score of an image against a reference, as `./voxray compare` says them.

    Rows are metrics. Columns: value; low and high, the ends of its 95 % interval, where the reference's halves are known (those of
    a run, and of a file X.exr with X_a.exr and X_b.exr next to it): its noise is then taken off nRMSE and relMSE; black,
    constant: what these images score; noise: about what a perfect image scores. `attrs["better"]`: the direction of each metric.

    @param image a file, an array (linear radiance, shape (height, width, 3)), a rendering, or a variant of a run
    @param reference likewise; None: what the variant was compared with in its run
    @param light "total" or "indirect", of renderings and variants; None: the indirect light where there is one
    @param exposure_stops of SSIM, PSNR and LDR-FLIP; None: a variant's own, else 0
    @throws VoxrayError where sizes differ, or there is no reference
    """
    if reference is None:
        reference = _shared_reference([image], light)
    if exposure_stops is None:
        exposure_stops = image.results.manifest["exposure_stops"] if isinstance(image, Variant) else 0
    with tempfile.TemporaryDirectory(prefix="voxray-") as folder:
        files = [_file(given, light, Path(folder) / name) for given, name in ((image, "image.exr"), (reference, "reference.exr"))]
        done = subprocess.run([str(PROGRAM), "compare", *map(str, files), "--json", "--exposure", str(exposure_stops)], capture_output=True,
                              text=True, check=False)
    if done.returncode:
        raise VoxrayError(done.stderr.strip().splitlines()[-1].removeprefix("voxray: error: "))
    return _table(json.loads(done.stdout))


def compare(a: Image | Results, b: Image | Results, reference: Image | None = None, *, light: str | None = None,
            exposure_stops: float | None = None) -> pd.DataFrame:
    """Every score of two images against one reference, side by side, with its interval, as `./voxray compare` says them.

    Rows are metrics, of two runs (variant, metric) for each variant that both have. Columns: a, a_low, a_high, b, b_low, b_high as
    value, low and high of score(), and better: "a", "b", or ≈ where the intervals overlap or, without intervals, both reach the
    noise that a perfect image has, or they are equal.

    @param a, b images as of score(), or results of two runs
    @param reference None: what the variants were compared with in their runs
    @throws VoxrayError where sizes differ, or the reference is not known, or not the same for both
    """
    if isinstance(a, Results) and isinstance(b, Results):
        both = [variant for variant in a.ok["variant"] if variant in set(b.ok["variant"])]
        if not both:
            raise VoxrayError(f"{a.directory} and {b.directory} have no variant in common; compare two of them: results[\"{a.ok['variant'].iloc[0]}\"]")
        return pd.concat({variant: compare(a[variant], b[variant], reference, light=light, exposure_stops=exposure_stops) for variant in both},
                         names=["variant"])
    shared = _shared_reference([a, b], light) if reference is None else reference
    first, second = (score(image, shared, light=light, exposure_stops=exposure_stops) for image in (a, b))
    table = pd.concat([scores[["value", "low", "high"]].set_axis([name, f"{name}_low", f"{name}_high"], axis=1)
                       for name, scores in (("a", first), ("b", second))], axis=1)
    better = first.attrs["better"]
    return table.assign(better=[_better(first.loc[metric], second.loc[metric], better[metric]) for metric in table.index])


def _table(said: dict) -> pd.DataFrame:
    """What the command prints as JSON."""
    names = list(said["better"])
    columns = {"value": said["scores"], **{end: {name: said["scores"].get(f"{name}_{end}") for name in names} for end in ("low", "high")},
               **{other: said.get(other, {}) for other in ("black", "constant", "noise")}}
    table = pd.DataFrame({column: [scores.get(name) for name in names] for column, scores in columns.items()}, index=pd.Index(names, name="metric"),
                         dtype=float)
    table.attrs["better"] = said["better"]
    return table


def _shared_reference(given: list[Image], light: str | None) -> Reference:
    """That of the variants among them."""
    variants = [image for image in given if isinstance(image, Variant)]
    references = [variant.results.reference_of(variant.id) or {} for variant in variants]
    if len({record.get("hash") for record in references}) > 1:
        raise VoxrayError(f"{variants[0].id} and {variants[1].id} were compared with different references: give one")
    found = variants[0].reference(light) if variants else None
    if found is None:
        raise VoxrayError("no reference to compare with: give one")
    return found


def _better(a: pd.Series, b: pd.Series, direction: str) -> str:
    if a[["low", "high"]].notna().all() and b[["low", "high"]].notna().all():
        is_tie = a["low"] <= b["high"] and b["low"] <= a["high"]
    else:
        reach_noise = [_rank(one["value"], direction) <= _rank(one["noise"], direction) for one in (a, b)]
        is_tie = all(reach_noise) or a["value"] == b["value"]
    return TIE if is_tie else "a" if _rank(a["value"], direction) < _rank(b["value"], direction) else "b"


def _rank(value: float, direction: str) -> float:
    """Lower is better."""
    return {"low": value, "high": -value, "one": abs(value - 1)}[direction]


def _file(image: Image, light: str | None, path: Path) -> Path:
    """The image as a file: its own, or one that is written to `path`."""
    if isinstance(image, (str, Path)):
        return Path(image)
    if isinstance(image, Reference):
        return image.file
    if isinstance(image, Variant):
        image.image(light)  # where there is none it says so
        return image.file(light)
    if not isinstance(image, np.ndarray):
        name = LIGHTS[light or ("total" if image.indirect is None else "indirect")]
        image = getattr(image, name)
        if image is None:
            raise VoxrayError(f"there is no image '{name}'")
    exr.write(path, image)
    return path
