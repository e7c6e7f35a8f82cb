"""Speed-against-error charts."""

from __future__ import annotations

import math
from dataclasses import dataclass

from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from report.ranking import pareto_front
from report.load import BASELINES, LIGHTS, Metric, Results, interval_of
from report.names import Names
from report.style import Style
from report.svg import FONT_SIZE, STAND_INS, drawing, to_svg

_MAX_COVERED = 0.1  # of a label, by others
_SIDES = ((1, 0), (1, 1), (-1, -1), (1, -1), (-1, 0), (-1, 1), (0, 1), (0, -1))  # of a point, the best first


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
        _draw_curves(axes, points, curves, styles)
        front = _draw_points(axes, points, styles, chart_id)
        unlabelled = _place_labels(axes, points, front, levels)
        titles = [f"{names.full(p.name)}: {p.cost:.3g} ms, {p.error:.3g}" for p in points]
        svg = to_svg(figure, chart_id, caption, titles)
    return Chart(svg, caption, not_drawn, unlabelled)


def _points(results, column, with_build, labels, anchors) -> tuple[list[Point], list[str]]:
    points, not_drawn = [], []
    for _, row in results.ok.iterrows():
        build = row["build_ms"] if with_build else 0.0
        cost, error = row["frame_ms_median"] + build, row[column]
        if not (0 < cost < math.inf and 0 < error < math.inf):
            not_drawn.append(row["variant"])
            continue
        low, high = (row[c] + build for c in ("frame_ms_p05", "frame_ms_p95"))
        low, high = (value if 0 < value < math.inf else cost for value in (low, high))
        name = row["variant"]
        points.append(Point(name, labels[name], anchors[name], cost, low, high, error, *interval_of(row, column)))
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
    axis.axes.grid(True, axis=axis.axis_name, color=STAND_INS["grid"], linewidth=0.6)
    axis.axes.spines[["top", "right"]].set_visible(False)
    axis.axes.set_axisbelow(True)


def _draw_levels(axes, levels) -> None:
    for name, value, dashes in levels:
        axes.axhline(value, color=STAND_INS["muted"], linestyle=dashes, linewidth=1.0)
        axes.annotate(name, (0.995, value), (0, 2), xycoords=("axes fraction", "data"), ha="right",
                      va="bottom", textcoords="offset points", color=STAND_INS["muted"],
                      fontsize=FONT_SIZE - 1)


def _draw_curves(axes, points: list[Point], curves: list[list[str]], styles: dict[str, Style]) -> None:
    for curve in curves:
        own = sorted((p.cost, p.error) for p in points if p.name in curve)
        if own:
            axes.plot(*zip(*own), color=STAND_INS[styles[curve[0]].color], linewidth=1.0, alpha=0.6)


def _draw_points(axes, points: list[Point], styles: dict[str, Style], chart_id: str) -> list[Point]:
    # The Pareto front is a staircase of the errors that are surely reached: what lies wholly above it is beaten.
    front = [points[i] for i in pareto_front([(p.cost, p.most) for p in points])]
    axes.step([p.cost for p in front], [p.most for p in front], where="post", color=STAND_INS["muted"],
              linewidth=1.2)
    for i, point in enumerate(points):
        ink = STAND_INS[styles[point.name].color]
        axes.plot([point.low, point.high], [point.error] * 2, color=ink, linewidth=1.0)
        bottom = max(point.least, axes.get_ylim()[0])  # an interval may begin at 0
        axes.plot([point.cost] * 2, [bottom, point.most], color=ink, linewidth=1.0)
        dot = axes.plot(point.cost, point.error, styles[point.name].marker, color=ink, markersize=7,
                        markeredgecolor=STAND_INS["card"], markeredgewidth=0.8, zorder=3)[0]
        dot.set_gid(f"{chart_id}-point-{i}")
        dot.set_url(f"#{point.anchor}")
    return front


def _place_labels(axes, points: list[Point], front: list[Point], levels) -> int:
    """Each label takes the side of its point where it covers least of what is drawn already. @return how many were left
    out, since they would lie on others."""
    frame = axes.get_window_extent()
    centers = [axes.transData.transform((p.cost, p.error)) for p in points]
    taken = [_Box(x - 5, y - 5, x + 5, y + 5) for x, y in centers]
    for name, value, _ in levels:
        y = axes.transData.transform((1, value))[1]
        width = 0.5 * (FONT_SIZE - 1) * len(name)
        taken += [_Box(frame.x1 - width, y, frame.x1, y + FONT_SIZE), _Box(frame.x0, y - 2, frame.x1, y + 2)]
    steps = [axes.transData.transform((p.cost, p.most)) for p in front]
    for (x0, y0), (x1, y1) in zip(steps, steps[1:]):
        taken += [_Box(x0, y0 - 2, x1, y0 + 2), _Box(x1 - 2, y1, x1 + 2, y0)]
    labels: list[_Box] = []
    for point, (x, y) in zip(points, centers):
        width, height = 0.56 * FONT_SIZE * len(point.label), FONT_SIZE
        best, best_cost = None, math.inf
        for preference, (dx, dy) in enumerate(_SIDES):
            reach = 6 if dx == 0 or dy == 0 else 4
            left = x + dx * reach - (width / 2 if dx == 0 else width if dx < 0 else 0)
            bottom = y + dy * reach - (height / 2 if dy == 0 else height if dy < 0 else 0)
            box = _Box(left, bottom, left + width, bottom + height)
            outside = box.area() - box.overlap(_Box(frame.x0, frame.y0, frame.x1, frame.y1))
            cost = sum(box.overlap(other) for other in taken) + 4 * outside + 0.5 * preference
            if cost < best_cost:
                best, best_cost = box, cost
        if sum(best.overlap(label) for label in labels) > _MAX_COVERED * best.area():
            continue
        taken.append(best)
        labels.append(best)
        axes.annotate(point.label, (best.x0, best.y0), xycoords="figure pixels", color=STAND_INS["fg"],
                      fontsize=FONT_SIZE, va="bottom", annotation_clip=False)
    return len(points) - len(labels)


@dataclass(frozen=True)
class _Box:
    x0: float
    y0: float
    x1: float
    y1: float

    def area(self) -> float:
        return (self.x1 - self.x0) * (self.y1 - self.y0)

    def overlap(self, other: _Box) -> float:
        width = min(self.x1, other.x1) - max(self.x0, other.x0)
        height = min(self.y1, other.y1) - max(self.y0, other.y0)
        return max(width, 0.0) * max(height, 0.0)
