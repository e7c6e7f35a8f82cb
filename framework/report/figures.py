"""Figures for a paper, in the widths of ACM's template: the matrix and each scene's chart as SVG and PDF, with their data."""

from __future__ import annotations

import math
import re
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.text import Text
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from report import pages, style, text
from report.pareto import CHARTED, COSTS, Scene

CHART, _FULL = (84.5 / 25.4, 0.75 * 84.5 / 25.4), 178 / 25.4  # widths of acmart, and a chart's height, inches
_FOLDS = LinearSegmentedColormap.from_list("folds", [style.VALUES[f"f{i}"] for i in range(5)])
_MOST_FOLD = float(style.VALUES["most-fold"])  # at which colors are strongest
STYLE = {"font.size": 7, "axes.linewidth": 0.5, "xtick.major.width": 0.5, "ytick.major.width": 0.5, "xtick.minor.width": 0.3,
         "ytick.minor.width": 0.3, "hatch.linewidth": 0.4, "text.parse_math": False,
         "pdf.fonttype": 42, "svg.fonttype": "path", "svg.hashsalt": "voxray"}  # TrueType in PDF; outlines in SVG


def write(folder: Path, compared) -> None:
    """Each figure by each cost, by the first error. @param compared a pareto_page.Comparison"""
    folder.mkdir(parents=True, exist_ok=True)
    with matplotlib.rc_context(STYLE):
        for cost in compared.costs:
            end = CHARTED[cost].replace(" + ", "-")
            _save(folder / f"matrix-{end}", _matrix(compared, cost), _matrix_rows(compared, cost))
            for scene in compared.scenes:
                stem = re.sub(r"[^\w.-]+", "-", scene.name).strip("-")
                figure = chart(FigureCanvasAgg(Figure(figsize=CHART)).figure, compared, scene, cost)
                _save(folder / f"{stem}-{end}", figure, _chart_rows(compared, scene, cost))


def _save(path: Path, figure: Figure, rows: list[list]) -> None:
    for kind, stamp in (("svg", "Date"), ("pdf", "CreationDate")):
        figure.savefig(f"{path}.{kind}", metadata={stamp: None})
    pages.write_whole(path.with_name(f"{path.name}.csv"), pages.csv_text(rows))


def chart(figure: Figure, compared, scene: Scene, cost: int) -> Figure:
    """Draws a scene's variants, error against cost, and the front of each method."""
    error = compared.first
    axes = figure.add_axes((0.15, 0.15, 0.84, 0.83))
    axes.set(xscale="log", yscale="log", xlabel=f"{COSTS[CHARTED[cost]]} (← cheaper)",
             ylabel=f"{compared.errors[error].label} of {compared.light} light (↓ better)")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if axis is axes.yaxis else (1,)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.6g}"))
        axis.set_minor_locator(NullLocator())
    axes.grid(True, color="#dddddd", linewidth=0.4)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    ends, styles = [], style.styles(len(compared.methods))
    for method, front in scene.fronts(cost, error).items():
        own, is_rival = styles[method], method == compared.rival
        color = style.VALUES[own.color]
        members = (scene.methods == method) & scene.usable[cost, error]
        axes.plot(scene.costs[cost, members], scene.errors[error, 0, members], "o", color=color, markersize=1.8, alpha=0.55, markeredgewidth=0)
        x, (y, low, high) = scene.costs[cost, front], scene.errors[error][:, front]
        axes.vlines(x, np.maximum(low, 1e-3 * y), high, color=color, linewidth=0.4, alpha=0.6)
        axes.plot(x, y, own.marker, linestyle="-", color=color, linewidth=1.6 if is_rival else 0.8, markersize=3.5 if is_rival else 2.8,
                  markeredgecolor="white", markeredgewidth=0.3)
        ends.append((compared.methods[method].name, x[-1], y[-1], color, "bold" if is_rival else "normal"))
    _label(axes, ends)
    return figure


