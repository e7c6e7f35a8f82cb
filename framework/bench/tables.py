"""What runs measured, as rows: passes, variants, rays a second, benchmarks."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from bench import processes
from bench.processes import Clock
from bench.runs import Program, Run

# Programs and the benchmarks in them that tell most; they choose the best device themselves.
BENCHMARKS = (("bench_compute", "Device"), ("bench_trace_backends", "sponza"), ("bench_voxel_march", "voxelMarch"),
              ("bench_octree", "octreeBuild/resolution:256"), ("bench_cone", "coneGather"), ("bench_trace_backends", "kitchen"))
_PLUMBING = {"name", "run_name", "run_type", "family_index", "per_family_instance_index", "repetitions", "repetition_index", "threads",
             "iterations", "real_time", "cpu_time", "time_unit"}


def pass_rows(runs: Iterable[Run]) -> list[dict]:
    """Each pass of each variant that finished, building and frames apart, with rays and steps a second."""
    rows = []
    for run in runs:
        for variant in run.variants:
            for cost in (variant.result or {}).get("passes", []):
                low, median, high = cost["ms"]
                rows.append({"kind": variant.kinds.get(cost["pass"], cost["pass"]), "pass": cost["pass"], "phase": cost["phase"],
                             "run": run.name, "config": run.config, "tracer": run.tracer or variant.result.get("tracer", ""),
                             "device": variant.result.get("device", ""), "variant": variant.name, "ms": median, "ms_p05": low,
                             "ms_p95": high, "rays": cost["rays"], "voxel_steps": cost["voxel_steps"],
                             "rays_per_s": _rate(cost["rays"], median), "voxel_steps_per_s": _rate(cost["voxel_steps"], median),
                             "memory_bytes": cost["memory_bytes"], "scratch_bytes": cost["scratch_bytes"], "dispatches": cost.get("dispatches"),
                             "host_waits": cost.get("host_waits"), "host_bytes": cost.get("host_bytes")})
    return rows


def _rate(count: int, milliseconds: float) -> float | None:
    return count / milliseconds * 1e3 if count and milliseconds > 0 else None


def slowest(rows: Iterable[dict]) -> list[dict]:
    """For each kind of pass and phase the row that took longest, by the device's own tracers where those ran it, and how many
    rows there are."""
    groups: dict[tuple, list[dict]] = {}
    for row in rows:
        groups.setdefault((row["kind"], row["phase"]), []).append(row)
    own = {key: [row for row in group if row["tracer"] != "embree"] or group for key, group in groups.items()}
    return [{**max(group, key=lambda row: row["ms"]), "of": len(group)} for _, group in sorted(own.items())]


def fastest_rays(rows: Iterable[dict]) -> list[dict]:
    """For each kind of pass that traces and each tracer the row with most rays a second."""
    groups: dict[tuple, list[dict]] = {}
    for row in rows:
        if row["rays_per_s"] or row["voxel_steps_per_s"]:
            groups.setdefault((row["kind"], row["phase"], row["tracer"]), []).append(row)
    return [max(group, key=lambda row: row["rays_per_s"] or row["voxel_steps_per_s"]) for _, group in sorted(groups.items())]


def variant_rows(run: Run) -> list[dict]:
    """What each variant took and how wrong it is; times of its passes: building and frames by id."""
    rows = []
    for variant in run.variants:
        result = variant.result
        if result is None:
            rows.append({"variant": variant.name, "error": variant.error})
            continue
        low, median, high = result["frame_ms"]
        scores = result.get("scores", {})
        rows.append({"variant": variant.name, "build_ms": result["build_ms"], "frame_ms": median, "frame_ms_p05": low,
                     "frame_ms_p95": high, "memory_bytes": result["memory_bytes"], "peak_bytes": result["peak_bytes"],
                     "indirect_nrmse": scores.get("indirect_nrmse"), "nrmse": scores.get("nrmse"),
                     "mean_ratio": scores.get("indirect_mean_ratio", scores.get("mean_ratio")),
                     "passes": {f"{cost['pass']} ({cost['phase']})": cost["ms"][1] for cost in result["passes"]}})
    return rows


def write_rows(run: Run) -> list[dict]:
    """Passes by each way of writing: their time, and that over the time of a plain store by the same pass into as many voxels."""
    rows = []
    for variant in run.variants:
        writers = {str(entry.get("id", entry["pass"])): entry for entry in variant.graph if "write" in entry}
        voxels = next((entry["resolution"] for entry in variant.graph if "resolution" in entry), 0)
        for cost in (variant.result or {}).get("passes", []):
            if cost["phase"] == "build" and (entry := writers.get(cost["pass"])):
                low, median, high = cost["ms"]
                rows.append({"kind": entry["pass"], "voxels": int(voxels), "write": entry["write"], "ms": median, "ms_p05": low, "ms_p95": high})
    plain = {(row["kind"], row["voxels"]): row["ms"] for row in rows if row["write"] == "none"}
    return [{**row, "over_none": row["ms"] / base if (base := plain.get((row["kind"], row["voxels"]))) else None} for row in rows]


def pass_names(program: Program, limit: float) -> list[str]:
    """All passes that the program has."""
    listing = program.call("passes", limit=limit).output
    return [match[1] for line in listing.splitlines() if (match := re.match(r"  ([a-z]\w*)  ", line))]


def benchmark(path: Path, pattern: str, clock: Clock) -> tuple[processes.Outcome, list[dict]]:
    """Runs benchmarks of a program: name, time and counters of each that finished."""
    done = processes.run([str(path), f"--benchmark_filter={pattern}", "--benchmark_format=json"], clock.left)
    found = finished_entries(done.output)
    rows = [{"program": path.name, "name": entry["name"], "time": entry.get("real_time"), "unit": entry.get("time_unit"),
             "error": entry.get("error_message", ""),
             "counters": {key: value for key, value in entry.items() if key not in _PLUMBING and isinstance(value, (int, float))
                          and not isinstance(value, bool)}} for entry in found]
    return replace(done, last=done.last if done.status == processes.FAILED else ""), rows


def finished_entries(output: str) -> list[dict]:
    """The entries of Google Benchmark's JSON, also of one that ends early."""
    for text in (output, output[:output.rfind("}") + 1] + "]}"):
        try:
            return json.loads(text)["benchmarks"]
        except (ValueError, KeyError):
            continue
    return []
