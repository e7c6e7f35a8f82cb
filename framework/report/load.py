"""Reads the result files of a run (docs/reading-a-report.md lists them), and no more."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import pandas as pd

from report.results import BETTER, LIGHTS, Metric, ReportError, Results, entries, interval_columns, masks_of, section, texts

_TEXT = ("variant", "status", "error", "device", "tracer")
_COST = ("build_ms", "frame_ms_median", "frame_ms_p05", "frame_ms_p95", "memory_bytes",
         "peak_bytes", "rays")
_PASS_NUMBERS = ("ms_median", "ms_p05", "ms_p95", "rays", "voxel_steps", "memory_bytes", "scratch_bytes", "dispatches",
                 "host_waits", "host_bytes")


def load(directory: str | Path) -> Results:
    """Reads results.csv, passes.csv, values.csv and manifest.json of a finished or partly finished run.

    @throws ReportError where results.csv is absent or is not a table of variants.
    """
    directory = Path(directory)
    warnings: list[str] = []
    variants = _read_variants(directory / "results.csv", warnings)
    if not (directory / "passes.csv").is_file():
        warnings.append("passes.csv is missing: the time of each pass is not shown.")
    passes, values, frames = (_read_optional(directory / f"{name}.csv", columns, left_out, warnings) for name, columns, left_out in (
        ("passes", ("variant", "pass", "phase"), "the time of each pass is"),
        ("values", ("variant", "pass", "name", "frame", "value"), "what passes reported is"),
        ("frames", ("variant", "frame"), "errors over frames are")))
    _to_numbers(passes, _PASS_NUMBERS)
    _to_numbers(values, ("frame", "value"))
    values = values[values["value"].notna()]
    manifest = _read_manifest(directory / "manifest.json", warnings)

    # The manifest names kinds of passes, metrics and sweep keys.
    graphs = section(manifest, "variants")
    kinds = {(variant, str(entry.get("id", entry.get("pass")))): str(entry.get("pass"))
             for variant in graphs for entry in entries(graphs, variant)}
    passes["kind"] = [kinds.get(key, key[1]) for key in zip(passes["variant"], passes["pass"])]
    metrics = _metrics_of(manifest, "metrics")
    if not metrics:
        warnings.append("The manifest doesn't list metrics with their directions: scores are left out.")
    seeds, temporal = _metrics_of(manifest, "seed_metrics"), _metrics_of(manifest, "temporal_metrics")
    regions = ["", *(f"@{name}" for name in masks_of(manifest))]
    scores = [prefix + metric.key + region for prefix in LIGHTS.values() for metric in metrics for region in regions]
    scores += [prefix + metric.key for prefix in LIGHTS.values() for metric in (*seeds, *temporal)]
    scores += [end for column in scores for end in interval_columns(column) if end in variants or end in frames]
    _to_numbers(variants, scores)
    _to_numbers(frames, ["frame", *scores])
    sweep_keys = [key for key in texts(manifest, "sweep_keys") if key in variants]
    warnings = texts(manifest, "warnings") + warnings
    numbers = {variant: str(i) for i, variant in enumerate(variants["variant"], 1)}
    names = dict(zip(variants["variant"], variants["name"]))
    results = Results(directory, variants, numbers, names, passes, values, frames, manifest, metrics, seeds, temporal,
                      sweep_keys, warnings)
    if (count := len(results.references)) > 1:
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
    return tuple(Metric(entry["name"], str(entry.get("label", entry["name"])), str(entry.get("unit", "")),
                        entry["better"], str(entry.get("meaning", "")), entry.get("interval") is True)
                 for entry in entries(manifest, key)
                 if entry.get("better") in BETTER and isinstance(entry.get("name"), str))


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
    if "name" not in table:  # of an older version
        table["name"] = table["variant"]
    _to_numbers(table, _COST)

    # A resumed run may have written a variant again: its last row holds.
    repeated = table["variant"].duplicated(keep="last")
    if repeated.any():
        warnings.append(f"results.csv has {int(repeated.sum())} repeated row(s); the last of each was taken.")
    return table[~repeated].reset_index(drop=True)


def _read_optional(path: Path, columns: Sequence[str], left_out: str, warnings: list[str]) -> pd.DataFrame:
    """A table without rows where there is no such file; likewise, with a warning, where it cannot be read or lacks a
    column. @param left_out what the page does without then"""
    if path.is_file():
        try:
            table = _read_table(path)
            if set(columns) <= set(table.columns):
                return table
            raise ReportError(f"{path.name} lacks a column of {', '.join(columns)}")
        except ReportError as error:
            warnings.append(f"{error}: {left_out} not shown.")
    return pd.DataFrame(columns=list(columns))


def _read_manifest(path: Path, warnings: list[str]) -> dict:
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
        if isinstance(manifest, dict):
            return manifest
        error = "it is no JSON object"
    except (OSError, ValueError) as failure:
        error = failure
    warnings.append(f"manifest.json cannot be read, so neither scores nor provenance are shown: {error}")
    return {}
