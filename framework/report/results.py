"""The results of a run, as load() reads them."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pandas as pd

from report import text


class ReportError(Exception):
    """What keeps a report from being made: one line, what is wrong and what to do."""


@dataclass(frozen=True)
class Metric:
    """One measure of an image against the reference, as the manifest lists it. `better`: "low", "high"
    or "one", closer to 1. One that has an interval is freed of the reference's noise."""

    key: str
    label: str
    unit: str
    better: str
    meaning: str
    has_interval: bool = False

    def rank(self, value: float) -> float:
        """A number that is lower where `value` is better, 0 or more for errors; NaN stays NaN."""
        if self.better == "high":
            return -value
        return abs(value - 1.0) if self.better == "one" else value


LIGHTS = {"total": "", "indirect": "indirect_"}  # name -> column prefix
INTERVAL = ("_low", "_high")  # what columns of the ends of a 95 % confidence interval add to the metric's name
IMAGES = {"total": ("final.png", "flip.png"), "indirect": ("indirect.png", "indirect_flip.png")}
BASELINES = ("black", "constant")


@dataclass
class Results:
    """A run's results.

    variants: one row for each variant, columns as in results.csv; costs and scores are floats (NaN where absent),
        everything else text as written. Ordered as the run wrote them.
    numbers, names: the number of each variant in the table, and what it is called.
    passes: one row for each variant, pass and phase, as in passes.csv, and the `kind` of the pass that has this id in
        the variant's graph; may be empty.
    frames: one row for each variant and compared frame, as in frames.csv, scores in columns; may be empty.
    values: one row for each variant, pass, name and frame, as in values.csv: what passes reported; frame is NaN in the
        build; may be empty.
    manifest: the run's manifest.json.
    metrics: the manifest's list, in the order in which tables show them; the first ones are charted.
    seed_metrics: likewise, bias and noise of nRMSE apart, of runs with a second seed.
    temporal_metrics: likewise, of differences of successive frames; the first one is of each frame too.
    sweep_keys: the columns of `variants` that the sweep varied.
    warnings: the run's own, and what was odd in the files.
    """

    directory: Path
    variants: pd.DataFrame
    numbers: dict[str, str]
    names: dict[str, str]
    passes: pd.DataFrame
    values: pd.DataFrame
    frames: pd.DataFrame
    manifest: dict
    metrics: tuple[Metric, ...]
    seed_metrics: tuple[Metric, ...]
    temporal_metrics: tuple[Metric, ...]
    sweep_keys: list[str]
    warnings: list[str] = field(default_factory=list)

    @functools.cached_property
    def ok(self) -> pd.DataFrame:
        """The variants that finished."""
        return self.variants[self.variants["status"] == "ok"]

    def only(self, variants: Iterable[str]) -> Results:
        """The same run with these variants alone."""
        chosen = set(variants)
        tables = {"variants": self.variants, "passes": self.passes, "values": self.values, "frames": self.frames}
        return replace(self, **{name: table[table["variant"].isin(chosen)] for name, table in tables.items()})

    def full(self, variant: str) -> str:
        """Number and name, as sentences call it."""
        return f"{self.numbers[variant]} ({self.names[variant]})"

    def listed(self, variants: list[str], limit: int = 6) -> str:
        """Several variants by their numbers, up to three by their names too."""
        if len(variants) <= 3:
            return text.joined(map(self.full, variants))
        numbers = [self.numbers[name] for name in variants]
        return text.first(numbers, limit) if len(numbers) > limit else text.joined(numbers)

    @property
    def missing(self) -> list[str]:
        """The variants that the manifest plans and that have no row, in its order."""
        known = set(self.variants["variant"])
        return [name for name in section(self.manifest, "variants") if name not in known]

    def sessions(self) -> list[tuple[str, list[str]]]:
        """When each process that measured finished variants began (UTC), and these variants. More than one where the run was
        resumed."""
        finished = set(self.ok["variant"])
        found = [(entry["started"], [name for name in entry["variants"] if name in finished])
                 for entry in self.manifest.get("sessions", [])]
        return [(began, names) for began, names in found if names]

    def lights(self) -> list[str]:
        """Which of "total" and "indirect" have any score or image, always with "total"."""
        columns = [LIGHTS["indirect"] + metric.key for metric in self.metrics]
        has_indirect = self.ok[columns].notna().any(axis=None) or any(
            self.image(folder, IMAGES["indirect"][0]) for folder in ["reference", *self.ok["variant"]])
        return ["total", "indirect"] if has_indirect else ["total"]

    @functools.cached_property
    def references(self) -> list[dict]:
        """The records of the run's references; more than one where the sweep varies what is lit or seen."""
        return self.manifest.get("references") or [section(self.manifest, "reference")]

    def reference_of(self, variant: str) -> dict | None:
        """The record of a variant's reference, None where several are and none names the variant."""
        return self.references[0] if len(self.references) == 1 else self._references_by_variant.get(variant)

    @functools.cached_property
    def _references_by_variant(self) -> dict[str, dict]:
        return {variant: record for record in reversed(self.references) for variant in record["variants"]}

    def reference_folder(self, variant: str) -> str | None:
        """The folder below images/ of a variant's reference, None where it is unknown."""
        record = self.reference_of(variant)
        return None if record is None else folder_of(record)

    def graph_of(self, variant: str) -> list[dict]:
        """The passes of a variant with their parameters, as the manifest lists them."""
        return section(self.manifest, "variants").get(variant, [])

    def noise(self, column: str, reference: dict | None) -> float:
        """About what a perfect image scores against a noisy reference, NaN where the score is freed of noise."""
        return number((reference or {}).get(column + "_noise"))

    def baseline(self, name: str, column: str, reference: dict | None) -> float:
        """What the "black" or the "constant" image scores against a reference, NaN where it was not measured."""
        return number(self.baseline_scores(name, reference).get(column))

    def baseline_scores(self, name: str, reference: dict | None) -> dict:
        """All scores of the "black" or the "constant" image against a reference."""
        own = section(reference or {}, "baselines")
        if not own and len(self.references) == 1:
            own = section(self.manifest, "baselines")
        return section(own, name)

    @property
    def only_reference(self) -> dict | None:
        """The reference that all variants share, None where they have several."""
        return self.references[0] if len(self.references) == 1 else None

    def image(self, folder: str, name: str) -> Path | None:
        """images/<folder>/<name>, None where there is no such file inside the run's images folder."""
        images = (self.directory / "images").resolve()
        try:
            path = (images / folder / name).resolve()
            return path if path.is_file() and images in path.parents else None
        except (OSError, ValueError):  # a name too long, or with a NUL, names no file
            return None


