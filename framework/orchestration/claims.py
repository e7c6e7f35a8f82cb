"""What a study claims: each score of each variant and the brightness of each reference, with the tolerance that follows from
its noise."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from statistics import NormalDist

import numpy as np
from PIL import Image

from report import exr_pixels
from report.results import LIGHTS, interval_columns
from report.rows import read_rows

LEVEL = 0.95  # of an interval, and of all tolerances of a study together
STATUS = "status"
MEAN, IMAGE = "mean radiance", "error of the image"  # claims of a reference
MEAN_RATIO = "mean_ratio"
LIGHT_OF_FILE = {"final": "total", "indirect": "indirect"}  # what images of a reference show, by their name


@dataclass(frozen=True)
class Claim:
    """A number of a variant or of a reference's light. Found between low and high, it is confirmed; text must be equal.

    is_interval: low to high is the 95 % interval of this result alone, of which of_two_results() makes a tolerance."""

    of: str
    what: str
    value: float | str
    low: float | None = None
    high: float | None = None
    is_interval: bool = False

    def verdict(self, found: float | str | None) -> str:
        """`same`, `within tolerance` or `not`."""
        if found == self.value:
            return "same"
        if found is None or isinstance(found, str) or self.low is None:
            return "not"
        return "within tolerance" if self.low <= found <= self.high else "not"

    def record(self) -> dict:
        """Of a tolerance."""
        return {key: value for key, value in asdict(self).items() if key != "is_interval"}


def standard_errors(count: int = 1) -> float:
    """How many standard errors on either side of its mean hold a normally distributed number; of `count` such numbers all at
    once, however they depend on each other (Bonferroni)."""
    return NormalDist().inv_cdf(1 - (1 - LEVEL) / (2 * max(count, 1)))


def of_two_results(stated: list[Claim]) -> list[Claim]:
    """Tolerances from the intervals of one result: a result that is noisy by as much, but independent, differs from it by the
    root of 2 times that noise, and all of a study's are to hold at once. An interval without negative numbers gets none."""
    widened = math.sqrt(2) * standard_errors(toleranced(stated)) / standard_errors()

    def tolerance(claim: Claim) -> Claim:
        low = claim.value - widened * max(claim.value - claim.low, 0.0)
        high = claim.value + widened * max(claim.high - claim.value, 0.0)
        return replace(claim, low=low if claim.low < 0 else max(low, 0.0), high=high, is_interval=False)

    return [tolerance(claim) if claim.is_interval else claim for claim in stated]


def toleranced(stated: list[Claim]) -> int:
    return sum(claim.low is not None for claim in stated)


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
        spread = standard_errors() * own.relative_error * own.mean
        claims += [Claim(label, MEAN, own.mean, own.mean - spread, own.mean + spread, is_interval=True),
                   Claim(label, IMAGE, 0.0, 0.0, own.noise)]
    return claims


def found_of_reference(packed: Path, fresh: Path, count: int) -> dict[tuple[str, str], float]:
    """What a new rendering of a reference has in place of reference_claims(), by what they are of and what they say.

    @param count of claims that are to hold at once"""
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
        low = float(squares.mean() - standard_errors(count) * squares.std() / math.sqrt(squares.size))
        found[label, IMAGE] = math.sqrt(max(low, 0.0)) / own.mean if own.mean > 0 else 0.0
    return found


def _score(row: dict[str, str], column: str, reference: dict, folder: Path) -> Claim:
    """A score with its interval: its own, or of the mean ratio that of the reference's mean. Of others it has the noise floor on
    either side, as far as a reference with other noise may lie from this one."""
    value = float(row[column])
    claim = Claim(row["name"], column, value)
    low, high = (row.get(name, "") for name in interval_columns(column))
    if low and high:
        return replace(claim, low=float(low), high=float(high), is_interval=True)
    light = "indirect" if column.startswith(LIGHTS["indirect"]) else "final"
    name, _, mask = column.partition("@")
    metric = name.removeprefix(LIGHTS["indirect"])
    if metric == MEAN_RATIO:
        spread = standard_errors() * read_light(folder, light, mask).relative_error * value
        return replace(claim, low=value - spread, high=value + spread, is_interval=True)
    floor = reference.get(f"{column}_noise")
    if not isinstance(floor, (int, float)):
        return claim
    if metric == "ssim":
        floor = 1 - floor
    if metric == "psnr_db":  # As errors, which add up
        error, noise = 10 ** (-value / 20), 10 ** (-floor / 20)
        return replace(claim, low=-20 * math.log10(error + noise), high=-20 * math.log10(error - noise) if error > noise else math.inf)
    return replace(claim, low=value - floor, high=value + floor)


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
            if math.isfinite(float(row[column])):
                yield _score(row, column, reference, results / "images" / reference["folder"])


def of_study(results: Path, manifest: dict) -> list[Claim]:
    """All that a run claims, with tolerances."""
    folders = [results / "images" / entry["folder"] for entry in manifest["references"]]
    own = [claim for folder in folders for claim in reference_claims(folder)]
    return of_two_results([*own, *variant_claims(results, manifest)])


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
