"""Reads the result files of a run (docs/reading-a-report.md lists them), and no more."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pandas as pd


class ReportError(Exception):
    """What keeps a report from being made: one line, what is wrong and what to do."""


@dataclass(frozen=True)
class Metric:
    """One measure of an image against the reference, as the manifest lists it. `better` is one of BETTER: lower,
    higher, or closer to 1. One that has an interval is freed of the reference's noise."""

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


BETTER = ("low", "high", "one")
LIGHTS = {"total": "", "indirect": "indirect_"}  # name -> column prefix
INTERVAL = ("_low", "_high")  # what columns of the ends of a 95 % confidence interval add to the metric's name
IMAGES = {"total": ("final.png", "flip.png"), "indirect": ("indirect.png", "indirect_flip.png")}
BASELINES = ("black", "constant")

_TEXT = ("variant", "status", "error", "device", "tracer")
_COST = ("build_ms", "frame_ms_median", "frame_ms_p05", "frame_ms_p95", "memory_bytes",
         "peak_bytes", "rays")
_PASS_NUMBERS = ("ms_median", "ms_p05", "ms_p95", "rays", "voxel_steps", "memory_bytes", "scratch_bytes", "dispatches",
                 "host_waits", "host_bytes")


@dataclass
class Results:
    """A run's results.

    variants: one row for each variant, columns as in results.csv; costs and scores are floats (NaN where absent),
        everything else text as written. Ordered as the run wrote them.
    passes: one row for each variant, pass and phase, as in passes.csv, and the `kind` of the pass that has this id in
        the variant's graph; may be empty.
    frames: one row for each variant and compared frame, as in frames.csv, scores in columns; may be empty.
    values: one row for each variant, pass, name and frame, as in values.csv: what passes reported; frame is NaN in the
        build; may be empty.
    manifest: the run's manifest.json, {} where it is absent or broken.
    metrics: the manifest's list, in the order in which tables show them; the first three are charted.
    seed_metrics: likewise, bias and noise of nRMSE apart, of runs with a second seed.
    temporal_metrics: likewise, of differences of successive frames; the first one is of each frame too.
    sweep_keys: the columns of `variants` that the sweep varied.
    warnings: what was absent or odd in the files, for the reader's eye, after the run's own warnings.
    """

    directory: Path
    variants: pd.DataFrame
    passes: pd.DataFrame
    values: pd.DataFrame
    frames: pd.DataFrame
    manifest: dict
    metrics: tuple[Metric, ...]
    seed_metrics: tuple[Metric, ...]
    temporal_metrics: tuple[Metric, ...]
    sweep_keys: list[str]
    warnings: list[str] = field(default_factory=list)

    @property
    def ok(self) -> pd.DataFrame:
        """The variants that finished."""
        return self.variants[self.variants["status"] == "ok"]

    def only(self, variants: Iterable[str]) -> Results:
        """The same run with these variants alone."""
        chosen = set(variants)
        tables = {"variants": self.variants, "passes": self.passes, "values": self.values, "frames": self.frames}
        return replace(self, **{name: table[table["variant"].isin(chosen)] for name, table in tables.items()})

    @property
    def missing(self) -> list[str]:
        """The variants that the manifest plans and that have no row, in its order."""
        known = set(self.variants["variant"])
        return [name for name in section(self.manifest, "variants") if name not in known]

    def sessions(self) -> list[tuple[str, list[str]]]:
        """Of each process that measured variants which finished: when it began (UTC, "" where that is unknown), and
        these variants. More than one where the run was resumed."""
        listed = self.manifest.get("sessions")
        finished = set(self.ok["variant"])
        found = [(str(entry.get("started", "")), [name for name in entry["variants"] if name in finished])
                 for entry in (listed if isinstance(listed, list) else [])
                 if isinstance(entry, dict) and isinstance(entry.get("variants"), list)]
        return [(began, names) for began, names in found if names]

    def lights(self) -> list[str]:
        """Which of "total" and "indirect" have any score or image, always with "total"."""
        def present(light: str) -> bool:
            columns = [LIGHTS[light] + metric.key for metric in self.metrics]
            return bool(self.ok[columns].notna().any(axis=None)) or any(
                self.image(folder, IMAGES[light][0]) for folder in ["reference", *self.ok["variant"]])

        return ["total"] + (["indirect"] if present("indirect") else [])

    def references(self) -> list[dict]:
        """The records of the run's references; more than one where the sweep varies what is lit or seen."""
        return self._references

    @functools.cached_property
    def _references(self) -> list[dict]:
        listed = self.manifest.get("references")
        records = [r for r in listed if isinstance(r, dict)] if isinstance(listed, list) else []
        return records or [section(self.manifest, "reference")]

    def reference_of(self, variant: str) -> dict | None:
        """The record of a variant's reference, None where several are and none names the variant."""
        records = self.references()
        return records[0] if len(records) == 1 else self._references_by_variant.get(variant)

    @functools.cached_property
    def _references_by_variant(self) -> dict[str, dict]:
        found = {}
        for record in self.references():
            for variant in record["variants"] if isinstance(record.get("variants"), list) else ():
                found.setdefault(str(variant), record)
        return found

    def reference_folder(self, variant: str) -> str | None:
        """The folder below images/ of a variant's reference, None where it is unknown."""
        record = self.reference_of(variant)
        return None if record is None else str(record.get("folder") or "reference")

    def noise(self, column: str, reference: dict | None) -> float:
        """About what a perfect image scores against a noisy reference, NaN where the score is freed of noise."""
        return number((reference or {}).get(column + "_noise"))

    def baseline(self, name: str, column: str, reference: dict | None) -> float:
        """What the "black" or the "constant" image scores against a reference, NaN where it was not measured."""
        return number(self.baseline_scores(name, reference).get(column))

    def baseline_scores(self, name: str, reference: dict | None) -> dict:
        """All scores of the "black" or the "constant" image against a reference."""
        own = section(reference or {}, "baselines")
        if not own and len(self.references()) == 1:
            own = section(self.manifest, "baselines")
        return section(own, name)

    def masks(self) -> dict[str, dict]:
        """The conditions of each mask by its name. Scores of its pixels have columns that end with @ and the name."""
        return _masks_of(self.manifest)

    @property
    def only_reference(self) -> dict | None:
        """The reference that all variants share, None where they have several."""
        records = self.references()
        return records[0] if len(records) == 1 else None

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


