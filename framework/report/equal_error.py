"""How much longer path tracing takes to reach the error of another method."""

from __future__ import annotations

import math
from dataclasses import dataclass

from report import text
from report.methods import Method
from report.ranking import all_beaten, log_cost_at, pareto_front
from report.results import LIGHTS, Metric, Results, interval_ends


@dataclass(frozen=True)
class Reached:
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


@dataclass(frozen=True)
class SpeedUp:
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
    def bound(self) -> str:
        """"more than " where path tracing does not reach the error at all, "at most " where all of it has less."""
        return {"": "", ">": "more than ", "<": "at most "}[self.reached.bound]

    @property
    def is_faster(self) -> bool:
        return self.reached.bound != "<" and self.factor > 1

    @property
    def is_significant(self) -> bool:
        """Whether the intervals of both errors leave no doubt of which one is faster."""
        return (self.least.bound != "<" and self.least.milliseconds > self.ms
                or self.most.bound != ">" and self.most.milliseconds < self.ms)

    @property
    def is_undecided(self) -> bool:
        """Whether a bound leaves open which of the two is faster."""
        return self.reached.bound == ("<" if self.factor > 1 else ">")

    @property
    def times(self) -> str:
        """The factor, ≈ before one that may lie on either side of 1, by the intervals."""
        about = "" if self.is_significant or self.bound else "≈ "
        return f"{about}{self.bound}{text.figures(self.factor, 2)} times as long"

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
    return max(found, key=lambda entry: (entry.is_faster, entry.is_undecided, entry.factor), default=None)


def sentence(found: SpeedUp, results: Results, light: str, metric: Metric) -> str:
    """What a frame of the method and of the fastest path-traced method take, and the build of a method that is faster."""
    head = f"At equal {metric.label} of the {light} light"
    who, ms, rival_ms = (results.full(found.variant), text.figures(found.ms), text.figures(found.reached.milliseconds))
    is_open = "" if found.is_significant else "; the intervals of their errors leave open which one is faster"
    if found.is_undecided:
        of, has = ("fastest", "less") if found.bound == "at most " else ("slowest", "more")
        return (f"{head} it is open whether path tracing is faster than {who}, {ms} ms a frame: the {of} "
                f"variant of {found.rival.name} takes {rival_ms} ms and has {has} error.")
    if not found.is_faster:
        return (f"{head} path tracing is as fast as all other methods or faster: a frame of {who} takes {ms} ms, one of "
                f"{found.rival.name} {found.bound}{rival_ms} ms{is_open}.")
    rival, short = f"one of {found.rival.name}", ""
    if found.bound:
        rival, short = "path tracing", " (all its variants have a higher error)"
    build = results.ok.set_index("variant").loc[found.variant, "build_ms"]
    number = results.numbers[found.variant]
    apart = f". Once for each scene or light, {number} is built in {text.figures(build)} ms, too" if build > 0 else ""
    return (f"{head}: a frame of {who} takes {ms} ms, {rival} {found.bound}{rival_ms} ms: {found.times}{found.span}"
            f"{short}{is_open}{apart}.")
