"""What `voxray stability` measured: of each scene and method a number, the limit that it is held against, and why it fails."""

from __future__ import annotations

import csv
import functools
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from PIL.Image import Resampling

from report import exr_pixels, verdict
from report.images import open_png
from report.load import load
from report.results import IMAGES, ReportError, Results, interval_of, number
from report.rows import read_rows
from report.verdict import Estimate, magnitude_of, mean_of, root_mean_square_of

_LIMIT_COLUMNS = ("profile", "scene", "measure", "methods", "limit", "scale", "why")
_REASON_COLUMNS = ("scenes", "measures", "methods", "cause")
_CAUSE_COLUMNS = ("cause", "sentence")
UNKNOWN = "not known"


@dataclass(frozen=True)
class Row:
    """A scene and what is measured in it.

    measure: one of MEASURES; "bias@rim" is that of the pixels under the mask "rim".
    limits: beginnings of methods' names, and the limit of these; the last that fits counts.
    scale: the radiance that a leak is a part of, W/(m² sr); how much more light there is than in the profile's first scene; or
    the number of frames in 0.1 s.
    mask_file: image of the mask, masks/NAME.png next to the limits, where there is one; else the run's measure.masks has it.
    """

    profile: str
    scene: str
    measure: str
    limits: tuple[tuple[str, float], ...]
    scale: float
    why: str
    mask_file: Path | None = None

    def limit(self, method: str) -> float:
        return [limit for beginning, limit in self.limits if method.startswith(beginning)][-1]

    @property
    def kind(self) -> str:
        """What is measured, of whichever pixels."""
        return self.measure.partition("@")[0]

    @property
    def mask(self) -> str:
        """The mask under which it is measured; empty: of the whole image."""
        return self.measure.partition("@")[2]


@dataclass(frozen=True)
class Cell:
    """A method in a row. estimate: relative, NaN where the method did not run. picture, truth: PNGs, of what it shows and
    of what it should show, None where there is none. remedies: the value with finer settings, by their name."""

    row: Row
    method: str
    estimate: Estimate
    reason: str
    picture: Path | None
    truth: Path | None
    remedies: tuple[tuple[str, float], ...] = ()

    @property
    def value(self) -> float:
        return self.estimate.value

    @property
    def limit(self) -> float:
        return self.row.limit(self.method)

    @property
    def verdict(self) -> str:
        return verdict.verdict(self.estimate, self.limit)

    @property
    def fails(self) -> bool:
        return self.verdict == verdict.FAILS

    @property
    def over(self) -> float:
        """The value over its limit; infinite where the method did not run."""
        if math.isnan(self.value) or self.limit == 0:
            return math.inf if self.fails else 0.0
        return self.value / self.limit

    @property
    def helping(self) -> list[tuple[str, float]]:
        """Remedies that lower the value by a tenth or more, the best first."""
        return sorted((entry for entry in self.remedies if entry[1] <= 0.9 * self.value), key=lambda entry: entry[1])


@dataclass(frozen=True)
class Seen:
    """A variant with one seed: its row of results.csv, of its last frame in frames.csv (empty where frames are not compared),
    its image, that of the profile's first scene by the same method, and that of its reference (NaN where there is none).
    is_masked: whether images are of the pixels under a mask alone, which scores are not."""

    scores: dict
    last_frame: dict
    image: np.ndarray
    base: np.ndarray
    reference: np.ndarray
    is_masked: bool


def _pixels(path: Path | None) -> np.ndarray:
    """RGB, shape (height, width, 3); NaN where there is no image."""
    return np.full((1, 1, 3), math.nan) if path is None else exr_pixels.rgb(path)


def _under(mask: np.ndarray | None, image: np.ndarray) -> np.ndarray:
    """The pixels under a mask, in a row; an image that is not there stays as it is."""
    return image if mask is None or image.shape[:2] != mask.shape else image[mask][None]


