"""Charts of a number over the measured frames."""

from __future__ import annotations

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from report import text
from report.names import Names
from report.style import Style
from report.svg import PLACEHOLDERS, drawing, to_svg


def line_chart(rows: pd.DataFrame, column: str, caption: str, styles: dict[str, Style], names: Names,
               chart_id: str) -> str:
    """One line for each variant, over frames. `rows` has the columns variant, frame and `column`."""
    with drawing():
        figure = Figure(figsize=(5.0, 3.7), dpi=72)  # matplotlib's SVG has 72 units an inch
        axes = figure.add_axes((0.16, 0.13, 0.80, 0.85))
        titles = []
        for i, (variant, own) in enumerate(rows.groupby("variant", sort=False)):
            own = own.sort_values("frame")
            style = styles[variant]
            line = axes.plot(own["frame"], own[column], color=PLACEHOLDERS[style.color], linewidth=1.2,
                             marker=style.marker, markersize=4)[0]
            line.set_gid(f"{chart_id}-point-{i}")
            titles.append(f"{names.full(variant)}: {text.figures(own[column].mean())} on average")
        axes.set_ylim(bottom=min(0.0, rows[column].min()))
        axes.set_xlabel("measured frame")
        axes.set_ylabel(caption)
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.grid(True, color=PLACEHOLDERS["grid"], linewidth=0.6)
        axes.spines[["top", "right"]].set_visible(False)
        axes.set_axisbelow(True)
        return to_svg(figure, chart_id, caption, titles)