def _label(axes, ends: list[tuple]) -> None:
    """Names at the lines' ends, moved up or down off each other."""
    taken: list = []
    low, high = axes.get_xlim()
    axes.set_xlim(low, high * (high / low) ** 0.2)
    if high < 10 * low:  # There may be no power of ten
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 3, 5, 7)))
    renderer = axes.figure.canvas.get_renderer()
    for name, x, y, color, weight in sorted(ends, key=lambda end: end[4] != "bold"):
        label = axes.annotate(name, (x, y), (0, 0), textcoords="offset points", color=color, fontsize=5.5, fontweight=weight,
                              va="center", path_effects=[withStroke(linewidth=1.2, foreground="white")],
                              arrowprops={"arrowstyle": "-", "linewidth": 0.3, "color": color, "shrinkA": 0, "shrinkB": 2})
        for step in range(80):
            up, is_left = (step // 2 + 1) // 2 * 3 * (-1) ** (step // 2), step % 2
            label.set(position=(-4 if is_left else 4, up), ha="right" if is_left else "left")
            label.update_positions(renderer)
            box = Text.get_window_extent(label, renderer)  # without its leader
            inside = axes.bbox.x0 <= box.x0 and box.x1 <= axes.figure.bbox.x1 and axes.bbox.y0 <= box.y0 and box.y1 <= axes.bbox.y1
            if inside and not any(box.overlaps(other) for other in taken):
                taken.append(box)
                break
        else:
            label.remove()


def _chart_rows(compared, scene: Scene, cost: int) -> list[list]:
    error, key = compared.first, compared.errors[compared.first].metric.key
    fronts = np.concatenate([[], *scene.fronts(cost, error).values()])
    rows = [[compared.methods[scene.methods[i]].name, scene.labels[i], scene.costs[cost, i], *scene.errors[error, :, i], int(i in fronts)]
            for i in np.flatnonzero(scene.usable[cost, error])]
    return [["method", "name", CHARTED[cost], key, f"{key}_low", f"{key}_high", "on front"], *rows]


def _order(compared, cost: int) -> list[int]:
    return np.argsort(-np.nan_to_num(compared.speed_ups.medians(compared.measured)[0, cost, compared.first]), kind="stable").tolist()


def _matrix(compared, cost: int) -> Figure:
    found, order = compared.speed_ups, _order(compared, cost)
    cells, counts = found.factors[0, cost, compared.first][:, order].swapaxes(0, 1), found.count[0, cost, compared.first]
    figure = Figure(figsize=(_FULL, 0.5 + 0.17 * len(order)))
    axes = figure.add_axes((0.2, 0.02, 0.78, 1 - 0.42 / figure.get_figheight()))
    axes.imshow(cells[..., 0], cmap=_FOLDS, norm=LogNorm(1 / _MOST_FOLD, _MOST_FOLD), aspect="auto")
    for row, s in np.ndindex(cells.shape[:2]):
        value, low, high, reached = cells[row, s]
        said, color = "–" if compared.measured[s, order[row]] and counts[s] else "", "#777777"
        if not math.isnan(value):
            said = text.figures(value, 2) + ("" if reached == counts[s] else f" ({reached:.0f}/{counts[s]})")
            color = "white" if abs(math.log2(value)) > 3 else "black"
        axes.text(s, row, said, ha="center", va="center", color=color)
        if low <= 1 <= high and order[row] != found.rivals[0]:
            axes.add_patch(Rectangle((s - 0.5, row - 0.5), 1, 1, fill=False, hatch="////", linewidth=0, edgecolor="#00000055"))
    axes.set_xticks(range(len(counts)), [scene.name for scene in compared.scenes])
    axes.set_yticks(range(len(order)), [compared.methods[i].name for i in order])
    axes.set_xticks(np.arange(-0.5, len(counts)), minor=True)
    axes.set_yticks(np.arange(-0.5, len(order)), minor=True)
    axes.tick_params(which="both", length=0, labeltop=True, labelbottom=False)
    axes.spines[:].set_visible(False)
    axes.grid(which="minor", color="white", linewidth=1)
    return figure


def _matrix_rows(compared, cost: int) -> list[list]:
    found, error = compared.speed_ups, compared.first
    rows = [[compared.methods[i].name, scene.name, *found.factors[0, cost, error, s, i], found.count[0, cost, error, s]]
            for i in _order(compared, cost) for s, scene in enumerate(compared.scenes) if compared.measured[s, i]]
    return [["method", "scene", f"factor over {compared.methods[found.rivals[0]].name}", "low", "high", "errors reached", "of"], *rows]
