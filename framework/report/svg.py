"""Charts as inline SVG, drawn by matplotlib and coloured by the page's style sheet."""

from __future__ import annotations

import io
import re
import warnings
from contextlib import contextmanager
from html import escape

import matplotlib
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from report.style import CATEGORY_COLORS

_COLORS = ("fg", "muted", "grid", *CATEGORY_COLORS)
# Matplotlib knows no CSS variables: each is drawn in a colour of its own, which the variable replaces afterwards.
PLACEHOLDERS = {name: f"#fe01{index:02x}" for index, name in enumerate(_COLORS)}
_RC = {
    "svg.fonttype": "none",  # text stays text: sharp, small, selectable
    "svg.hashsalt": "voxray",  # the same ids in every run
    "text.parse_math": False,  # a name with a dollar sign is no formula
    "font.size": 9.0,
    "axes.edgecolor": PLACEHOLDERS["muted"],
    "axes.labelcolor": PLACEHOLDERS["fg"],
    "xtick.color": PLACEHOLDERS["muted"],
    "ytick.color": PLACEHOLDERS["muted"],
}


@contextmanager
def drawing():
    """The settings under which charts are drawn."""
    with matplotlib.rc_context(_RC), warnings.catch_warnings():
        # The browser has the letters that matplotlib's own font lacks.
        warnings.filterwarnings("ignore", message="Glyph")
        yield


def to_svg(figure: Figure, chart_id: str, caption: str, titles: list[str]) -> str:
    """The figure as a part of a page: ids unique to the chart, colours the page's.

    @param titles What elements with the group ids "<chart_id>-point-<i>" say when pointed at.
    """
    figure.patch.set_visible(False)
    for axes in figure.axes:
        axes.patch.set_visible(False)
    out = io.StringIO()
    FigureCanvasSVG(figure).print_svg(out, metadata={"Date": None})
    svg = out.getvalue()

    # What a page must not get from a stand-alone file: prologue, metadata, size, fonts and page-wide styles.
    svg = svg[svg.index("<svg"):].replace("\n", " ")
    svg = re.sub(r"<metadata>.*?</metadata>|<style.*?</style>", "", svg)
    box = re.search(r'viewBox="([^"]*)"', svg).group(1)
    opening = f'<svg class="chart" viewBox="{box}" role="img" aria-label="{escape(caption)}">'
    svg = re.sub(r"<svg[^>]*>", lambda _: opening, svg, count=1)
    svg = re.sub(r"font: ([\d.]+)px [^;\"]*", r"font-size: \1px", svg)

    svg = re.sub(r'(?<= id=")(?!%s-point-)' % re.escape(chart_id), f"{chart_id}-", svg)
    svg = re.sub(r'(?<=href="#)(?=[mpCDLQPM][0-9a-f]{10}")|(?<=url\(#)', f"{chart_id}-", svg)
    for color, placeholder in PLACEHOLDERS.items():
        svg = svg.replace(placeholder, f"var(--{color})")
    for i, title in enumerate(titles):
        group = f'<g id="{chart_id}-point-{i}">'
        svg = svg.replace(group, f"{group}<title>{escape(title)}</title>")
    return svg