def _mask(results: Results, variant: str, row: Row, size: tuple[int, int]) -> np.ndarray:
    """The pixels under the row's mask, shape (height, width). @throws ReportError where there is no such mask."""
    folder = results.reference_folder(variant)
    path = row.mask_file or (results.image(folder, f"mask.{row.mask}.png") if folder else None)
    if path is None:
        raise ReportError(f"{results.directory}: no mask '{row.mask}': neither masks/{row.mask}.png next to the limits nor a mask of "
                          "measure.masks, which needs a reference")
    picture = open_png(path).convert("L").resize(size[::-1], Resampling.NEAREST)
    return np.asarray(picture) > 127


def _excess(seen: Seen, scale: float) -> float:
    """Of the mean radiance over that in the profile's first scene, over 1."""
    return seen.image.mean() / (scale * seen.base.mean()) - 1


def _difference(seen: Seen, scale: float) -> float:
    image, base = seen.image / scale, seen.base
    return np.sqrt(((image - base) ** 2).mean()) / base.mean() if base.shape == image.shape else math.nan


def _score(column: str) -> Measure:
    """A score that is a root mean square: over seeds, or with its own interval where there is one seed."""
    def estimate(seen: list[Seen], _: float) -> Estimate:
        values = [number(entry.scores.get(column)) for entry in seen]
        own = Estimate(values[0], *interval_of(seen[0].scores, column))
        return own if len(seen) == 1 else root_mean_square_of(values)
    return estimate


def _energy(seen: Seen) -> float:
    """Of the mean radiance over the reference's, over 1."""
    if seen.is_masked:
        return seen.image.mean() / seen.reference.mean() - 1
    return number(seen.scores.get("indirect_mean_ratio")) - 1


def _bias(seen: list[Seen], scale: float) -> Estimate:
    """What the errors of seeds have in common; of one seed the score, for which `second_seed` has to be on, and none under a mask."""
    if len(seen) == 1 and seen[0].is_masked:
        return Estimate(math.nan, math.nan, math.nan)
    if len(seen) == 1:
        return _score("indirect_bias_nrmse")(seen, scale)
    mean = np.mean([entry.reference.mean() for entry in seen])
    return verdict.shared_error_of([(entry.image - entry.reference) / mean for entry in seen])


def _hitch(seen: Seen) -> float:
    return number(seen.scores.get("frame_ms_p95")) / number(seen.scores.get("frame_ms_median")) - 1


# Of a variant with each of its seeds, and the row's scale
Measure = Callable[[list[Seen], float], Estimate]

# What is measured of the indirect light, and what that says.
MEASURES: dict[str, tuple[Measure, str]] = {
    "leak": (lambda seen, scale: magnitude_of([entry.image.mean() / scale for entry in seen]),
             "mean radiance where all is black, over that of the lit side"),
    "energy": (lambda seen, _: magnitude_of([_energy(entry) for entry in seen]),
               "mean radiance over the reference's, less 1, absolute"),
    "bias": (_bias, "error apart from noise, over the reference's mean"),
    "mean": (lambda seen, scale: magnitude_of([_excess(entry, scale) for entry in seen]),
             "mean radiance over that in the profile's first scene, less 1, absolute"),
    "image": (lambda seen, scale: root_mean_square_of([_difference(entry, scale) for entry in seen]),
              "root mean square of the difference from the image of the profile's first scene, over its mean"),
    "drift": (_score("indirect_temporal_bias"), "temporal bias: how much the error grows each frame, over the reference's mean"),
    "afterglow": (lambda seen, scale: mean_of([number(entry.last_frame.get("indirect_frames_lit")) / scale for entry in seen]),
                  "frames in which a light is still seen after it went out, over those of 0.1 s"),
    "hitch": (lambda seen, _: mean_of([_hitch(entry) for entry in seen]),
              "the 95th percentile of the frame's time over its median, less 1"),
    "flicker": (_score("indirect_temporal_flicker"), "temporal flicker: how much the error varies from frame to frame"),
}

