"""The sentences on top of the page."""

from __future__ import annotations

import math
from dataclasses import replace

import pandas as pd

from report import pareto, text
from report.methods import methods_of
from report.ranking import score_marks
from report.results import LIGHTS, Metric, Results, section
from report.setting import comparisons

_IMAGES = {"total": "final", "indirect": "indirect"}  # light -> image, as the manifest calls it
_MAX_MISSING = 6  # variants that are listed by name


def summary(results: Results, light: str) -> list[str]:
    """Sentences on what failed, the best error, the time at equal error, and noise.

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
        said += found + _noise(results, light)
    return said + _sessions(results)


def unfinished(results: Results) -> str:
    """What of a run that has not ended is there and what is missing; "" of one that has."""
    if results.manifest.get("finished"):
        return ""
    said, missing = "The run had not ended when this page was made.", results.missing
    if total := len(results.variants) + len(missing):
        said += f" {len(results.ok)} of {_count(total, 'variant')} {'is' if total == 1 else 'are'} finished"
        said += (f"; missing: {text.first(missing, _MAX_MISSING)}" if missing else "") + "."
    return said


def _of_scene(scene: str, results: Results, has_others: bool, light: str, metric: Metric) -> str:
    """The lowest error in a scene, and how much faster than path tracing a method is. "" of a scene without errors, or with
    a single one among other scenes."""
    results = replace(results, names={key: name.removeprefix(f"{scene}, ") for key, name in results.names.items()})
    scores = results.ok.set_index("variant")[LIGHTS[light] + metric.key].dropna()
    if len(scores) <= has_others:
        return ""
    best, marks = scores.map(metric.rank).idxmin(), score_marks(results, metric, LIGHTS[light] + metric.key)
    ties = [name for name in results.ok["variant"] if marks.get(name) == "tie"]
    own = scores[ties or [best]]
    who = f"{results.listed(ties)} tie" if ties else results.full(best)
    said = f"{f'{scene}: ' if has_others else ''}lowest {metric.label} {' to '.join(dict.fromkeys(map(text.figures, (own.min(), own.max()))))}, {who}."
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


def _noise(results: Results, light: str) -> list[str]:
    """Whose error is noise for the larger part, and which parameters lower it, where a second seed tells."""
    split = [results.ok.set_index("variant")[LIGHTS[light] + metric.key] for metric in results.seed_metrics]
    bias_and_noise = pd.concat(split, axis=1).dropna() if split else pd.DataFrame()
    if bias_and_noise.empty:
        return []
    is_noise = bias_and_noise.iloc[:, 1] > bias_and_noise.iloc[:, 0]
    noisy = list(is_noise.index[is_noise])
    if not noisy:
        return ["Bias is the larger part of every variant's error."]
    lower = section(section(results.manifest, "noise_parameters"), _IMAGES[light])
    parameters = ", ".join(dict.fromkeys(path for name in noisy for path in lower.get(name, [])))
    return [f"Noise is the larger part of the error of {results.listed(noisy)}"
            + (f"; it falls as these rise: {parameters}." if parameters else ".")]


def _sessions(results: Results) -> list[str]:
    """Where times come from, if the run was resumed or done in parts: the machine may have been busier during one."""
    count = len(results.sessions())
    return [f"Times come from {count} processes, for the run was resumed or done in parts: compare those of different ones "
            "only where the machine was equally idle."] if count > 1 else []


def _count(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
