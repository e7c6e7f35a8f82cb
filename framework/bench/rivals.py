"""What methods take over filtered path tracing on the same device, at equal error."""

from __future__ import annotations

import math

from bench.runs import Run, Variant
from report.ranking import log_cost_at, pareto_front

ERRORS = {"indirect_nrmse": "nRMSE", "indirect_relmse": "relMSE"}
_PATHS = {"path_trace_device", "filter_irradiance"}
_HOST = "path_trace"  # on the host: no rival on a device


def rows(run: Run) -> list[dict]:
    """A row for each variant of a run that finished, the path-traced ones first: time of a frame and of a frame with all that is built,
    ms, errors, and these times over the path tracer's at each error; `at` is "least" or "most" where it is beyond the path tracer's
    numbers of samples."""
    done = [variant for variant in run.variants if variant.result and _HOST not in variant.kinds.values()]
    paths = [variant for variant in done if _PATHS <= set(variant.kinds.values())]
    found = [_row(variant, variant in paths) for variant in [*paths, *(v for v in done if v not in paths)]]
    rivals = [row for row in found if row["is_rival"]]
    for row in found if rivals else []:
        row["over"] = {error: _over(row, rivals, error) for error in ERRORS if row["errors"].get(error)}
    return found if rivals else []


def _row(variant: Variant, is_rival: bool) -> dict:
    result = variant.result
    frame = result["frame_ms"][1]
    return {"variant": variant.name, "tracer": result.get("tracer", ""), "is_rival": is_rival, "frame_ms": frame,
            "whole_ms": frame + result["build_ms"],
            "errors": {error: result.get("scores", {}).get(error) for error in ERRORS}}


def _over(row: dict, rivals: list[dict], error: str) -> dict:
    points = [(rival["frame_ms"], rival["errors"][error]) for rival in rivals if rival["errors"][error]]
    times, reached = zip(*(points[i] for i in pareto_front(points)))
    wanted = row["errors"][error]
    at = "least" if wanted > reached[0] else "most" if wanted < reached[-1] else ""
    if wanted <= reached[-1]:
        time = times[-1]
    else:
        time = times[0] if wanted >= reached[0] else math.exp(log_cost_at(wanted, times, reached))
    return {"frame": row["frame_ms"] / time, "whole": row["whole_ms"] / time, "at": at}
