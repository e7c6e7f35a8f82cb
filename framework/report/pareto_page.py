"""The page of `voxray pareto`: charts of cost against error, a scene each, and what methods save."""

from __future__ import annotations

import math
from pathlib import Path

from matplotlib.figure import Figure

from report import pages, pareto, text
from report.charts import set_up_axis
from report.load import load
from report.pareto import COSTS, TRACED, Factor, Measured, Scene
from report.ranking import pareto_front
from report.results import Metric, ReportError, Results
from report.style import CATEGORY_COLORS, MARKERS, Style
from report.svg import PLACEHOLDERS, drawing, to_svg

_SAMPLES = (4, 16)  # of filtered path tracing, at whose errors the best method is looked for
_MAX_ON_FRONT = 3  # methods that are named
_WORST_OF = ("nrmse", "relmse")  # the metric that shows least gain counts
_QUALITY = ("ssim", "nrmse", "relmse", "mean_ratio")
CHARTED = (*pareto.TIMES, "memory")


def write(page: Path, folders: list[Path], error: str, light: str) -> Path:
    """Makes the page, and next to it a table of the same name. @return the table
    @throws ReportError where there are no results with that metric"""
    runs = [load(folder) for folder in folders]
    usable = {metric.key: metric for metric in runs[0].metrics if metric.better == "low"}
    if error not in usable:
        raise ReportError(f"--error: '{error}' is none of {', '.join(usable)}")
    metric, table = usable[error], page.with_suffix(".csv")
    rows = list(csv_lines(runs, metric, light))
    if len(rows) < 2:
        raise ReportError(f"no variant has {metric.label} of the {light} light")
    pages.write_whole(page, render(runs, metric, light))
    pages.write_whole(table, pages.csv_text(rows))
    return table


def render(runs: list[Results], metric: Metric, light: str) -> str:
    """The whole page, self-contained."""
    scenes = pareto.scenes_of(runs, metric, light)
    worst = [other for other in runs[0].metrics if other.key in _WORST_OF]
    both = [pareto.scenes_of(runs, other, light) for other in worst]
    methods = list(dict.fromkeys(method for scene in scenes for method in scene.methods()))
    styles = {method: Style(CATEGORY_COLORS[i % len(CATEGORY_COLORS)], list(MARKERS)[i % len(MARKERS)])
              for i, method in enumerate(methods)}
    rivalled = _with_rival(scenes)
    charts = [(scene.name, [chart for c, cost in enumerate(CHARTED)
                            if (chart := _chart(scene, cost, metric, light, styles, f"scene{s}-{c}"))])
              for s, scene in enumerate(scenes)]
    return pages.render(
        "pareto.html.j2", metric=metric, light=light, charts=charts,
        legend=list(styles.items()), markers=MARKERS, tables=[(cost, _savings(rivalled, cost)) for cost in pareto.TIMES],
        equal_time=_equal_time(rivalled, "frame"), best_points=_best_points(rivalled), gains=_gains(scenes, both),
        worst_of=_WORST_OF, scene_names=[scene.name for scene in rivalled], words={cost: _words_of(cost) for cost in pareto.TIMES},
        sentences=[*(said for cost in pareto.TIMES for said in _winners(scenes, both, cost)), *_not_reached(scenes, both, worst),
                   *_not_ranked(scenes, both), *_without_error(runs, metric, light),
                   *(said for cost in pareto.TIMES for said in _beaten(scenes, cost))],
        runs=[str(run.directory) for run in runs])


def csv_lines(runs: list[Results], metric: Metric, light: str):
    """Every variant of all runs: scene, method, machine, variant, costs, error and its interval."""
    yield ["scene", "method", "machine", "variant", *COSTS, metric.key, f"{metric.key}_low", f"{metric.key}_high"]
    for scene in pareto.scenes_of(runs, metric, light):
        for m in scene.measured:
            yield [scene.name, m.method, m.machine, m.label, *(f"{m.costs[cost]:.9g}" for cost in COSTS),
                   *(f"{value:.9g}" for value in (m.error, m.low, m.high))]


def _with_rival(scenes: list[Scene]) -> list[Scene]:
    """The scenes in which filtered path tracing was measured."""
    return [scene for scene in scenes if any(m.is_rival for m in scene.measured)]


