"""Parts of an error: what of it each stage of a graph brings, by the images of a run of `voxray explain`."""

from __future__ import annotations

import itertools
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from report import exr_pixels
from report.results import ReportError, Results

AXIS = "explained"  # the sweep's key, as orchestration/explain.py writes it
RELMSE_OFFSET = 0.01  # as framework/image/metrics.h has it
_RESAMPLES, _OUTSIDE = 999, 25
_TILE_EDGE, _FEW_TILES = 16, 64  # as framework/image/bootstrap.cpp has them


@dataclass(frozen=True)
class Stage:
    """A stage that was swapped for its counterpart. needs: stages that were swapped along with it."""

    name: str
    cure: str
    needs: tuple[str, ...]
    changes: tuple[str, ...]


@dataclass(frozen=True)
class Part:
    """What a stage brings, in parts of the whole error. low, high: 95 % interval of `share`, the stage swapped alone;
    mean, least, most: over all orders in which the stages can be swapped one after another."""

    stage: Stage
    share: float
    low: float
    high: float
    mean: float
    least: float
    most: float


@dataclass(frozen=True)
class Explained:
    """A squared error and its parts. rest: what the parts, each swapped alone, leave of the whole. left: the error with
    all stages swapped, in parts of the whole."""

    label: str
    whole: float
    parts: tuple[Part, ...]
    rest: float
    rest_low: float
    rest_high: float
    left: float
    errors: dict[frozenset[str], float]

    def ranked(self) -> list[Part]:
        return sorted(self.parts, key=lambda part: -part.share)


@dataclass(frozen=True)
class Images:
    """Indirect light in units of the reference's mean, height x width x 3: of each set of swapped stages, and the
    reference's halves. names: the variant of each set."""

    of: dict[frozenset[str], np.ndarray]
    half_a: np.ndarray
    half_b: np.ndarray
    names: dict[frozenset[str], str]

    @property
    def reference(self) -> np.ndarray:
        return (self.half_a + self.half_b) / 2

    def part(self, stage: Stage) -> np.ndarray:
        """What the stage adds to the image."""
        needs = frozenset(stage.needs)
        return self.of[needs] - self.of[needs | {stage.name}]


def read(results: Results) -> tuple[list[Stage], Images]:
    """@throws ReportError where the folder is not a whole run of `voxray explain`."""
    path = results.directory / "explain.json"
    try:
        listed = json.loads(path.read_text(encoding="utf-8"))
        stages = [Stage(entry["name"], entry["cure"], tuple(entry["needs"]), tuple(entry["changes"]))
                  for entry in listed["stages"]]
        sets = {label: frozenset(names) for label, names in listed["variants"].items()}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise ReportError(f"{path}: cannot be read, so this is no run of voxray explain: {error}") from error
    rows = results.ok.set_index(AXIS)["variant"] if AXIS in results.ok else {}
    missing = [label for label in sets if label not in rows]
    if missing:
        raise ReportError(f"{results.directory}: no finished variant '{missing[0]}'; run it again with --resume")
    names = {chosen: str(rows[label]) for label, chosen in sets.items()}
    folder = results.directory / "images"
    reference = folder / (results.reference_folder(names[frozenset()]) or "reference")
    half_a, half_b = (_pixels(reference / f"indirect_{half}.exr") for half in "ab")
    mean = float((half_a + half_b).mean() / 2)
    if not mean > 0:
        raise ReportError("the reference's indirect light is black: there is no error to explain")
    of = {chosen: _pixels(folder / name / "indirect.exr") / mean for chosen, name in names.items()}
    return stages, Images(of, half_a / mean, half_b / mean, names)


def _pixels(path: Path) -> np.ndarray:
    try:
        return exr_pixels.rgb(path)
    except FileNotFoundError as error:
        raise ReportError(f"{path}: missing: a graph must write 'indirect' for its error to be explained") from error
    except (OSError, ValueError, KeyError) as error:
        raise ReportError(f"{path}: cannot be read: {error}") from error


