"""The sentences on top of the page."""

from __future__ import annotations

import math
from dataclasses import replace

from report import noise, pareto, text
from report.methods import methods_of
from report.ranking import all_beaten, score_marks
from report.results import LIGHTS, Metric, Results
from report.setting import comparisons

_TENTH_DB = 10.0  # a tenth of a squared error, in dB
_MAX_MISSING = 6  # variants that are listed by name
_MAX_SESSIONS = 4  # that are told apart


def summary(results: Results, light: str) -> list[str]:
    """Sentences on the best error, the time at equal error, the fastest variant and what failed.

    @param light "indirect" or "total".
    """
    total, finished = len(results.variants), len(results.ok)
    if total == 0:
        return ["No variant has finished yet."]
    said = []
    if failed := total - finished:
        of = "" if unfinished(results) else f"{finished} of {_count(total, 'variant')} finished. "
        said.append(f"{of}{_count(failed, 'variant')} failed; the reason stands below the table.")
    compared = comparisons(results)
    for metric in results.metrics[:1]:
        found = list(filter(None, (_of_scene(scene, of, len(compared) > 1, light, metric) for scene, of in compared)))
        if found:
            found[0] = f"Of the {light} light, {found[0]}" + (f" {metric.label}: {metric.meaning.split(';')[0]}." if metric.meaning else "")
        said += found + noise.sentences(results, light)
    said += _fastest(results, light) if len(compared) == 1 else []
    return said + _sessions(results) + _worse_than_nothing(results, light)


def unfinished(results: Results) -> str:
    """What of a run that has not ended is there and what is missing; "" of one that has."""
    if not results.manifest or results.manifest.get("finished"):
        return ""
    said, missing = "The run had not ended when this page was made.", results.missing
    if total := len(results.variants) + len(missing):
        said += f" {len(results.ok)} of {_count(total, 'variant')} {'is' if total == 1 else 'are'} finished"
        more = len(missing) - _MAX_MISSING
        said += f"; missing: {', '.join(missing[:_MAX_MISSING])}" if missing else ""
        said += f" and {more} more." if more > 0 else "."
    return said


def _of_scene(scene: str, results: Results, has_others: bool, light: str, metric: Metric) -> str:
    """The lowest error in a scene, and how much faster than path tracing a method is. "" of a scene without errors, or with
    a single one among other scenes."""
    results = replace(results, names={key: name.removeprefix(f"{scene}, ") for key, name in results.names.items()})
    scores = results.ok.set_index("variant")[LIGHTS[light] + metric.key].dropna()
    if len(scores) <= has_others:
        return ""
    best, ties = scores.map(metric.rank).idxmin(), _ties(results, light, metric)
    own = scores[ties or [best]]
    who = f"{results.listed(ties)} tie" if ties else results.full(best)
    said = f"{f'{scene}: ' if has_others else ''}lowest {metric.label} {' to '.join(dict.fromkeys(map(text.figures, (own.min(), own.max()))))}, {who}."
    said += _what_tells_apart(results, light, ties) if 2 * len(ties) > len(scores) else ""
    return f"{said}{_speed_up(results, light, metric)}"


def _speed_up(results: Results, light: str, metric: Metric) -> str:
    """How much faster than path tracing, filtered where it was, the fastest method is at equal error, as on the page of
    `voxray pareto`."""
    methods, members = methods_of([results])
    rivals = sorted((i for i, method in enumerate(methods) if method.traces_paths), key=lambda i: not methods[i].is_rival)
    scenes = pareto.scenes_of([results], members, [pareto.Error(metric)], light) if rivals else []
    found = pareto.speed_ups(scenes, methods, rivals[:1], 1)
    best = found.best(methods, 0, 0, 0) if scenes else None
    if best is None:
        return ""
    name, (value, low, high, reached) = best
    rival, factor = methods[rivals[0]].name, text.figures(value, 2)
    span = text.span(low, high) if 0 < low < high < math.inf else f"at least {text.figures(low, 2)}" if low > 0 else \
        f"up to {text.figures(high, 2)}" if high < math.inf else "any factor"
    ends = f"{span} within the intervals" + ("; that leaves open which is faster" if low <= 1 <= high else "")
    said = (f"{name} is {factor} times as fast as {rival}" if value > 1 else
            f"no method is faster than {rival}; {name} comes nearest, {factor} times as fast")
    return (f" At equal {metric.label} {said} ({f'{ends}; ' if low < high else ''}it reaches {reached:.0f} of "
            f"{found.count[0, 0, 0, 0]} errors).")