# Those of pixels of one image, so that a mask can choose the pixels.
UNDER_MASKS = ("leak", "energy", "bias", "mean", "image")


def _table(path: Path, columns: tuple[str, ...]) -> list[dict[str, str]]:
    try:
        rows = read_rows(path)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ReportError(f"{path}: cannot read: {error}") from error
    if any(tuple(row) != columns or None in row.values() for row in rows):
        raise ReportError(f"{path}: expected the columns {', '.join(columns)}")
    return rows


def read_limits(path: Path) -> list[Row]:
    """@throws ReportError for a table with other columns, an unknown measure, or a row without a limit for all methods."""
    found: dict[tuple[str, ...], Row] = {}
    for entry in _table(path, _LIMIT_COLUMNS):
        key = (entry["profile"], entry["scene"], entry["measure"])
        limit, scale = number(entry["limit"]), number(entry["scale"] or 1)
        kind, at, name = entry["measure"].partition("@")
        if kind not in MEASURES:
            raise ReportError(f"{path}: no measure '{kind}'; one of {', '.join(MEASURES)}")
        if at and kind not in UNDER_MASKS:
            raise ReportError(f"{path}: '{kind}' is of the whole image; under a mask: {', '.join(UNDER_MASKS)}")
        if not limit >= 0 or not scale > 0:
            raise ReportError(f"{path}: {', '.join(key)}: a limit is 0 or more, a scale above 0")
        if key not in found and entry["methods"]:
            raise ReportError(f"{path}: {', '.join(key)}: the first limit is that of all methods")
        before = found[key].limits if key in found else ()
        mask = path.parent / "masks" / f"{name}.png" if at else None
        found[key] = Row(*key, (*before, (entry["methods"], limit)), scale, entry["why"], mask if mask and mask.is_file() else None)
    return list(found.values())


@dataclass(frozen=True)
class Reason:
    """Why cells fail. scenes, measures and beginnings of methods' names; empty: all."""

    scenes: tuple[str, ...]
    measures: tuple[str, ...]
    methods: tuple[str, ...]
    sentence: str

    def fits(self, row: Row, method: str) -> bool:
        return ((not self.scenes or row.scene in self.scenes) and (not self.measures or row.kind in self.measures)
                and (not self.methods or method.startswith(self.methods)))


def read_reasons(path: Path) -> list[Reason]:
    """Known reasons for failing: REASONS.csv names causes, CAUSES.csv next to it has a sentence for each.

    @param path LIMITS_reasons.csv; none where there is no such file. @throws ReportError for a cause without a sentence."""
    if not path.is_file():
        return []
    known = path.with_name(path.name.replace("_reasons", "_causes"))
    sentences = {entry["cause"]: entry["sentence"] for entry in _table(known, _CAUSE_COLUMNS)}
    entries = _table(path, _REASON_COLUMNS)
    lacking = [entry["cause"] for entry in entries if entry["cause"] not in sentences]
    if lacking:
        raise ReportError(f"{path}: {known.name} has no cause '{lacking[0]}'")
    return [Reason(_names(entry["scenes"]), _names(entry["measures"]), _names(entry["methods"]), sentences[entry["cause"]]) for entry in entries]


def _names(listed: str) -> tuple[str, ...]:
    """Names that stand in one field, with semicolons between them."""
    return tuple(name.strip() for name in listed.split(";")) if listed else ()


def reason_of(reasons: list[Reason], row: Row, method: str) -> str:
    """The last reason that fits."""
    fitting = [reason.sentence for reason in reasons if reason.fits(row, method)]
    return fitting[-1] if fitting else UNKNOWN


def _said_of(cell: Cell, reasons: list[Reason]) -> str:
    """Why a cell fails, or what keeps it from being told."""
    low, high = 100 * cell.estimate.low, 100 * cell.estimate.high
    if cell.verdict in (verdict.UNDECIDED, verdict.NOISE):
        return f"{cell.verdict}: the interval of 95 %, {low:.2g} to {high:.2g} %, holds the limit"
    return reason_of(reasons, cell.row, cell.method) if cell.fails else ""


