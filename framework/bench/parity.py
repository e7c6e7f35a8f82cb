"""The same images by the tracers of a device, by Embree, twice, and on a device in software: do they agree?"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from bench import devices, runs
from bench.processes import Clock
from bench.runs import Program, Run
from report import exr_pixels

CONFIG = "bench/gpu_parity.yaml"
_COMPARISON = 20  # seconds that one comparison of two images may take
_APART = 0.01  # of a pixel's value
_SCORES = ("nrmse", "mean_ratio", "flip")
_LARGEST_PART = 0.6  # of the time that is left, for one run
_SOFTWARE = "software device"


def measure(program: Program, found: list[devices.Device], device: devices.Device, tracers: list[str], out: Path,
            clock: Clock, warming: tuple[str, ...]) -> tuple[list[Run], list[dict]]:
    """@return the runs, and how images differ: a row for each method and pair of runs.

    @param tracers Those of the device to compare with Embree; none: Embree alone, against itself and another device.
    @param warming What is set in runs by the device's own tracers, which are timed, too.
    """
    first = tracers[0] if tracers else "embree"
    again, software = f"{first} again", devices.software(found, device)
    plan = [(first, first, device), *([("embree", "embree", device)] if tracers else []), (again, first, device)]
    pairs = [(first, "embree"), (again, first)]
    if software:
        plan.append((_SOFTWARE, "embree", software))
        pairs.append(("embree", _SOFTWARE))
    plan += [(tracer, tracer, device) for tracer in tracers[1:]]
    pairs += [(tracer, "embree") for tracer in tracers[1:]]

    done: dict[str, Run] = {}
    rows: list[dict] = []
    for i, (name, tracer, on) in enumerate(plan):
        own = clock.part(clock.left * (1 if i + 1 == len(plan) else _LARGEST_PART))
        done[name] = runs.run_config(program, CONFIG, f"parity.{name.replace(' ', '.')}", out, own, tracer=tracer, device=on.name,
                                     assignments=() if tracer == "embree" else warming)
        for test, reference in pairs:
            if test != reference and name in (test, reference) and test in done and reference in done:
                rows += _compare(program, f"{test} against {reference}", done[test], done[reference], clock)
    return list(done.values()), rows


def _compare(program: Program, pair: str, test: Run, reference: Run, clock: Clock) -> list[dict]:
    """The variants of two runs, one by one."""
    return [{"pair": pair, "method": variant.name, **_difference(program, test, variant, reference, clock)} for variant in test.variants]


def _difference(program: Program, test: Run, variant: runs.Variant, reference: Run, clock: Clock) -> dict:
    other = reference.variant(variant.name)
    images = [test.image(variant), reference.image(other) if other else None]
    if None in images:
        return {"error": variant.error or (other.error if other else "") or "no image to compare with"}
    row = {"pixels_apart": _pixels_apart(*images), "errors": [_error_of(variant.result), _error_of(other.result)],
           "same_bytes": _hash(images[0]) == _hash(images[1]),
           "pictures": [str(image.with_suffix(".png")) for image in images]}
    if row["same_bytes"]:
        return {**row, "nrmse": 0.0, "mean_ratio": 1.0, "flip": 0.0}
    said = program.call("compare", *map(str, images), "--json", limit=min(clock.left, _COMPARISON))
    try:
        scores = json.loads(said.output)["scores"]
    except (ValueError, KeyError):
        return {**row, "error": f"not compared: {said.last or said.status}"}
    return {**row, **{score: scores.get(score) for score in _SCORES}}


def _error_of(result: dict) -> float | None:
    """Against the path-traced reference, of indirect light where there is such a score."""
    scores = result.get("scores") or {}
    return scores.get("indirect_nrmse", scores.get("nrmse"))


def _pixels_apart(test: Path, reference: Path) -> float:
    """The fraction of pixels that differ by more than _APART of the reference's, or of its mean where that is larger: few where rays
    met other triangles at edges, many where all is computed otherwise."""
    one, two = (exr_pixels.rgb(path).sum(axis=-1) for path in (test, reference))
    scale = abs(two).clip(min=abs(two).mean())
    return float((abs(one - two) > _APART * scale).mean())


def _hash(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
