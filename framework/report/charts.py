"""The numbers of the report's charts, which chart.js draws: error against time, and numbers over frames."""

from __future__ import annotations

import numpy as np
import pandas as pd

from report import text
from report.ranking import pareto_front, pareto_layers
from report.results import BASELINES, LIGHTS, Metric, Results, interval_ends
from report.style import Style

_MAX_MARKS = 250  # of more points the ones far from the Pareto front are small dots
_MAX_LABELS = 80
_MAX_METRICS = 3  # that have a chart
TIMES = {"frame": "one frame", "total": "build + one frame"}


def variants(results: Results, styles: dict[str, Style], labels: dict[str, str], anchors: dict[str, str]) -> dict:
    """What all charts of a page share: how each finished variant is called and drawn, and its times with their 5th and 95th
    percentile."""
    frame = [results.ok[f"frame_ms_{key}"] for key in ("median", "p05", "p95")]
    return {"variants": [{"name": results.full(name), "number": results.numbers[name], "label": labels[name], "anchor": anchors[name],
                          "color": styles[name].color, "mark": styles[name].mark} for name in results.ok["variant"]],
            "times": {"frame": frame, "total": [times + results.ok["build_ms"] for times in frame]}}


def error_chart(results: Results, metric: Metric, light: str, time: str) -> tuple[dict | None, list[str]]:
    """Time against one error on logarithmic axes, with the reference's own noise and what a black and a constant image score
    where all variants have one reference. @return the chart, None where no variant has both numbers above zero, and the
    variants that have not"""
    column = LIGHTS[light] + metric.key
    error = results.ok[column].to_numpy(float)
    low, high = (end.to_numpy(float) for end in interval_ends(results.ok, column))
    spent = (results.ok["frame_ms_median"] + (results.ok["build_ms"] if time == "total" else 0)).to_numpy(float)
    is_drawn = (spent > 0) & np.isfinite(spent) & (error > 0) & np.isfinite(error)
    drawn = np.flatnonzero(is_drawn)
    absent = list(results.ok["variant"][~is_drawn])
    if not len(drawn):
        return None, absent
    reference = results.only_reference
    levels = [["reference's own noise", results.noise(column, reference)]]
    levels += [[f"{name} image", results.baseline(name, column, reference)] for name in BASELINES]
    points = list(zip(spent[drawn].tolist(), high[drawn].tolist()))
    marked = drawn[pareto_layers(points, _MAX_MARKS)]
    # A staircase of the errors that are surely reached: what lies wholly above it is beaten
    front = drawn[pareto_front(points)]
    return {"light": light, "time": time, "error": [error, low, high], "xLabel": f"time of {TIMES[time]}, ms",
            "yLabel": f"{metric.label}, {light} light", "drawn": drawn, "marked": marked, "labelled": marked[:_MAX_LABELS], "front": front,
            "levels": [level for level in levels if level[1] > 0],
            "text": f"{metric.label} of the {light} light against the time of {TIMES[time]}; {len(front)} of {len(drawn)} variants on the front"}, absent


def error_charts(results: Results, lights: list[str]) -> tuple[list[dict], set[tuple[str, str]]]:
    """The charts of the first metrics by each time, and (variant, what of it cannot be drawn)."""
    found, absent = [], set()
    for light in lights:
        for time in TIMES:
            for metric in results.metrics[:_MAX_METRICS]:
                chart, without = error_chart(results, metric, light, time)
                if chart:
                    found.append(chart)
                    absent.update((name, f"{metric.label}, {light}") for name in without)
    return found, absent


def frame_chart(rows: pd.DataFrame, column: str, label: str, results: Results, light: str = "") -> dict:
    """One line for each variant, over frames. `rows` has the columns variant, frame and `column`."""
    index = {variant: i for i, variant in enumerate(results.ok["variant"])}
    lines, means = [], []
    for variant, frames in rows[rows["variant"].isin(index)].groupby("variant", sort=False):
        frames = frames[frames["frame"].notna()].sort_values("frame")
        lines.append([index[variant], frames["frame"].astype(int), frames[column]])
        means.append(f"{results.names[variant]}: {text.figures(frames[column].mean())} on average")
    return {"light": light, "lines": lines, "xLabel": "measured frame", "yLabel": label, "text": f"{label} over frames; {', '.join(means)}"}