def number(value) -> float:
    """`value` as a float, NaN where it is no number."""
    try:
        return math.nan if value is None or isinstance(value, bool) else float(value)
    except (TypeError, ValueError):
        return math.nan


def section(parent: dict, key: str) -> dict:
    """parent[key] where that is an object, {} otherwise."""
    value = parent.get(key)
    return value if isinstance(value, dict) else {}


def load(directory: str | Path) -> Results:
    """Reads results.csv, passes.csv, values.csv and manifest.json of a finished or partly finished run.

    @throws ReportError where results.csv is absent or is not a table of variants.
    """
    directory = Path(directory)
    warnings: list[str] = []
    variants = _read_variants(directory / "results.csv", warnings)
    passes = _read_passes(directory / "passes.csv", warnings)
    values = _read_values(directory / "values.csv", warnings)
    frames = _read_frames(directory / "frames.csv", warnings)
    manifest = _read_manifest(directory / "manifest.json", warnings)

    # The manifest names kinds of passes, metrics and sweep keys.
    kinds = {(variant, str(entry.get("id", entry.get("pass")))): str(entry.get("pass"))
             for variant, graph in section(manifest, "variants").items() if isinstance(graph, list)
             for entry in graph if isinstance(entry, dict)}
    passes["kind"] = [kinds.get(key, key[1]) for key in zip(passes["variant"], passes["pass"])]
    metrics = _metrics_of(manifest, "metrics")
    if not metrics:
        warnings.append("The manifest doesn't list metrics with their directions: scores are left out.")
    seeds, temporal = _metrics_of(manifest, "seed_metrics"), _metrics_of(manifest, "temporal_metrics")
    regions = ["", *(f"@{name}" for name in _masks_of(manifest))]
    scores = [prefix + metric.key + region for prefix in LIGHTS.values() for metric in metrics for region in regions]
    scores += [prefix + metric.key for prefix in LIGHTS.values() for metric in (*seeds, *temporal)]
    scores += [end for column in scores for end in interval_columns(column) if end in variants or end in frames]
    _to_numbers(variants, scores)
    _to_numbers(frames, ["frame", *scores])
    declared = manifest.get("sweep_keys")
    sweep_keys = [str(key) for key in declared if str(key) in variants.columns] if isinstance(declared, list) else []
    own = manifest.get("warnings")
    warnings = [str(text) for text in own] + warnings if isinstance(own, list) else warnings
    results = Results(directory, variants, passes, values, frames, manifest, metrics, seeds, temporal, sweep_keys, warnings)
    if (count := len(results.references())) > 1:
        warnings.append(f"The variants have {count} different references, so their scores are not of one "
                        "image. Each is compared with its own one's noise, black and constant image; charts "
                        "don't show these.")
    return results


