"""The sentences on top of the page: numbers and short names."""

from __future__ import annotations

from report import equal_error, noise, text
from report.load import LIGHTS, Results
from report.names import Family, Names
from report.ranking import beaten_by, score_marks


def summary(results: Results, light: str, families: list[Family], names: Names) -> list[str]:
    """Sentences on the best error, the time at equal error, the fastest variant and what failed.

    @param light "indirect" or "total".
    """
    total, finished = len(results.variants), len(results.ok)
    if total == 0:
        return ["No variant has finished yet."]
    sentences = []
    if failed := total - finished:
        sentences.append(f"{finished} of {_count(total, 'variant')} finished. {_count(failed, 'variant')} failed; the "
                         "reason stands below the table.")
    metric = results.metrics[0] if results.metrics else None
    if metric:
        sentences += _lowest_error(results, light, metric, names)
        sentences += equal_error.sentences(results, light, metric, families, names)
        sentences += noise.sentences(results, light, names)
    sentences += _fastest(results, light, names)
    return sentences + _worse_than_nothing(results, light, names)


def _lowest_error(results: Results, light: str, metric, names: Names) -> list[str]:
    column = LIGHTS[light] + metric.key
    scores = results.ok.set_index("variant")[column].dropna()
    if scores.empty:
        return []
    best = scores.map(metric.rank).idxmin()
    marks = score_marks(results, metric, column)
    ties = [name for name in scores.index if marks.get(name) == "tie"]
    explained = f" {metric.label}: {metric.meaning.split(';')[0]}." if metric.meaning else ""
    if not ties:
        return [f"Lowest {metric.label} of the {light} light: {names.full(best)}, {text.figures(scores[best])}.{explained}"]
    found = [f"Lowest {metric.label} of the {light} light: {names.listed(ties)} tie, from "
             f"{text.figures(scores[ties].min())} to {text.figures(scores[ties].max())}."]
    if 2 * len(ties) > len(scores):
        spp = (results.only_reference or {}).get("spp")
        found[0] += (" Most variants tie: more samples in the reference tell them apart (raise reference.spp"
                     f"{f', now {spp}' if spp else ''}).")
    found[0] += explained
    return found


def _fastest(results: Results, light: str, names: Names) -> list[str]:
    """The fastest of those that are better than no image at all, where some are."""
    rows = results.ok.set_index("variant", drop=False)
    rows = rows[rows["frame_ms_median"].notna()]
    if rows.empty:
        return []
    usable = [name for name, row in rows.iterrows()
              if not any(beaten_by(results, metric, LIGHTS[light] + metric.key, row) for metric in results.metrics[:1])]
    times = rows.loc[usable or list(rows.index), "frame_ms_median"]
    but = ", of those better than a constant image" if 0 < len(usable) < len(rows) else ""
    reach = max(times.min(), rows.loc[times.idxmin(), "frame_ms_p95"])
    ties = [name for name, ms in times.items() if ms <= reach and name != times.idxmin()]
    tied = f"; within its spread {names.listed(ties)}" if ties else ""
    return [f"Fastest frame{but}: {names.full(times.idxmin())}, {text.figures(times.min())} ms{tied}."]


def _worse_than_nothing(results: Results, light: str, names: Names) -> list[str]:
    # By what they fail, so that variants that fail alike stand together.
    worse: dict[str, list[str]] = {}
    for metric in results.metrics[:3]:
        for _, row in results.ok.iterrows():
            if beaten_by(results, metric, LIGHTS[light] + metric.key, row):
                worse.setdefault(row["variant"], []).append(metric.label)
    sentences = []
    for measures in dict.fromkeys(map(tuple, worse.values())):
        found = [name for name, its in worse.items() if tuple(its) == measures]
        labels = " and ".join([", ".join(measures[:-1]), measures[-1]] if len(measures) > 1 else measures)
        sentences.append(f"Worse than a black or a constant image in {labels}: {names.listed(found)}.")
    return sentences


def _count(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
