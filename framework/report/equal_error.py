"""How much longer path tracing takes to reach the error of another method."""

from __future__ import annotations

import math
from typing import NamedTuple

from report import text
from report.methods import Method
from report.ranking import all_beaten, log_cost_at, pareto_front
from report.results import LIGHTS, Metric, Results, interval_ends


class Reached(NamedTuple):
    """The time in which variants of a method reach an error. `bound` is "" for an interpolated time, "<" where the
    fastest one has less error already, ">" where none has as little."""

    milliseconds: float
    bound: str = ""


def time_to_reach(error: float, points: list[tuple[float, float]]) -> Reached | None:
    """Interpolates (ms, error) points between those that no other one beats. None without any point."""
    front = [points[i] for i in pareto_front(points)]
    if not front:
        return None
    times, errors = zip(*front)
    log_ms = float(log_cost_at(error, times, errors))
    if math.isnan(log_ms):
        return Reached(times[-1], ">")
    return Reached(math.exp(log_ms), "<" if error > errors[0] else "")


class SpeedUp(NamedTuple):
    """How many times as long as a frame of a variant, `ms`, path tracing takes to reach its error.

    reached: the time of the path-traced method `rival`. least, most: that time at the ends of the intervals of both errors;
        equal to `reached` where there are none.
    """

    variant: str
    ms: float
    rival: Method
    reached: Reached
    least: Reached
    most: Reached

    @property
    def factor(self) -> float:
        return self.reached.milliseconds / self.ms

    @property
    def is_open(self) -> bool:
        """Whether a bound leaves open which of the two is faster."""
        return self.reached.bound == ("<" if self.factor > 1 else ">")

    @property
    def is_significant(self) -> bool:
        """Whether the intervals of both errors leave no doubt of which one is faster."""
        return (self.least.bound != "<" and self.least.milliseconds > self.ms
                or self.most.bound != ">" and self.most.milliseconds < self.ms)

    @property
    def span(self) -> str:
        """The factors at the ends of the intervals, as far as they are known; "" without intervals, or where neither is."""
        low, high = (end.milliseconds / self.ms for end in (self.least, self.most))
        is_low, is_high = self.least.bound != "<", self.most.bound != ">"
        if self.least == self.most or not (is_low or is_high):
            return ""
        known = (text.span(low, high) if is_low and is_high else
                 f"at least {text.figures(low, 2)}" if is_low else f"up to {text.figures(high, 2)}")
        return f" ({known} within the errors' intervals)"


def speed_up(results: Results, light: str, metric: Metric, families: list[tuple[Method, list[str]]]) -> SpeedUp | None:
    """The method that saves most time over path tracing at equal error. Where none surely saves any, one that may; where
    none may, the one that loses least. None where the run has no path-traced method or nothing but such.

    @param results Variants of one scene and reference: others don't compare. @param families see families_of()
    """
    column = LIGHTS[light] + metric.key
    rows = results.ok.set_index("variant")
    rows = rows[(rows["frame_ms_median"] > 0) & (rows[column] > 0)]
    low, high = interval_ends(rows, column)
    traced = {name for method, names in families if method.traces_paths for name in names}
    beaten = all_beaten(results, metric, column)

    def fronts(errors) -> list[tuple[Method, list[tuple[float, float]]]]:
        """Of each path-traced method the points that no other one of its own beats."""
        points = [(method, [(rows["frame_ms_median"][name], errors[name]) for name in names if name in rows.index])
                  for method, names in families if method.traces_paths]
        return [(method, [own[i] for i in pareto_front(own)]) for method, own in points if own]

    def fastest(error: float, fronts) -> tuple[Method, Reached]:
        """The fastest of the methods that reach the error; where none does, the one that fails to at the least cost."""
        reached = [(method, time_to_reach(error, front)) for method, front in fronts]
        return min(reached, key=lambda entry: (entry[1].bound == ">", entry[1].milliseconds))

    curves, of_low, of_high = map(fronts, (rows[column], low, high))
    found = [SpeedUp(name, row["frame_ms_median"], *fastest(row[column], curves), fastest(high[name], of_low)[1],
                     fastest(low[name], of_high)[1])
             for name, row in rows.iterrows() if curves and name not in traced and name not in beaten]
    return max(found, key=lambda entry: (entry.reached.bound != "<" and entry.factor > 1, entry.is_open, entry.factor),
               default=None)


def sentence(found: SpeedUp, results: Results) -> str:
    """What path tracing takes for a variant's error, and whether that leaves open which of the two is faster."""
    build = results.ok.set_index("variant").loc[found.variant, "build_ms"]
    bound = {"": "", ">": "more than ", "<": "at most "}[found.reached.bound]
    about = "" if found.is_significant or bound else "≈ "
    if found.is_open or not found.is_significant:
        end = "; that leaves open which one is faster"
    else:
        end = "" if found.factor > 1 else ", and no other method is faster"
    return (f"For the error of {results.full(found.variant)}, {text.figures(found.ms)} ms a frame"
            f"{f' and {text.figures(build)} ms of build' if build > 0 else ''}, path tracing ({found.rival.name}) takes "
            f"{bound}{text.figures(found.reached.milliseconds)} ms a frame: {about}{bound}{text.figures(found.factor, 2)} "
            f"times as long{found.span}{end}.")
