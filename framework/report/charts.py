"""Speed-against-error charts as inline SVG, drawn by matplotlib and coloured by the page's style sheet."""

from __future__ import annotations

import io
import math
import re
import warnings
from dataclasses import dataclass
from html import escape

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from report.judge import pareto_front
from report.load import BASELINES, LIGHTS, Metric, Results
from report.style import CATEGORY_COLORS, RAMP_COLORS, Style

_FONT_SIZE = 9.0
_SIDES = ((1, 0), (1, 1), (-1, -1), (1, -1), (-1, 0), (-1, 1), (0, 1), (0, -1))  # of a point, the best first
_INKS = ("fg", "muted", "grid", "card", *CATEGORY_COLORS, *RAMP_COLORS)
# Matplotlib knows no CSS variables: each is drawn in a colour that stands for it, and replaced afterwards.
_STAND_INS = {name: f"#fe01{index:02x}" for index, name in enumerate(_INKS)}
_RC = {
    "svg.fonttype": "none",  # text stays text: sharp, small, selectable
    "svg.hashsalt": "voxray",  # the same ids in every run
    "text.parse_math": False,  # a name with a dollar sign is no formula
    "font.size": _FONT_SIZE,
    "axes.edgecolor": _STAND_INS["muted"],
    "axes.labelcolor": _STAND_INS["fg"],
    "xtick.color": _STAND_INS["muted"],
    "ytick.color": _STAND_INS["muted"],
}


@dataclass(frozen=True)
class Point:
    """A variant on a chart: its median cost in ms with the 5th and 95th percentile, and its error."""

    name: str
    label: str
    anchor: str
    cost: float
    low: float
    high: float
    error: float


@dataclass(frozen=True)
class Chart:
    svg: str
    caption: str
    not_drawn: list[str]


def cost_error_chart(results: Results, metric: Metric, light: str, with_build: bool, styles: dict[str, Style],
                     labels: dict[str, str], anchors: dict[str, str], chart_id: str) -> Chart | None:
    """Draws time against one error on two log axes, the Pareto front, and, if all variants have one reference,
    its own noise and what a black and a constant image score. None where no variant has both numbers above zero.

    @param with_build Adds the build's time to the frame's.
    @param labels, anchors For each variant, the text at its point and the id that its point links to.
    """
    column = LIGHTS[light] + metric.key
    points, not_drawn = _points(results, column, with_build, labels, anchors)
    if not points:
        return None
    levels = [("reference's own noise", results.noise(column, results.only_reference), ":")]
    levels += [(f"{name} image", results.baseline(name, column, results.only_reference), "--") for name in BASELINES]
    levels = [level for level in levels if level[1] > 0]

    with matplotlib.rc_context(_RC), warnings.catch_warnings():
        # The browser has the letters that matplotlib's own font lacks.
        warnings.filterwarnings("ignore", message="Glyph")
        figure = Figure(figsize=(5.0, 3.7), dpi=72)  # matplotlib's SVG has 72 units an inch
        axes = figure.add_axes((0.14, 0.13, 0.84, 0.85))
        time = "build + one frame" if with_build else "one frame"
        _set_up_axis(axes.xaxis, [p.low for p in points] + [p.high for p in points])
        _set_up_axis(axes.yaxis, [p.error for p in points] + [level[1] for level in levels])
        axes.set_xlabel(f"time of {time}, ms (median; left is faster)")
        axes.set_ylabel(f"{metric.label}, {light} light (lower is better)")
        _draw_levels(axes, levels)
        front = _draw_points(axes, points, styles, chart_id)
        _place_labels(axes, points, front, levels)
        svg = _to_svg(figure)

    caption = f"{metric.label} of the {light} light against the time of {time}."
    return Chart(_adopt(svg, points, chart_id, caption), caption, not_drawn)


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
        points.append(Point(name, labels[name], anchors[name], cost, low, high, error))
    return points, not_drawn


def _set_up_axis(axis, values: list[float]) -> None:
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
    axis.axes.grid(True, axis=axis.axis_name, color=_STAND_INS["grid"], linewidth=0.6)
    axis.axes.spines[["top", "right"]].set_visible(False)
    axis.axes.set_axisbelow(True)


