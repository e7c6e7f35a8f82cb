"""What the numbers say: the best of a column, its ties, what a black image beats, the Pareto front."""

from __future__ import annotations

import math

import pandas as pd

from report.load import BASELINES, LIGHTS, Metric, Results

COST_COLUMNS = ("build_ms", "frame_ms_median", "memory_bytes")


def score_marks(results: Results, metric: Metric, column: str) -> dict[str, str]:
    """Marks of one score: variant -> "best" or "tie".

    A tie differs from the best by no more than the reference's own noise: another reference of the same
    quality could have ranked the two the other way round. Where the two have different references, the larger
    noise counts. No marks where fewer than two variants have one.
    """
    ranks = results.ok.set_index("variant")[column].map(metric.rank).dropna()
    if len(ranks) < 2:
        return {}
    best = ranks.min()
    noises = {name: results.noise(column, results.reference_of(name)) for name in ranks.index}
    noises = {name: noise if math.isfinite(noise) else 0.0 for name, noise in noises.items()}
    of_best = noises[ranks.idxmin()]
    marks = {name: "tie" for name, rank in ranks.items() if rank <= best + max(noises[name], of_best)}
    marks[ranks.idxmin()] = "best"
    # Equal to the last digit is no less the best.
    marks.update({name: "best" for name, rank in ranks.items() if rank == best})
    return marks


def cost_marks(results: Results, column: str) -> dict[str, str]:
    """Marks of one cost, lower is better. Frame times tie where the fastest one's p95 reaches this median."""
    rows = results.ok.set_index("variant")
    costs = rows[column].dropna()
    if len(costs) < 2:
        return {}
    fastest = costs.idxmin()
    spread = rows.loc[fastest, "frame_ms_p95"] if column == "frame_ms_median" else math.nan
    reach = max(costs[fastest], spread) if math.isfinite(spread) else costs[fastest]
    marks = {name: "tie" for name, cost in costs.items() if cost <= reach}
    marks.update({name: "best" for name, cost in costs.items() if cost == costs[fastest]})
    return marks


def beaten_by(results: Results, metric: Metric, column: str, variant: str, value: float) -> list[str]:
    """Which of the black and the constant image score better than a variant's `value` against its reference.

    The mean ratio is left out: the constant image has the right mean by construction.
    """
    if metric.better == "one" or math.isnan(value):
        return []
    scores = {name: results.baseline(name, column, results.reference_of(variant)) for name in BASELINES}
    return [name for name, score in scores.items() if metric.rank(score) < metric.rank(value)]


def pareto_front(points: list[tuple[float, float]]) -> list[int]:
    """The indices of the (cost, error) points that no other dominates, by rising cost."""
    front: list[int] = []
    lowest = math.inf
    for index in sorted(range(len(points)), key=lambda i: points[i]):
        if points[index][1] < lowest:
            front.append(index)
            lowest = points[index][1]
    return front


def summary(results: Results, light: str) -> list[str]:
    """Sentences on the best error, the fastest variant and what failed; `light` is "indirect" or "total"."""
    total, finished = len(results.variants), len(results.ok)
    if total == 0:
        return ["No variant has finished yet."]
    sentences = [f"{finished} of {_count(total, 'variant')} finished."]
    if failed := total - finished:
        sentences.append(f"{_count(failed, 'variant')} failed; the reason stands below the table.")

    # The best of each error, with what cannot be told from it.
    worse: dict[str, list[str]] = {}
    for metric in results.metrics[:3]:
        column = LIGHTS[light] + metric.key
        scores = results.ok.set_index("variant")[column].dropna()
        if scores.empty:
            continue
        best = scores.map(metric.rank).idxmin()
        ties = [name for name in score_marks(results, metric, column) if name != best]
        tied = f", which cannot be told from {_names(ties)}" if ties else ""
        sentences.append(f"Lowest {metric.label} of the {light} light: {best} with {scores[best]:.3g}{tied}.")
        for name, value in scores.items():
            if beaten_by(results, metric, column, name, value):
                worse.setdefault(name, []).append(metric.label)
    for measures in dict.fromkeys(map(tuple, worse.values())):
        names = [name for name, its in worse.items() if tuple(its) == measures]
        better = f"A black or a constant image has a lower {_names(list(measures))}"
        sentences.append(f"{better} than {_names(names)}.")

    times = results.ok.set_index("variant")["frame_ms_median"].dropna()
    if not times.empty:
        ties = [name for name in cost_marks(results, "frame_ms_median") if name != times.idxmin()]
        tied = f", within its spread {_names(ties)}" if ties else ""
        sentences.append(f"Fastest frame: {times.idxmin()} with {times.min():.3g} ms{tied}.")
    return sentences


def is_numeric(values: pd.Series) -> bool:
    """Whether every value of a sweep key is a finite number."""
    numbers = pd.to_numeric(values, errors="coerce")
    return bool(len(values)) and bool(numbers.map(math.isfinite).all())


def _count(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def _names(names: list[str], limit: int = 3) -> str:
    if len(names) > limit:
        return f"{', '.join(names[:limit])} and {len(names) - limit} more"
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
