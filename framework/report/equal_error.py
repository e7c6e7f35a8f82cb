"""How much longer path tracing takes to reach the error of another method."""

from __future__ import annotations

import math
from dataclasses import dataclass

from report import text
from report.names import Family, Names
from report.ranking import all_beaten, pareto_front
from report.results import LIGHTS, Metric, Results, interval_ends

_RIVAL = "path_trace"  # the pass that a user would pick instead


@dataclass(frozen=True)
class Reached:
    """The time in which a family of variants reaches an error. `bound` is "" for an interpolated time, "<" where its
    fastest variant has less error already, ">" where none has as little."""

    milliseconds: float
    bound: str = ""


def time_to_reach(error: float, points: list[tuple[float, float]]) -> Reached | None:
    """Interpolates (ms, error) points, logarithm over logarithm, between those that no other one beats."""
    front = _front(points)
    if not front:
        return None
    if front[0][1] <= error:
        return Reached(front[0][0], "<" if front[0][1] < error else "")
    for (ms0, error0), (ms1, error1) in zip(front, front[1:]):
        if error1 <= error:
            fraction = math.log(error0 / error) / math.log(error0 / error1) if error1 > 0 else 0.0
            return Reached(ms0 * (ms1 / ms0) ** fraction)
    return Reached(front[-1][0], ">")


@dataclass(frozen=True)
class SpeedUp:
    """How many times as long as a frame of a variant, `ms`, path tracing takes to reach its error.

    reached: the time of the path-traced family `rival`. least, most: that time at the ends of the intervals of both errors;
        equal to `reached` where there are none.
    """

    variant: str
    ms: float
    rival: Family
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
    def about(self) -> str:
        """"≈ " before a factor that is no bound and may lie on either side of 1, by the intervals."""
        return "" if self.is_significant or self.bound else "≈ "

    @property
    def span(self) -> str:
        """The factors at the ends of the intervals, as far as they are known; "" without intervals, or where neither is."""
        low, high = (end.milliseconds / self.ms for end in (self.least, self.most))
        is_low, is_high = self.least.bound != "<", self.most.bound != ">"
        if self.least == self.most or not (is_low or is_high):
            return ""
        known = text.span(low, high) if is_low and is_high else f"at least {text.figures(low, 2)}" if is_low else f"up to {text.figures(high, 2)}"
        return f" ({known} within the errors' intervals)"

    @property
    def is_undecided(self) -> bool:
        """Whether a bound leaves open which of the two is faster."""
        return self.reached.bound == ("<" if self.factor > 1 else ">")


def speed_up(results: Results, light: str, metric: Metric, families: list[Family]) -> SpeedUp | None:
    """The method that saves most time over path tracing at equal error. Where none surely saves any, one that may; where
    none may, the one that loses least. None where the run has no path-traced family or nothing but such.

    @param results Variants of one scene and reference: others don't compare.
    """
    column = LIGHTS[light] + metric.key
    rows = results.ok.set_index("variant", drop=False)
    usable = {name for name in rows.index if rows.loc[name, "frame_ms_median"] > 0 and rows.loc[name, column] > 0}
    rivals = [family for family in families if _RIVAL in family.passes and usable & set(family.variants)]
    traced = {name for family in rivals for name in family.variants}
    low, high = interval_ends(rows, column)
    curves, of_low, of_high = ([(family, _front([(rows.loc[name, "frame_ms_median"], errors[name])
                                                 for name in family.variants if name in usable])) for family in rivals]
                               for errors in (rows[column], low, high))
    beaten = all_beaten(results, metric, column)
    found = []
    for row in rows.to_dict("records") if rivals else ():
        name, ms = row["variant"], row["frame_ms_median"]
        if name in traced or name not in usable or name in beaten:
            continue
        found.append(SpeedUp(name, ms, *_fastest(row[column], curves), _fastest(high[name], of_low)[1], _fastest(low[name], of_high)[1]))
    return max(found, key=lambda entry: (entry.is_faster, entry.is_undecided, entry.factor), default=None)


def sentence(found: SpeedUp, results: Results, light: str, metric: Metric, names: Names) -> str:
    """What a frame of the method and of the fastest path-traced family take, and the build of a method that is faster."""
    head = f"At equal {metric.label} of the {light} light"
    ms, rival_ms = text.figures(found.ms), text.figures(found.reached.milliseconds)
    if found.is_undecided:
        of, has = ("fastest", "less") if found.bound == "at most " else ("slowest", "more")
        return (f"{head} it is open whether path tracing is faster than {names.full(found.variant)}, {ms} ms a frame: the {of} "
                f"variant of {found.rival.name} takes {rival_ms} ms and has {has} error.")
    if not found.is_faster:
        return (f"{head} path tracing is as fast as all other methods or faster: a frame of {names.full(found.variant)} takes "
                f"{ms} ms, one of {found.rival.name} {found.bound}{rival_ms} ms"
                f"{_open(found)}.")
    who, short = f"one of {found.rival.name}", ""
    if found.bound:
        who, short = "path tracing", " (all its variants have a higher error)"
    build = results.ok.set_index("variant").loc[found.variant, "build_ms"]
    number = names.numbers[found.variant]
    apart = f". Once for each scene or light, {number} is built in {text.figures(build)} ms, too" if build > 0 else ""
    return (f"{head}: a frame of {names.full(found.variant)} takes {ms} ms, {who} {found.bound}{rival_ms} ms: {found.about}{found.bound}"
            f"{text.figures(found.factor, 2)} times as long{found.span}{short}{_open(found)}{apart}.")


def _open(found: SpeedUp) -> str:
    return "" if found.is_significant else "; the intervals of their errors leave open which one is faster"


def _front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    return [points[i] for i in pareto_front(points)]


def _fastest(error: float, curves) -> tuple[Family | None, Reached | None]:
    # The fastest of the families that reach the error; where none does, the one that fails to at the least cost
    found = [(reached.bound == ">", reached.milliseconds, i, reached)
             for i, (_, points) in enumerate(curves) if (reached := time_to_reach(error, points))]
    if not found:
        return None, None
    _, _, i, reached = min(found, key=lambda entry: entry[:3])
    return curves[i][0], reached