def _savings(scenes: list[Scene], cost: str) -> list[tuple[str, ...]]:
    """Rows: method, range of factors in each scene, median, how often it reached the error."""
    rows = []
    by_scene = [pareto.speed_ups(scene, cost) for scene in scenes]
    for method, (median, _, reached, of) in pareto.median_speed_ups(scenes, cost).items():
        cells = [_range(own.get(method, [])) for own in by_scene]
        rows.append((method, *cells, text.figures(median, 2), f"{reached} of {of}"))
    return rows


def _ranked(scenes: list[Scene], views: list[list[Scene]]) -> list[tuple[Scene, ...]]:
    """The scenes in which the fastest method is looked for, each by several metrics."""
    return [own for scene, *own in zip(scenes, *views) if not _why_not_ranked(scene, own)]


def _why_not_ranked(scene: Scene, views: list[Scene]) -> str:
    """Why no method is looked for at the errors of filtered path tracing with _SAMPLES; "" where one is."""
    machines = list(dict.fromkeys(m.machine for m in scene.measured if m.is_rival))
    if not machines:
        return "no variant of path_trace with filter_irradiance was measured to compare with"
    spps = {m.spp for m in scene.measured if m.is_rival}
    if not spps >= set(_SAMPLES):
        return f"filtered path tracing was measured with {text.joined(sorted(spps))} samples a pixel, and {text.joined(_SAMPLES)} are needed"
    if not any(m.machine in machines and TRACED not in m.method for m in scene.measured):
        return "no other method was measured on the machine of filtered path tracing"
    if not views:
        return f"none of {text.joined(_WORST_OF)} was measured"
    if not all({m.spp for machine in machines for m in view.rivals(machine, "frame")} >= set(_SAMPLES) for view in views):
        return f"more samples a pixel did not lower the error of filtered path tracing, of {text.joined(_SAMPLES)}"
    return ""


def _not_ranked(scenes: list[Scene], views: list[list[Scene]]) -> list[str]:
    reasons: dict[str, list[str]] = {}  # scenes by why
    for scene, *own in zip(scenes, *views):
        if reason := _why_not_ranked(scene, own):
            reasons.setdefault(reason, []).append(scene.name)
    return [f"Not ranked, for {reason}: {', '.join(names)}." for reason, names in reasons.items()]


def _without_error(runs: list[Results], metric: Metric, light: str) -> list[str]:
    names = [str(run.directory) for run in runs if not pareto.scenes_of([run], metric, light)]
    return [f"Not shown, for no variant has {metric.label} of the {light} light: {', '.join(names)}."] if names else []


def _not_reached(scenes: list[Scene], views: list[list[Scene]], metrics: list[Metric]) -> list[str]:
    """Names the ranked scenes in which no method reaches the errors at any cost."""
    names = [own[0].name for own in _ranked(scenes, views) if pareto.best_at(own, "frame", _SAMPLES) is None]
    errors = f"{'both errors' if len(metrics) == 2 else 'the error'} ({text.joined([metric.label for metric in metrics])})"
    return [f"No method reaches {errors} of filtered path tracing with {text.joined(_SAMPLES)} samples a pixel, so none is called fastest there: "
            f"{', '.join(names)}."] if names else []


def _winners(scenes: list[Scene], views: list[list[Scene]], cost: str) -> list[str]:
    """A sentence on who wins by a time: at the errors of filtered path tracing, or else who is on the front."""
    wins: dict[str, list[str]] = {}  # by method: scenes
    for scene in _ranked(scenes, views):
        if (found := pareto.best_at(scene, cost, _SAMPLES)) is None:
            continue
        method, factor = found
        who = "filtered path tracing itself" if factor.high < 1 else method if factor.is_significant else "open"
        wins.setdefault(who, []).append(scene[0].name + ("" if factor.high < 1 else f" {_range([factor])}×"))
    if wins:
        listed = [f"{who} ({', '.join(names)})" for who, names in sorted(wins.items(), key=lambda entry: -len(entry[1]))]
        return [f"By the time of {_words_of(cost)}, fastest at the errors of filtered path tracing with {text.joined(_SAMPLES)} samples a pixel: "
                f"{'; '.join(listed)}."]
    front = list(pareto.on_front(scenes, cost).items())[:_MAX_ON_FRONT]
    told = "; ".join(f"{method} ({count} of {len(scenes)} scene{'s' * (len(scenes) > 1)})" for method, count in front)
    return [f"By the time of {_words_of(cost)}, most often on the Pareto front: {told}."] if told else []


