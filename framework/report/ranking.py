"""What the numbers say: the best of a column, its ties, what a black image beats, the Pareto front."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping

import pandas as pd

from report.comparisons import comparisons
from report.results import BASELINES, Metric, Results, interval_ends, interval_of

COST_COLUMNS = ("build_ms", "frame_ms_median", "memory_bytes")


def score_marks(results: Results, metric: Metric, column: str) -> dict[str, str]:
    """Marks of one score: variant -> "best" or "tie", among those that are compared with the same reference. No marks where
    fewer than two of these have one.

    Scores with confidence intervals tie where no other's interval lies wholly below theirs; the best is then one of
    the ties. Others tie where both reach their reference's noise floor: a perfect image would score no better.
    Scores that are equal to the last digit are all the best, but for those of images that are all black.
    """
    return {name: mark for _, compared in comparisons(results)
            for name, mark in _score_marks(compared, metric, column).items()}


def _score_marks(results: Results, metric: Metric, column: str) -> dict[str, str]:
    rows = results.ok.set_index("variant")
    ranks = rows[column].map(metric.rank).dropna()
    if len(ranks) < 2:
        return {}
    best = ranks.idxmin()
    equal = {name for name, rank in ranks.items() if rank == ranks[best]}
    if metric.has_interval:
        low, high = interval_ends(rows.loc[ranks.index], column)
        ties = set(low.index[low <= high.min()])
    else:
        floors = {name: metric.rank(results.noise(column, results.reference_of(name))) for name in ranks.index}
        ties = {name for name, rank in ranks.items() if rank <= floors[name]}
        ties = ties if best in ties else set()
    if ties - equal:
        return dict.fromkeys(ties | equal, "tie")
    black = results.baseline_scores("black", results.reference_of(best)).get(column, math.nan)
    if len(equal) == len(ranks) and math.isclose(rows[column][best], black, rel_tol=1e-6):  # Tables round to 9 digits
        return {}
    return dict.fromkeys(equal, "best")


def cost_marks(results: Results, column: str) -> dict[str, str]:
    """Marks of one cost, lower is better, among variants of the same scene and reference; none where some variant has no
    such cost at all, for nothing is cheaper than that. Frame times tie where the fastest one's p95 reaches this median."""
    return {name: mark for _, compared in comparisons(results) for name, mark in _cost_marks(compared, column).items()}


def _cost_marks(results: Results, column: str) -> dict[str, str]:
    rows = results.ok.set_index("variant")
    costs = rows[column].dropna()
    if len(costs) < 2 or (costs == 0).any():
        return {}
    fastest = costs.idxmin()
    spread = rows.loc[fastest, "frame_ms_p95"] if column == "frame_ms_median" else math.nan
    reach = max(costs[fastest], spread) if math.isfinite(spread) else costs[fastest]
    marks = {name: "tie" for name, cost in costs.items() if cost <= reach}
    marks.update({name: "best" for name, cost in costs.items() if cost == costs[fastest]})
    return marks


def beaten_by(results: Results, metric: Metric, column: str, row: Mapping) -> list[str]:
    """Which of the black and the constant image score better than a variant against its reference, `row` of
    results.csv; with intervals, those whose interval lies wholly on the better side.

    The mean ratio is left out: the constant image has the right mean by construction.
    """
    if metric.better == "one" or math.isnan(row[column]):
        return []
    limits = _baseline_ranks(results, metric, column, results.reference_of(row["variant"]))
    own = min(map(metric.rank, interval_of(row, column)))
    return [name for name, limit in limits.items() if limit < own]


def all_beaten(results: Results, metric: Metric, column: str) -> dict[str, list[str]]:
    """beaten_by() of each variant that finished, without those that neither image beats."""
    if metric.better == "one":
        return {}
    limits: dict[int, dict[str, float]] = {}  # by reference
    found = {}
    for name, value, *ends in zip(results.ok["variant"], results.ok[column], *interval_ends(results.ok, column)):
        if math.isnan(value):
            continue
        reference = results.reference_of(name)
        if id(reference) not in limits:
            limits[id(reference)] = _baseline_ranks(results, metric, column, reference)
        own = min(map(metric.rank, ends))
        if beaten := [baseline for baseline, limit in limits[id(reference)].items() if limit < own]:
            found[name] = beaten
    return found


def _baseline_ranks(results: Results, metric: Metric, column: str, reference: dict | None) -> dict[str, float]:
    """The worse end of what the black and the constant image score."""
    return {name: max(map(metric.rank, interval_of(results.baseline_scores(name, reference), column))) for name in BASELINES}


def pareto_front(points: list[tuple[float, float]]) -> list[int]:
    """The indices of the (cost, error) points that no other dominates, by rising cost."""
    front: list[int] = []
    lowest = math.inf
    for index in sorted(range(len(points)), key=points.__getitem__):
        if points[index][1] < lowest:
            front.append(index)
            lowest = points[index][1]
    return front


def pareto_layers(points: list[tuple[float, float]], count: int) -> list[int]:
    """The indices of `count` points, or of all where they are fewer: the Pareto front, then the front of what is left,
    and so on."""
    # Points come by rising cost: each is on the first front whose lowest error so far lies above its own. These lowest errors
    # rise from front to front, so that the front is found by bisection.
    fronts: list[list[int]] = []
    lowest: list[float] = []
    for index in sorted(range(len(points)), key=points.__getitem__):
        error = points[index][1]
        number = bisect_right(lowest, error)
        if number == len(fronts):
            fronts.append([])
            lowest.append(error)
        fronts[number].append(index)
        lowest[number] = error
    return [index for front in fronts for index in front][:count]


def is_numeric(values: pd.Series) -> bool:
    """Whether every value of a sweep key is a finite number."""
    numbers = pd.to_numeric(values, errors="coerce")
    return bool(len(values)) and bool(numbers.map(math.isfinite).all())