def _read_table(path: Path) -> pd.DataFrame:
    # Everything is read as text, so that a variant called "001", "nan" or "None" keeps its name.
    try:
        return pd.read_csv(path, dtype=str, keep_default_na=False, na_filter=False, encoding="utf-8")
    except (OSError, ValueError) as error:  # pandas' and the decoder's errors are ValueErrors
        raise ReportError(f"{path}: cannot read: {error}") from error


def _metrics_of(manifest: dict, key: str) -> tuple[Metric, ...]:
    listed = manifest.get(key)
    known = [entry for entry in (listed if isinstance(listed, list) else []) if isinstance(entry, dict)
             and entry.get("better") in BETTER and isinstance(entry.get("name"), str)]
    return tuple(Metric(entry["name"], str(entry.get("label", entry["name"])), str(entry.get("unit", "")),
                        entry["better"], str(entry.get("meaning", "")), entry.get("interval") is True)
                 for entry in known)


def _masks_of(manifest: dict) -> dict[str, dict]:
    masks = section(section(section(manifest, "config"), "measure"), "masks")
    return {name: conditions for name, conditions in masks.items() if isinstance(conditions, dict)}


def _to_numbers(table: pd.DataFrame, columns: Iterable[str]) -> None:
    for column in columns:
        table[column] = pd.to_numeric(table[column], errors="coerce") if column in table else math.nan


def _read_variants(path: Path, warnings: list[str]) -> pd.DataFrame:
    if not path.is_file():
        raise ReportError(f"{path}: no such file; name the folder that a run wrote its results to")
    table = _read_table(path)
    for column in ("variant", "status"):
        if column not in table:
            raise ReportError(f"{path}: has no column '{column}', so it is not a run's results.csv")
    for column in _TEXT:
        if column not in table:
            table[column] = ""
    _to_numbers(table, _COST)

    # A resumed run may have written a variant again: its last row holds.
    repeated = table["variant"].duplicated(keep="last")
    if repeated.any():
        warnings.append(f"results.csv has {int(repeated.sum())} repeated row(s); the last of each was taken.")
    return table[~repeated].reset_index(drop=True)


def _read_passes(path: Path, warnings: list[str]) -> pd.DataFrame:
    columns = ["variant", "pass", "phase", *_PASS_NUMBERS]
    table = pd.DataFrame(columns=columns)
    if not path.is_file():
        warnings.append("passes.csv is missing: the time of each pass is not shown.")
    else:
        try:
            table = _read_table(path)
            if not {"variant", "pass", "phase"} <= set(table.columns):
                raise ReportError("passes.csv lacks a column variant, pass or phase")
        except ReportError as error:
            warnings.append(f"{error}: the time of each pass is not shown.")
            table = pd.DataFrame(columns=columns)
    _to_numbers(table, _PASS_NUMBERS)
    return table


def _read_values(path: Path, warnings: list[str]) -> pd.DataFrame:
    """What passes reported; most runs have none and no such file."""
    columns = ["variant", "pass", "name", "frame", "value"]
    table = pd.DataFrame(columns=columns)
    if path.is_file():
        try:
            table = _read_table(path)
            if not set(columns) <= set(table.columns):
                raise ReportError(f"values.csv lacks a column of {', '.join(columns)}")
        except ReportError as error:
            warnings.append(f"{error}: what passes reported is not shown.")
            table = pd.DataFrame(columns=columns)
    _to_numbers(table, ("frame", "value"))
    return table[table["value"].notna()]


def _read_frames(path: Path, warnings: list[str]) -> pd.DataFrame:
    """Scores of each compared frame; only runs that compare several have such a file."""
    table = pd.DataFrame(columns=["variant", "frame"])
    if path.is_file():
        try:
            table = _read_table(path)
            if not {"variant", "frame"} <= set(table.columns):
                raise ReportError("frames.csv lacks a column variant or frame")
        except ReportError as error:
            warnings.append(f"{error}: errors over frames are not shown.")
            table = pd.DataFrame(columns=["variant", "frame"])
    return table


def _read_manifest(path: Path, warnings: list[str]) -> dict:
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        warnings.append(f"manifest.json cannot be read, so neither scores nor provenance are shown: {error}")
        return {}
    if not isinstance(manifest, dict):
        warnings.append("manifest.json is not a JSON object, so neither scores nor provenance are shown.")
        return {}
    return manifest