def _beaten(scenes: list[Scene], cost: str) -> list[str]:
    beaten = pareto.dominated(scenes, cost)
    return [f"By the time of {_words_of(cost)}, beaten in every scene by another method: {'; '.join(beaten)}."] if beaten else []


def _gains(scenes: list[Scene], views: list[list[Scene]]) -> list[tuple[str, str, str, str]]:
    """A row for each scene and time: the factor of the method that gains most, and the method. No row where no method
    reaches the errors."""
    rows = []
    for scene in _ranked(scenes, views):
        for cost in pareto.TIMES:
            if found := pareto.best_at(scene, cost, _SAMPLES):
                rows.append((scene[0].name, _words_of(cost), _range([found[1]]), found[0]))
    return rows


def _words_of(cost: str) -> str:
    return COSTS[cost].split(",")[0].removeprefix("time of ")


def _best_points(scenes: list[Scene]) -> list[tuple[str, ...]]:
    """For each scene its most accurate variant that is no slower than filtered path tracing at its error."""
    rows = []
    for scene in scenes:
        if (found := pareto.best_point(scene, "frame")) is None:
            continue
        best, reached, ties = found
        rows.append((scene.name, best.label + (f" (≈ {len(ties)} more)" if ties else ""), text.figures(best.costs["frame"]),
                     f"never; its slowest {text.figures(reached.milliseconds)}" if reached.bound == ">" else
                     reached.bound + text.figures(reached.milliseconds),
                     *(text.figures(best.scores.get(key, math.nan)) for key in _QUALITY)))
    return rows


def _equal_time(scenes: list[Scene], cost: str) -> list[tuple[str, ...]]:
    by_scene = [pareto.errors_at_equal_time(scene, cost) for scene in scenes]
    methods = dict.fromkeys(method for own in by_scene for method in own)
    return [(method, *(_range(own.get(method, [])) for own in by_scene)) for method in methods]


def _range(factors: list[Factor]) -> str:
    """Least to greatest; "≈" before it where intervals leave open whether one of them is above or below 1."""
    known = [factor for factor in factors if not math.isnan(factor.value)]
    if not known:
        return "–"
    low, high = (text.figures(end(factor.value for factor in known), 2) for end in (min, max))
    part = "" if len(known) == len(factors) else f" ({len(known)} of {len(factors)})"
    return ("" if all(factor.is_significant for factor in known) else "≈ ") + (low if low == high else f"{low}–{high}") + part


def _chart(scene: Scene, cost: str, metric: Metric, light: str, styles: dict[str, Style], chart_id: str) -> str | None:
    points: list[Measured] = [m for m in scene.measured if 0 < m.costs[cost] < math.inf and 0 < m.error < math.inf]
    if not points:
        return None
    with drawing():
        figure = Figure(figsize=(5.0, 3.7), dpi=72)
        axes = figure.add_axes((0.14, 0.13, 0.84, 0.85))
        set_up_axis(axes.xaxis, [m.costs[cost] for m in points])
        set_up_axis(axes.yaxis, [m.error for m in points] + [m.high for m in points])
        axes.set_xlabel(COSTS[cost])
        axes.set_ylabel(f"{metric.label}, {light} light (lower is better)")
        front = [points[i] for i in pareto_front([(m.costs[cost], m.high) for m in points])]
        axes.step([m.costs[cost] for m in front], [m.high for m in front], where="post", color=PLACEHOLDERS["muted"],
                  linewidth=1.2)
        for method in scene.methods():
            line = sorted((m.costs[cost], m.error) for m in points if m.method == method)
            axes.plot(*zip(*line), color=PLACEHOLDERS[styles[method].color], linewidth=1.0, alpha=0.5) if line else None
        for i, m in enumerate(points):
            ink = PLACEHOLDERS[styles[m.method].color]
            axes.plot([m.costs[cost]] * 2, [max(m.low, axes.get_ylim()[0]), m.high], color=ink, linewidth=1.0)
            dot = axes.plot(m.costs[cost], m.error, styles[m.method].marker, color=ink, markersize=6,
                            markeredgecolor=PLACEHOLDERS["card"], markeredgewidth=0.8, zorder=3)[0]
            dot.set_gid(f"{chart_id}-point-{i}")
        titles = [f"{m.label}, {m.method}: {m.costs[cost]:.3g}, {m.error:.3g}" for m in points]
        return to_svg(figure, chart_id, f"{scene.name}: {metric.label} against {COSTS[cost]}", titles)
