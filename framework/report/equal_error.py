"""How much longer path tracing takes to reach the error of another method."""

from __future__ import annotations

import math
from dataclasses import dataclass

from report import text
from report.load import LIGHTS, Metric, Results, interval_of
from report.names import Family, Names
from report.ranking import all_beaten, pareto_front

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
            at = math.log(error0 / error) / math.log(error0 / error1)
            return Reached(ms0 * (ms1 / ms0) ** at)
    return Reached(front[-1][0], ">")


@dataclass(frozen=True)
class SpeedUp:
    """How many times as long path tracing takes as a frame of a variant, `ms`, for its error: `reached` is its time, that of
    the family `rival`. `ends` are the factors at the ends of the error's interval, () where they tell nothing."""

    variant: str
    ms: float
    rival: Family
    reached: Reached
    ends: tuple[float, ...]

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
    def is_open(self) -> bool:
        """Whether a bound leaves open which of the two is faster."""
        return self.reached.bound == ("<" if self.factor > 1 else ">")


def speed_up(results: Results, light: str, metric: Metric, families: list[Family]) -> SpeedUp | None:
    """Of the methods next to path tracing, the one that saves most time at equal error. Where none saves any, one of which
    that is open; where it is of none, the one that loses least. None where the run has no path-traced family or nothing
    next to it. `results` are of one scene and reference: others don't compare."""
    column = LIGHTS[light] + metric.key
    rows = results.ok.set_index("variant", drop=False)
    usable = {name for name in rows.index if rows.loc[name, "frame_ms_median"] > 0 and rows.loc[name, column] > 0}
    rivals = [family for family in families if _RIVAL in family.passes and usable & set(family.variants)]
    traced = {name for family in rivals for name in family.variants}
    curves = [(family, _front([(rows.loc[name, "frame_ms_median"], rows.loc[name, column])
                               for name in family.variants if name in usable])) for family in rivals]
    beaten = all_beaten(results, metric, column)
    found = []
    for row in rows.to_dict("records") if rivals else ():
        name, ms = row["variant"], row["frame_ms_median"]
        if name in traced or name not in usable or name in beaten:
            continue
        found.append(SpeedUp(name, ms, *_fastest(row[column], curves), _ends(row, column, ms, curves)))
    return max(found, key=lambda entry: (entry.is_faster, entry.is_open, entry.factor), default=None)


def sentence(found: SpeedUp, results: Results, light: str, metric: Metric, names: Names) -> str:
    """What a frame of the method and of the fastest path-traced family take, and the build of a method that is faster."""
    head = f"At equal {metric.label} of the {light} light"
    ms, rival_ms = text.figures(found.ms), text.figures(found.reached.milliseconds)
    if found.is_open:
        of, has = ("fastest", "less") if found.bound == "at most " else ("slowest", "more")
        return (f"{head} it is open whether path tracing is faster than {names.full(found.variant)}, {ms} ms a frame: the {of} "
                f"variant of {found.rival.name} takes {rival_ms} ms and has {has} error.")
    if not found.is_faster:
        return (f"{head} path tracing is as fast as all other methods or faster: a frame of {names.full(found.variant)} takes "
                f"{ms} ms, one of {found.rival.name} {found.bound}{rival_ms} ms.")
    who, short = f"one of {found.rival.name}", ""
    if found.bound:
        who, short = "path tracing", " (all its variants have a higher error)"
    build = results.ok.set_index("variant").loc[found.variant, "build_ms"]
    apart = f". Its build, once for each scene or light, takes {text.figures(build)} ms more" if build > 0 else ""
    within = f" ({text.span(*found.ends)} within the error's interval)" if found.ends else ""
    return (f"{head}: a frame of {names.full(found.variant)} takes {ms} ms, {who} {found.bound}{rival_ms} ms: {found.bound}"
            f"{text.figures(found.factor, 2)} times as long{short}{within}{apart}.")


def _front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    return [points[i] for i in pareto_front(points)]


def _fastest(error: float, curves) -> tuple[Family | None, Reached | None]:
    # Of families that reach the error the fastest; where none does, the least of what is not enough.
    found = [(reached.bound == ">", reached.milliseconds, i, reached)
             for i, (_, points) in enumerate(curves) if (reached := time_to_reach(error, points))]
    if not found:
        return None, None
    _, _, i, reached = min(found, key=lambda entry: entry[:3])
    return curves[i][0], reached


def _ends(row, column: str, ms: float, curves) -> tuple[float, ...]:
    # What the error's own interval makes of the factor.
    ends = [_fastest(error, curves)[1] for error in reversed(interval_of(row, column)) if error > 0]
    if len(ends) < 2 or any(end.bound for end in ends) or ends[0].milliseconds == ends[1].milliseconds:
        return ()
    return tuple(end.milliseconds / ms for end in ends)