def _profile_cells(results: Results, rows: list[Row], reasons: list[Reason]) -> list[Cell]:
    variants = results.variants.to_dict("records")
    if variants and not {"scene", "method"} <= set(variants[0]):
        raise ReportError(f"{results.directory}: its sweep has no axes 'scene' and 'method'")
    png = IMAGES["indirect"][0]

    @functools.cache
    def pixels(folder: str | None) -> np.ndarray:
        return _pixels(results.image(folder, png.replace(".png", ".exr")) if folder else None)

    def mask_of(variant: str, row: Row) -> np.ndarray | None:
        return _mask(results, variant, row, pixels(variant).shape[:2]) if row.mask else None

    first = {(entry["method"], entry.get("seed")): entry["variant"] for entry in variants if entry["scene"] == variants[0]["scene"]}
    last_frames = {entry["variant"]: entry for entry in results.frames.to_dict("records")}
    seeds: dict[tuple[str, str], list[dict]] = {}
    for entry in variants:
        seeds.setdefault((entry["scene"], entry["method"]), []).append(entry)
    cells = []
    for row in rows:
        for (scene, method), entries in seeds.items():
            if scene != row.scene:
                continue
            failed = [entry["error"] for entry in entries if entry["status"] != "ok"]
            if failed:
                cells.append(Cell(row, method, Estimate(math.nan, math.nan, math.nan), f"does not run: {failed[0]}", None, None))
                continue
            base = [first.get((method, entry.get("seed"))) for entry in entries]
            mask = mask_of(entries[0]["variant"], row)
            seen = [Seen(entry, last_frames.get(entry["variant"], {}),
                         *(_under(mask, pixels(name)) for name in (entry["variant"], first_name, results.reference_folder(entry["variant"]))),
                         mask is not None) for entry, first_name in zip(entries, base)]
            with np.errstate(all="ignore"):
                estimate = MEASURES[row.kind][0](seen, row.scale)
            name = entries[0]["variant"]
            truth = base[0] if row.kind in ("mean", "image") else results.reference_folder(name)
            cell = Cell(row, method, estimate, "", results.image(name, png), results.image(truth, png) if truth else None)
            cells.append(replace(cell, reason=_said_of(cell, reasons)))
    return cells


def with_remedies(cells: list[Cell], directory: Path, rows: list[Row]) -> list[Cell]:
    """The same, with what those that fail are with each remedy, runs in directory/remedies/REMEDY/METHOD/PROFILE."""
    found: dict[tuple[Row, str], list[tuple[str, float]]] = {}
    for folder in sorted((directory / "remedies").glob("*/*")):
        for cell in cells_of(folder, rows, []):
            if not math.isnan(cell.value):
                found.setdefault((cell.row, cell.method), []).append((folder.parent.name.replace("_", " "), cell.value))
    return [replace(cell, remedies=tuple(found.get((cell.row, cell.method), ()))) if cell.fails else cell for cell in cells]


def failing_of(cells: list[Cell]) -> dict[str, dict[str, list[str]]]:
    """The scenes of cells that fail but run, by profile and method."""
    failing: dict[str, dict[str, list[str]]] = {}
    for profile, method, scene in dict.fromkeys((cell.row.profile, cell.method, cell.row.scene) for cell in cells
                                                if cell.fails and not math.isnan(cell.value)):
        failing.setdefault(profile, {}).setdefault(method, []).append(scene)
    return failing


def cells_of(directory: Path, rows: list[Row], reasons: list[Reason]) -> list[Cell]:
    """All cells of the runs in a folder, one folder a profile, in the order of the rows.

    @throws ReportError where one of them has no scenes and methods.
    """
    return [cell for profile in dict.fromkeys(row.profile for row in rows) if (directory / profile / "results.csv").is_file()
            for cell in _profile_cells(load(directory / profile), [row for row in rows if row.profile == profile], reasons)]