def squared_nrmse(test: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The squared error of each pixel, freed of the reference's noise: docs/units.md."""
    return ((test - a) * (test - b)).mean(axis=-1)


def relmse(test: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Of each pixel, freed of the reference's noise: docs/units.md."""
    m, d = (a + b) / 2, (a - b) / 2
    e, q = test - m, m * m + RELMSE_OFFSET
    bending = 1 / q + 4 * e * m / q**2 + e * e * (4 * m * m - q) / q**3
    return (e * e / q - bending * d * d).mean(axis=-1)


METRICS = {"relMSE": relmse, "nRMSE²": squared_nrmse}


def explain(stages: list[Stage], images: Images, label: str) -> Explained:
    """Splits one error into parts. @throws ReportError where the reference's noise hides the whole error."""
    maps = {chosen: METRICS[label](image, images.half_a, images.half_b) for chosen, image in images.of.items()}
    errors = {chosen: float(error.mean()) for chosen, error in maps.items()}
    whole = errors[frozenset()]
    if not whole > 0:
        raise ReportError(f"{label}: the reference's noise hides the error: raise reference.spp")

    # Shares of the image, and of images made of its tiles drawn with replacement
    def shares(error_of) -> tuple[np.ndarray, np.ndarray]:
        own = error_of(frozenset())
        parts = np.array([_part(stage, error_of) for stage in stages]) / own
        return parts, 1 - parts.sum(axis=0)

    parts, rest = shares(errors.__getitem__)
    resampled, resampled_rest = shares(_resampled(maps).__getitem__)
    ends = np.sort(resampled, axis=1)[:, [_OUTSIDE - 1, -_OUTSIDE]]
    rest_ends = np.sort(resampled_rest)[[_OUTSIDE - 1, -_OUTSIDE]]
    sequence = _over_orders(stages, errors)
    return Explained(label, whole,
                     tuple(Part(stage, float(share), *map(float, end), float(own.mean()) / whole, min(own) / whole,
                                max(own) / whole)
                           for stage, share, end, own in zip(stages, parts, ends, sequence)),
                     float(rest), *map(float, rest_ends), errors[frozenset(s.name for s in stages)] / whole, errors)


def _part(stage: Stage, error_of):
    needs = frozenset(stage.needs)
    return error_of(needs) - error_of(needs | {stage.name})


def _over_orders(stages: list[Stage], errors: dict[frozenset[str], float]) -> list[np.ndarray]:
    """The part of each stage in each order in which stages come after those that they need."""
    found: dict[str, list[float]] = {stage.name: [] for stage in stages}
    for order in itertools.permutations(found):
        before = [frozenset(order[:i]) for i in range(len(order) + 1)]
        if all(chosen in errors for chosen in before):
            for name, was, now in zip(order, before, before[1:]):
                found[name].append(errors[was] - errors[now])
    return [np.array(values) for values in found.values()]


def _resampled(maps: dict[frozenset[str], np.ndarray]) -> dict[frozenset[str], np.ndarray]:
    """Means of each map over tiles drawn with replacement, the same ones of all maps."""
    height, width = next(iter(maps.values())).shape
    edge = min(max(int((height * width / _FEW_TILES) ** 0.5), 1), _TILE_EDGE)
    rows, columns = np.arange(0, height, edge), np.arange(0, width, edge)

    def tiles(error: np.ndarray) -> np.ndarray:
        return np.add.reduceat(np.add.reduceat(error, rows, axis=0), columns, axis=1).ravel()

    count = tiles(np.ones((height, width)))
    drawn = np.random.default_rng(1).integers(len(count), size=(_RESAMPLES, len(count)))
    size = count[drawn].sum(axis=1)
    return {chosen: tiles(error)[drawn].sum(axis=1) / size for chosen, error in maps.items()}


def sentence(explained: Explained) -> str:
    """The largest part, and what to do about it."""
    first = explained.ranked()[0]
    return (f"{percent(first.share)} of {explained.label} is the {first.stage.name}: {first.stage.cure} "
            f"({', '.join(first.stage.changes)}).")


def percent(share: float) -> str:
    return f"{round(100 * share)} %".replace("-", "−")
