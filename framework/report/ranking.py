"""What the numbers say: the best of a column, its ties, what a black image beats, the Pareto front, costs of an error."""

from __future__ import annotations

import functools
import itertools
import math
from bisect import bisect_right

import numpy as np
import pandas as pd

from report.results import BASELINES, Metric, Results, interval_ends, interval_of
from report.setting import comparisons

COST_COLUMNS = ("build_ms", "frame_ms_median", "memory_bytes")
_LEAST = 1e-12  # what stands for an error of 0 on a logarithmic axis


def _by_comparison(marks_of):
    """Marks of variants of the same scene and reference alone: others don't compare."""
    @functools.wraps(marks_of)
    def of_all(results: Results, *arguments) -> dict[str, str]:
        return {name: mark for _, compared in comparisons(results) for name, mark in marks_of(compared, *arguments).items()}
    return of_all


@_by_comparison
def score_marks(results: Results, metric: Metric, column: str) -> dict[str, str]:
    """Marks of one score: variant -> "best" or "tie", among those that are compared with the same reference. No marks where
    fewer than two of these have one.

    Scores with confidence intervals tie where no other's interval lies wholly below theirs; the best is then one of
    the ties. Others tie where both reach their reference's noise floor: a perfect image would score no better.
    Scores that are equal to the last digit are all the best, but for those of images that are all black.
    """
    rows = results.ok.set_index("variant")
    ranks = rows[column].map(metric.rank).dropna()
    if len(ranks) < 2:
        return {}
    best = ranks.idxmin()
    equal = set(ranks.index[ranks == ranks[best]])
    if metric.has_interval:
        low, high = interval_ends(rows.loc[ranks.index], column)
        ties = set(low.index[low <= high.min()])
    else:
        floors = [metric.rank(results.noise(column, results.reference_of(name))) for name in ranks.index]
        ties = set(ranks.index[ranks <= floors])
        ties = ties if best in ties else set()
    if ties - equal:
        return dict.fromkeys(ties | equal, "tie")
    black = results.baseline("black", column, results.reference_of(best))
    is_black = len(equal) == len(ranks) and math.isclose(rows[column][best], black, rel_tol=1e-6)  # Tables round to 9 digits
    return {} if is_black else dict.fromkeys(equal, "best")


@_by_comparison
def cost_marks(results: Results, column: str) -> dict[str, str]:
    """Marks of one cost, lower is better, among variants of the same scene and reference; none where some variant has no
    such cost at all, for nothing is cheaper than that. Frame times tie where the fastest one's p95 reaches this median."""
    rows = results.ok.set_index("variant")
    costs = rows[column].dropna()
    if len(costs) < 2 or (costs == 0).any():
        return {}
    least = costs.min()
    reach = rows["frame_ms_p95"][costs.idxmin()] if column == "frame_ms_median" else least
    return {name: "best" if cost == least else "tie" for name, cost in costs.items() if cost <= max(least, reach)}


def all_beaten(results: Results, metric: Metric, column: str) -> dict[str, list[str]]:
    """Which of the black and the constant image score better than a variant against its reference, for the variants that
    either beats; with intervals, those whose interval lies wholly on the better side.

    The mean ratio is left out: the constant image has the right mean by construction.
    """
    if metric.better == "one":
        return {}
    low, high = interval_ends(results.ok, column)
    limits: dict[int, dict[str, float]] = {}  # the worse end of what each image scores, by reference
    found = {}
    for name, own in zip(results.ok["variant"], low if metric.better == "low" else -high):
        reference = results.reference_of(name)
        if id(reference) not in limits:
            limits[id(reference)] = {
                image: max(map(metric.rank, interval_of(results.baseline_scores(image, reference), column)))
                for image in BASELINES}
        if beaten := [image for image, limit in limits[id(reference)].items() if limit < own]:
            found[name] = beaten
    return found


def pareto_front(points: list[tuple[float, float]]) -> list[int]:
    """The indices of the (cost, error) points that no other dominates, by rising cost."""
    order = sorted(range(len(points)), key=points.__getitem__)
    errors = [points[index][1] for index in order]
    before = itertools.accumulate(errors, min, initial=math.inf)
    return [index for index, error, lowest in zip(order, errors, before) if error < lowest]


def pareto_layers(points: list[tuple[float, float]], count: int) -> list[int]:
    """The indices of `count` points, or of all where they are fewer: the Pareto front, then the front of what is left,
    and so on."""
    # Points come by rising cost: each is on the first front whose lowest error so far lies above its own. These lowest errors
    # rise from front to front, so that the front is found by bisection.
    lowest: list[float] = []
    front_of: dict[int, int] = {}
    for index in sorted(range(len(points)), key=points.__getitem__):
        front = front_of[index] = bisect_right(lowest, points[index][1])
        lowest[front:front + 1] = [points[index][1]]
    return sorted(front_of, key=front_of.__getitem__)[:count]


def log_cost_at(errors, costs, reached) -> np.ndarray:
    """The logarithm of the cost of each error, interpolated on a front, logarithm over logarithm; that of the cheapest
    point where it has less error already, NaN where none has as little.

    @param costs, reached Costs and errors of the front, by rising cost."""
    reached = np.maximum(reached, _LEAST)
    with np.errstate(all="ignore"):
        found = np.interp(-np.log(np.maximum(errors, 0)), -np.log(reached), np.log(costs))
    return np.where(errors < reached[-1], np.nan, found)


def is_numeric(values: pd.Series) -> bool:
    """Whether every value of a sweep key is a finite number."""
    return bool(len(values)) and bool(np.isfinite(pd.to_numeric(values, errors="coerce")).all())
