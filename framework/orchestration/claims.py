"""What a study claims: each score of each variant and the brightness of each reference, with the tolerance that follows from
its interval."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from report import exr_pixels
from report.results import LIGHTS, interval_columns
from report.rows import read_rows

NORMAL_95 = 1.959964  # standard errors on either side of a mean, of 95 % of a normal distribution
STATUS = "status"
MEAN, IMAGE = "mean radiance", "error of the image"  # claims of a reference
MEAN_RATIO = "mean_ratio"
LIGHT_OF_FILE = {"final": "total", "indirect": "indirect"}  # what images of a reference show, by their name


@dataclass(frozen=True)
class Claim:
    """A number of a variant or of a reference's light. Found between low and high, it is confirmed; text must be equal."""

    of: str
    what: str
    value: float | str
    low: float | None = None
    high: float | None = None

    def verdict(self, found: float | str | None) -> str:
        """`same`, `within tolerance` or `not`."""
        if found == self.value:
            return "same"
        if found is None or isinstance(found, str) or self.low is None:
            return "not"
        return "within tolerance" if self.low <= found <= self.high else "not"

    def record(self) -> dict:
        return asdict(self)


@dataclass(frozen=True)
class Light:
    """The total or the indirect light of a reference.

    noise: nRMSE of its image that is noise, by its halves. relative_error: standard error of its mean over its mean."""

    mean: float
    noise: float
    relative_error: float


def _halves(folder: Path, light: str) -> tuple[np.ndarray, np.ndarray]:
    a, b = (exr_pixels.rgb(folder / f"{light}_{half}.exr") for half in "ab")
    return a, b


def read_light(folder: Path, light: str, mask: str = "") -> Light:
    """Of a reference's folder. Pixels have random numbers of their own, so that the difference of the halves tells the noise of
    their mean, pixel by pixel. @param light final or indirect. @param mask name of the mask whose pixels count"""
    a, b = _halves(folder, light)
    if mask:
        selected = np.asarray(Image.open(folder / f"mask.{mask}.png").convert("L")) > 0
        a, b = a[selected], b[selected]
    mean, deviation = float((a + b).mean() / 2), (a - b) / 2
    if mean <= 0:
        return Light(mean, 0.0, 0.0)
    of_pixels = deviation.mean(axis=-1)  # Channels share the paths of their pixel: they deviate together
    error = math.sqrt(float((of_pixels**2).sum())) / of_pixels.size
    return Light(mean, math.sqrt(float((deviation**2).mean())) / mean, error / mean)


def reference_claims(folder: Path) -> list[Claim]:
    """Its brightness, as far as noise lets it be known; and that its image has no error but noise."""
    claims = []
    for name, light in LIGHT_OF_FILE.items():
        own, label = read_light(folder, name), f"{folder.name}, {light} light"
        spread = NORMAL_95 * own.relative_error * own.mean
        claims += [Claim(label, MEAN, own.mean, own.mean - spread, own.mean + spread), Claim(label, IMAGE, 0.0, 0.0, own.noise)]
    return claims


def found_of_reference(packed: Path, fresh: Path) -> dict[tuple[str, str], float]:
    """What a new rendering of a reference has in place of reference_claims(), by what they are of and what they say."""
    found = {}
    for name, light in LIGHT_OF_FILE.items():
        (a, b), own = _halves(packed, name), read_light(packed, name)
        c, d = _halves(fresh, name)
        label, image = f"{packed.name}, {light} light", (c + d) / 2
        found[label, MEAN] = read_light(fresh, name).mean
        if image.shape != a.shape:
            found[label, IMAGE] = math.inf
            continue
        # Errors against either half, whose noise is independent; the lower end of the mean's interval
        squares = ((image - a) * (image - b)).mean(axis=-1)
        low = float(squares.mean() - NORMAL_95 * squares.std() / math.sqrt(squares.size))
        found[label, IMAGE] = math.sqrt(max(low, 0.0)) / own.mean if own.mean > 0 else 0.0
    return found


def _tolerance(row: dict[str, str], column: str, reference: dict, folder: Path) -> tuple[float, float] | None:
    """The interval of a score: its own; of the mean ratio, that of the reference's mean; of others by the noise floor, as far as
    a reference with other noise may lie from this one."""
    value = float(row[column])
    low, high = (row.get(name, "") for name in interval_columns(column))
    if low and high:
        return float(low), float(high)
    light = "indirect" if column.startswith(LIGHTS["indirect"]) else "final"
    name, _, mask = column.partition("@")
    metric = name.removeprefix(LIGHTS["indirect"])
    if metric == MEAN_RATIO:
        spread = NORMAL_95 * read_light(folder, light, mask).relative_error * value
        return value - spread, value + spread
    floor = reference.get(f"{column}_noise")
    if not isinstance(floor, (int, float)):
        return None
    if metric == "ssim":
        return value - (1 - floor), value + (1 - floor)
    if metric == "psnr_db":  # As errors, which add up
        error, noise = 10 ** (-value / 20), 10 ** (-floor / 20)
        return -20 * math.log10(error + noise), -20 * math.log10(error - noise) if error > noise else math.inf
    return value - floor, value + floor


def score_columns(row: dict[str, str], manifest: dict) -> list[str]:
    metrics = {entry["name"] for kind in ("metrics", "seed_metrics", "temporal_metrics") for entry in manifest.get(kind, [])}
    return [column for column, value in row.items()
            if value and column.partition("@")[0].removeprefix(LIGHTS["indirect"]) in metrics]


def variant_claims(results: Path, manifest: dict) -> Iterator[Claim]:
    """Whether each variant runs, and its scores in results.csv."""
    references = {variant: entry for entry in manifest.get("references") or [] for variant in entry["variants"]}
    for row in read_rows(results, "results.csv"):
        yield Claim(row["name"], STATUS, row["status"])
        reference = references.get(row["variant"])
        if row["status"] != "ok" or reference is None:
            continue
        for column in score_columns(row, manifest):
            if math.isfinite(value := float(row[column])):
                ends = _tolerance(row, column, reference, results / "images" / reference["folder"])
                yield Claim(row["name"], column, value, *(ends or (None, None)))


def coarsest(claims: list[Claim]) -> float:
    """The largest relative change of brightness that the claims let pass."""
    spreads = [(claim.high - claim.low) / 2 / claim.value for claim in claims
               if claim.low is not None and claim.value and (claim.what == MEAN or claim.what.endswith(MEAN_RATIO))]
    return max(spreads, default=math.inf)


def found_scores(results: Path) -> dict[str, dict[str, float | str]]:
    """What a run found, by variant's name and column."""
    def value(column: str, text: str) -> float | str:
        try:
            return text if column == STATUS else float(text)
        except ValueError:
            return text
    return {row["name"]: {column: value(column, text) for column, text in row.items() if text}
            for row in read_rows(results, "results.csv")}
