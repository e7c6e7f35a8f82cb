"""Scores of parts of a run: of the pixels under masks, and of sequences of frames."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from report import images, table, text
from report.charts import frame_chart
from report.names import Names
from report.results import LIGHTS, Results, folder_of, number, section
from report.style import Style


@dataclass(frozen=True)
class Region:
    """The scores of the pixels under a mask: a table like that of the whole image."""

    name: str
    conditions: str
    pictures: list[tuple[images.Picture, str]]  # of each reference's pixels, and what they are of the image
    columns: list[table.Column]
    rows: list[table.Row]
    footers: list[table.Row]


@dataclass(frozen=True)
class Sequence:
    """Scores over the compared frames: a table of temporal error, and charts over frames."""

    columns: list[table.Column]
    rows: list[table.Row]
    charts: list[dict]


def regions(results: Results, lights: list[str], names: Names, anchors: dict[str, str],
            picture_of: Callable[[str, str], images.Picture | None]) -> list[Region]:
    """A region for each mask. @param picture_of the picture of a name in a folder of images."""
    shown = []
    for name, conditions in results.masks().items():
        columns = table.score_columns(results, lights, results.metrics, f"@{name}")
        pictures = []
        for record in results.references():
            fraction = number(section(record, "mask_fractions").get(name))
            picture = picture_of(folder_of(record), f"mask.{name}.png")
            if picture and fraction >= 0:
                pictures.append((picture, f"{text.figures(100 * fraction)} % of the pixels"))
        words = ", ".join(f"{key.replace('_', ' ')} {text.plain(value)}" for key, value in conditions.items())
        shown.append(Region(name, words, pictures, columns, table.variant_rows(results, columns, names, anchors),
                            table.baseline_rows(results, columns) + table.noise_rows(results, columns)))
    return shown


def sequence(results: Results, shown: Results, lights: list[str], styles: dict[str, Style], names: Names,
             anchors: dict[str, str]) -> Sequence | None:
    """Temporal error of each variant, and the errors over frames of those that are `shown`; None where one frame alone
    was compared."""
    if results.frames.empty or not results.temporal_metrics:
        return None
    columns = table.score_columns(results, lights, results.temporal_metrics)
    charts = []
    for light in lights:
        for metric in (*results.metrics[:2], results.temporal_metrics[0]):
            key = LIGHTS[light] + metric.key
            rows = shown.frames[shown.frames[key].notna() & shown.frames["variant"].isin(styles)]
            if rows["frame"].nunique() > 1:
                charts.append(frame_chart(rows, key, f"{metric.label}, {light} light", results, light))
    return Sequence(columns, table.variant_rows(results, columns, names, anchors), charts)