def _draw_levels(axes, levels) -> None:
    for name, value, dashes in levels:
        axes.axhline(value, color=_STAND_INS["muted"], linestyle=dashes, linewidth=1.0)
        axes.annotate(name, (0.995, value), (0, 2), xycoords=("axes fraction", "data"), ha="right",
                      va="bottom", textcoords="offset points", color=_STAND_INS["muted"],
                      fontsize=_FONT_SIZE - 1)


def _draw_points(axes, points: list[Point], styles: dict[str, Style], chart_id: str) -> list[Point]:
    # The Pareto front is a staircase: what no variant reaches lies below and left of it.
    front = [points[i] for i in pareto_front([(p.cost, p.error) for p in points])]
    axes.step([p.cost for p in front], [p.error for p in front], where="post", color=_STAND_INS["muted"],
              linewidth=1.2)
    for i, point in enumerate(points):
        ink = _STAND_INS[styles[point.name].color]
        axes.plot([point.low, point.high], [point.error] * 2, color=ink, linewidth=1.0)
        dot = axes.plot(point.cost, point.error, styles[point.name].marker, color=ink, markersize=7,
                        markeredgecolor=_STAND_INS["card"], markeredgewidth=0.8, zorder=3)[0]
        dot.set_gid(f"{chart_id}-point-{i}")
        dot.set_url(f"#{point.anchor}")
    return front


def _place_labels(axes, points: list[Point], front: list[Point], levels) -> None:
    # Each label takes the side of its point where it covers least of what is drawn already.
    frame = axes.get_window_extent()
    centers = [axes.transData.transform((p.cost, p.error)) for p in points]
    taken = [_Box(x - 5, y - 5, x + 5, y + 5) for x, y in centers]
    for name, value, _ in levels:
        y = axes.transData.transform((1, value))[1]
        width = 0.5 * (_FONT_SIZE - 1) * len(name)
        taken += [_Box(frame.x1 - width, y, frame.x1, y + _FONT_SIZE), _Box(frame.x0, y - 2, frame.x1, y + 2)]
    steps = [axes.transData.transform((p.cost, p.error)) for p in front]
    for (x0, y0), (x1, y1) in zip(steps, steps[1:]):
        taken += [_Box(x0, y0 - 2, x1, y0 + 2), _Box(x1 - 2, y1, x1 + 2, y0)]
    for point, (x, y) in zip(points, centers):
        width, height = 0.56 * _FONT_SIZE * len(point.label), _FONT_SIZE
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
        taken.append(best)
        axes.annotate(point.label, (best.x0, best.y0), xycoords="figure pixels", color=_STAND_INS["fg"],
                      fontsize=_FONT_SIZE, va="bottom", annotation_clip=False)


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


def _to_svg(figure: Figure) -> str:
    figure.patch.set_visible(False)
    for axes in figure.axes:
        axes.patch.set_visible(False)
    out = io.StringIO()
    FigureCanvasSVG(figure).print_svg(out, metadata={"Date": None})
    return out.getvalue()


def _adopt(svg: str, points: list[Point], chart_id: str, caption: str) -> str:
    # What a page must not get from a stand-alone file: prologue, metadata, size, fonts and page-wide styles.
    svg = svg[svg.index("<svg"):].replace("\n", " ")
    svg = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>", "", svg)
    box = re.search(r'viewBox="([^"]*)"', svg).group(1)
    opening = f'<svg class="chart" viewBox="{box}" role="img" aria-label="{escape(caption)}">'
    svg = re.sub(r"<svg[^>]*>", lambda _: opening, svg, count=1)
    svg = re.sub(r"font: ([\d.]+)px [^;\"]*", r"font-size: \1px", svg)

    # Ids are made unique to the chart, colours become the page's, points get their numbers as tooltips.
    names = [f"{chart_id}-point-{i}" for i in range(len(points))]
    svg = re.sub(r'(?<= id=")(?!%s-point-)' % re.escape(chart_id), f"{chart_id}-", svg)
    svg = re.sub(r'(?<=href="#)(?=[mpCDLQPM][0-9a-f]{10}")|(?<=url\(#)', f"{chart_id}-", svg)
    for ink, stand_in in _STAND_INS.items():
        svg = svg.replace(stand_in, f"var(--{ink})")
    for name, point in zip(names, points):
        title = f"{point.name}: {point.cost:.3g} ms, {point.error:.3g}"
        svg = svg.replace(f'<g id="{name}">', f'<g id="{name}"><title>{escape(title)}</title>')
    return svg
