"""Reads the result files of a run (docs/reading-a-report.md lists them), and no more."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import pandas as pd

from report.results import LIGHTS, Metric, ReportError, Results, interval_columns, masks_of, section

_COST = ("build_ms", "frame_ms_median", "frame_ms_p05", "frame_ms_p95", "memory_bytes",
         "peak_bytes", "rays")
_PASS_NUMBERS = ("ms_median", "ms_p05", "ms_p95", "rays", "voxel_steps", "memory_bytes", "scratch_bytes", "dispatches",
                 "host_waits", "host_bytes")


def load(directory: str | Path) -> Results:
    """Reads results.csv, passes.csv, values.csv, frames.csv and manifest.json of a finished or partly finished run.

    @throws ReportError where one of them is not as runs write it, or is absent; runs may leave no values and frames
    """
    directory = Path(directory)
    variants = _read_table(directory / "results.csv", ("variant", "status"))
    passes = _read_table(directory / "passes.csv", ("variant", "pass", "phase"))
    values = _read_table(directory / "values.csv", ("variant", "pass", "name", "frame", "value"), is_optional=True)
    frames = _read_table(directory / "frames.csv", ("variant", "frame"), is_optional=True)
    manifest = _read_manifest(directory / "manifest.json")
    if "name" not in variants:  # of an older version
        variants["name"] = variants["variant"]
    _to_numbers(variants, _COST)
    _to_numbers(passes, _PASS_NUMBERS)
    _to_numbers(values, ("frame", "value"))
    values = values[values["value"].notna()]

    # The manifest names kinds of passes, metrics and sweep keys.
    kinds = {(variant, entry.get("id", entry["pass"])): entry["pass"]
             for variant, graph in section(manifest, "variants").items() for entry in graph}
    passes["kind"] = [kinds.get(key, key[1]) for key in zip(passes["variant"], passes["pass"])]
    metrics, seeds, temporal = (_metrics_of(manifest, key) for key in ("metrics", "seed_metrics", "temporal_metrics"))
    regions = ["", *(f"@{name}" for name in masks_of(manifest))]
    scores = [prefix + metric.key + region for prefix in LIGHTS.values() for metric in metrics for region in regions]
    scores += [prefix + metric.key for prefix in LIGHTS.values() for metric in (*seeds, *temporal)]
    scores += [end for column in scores for end in interval_columns(column) if end in variants or end in frames]
    _to_numbers(variants, scores)
    _to_numbers(frames, ["frame", *scores])
    sweep_keys = [key for key in manifest.get("sweep_keys", []) if key in variants]
    numbers = {variant: str(i) for i, variant in enumerate(variants["variant"], 1)}
    names = dict(zip(variants["variant"], variants["name"]))
    results = Results(directory, variants, numbers, names, passes, values, frames, manifest, metrics, seeds, temporal,
                      sweep_keys, list(manifest.get("warnings") or []))
    if (count := len(results.references)) > 1:
        results.warnings.append(f"The variants have {count} different references, so their scores are not of one "
                                "image. Each is compared with its own one's noise, black and constant image; charts "
                                "don't show these.")
    return results


def _read_table(path: Path, columns: Sequence[str], is_optional: bool = False) -> pd.DataFrame:
    if not path.is_file():
        if is_optional:
            return pd.DataFrame(columns=list(columns))
        raise ReportError(f"{path}: no such file; name the folder that a run wrote its results to")
    # Everything is read as text, so that a variant called "001", "nan" or "None" keeps its name.
    try:
        table = pd.read_csv(path, dtype=str, keep_default_na=False, na_filter=False, encoding="utf-8")
    except (OSError, ValueError) as error:  # pandas' and the decoder's errors are ValueErrors
        raise ReportError(f"{path}: cannot read: {error}") from error
    for column in columns:
        if column not in table:
            raise ReportError(f"{path}: has no column '{column}', so it is not a run's {path.name}")
    return table


def _read_manifest(path: Path) -> dict:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ReportError(f"{path}: cannot read: {error}") from error


def _metrics_of(manifest: dict, key: str) -> tuple[Metric, ...]:
    return tuple(Metric(entry["name"], entry["label"], entry["unit"], entry["better"], entry["meaning"], entry["interval"])
                 for entry in manifest.get(key, []))


def _to_numbers(table: pd.DataFrame, columns: Iterable[str]) -> None:
    for column in columns:
        table[column] = pd.to_numeric(table[column], errors="coerce") if column in table else math.nan
