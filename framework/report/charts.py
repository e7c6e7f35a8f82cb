"""Speed-against-error charts."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from report.names import Names
from report.ranking import pareto_front, pareto_layers
from report.results import BASELINES, LIGHTS, Metric, Results, interval_ends
from report.style import Style
from report.svg import FONT_SIZE, PLACEHOLDERS, drawing, to_svg

_MAX_OVERLAP = 0.1  # of a label with others, as a fraction of its area
_MAX_MARKS = 250  # of more points the ones far from the Pareto front are small dots
_MAX_LABELS = 80
_LABEL_DIRECTIONS = ((1, 0), (1, 1), (-1, -1), (1, -1), (-1, 0), (-1, 1), (0, 1), (0, -1))  # from its point, the best first


@dataclass(frozen=True)
class Point:
    """A variant on a chart: its median cost in ms with the 5th and 95th percentile, and its error with its interval."""

    name: str
    label: str
    anchor: str
    cost: float
    low: float
    high: float
    error: float
    least: float
    most: float


@dataclass(frozen=True)
class Chart:
    svg: str
    caption: str
    not_drawn: list[str]
    unlabelled: int  # points whose label would lie on another one
    marks: int = 0  # points with a mark, a link and bars
    dots: int = 0  # all others


def cost_error_chart(results: Results, metric: Metric, light: str, with_build: bool, styles: dict[str, Style],
                     labels: dict[str, str], anchors: dict[str, str], chart_id: str,
                     curves: list[list[str]], names: Names) -> Chart | None:
    """Draws time against one error on two log axes, the Pareto front, and, if all variants have one reference,
    its own noise and what a black and a constant image score. None where no variant has both numbers above zero.

    @param with_build Adds the build's time to the frame's.
    @param labels, anchors For each variant, the text at its point and the id that its point links to.
    @param curves Variants that a line joins.
    """
    column = LIGHTS[light] + metric.key
    points, not_drawn = _points(results, column, with_build, labels, anchors)
    if not points:
        return None
    levels = [("reference's own noise", results.noise(column, results.only_reference), ":")]
    levels += [(f"{name} image", results.baseline(name, column, results.only_reference), "--") for name in BASELINES]
    levels = [level for level in levels if level[1] > 0]

    time = "build + one frame" if with_build else "one frame"
    caption = f"{metric.label} of the {light} light against the time of {time}."
    with drawing():
        figure = Figure(figsize=(5.0, 3.7), dpi=72)  # matplotlib's SVG has 72 units an inch
        axes = figure.add_axes((0.14, 0.13, 0.84, 0.85))
        set_up_axis(axes.xaxis, [p.low for p in points] + [p.high for p in points])
        set_up_axis(axes.yaxis, [p.error for p in points] + [p.most for p in points] + [level[1] for level in levels])
        axes.set_xlabel(f"time of {time}, ms (median; left is faster)")
        axes.set_ylabel(f"{metric.label}, {light} light (lower is better)")
        _draw_levels(axes, levels)
        near = sorted(_near_front(points, _MAX_MARKS))
        marked, dots = [points[i] for i in near], [points[i] for i in set(range(len(points))).difference(near)]
        _draw_dots(axes, dots, styles)
        _draw_curves(axes, points, curves, styles)
        front, drawn = _draw_points(axes, marked, styles, chart_id)
        labelled = [marked[i] for i in _near_front(marked, _MAX_LABELS)] if len(marked) > _MAX_LABELS else marked
        unlabelled = len(points) - _place_labels(axes, labelled, marked, front, levels)
        titles = [f"{names.full(p.name)}: {p.cost:.3g} ms, {p.error:.3g}" for p in drawn]
        svg = to_svg(figure, chart_id, caption, titles, [p.anchor for p in drawn])
    return Chart(svg, caption, not_drawn, unlabelled, len(marked), len(dots))


def _near_front(points: list[Point], count: int) -> list[int]:
    return pareto_layers([(p.cost, p.most) for p in points], count)


def _points(results, column, with_build, labels, anchors) -> tuple[list[Point], list[str]]:
    points, not_drawn = [], []
    ok = results.ok
    build = ok["build_ms"] if with_build else 0.0
    times = (ok[key] + build for key in ("frame_ms_median", "frame_ms_p05", "frame_ms_p95"))
    for name, error, least, most, cost, *spread in zip(ok["variant"], ok[column], *interval_ends(ok, column), *times):
        if not (0 < cost < math.inf and 0 < error < math.inf):
            not_drawn.append(name)
            continue
        low, high = (value if 0 < value < math.inf else cost for value in spread)
        points.append(Point(name, labels[name], anchors[name], cost, low, high, error, least, most))
    return points, not_drawn


def set_up_axis(axis, values: list[float]) -> None:
    """A log axis over values above zero, with ticks and a grid."""
    # At least a factor of four, so that a cluster is not blown up into a spread, and room for the labels.
    low, high = math.log10(min(values)), math.log10(max(values))
    widen = max(0.0, math.log10(4.0) - (high - low)) / 2
    low, high = low - widen, high + widen
    margin = 0.1 * (high - low)
    limits = 10 ** (low - margin), 10 ** (high + margin)

    # Ticks at 1, 2 and 5, or at the powers of ten where those are many.
    def ticks(steps):
        decades = range(math.floor(low - margin), math.ceil(high + margin) + 1)
        return [t for d in decades for s in steps if limits[0] <= (t := s * 10.0**d) <= limits[1]]

    axis.axes.set(**{f"{axis.axis_name}scale": "log", f"{axis.axis_name}lim": limits})
    axis.set_major_locator(FixedLocator(ticks((1,)) if high - low > 2.2 else ticks((1, 2, 5))))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.6g}"))
    axis.set_minor_locator(NullLocator())
    axis.axes.grid(True, axis=axis.axis_name, color=PLACEHOLDERS["grid"], linewidth=0.6)
    axis.axes.spines[["top", "right"]].set_visible(False)
    axis.axes.set_axisbelow(True)


def _draw_levels(axes, levels) -> None:
    for name, value, dashes in levels:
        axes.axhline(value, color=PLACEHOLDERS["muted"], linestyle=dashes, linewidth=1.0)
        axes.annotate(name, (0.995, value), (0, 2), xycoords=("axes fraction", "data"), ha="right",
                      va="bottom", textcoords="offset points", color=PLACEHOLDERS["muted"],
                      fontsize=FONT_SIZE - 1)


def _draw_curves(axes, points: list[Point], curves: list[list[str]], styles: dict[str, Style]) -> None:
    position = {p.name: (p.cost, p.error) for p in points}
    for curve in curves:
        line = sorted(position[name] for name in curve if name in position)
        if line:
            axes.plot(*zip(*line), color=PLACEHOLDERS[styles[curve[0]].color], linewidth=1.0, alpha=0.6)


def _draw_dots(axes, points: list[Point], styles: dict[str, Style]) -> None:
    """Small dots: strokes of no length with round ends."""
    for color, own in _by(points, lambda point: styles[point.name].color).items():
        _draw_strokes(axes, [((p.cost, p.error), (p.cost, p.error)) for p in own], color=PLACEHOLDERS[color], linewidth=2.2,
                      solid_capstyle="round", alpha=0.6)


def _draw_points(axes, points: list[Point], styles: dict[str, Style], chart_id: str) -> tuple[list[Point], list[Point]]:
    """@return the Pareto front, and the points in the order in which their marks are drawn."""
    # The Pareto front is a staircase of the errors that are surely reached: what lies wholly above it is beaten.
    front = [points[i] for i in pareto_front([(p.cost, p.most) for p in points])]
    axes.step([p.cost for p in front], [p.most for p in front], where="post", color=PLACEHOLDERS["muted"],
              linewidth=1.2)
    for color, own in _by(points, lambda point: styles[point.name].color).items():
        bottom = axes.get_ylim()[0]  # an interval may begin at 0
        _draw_strokes(axes, [((p.low, p.error), (p.high, p.error)) for p in own] +
                      [((p.cost, max(p.least, bottom)), (p.cost, p.most)) for p in own], color=PLACEHOLDERS[color], linewidth=1.0)
    groups = _by(points, lambda point: styles[point.name])
    for i, (style, own) in enumerate(groups.items()):
        marks = axes.plot([p.cost for p in own], [p.error for p in own], style.marker, color=PLACEHOLDERS[style.color], markersize=7,
                          markeredgecolor=PLACEHOLDERS["card"], markeredgewidth=0.8, zorder=3)[0]
        marks.set_gid(f"{chart_id}-points-{i}")
    return front, [point for own in groups.values() for point in own]


def _draw_strokes(axes, ends, **style) -> None:
    """Lines between pairs of positions, as one path: many paths are slow to draw and large."""
    gap = (math.nan, math.nan)
    axes.plot(*zip(*(position for begin, end in ends for position in (begin, end, gap))), **style)


def _by(points: list[Point], key: Callable) -> dict[Hashable, list[Point]]:
    groups = {}
    for point in points:
        groups.setdefault(key(point), []).append(point)
    return groups


def _place_labels(axes, points: list[Point], marked: list[Point], front: list[Point], levels) -> int:
    """Each label of `points` takes the side where it covers least of what is drawn already. @return how many there are:
    those that would lie on others are left out."""
    frame = axes.get_window_extent()
    taken = [(x - 5, y - 5, x + 5, y + 5) for x, y in _positions(axes, marked)]
    for name, value, _ in levels:
        y = axes.transData.transform((1, value))[1]
        width = 0.5 * (FONT_SIZE - 1) * len(name)
        taken += [(frame.x1 - width, y, frame.x1, y + FONT_SIZE), (frame.x0, y - 2, frame.x1, y + 2)]
    steps = [axes.transData.transform((p.cost, p.most)) for p in front]
    for (x0, y0), (x1, y1) in zip(steps, steps[1:]):
        taken += [(x0, y0 - 2, x1, y0 + 2), (x1 - 2, y1, x1 + 2, y0)]
    labels = []
    for point, (x, y) in zip(points, _positions(axes, points)):
        width, height = 0.56 * FONT_SIZE * len(point.label), FONT_SIZE
        sides = []
        for dx, dy in _LABEL_DIRECTIONS:
            reach = 6 if dx == 0 or dy == 0 else 4
            left = x + dx * reach - (width / 2 if dx == 0 else width if dx < 0 else 0)
            bottom = y + dy * reach - (height / 2 if dy == 0 else height if dy < 0 else 0)
            sides.append((left, bottom, left + width, bottom + height))
        outside = width * height - _overlaps(sides, [(frame.x0, frame.y0, frame.x1, frame.y1)])[:, 0]
        costs = _overlaps(sides, taken).sum(axis=1) + 4 * outside + 0.5 * np.arange(len(sides))
        best = sides[int(costs.argmin())]
        if labels and _overlaps([best], labels).sum() > _MAX_OVERLAP * width * height:
            continue
        taken.append(best)
        labels.append(best)
        axes.annotate(point.label, best[:2], xycoords="figure pixels", color=PLACEHOLDERS["fg"],
                      fontsize=FONT_SIZE, va="bottom", annotation_clip=False)
    return len(labels)


def _positions(axes, points: list[Point]) -> np.ndarray:
    """Where points lie in the figure, in its pixels: shape (points, 2)."""
    return axes.transData.transform([(p.cost, p.error) for p in points])


def _overlaps(boxes, others) -> np.ndarray:
    """The areas that boxes (left, bottom, right, top) have in common with others: shape (boxes, others)."""
    a, b = np.asarray(boxes)[:, None], np.asarray(others)[None]
    sides = np.minimum(a[..., 2:], b[..., 2:]) - np.maximum(a[..., :2], b[..., :2])
    return sides.clip(min=0).prod(axis=-1)
