"""Parts of a page besides the results: scores under masks, sequences of frames, what passes report, where costs go."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import pandas as pd

from report import images, table, text
from report.charts import frame_chart
from report.results import LIGHTS, Results, folder_of, masks_of, number, section
from report.setting import comparisons
from report.style import Style
from report.table import Cell, Table

_REPORTED = ["pass", "name"]  # columns of values.csv that tell what was reported


class Region(NamedTuple):
    """The scores of the pixels under a mask: a table like that of the whole image. pictures: of each reference's pixels, and
    what they are of the image."""

    name: str
    conditions: str
    pictures: list[tuple[images.Picture, str]]
    table: Table


class Shown(NamedTuple):
    """An image with its caption."""

    picture: images.Picture
    title: str
    note: str


class Segment(NamedTuple):
    """A part of a bar, in percent of the longest bar. css: "below" where it is less than 0."""

    background: str
    percent: float
    title: str
    label: str = ""
    css: str = ""


class Bar(NamedTuple):
    number: str
    name: str
    anchor: str
    total: str
    segments: list[Segment]


class Bars(NamedTuple):
    """Bars on one scale."""

    heading: str
    bars: list[Bar]


def regions(results: Results, lights: list[str], anchors: dict[str, str],
            picture_of: Callable[[str, str], images.Picture | None]) -> list[Region]:
    """A region for each mask. @param picture_of the picture of a name in a folder of images."""
    shown = []
    for name, conditions in masks_of(results.manifest).items():
        columns = table.score_columns(results, lights, results.metrics, f"@{name}")
        pictures = []
        for record in results.references:
            fraction = number(section(record, "mask_fractions").get(name))
            picture = picture_of(folder_of(record), f"mask.{name}.png")
            if picture and fraction >= 0:
                pictures.append((picture, f"{text.figures(100 * fraction)} % of the pixels"))
        words = ", ".join(f"{key.replace('_', ' ')} {text.plain(value)}" for key, value in conditions.items())
        scores = table.results_table(results, f"Scores under the mask {name}", columns, anchors)
        shown.append(Region(name, words, pictures, scores))
    return shown


def sequence(results: Results, shown: Results, lights: list[str], styles: dict[str, Style],
             anchors: dict[str, str]) -> tuple[Table, list[dict]] | None:
    """A table of each variant's temporal error, and charts of the errors over frames of those that are `shown`, of each scene
    its own; None where one frame alone was compared."""
    if results.frames.empty or not results.temporal_metrics:
        return None
    columns = table.score_columns(results, lights, results.temporal_metrics)
    charts = []
    scenes = comparisons(shown)
    for light in lights:
        for metric in (*results.metrics[:2], results.temporal_metrics[0]):
            key = LIGHTS[light] + metric.key
            for scene, compared in scenes:
                drawn = [variant for variant in compared.variants["variant"] if variant in styles]
                rows = shown.frames[shown.frames[key].notna() & shown.frames["variant"].isin(drawn)]
                if rows["frame"].nunique() > 1:
                    where = f", {scene}" if len(scenes) > 1 else ""
                    charts.append(frame_chart(rows, key, f"{metric.label}, {light} light{where}", results, light))
    return table.results_table(results, "Temporal error", columns, anchors, has_baselines=False), charts


def value_table(results: Results) -> Table | None:
    """What passes reported of each variant; of several frames the mean and the largest. None where nothing was reported."""
    values = results.values
    if values.empty:
        return None
    groups = ["variant", *_REPORTED]
    # A build pass that reports again in frames, because surfaces move, is shown by its frames alone
    values = values[values["frame"].notna() | (values.groupby(groups)["frame"].transform("count") == 0)]
    found = values.groupby(groups)["value"].agg(["size", "mean", "max"])
    words = pd.Series([text.exact(mean) if size == 1 else f"{text.figures(mean)} (most {text.figures(most)})"
                       for size, mean, most in found.itertuples(index=False)], found.index)
    reported = pd.MultiIndex.from_frame(values[_REPORTED].drop_duplicates())
    cells = words.unstack(_REPORTED).reindex(columns=reported).fillna("")
    rows = [[results.numbers[name], Cell(results.names[name], "name"), *cells.loc[name]]
            for name in results.ok["variant"] if name in cells.index]
    return Table("What passes report", ["#", "variant", *(f"{part}: {name}" for part, name in reported)], rows, words=(1,))


def value_charts(shown: Results, results: Results) -> list[dict]:
    """A chart for each value that changes from frame to frame in some variant: one line for each variant that is shown."""
    series = shown.values[shown.values["frame"].notna()]
    return [frame_chart(rows, "value", f"{part}: {name}", results)
            for (part, name), rows in series.groupby(_REPORTED, sort=False)
            if rows.groupby("variant")["value"].nunique().max() > 1]


def bar_groups(results: Results, colors: dict[str, str], anchors: dict[str, str]) -> list[Bars]:
    """Frame time, build time and memory, split by kind of pass; without groups that have no bar."""
    def milliseconds(value: float) -> str:
        return f"{text.figures(value)} ms"

    groups = []
    for heading, phases, column, part, write in (
            ("Time of a frame", ["frame"], "frame_ms_median", "ms_median", milliseconds),
            ("Time of the build, once for each scene or light", ["build"], "build_ms", "ms_median", milliseconds),
            ("Device memory that the passes keep", ["frame", "build"], "memory_bytes", "memory_bytes", text.size)):
        totals = results.ok.set_index("variant")[column]
        totals = totals[totals > 0]
        passes = results.passes[(results.passes[part] > 0) & results.passes["phase"].isin(phases)]
        split: dict[str, dict[str, float]] = {name: {} for name in totals.index}
        # By kind, because an id may be that of another pass in each variant
        for (name, kind), value in passes.groupby(["variant", "kind"], sort=False)[part].sum().items():
            if name in split:
                split[name][kind] = value
        # Whatever no pass accounts for is shown as such; a sum of medians can also exceed the whole's median.
        for name, own in split.items():
            if (rest := totals[name] - sum(own.values())) > 0:
                own["outside the passes"] = rest
        longest = max((sum(own.values()) for own in split.values()), default=0)
        groups.append(Bars(heading, [
            Bar(results.numbers[name], results.names[name], anchors[name], write(totals[name]),
                [Segment(colors.get(kind, "var(--muted)"), 100 * value / longest, f"{kind}: {write(value)}")
                 for kind, value in own.items()]) for name, own in split.items()]))
    return [group for group in groups if group.bars]
