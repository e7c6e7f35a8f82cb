"""What methods take over filtered path tracing on the same device, at equal error."""

from __future__ import annotations

import itertools
import math

from bench.runs import Run, Variant

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
    front = _front([(rival["frame_ms"], rival["errors"][error]) for rival in rivals if rival["errors"][error]])
    wanted = row["errors"][error]
    time = _time_at(front, wanted)
    at = "least" if wanted > front[0][1] else "most" if wanted < front[-1][1] else ""
    return {"frame": row["frame_ms"] / time, "whole": row["whole_ms"] / time, "at": at}


def _front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The (time, error) points that no other dominates, by rising time."""
    ordered = sorted(points)
    before = itertools.accumulate((error for _, error in ordered), min, initial=math.inf)
    return [point for point, lowest in zip(ordered, before) if point[1] < lowest]


def _time_at(front: list[tuple[float, float]], error: float) -> float:
    """The time to an error, logarithm over logarithm; at the ends of the front the time there."""
    if error >= front[0][1]:
        return front[0][0]
    for (fast, high), (slow, low) in itertools.pairwise(front):
        if error >= low:
            part = math.log(high / error) / math.log(high / low)
            return fast * (slow / fast) ** part
    return front[-1][0]