def interval_columns(column: str) -> tuple[str, str]:
    """The columns of the ends of a score's interval; a mask's name stays last."""
    name, at, mask = column.partition("@")
    return name + INTERVAL[0] + at + mask, name + INTERVAL[1] + at + mask


def interval_of(scores, column: str) -> tuple[float, float]:
    """The ends of a score's interval, out of a row or of a baseline's scores; the score itself where there is none."""
    value = number(scores.get(column))
    ends = [number(scores.get(name)) for name in interval_columns(column)]
    return (ends[0], ends[1]) if all(map(math.isfinite, ends)) else (value, value)


def interval_ends(table: pd.DataFrame, column: str) -> tuple[pd.Series, pd.Series]:
    """The ends of each row's interval, as interval_of() finds them."""
    value = table[column]
    low, high = (table[name] if name in table else value for name in interval_columns(column))
    are_known = np.isfinite(low) & np.isfinite(high)
    return low.where(are_known, value), high.where(are_known, value)


def folder_of(reference: dict) -> str:
    """The folder below images/ of a reference's record."""
    return str(reference.get("folder") or "reference")


def number(value) -> float:
    """`value` as a float, NaN where it is no number."""
    try:
        return math.nan if value is None or isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        return math.nan


def section(parent: dict, key: str) -> dict:
    """parent[key], {} where it is absent or null."""
    return parent.get(key) or {}


def masks_of(manifest: dict) -> dict[str, dict]:
    """The conditions of each mask by its name. Scores of its pixels have columns that end with @ and the name."""
    return section(section(section(manifest, "config"), "measure"), "masks")