def _ties(results: Results, light: str, metric: Metric) -> list[str]:
    marks = score_marks(results, metric, LIGHTS[light] + metric.key)
    return [name for name in results.ok["variant"] if marks.get(name) == "tie"]


def _what_tells_apart(results: Results, light: str, ties: list[str]) -> str:
    """Less noise of their own where that is the larger part of all their errors; more samples in the reference where its
    noise is over a tenth of the ties' squared error, by PSNR of the previews; else nothing that the reference could bring:
    the ties share an error."""
    if noise.dominated(results, light).issuperset(ties):
        return " Most variants tie, within noise of their own."
    reference = results.reference_of(ties[0])
    column = LIGHTS[light] + "psnr_db"
    floor = results.noise(column, reference)
    scores = results.ok.set_index("variant").get(column)
    if scores is None or not math.isfinite(floor) or not scores[ties].median() < floor - _TENTH_DB:
        spp = (reference or {}).get("spp")
        now = f", now {spp}" if spp else ""
        return f" Most variants tie: more samples in the reference tell them apart (raise reference.spp{now})."
    return (" Most variants tie, and not for the reference's noise, which is less than a tenth of their squared error: they "
            "share an error. ./voxray explain CONFIG says which stage it comes from.")


def _fastest(results: Results, light: str) -> list[str]:
    """The fastest of those that are better than no image at all, where some are."""
    rows = results.ok.set_index("variant").dropna(subset="frame_ms_median")
    if rows.empty:
        return []
    beaten = {name for metric in results.metrics[:1]
              for name in all_beaten(results, metric, LIGHTS[light] + metric.key)}
    usable = rows[~rows.index.isin(beaten)]
    but = ", of those better than a constant image" if 0 < len(usable) < len(rows) else ""
    times = (rows if usable.empty else usable)["frame_ms_median"]
    first = times.idxmin()
    ties = [name for name in times.index[times <= max(times.min(), rows["frame_ms_p95"][first])] if name != first]
    tied = f"; within its spread {results.listed(ties)}" if ties else ""
    return [f"Fastest frame{but}: {results.full(first)}, {text.figures(times.min())} ms{tied}."]


def _sessions(results: Results) -> list[str]:
    """Where times come from, if the run was resumed or done in parts: the machine may have been busier during one."""
    sessions = results.sessions()
    if len(sessions) < 2:
        return []
    told = [f"{_count(len(names), 'variant')} of {began or 'an unknown time'}" for began, names in sessions[:_MAX_SESSIONS]]
    more = f" and {len(sessions) - _MAX_SESSIONS} more" if len(sessions) > _MAX_SESSIONS else ""
    return [f"Times come from {len(sessions)} processes, for the run was resumed or done in parts ({', '.join(told)}{more}): "
            "compare those of different ones only where the machine was equally idle."]


def _worse_than_nothing(results: Results, light: str) -> list[str]:
    # Variants that are worse in the same metrics share a sentence.
    worse: dict[str, list[str]] = {}
    for metric in results.charted:
        for name in all_beaten(results, metric, LIGHTS[light] + metric.key):
            worse.setdefault(name, []).append(metric.label)
    groups: dict[tuple[str, ...], list[str]] = {}
    for name, labels in worse.items():
        groups.setdefault(tuple(labels), []).append(name)
    return [f"Worse than a black or a constant image in {text.joined(labels)}: {results.listed(names)}."
            for labels, names in groups.items()]


def _count(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
