"""Builds the page: turns results into what template.html.j2 shows."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from pathlib import Path

import jinja2
import pandas as pd

from report import charts, images, parts, ranking, style, table, text, values
from report.load import IMAGES, ReportError, Results, section

_HERE = Path(__file__).parent
_LONGEST_POINT_LABEL = 18  # characters; longer names are drawn as the table's row numbers
_MAX_NAMED_POINTS = 12
# Of the manifest:
_SHOWN_ELSEWHERE = ("config", "metrics", "temporal_metrics", "warnings", "baselines", "reference", "references", "variants")


@dataclass(frozen=True)
class Segment:
    color: str
    percent: float
    title: str


@dataclass(frozen=True)
class Bar:
    number: str
    name: str
    anchor: str
    total: str
    segments: list[Segment]


@dataclass(frozen=True)
class View:
    """A variant's image and error map under one light; None where the file is absent."""

    light: str
    image: images.Picture | None
    error: images.Picture | None


@dataclass(frozen=True)
class Variant:
    number: str
    name: str
    anchor: str
    facts: list[tuple[str, str]]
    error: str
    views: list[View]
    passes: list[dict] = field(default_factory=list)
    reference: str = ""
    graph: str = ""


def render(results: Results) -> str:
    """The whole page. Nothing in it refers to anything outside it."""
    warnings = list(results.warnings)
    lights = results.lights()
    names = list(results.variants["variant"])
    anchors = {name: f"variant-{i}" for i, name in enumerate(names, 1)}
    numbers = {name: str(i) for i, name in enumerate(names, 1)}
    styles, legends = style.variant_styles(results)
    colors = style.pass_colors(results)
    columns = table.columns_of(results, lights)
    chart_groups, not_drawn = _charts(results, lights, styles, numbers, anchors)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(_HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["breakable"] = text.breakable
    return environment.get_template("template.html.j2").render(
        title=_title(results), setting=_setting(results), lights=lights, light=lights[-1],
        summaries={light: ranking.summary(results, light) for light in lights},
        columns=columns, metrics=results.metrics,
        rows=table.variant_rows(results, columns, numbers, anchors),
        baselines=table.baseline_rows(results, columns), noises=table.noise_rows(results, columns),
        charts=chart_groups, not_drawn=not_drawn, legends=legends, markers=style.MARKERS, pass_colors=colors,
        regions=parts.regions(results, lights, numbers, anchors,
                              lambda folder, name: _picture(results, folder, name, images.embed, warnings)),
        sequence=parts.sequence(results, lights, styles, numbers, anchors),
        values=values.value_table(results, numbers),
        value_charts=values.value_charts(results, styles, numbers),
        bars=_bars(results, colors, numbers, anchors), reference=_reference(results, lights, warnings),
        variants=[_variant(results, row, lights, colors, numbers, anchors, warnings)
                  for _, row in results.variants.iterrows()],
        error_gradient=images.error_gradient(), provenance=_provenance(results),
        config=text.yaml_like(results.manifest["config"]) if results.manifest.get("config") else "",
        manifest=json.dumps(results.manifest, indent=2, ensure_ascii=False) if results.manifest else "",
        warnings=warnings, style_css=(_HERE / "style.css").read_text(encoding="utf-8"),
        viewer_js=(_HERE / "viewer.js").read_text(encoding="utf-8"))


def _title(results: Results) -> str:
    return str(section(results.manifest, "config").get("name") or results.directory.resolve().name)


def _setting(results: Results) -> str:
    # One sentence: what ran where, against what.
    manifest, parts = results.manifest, []
    image = section(manifest, "image")
    if image:
        parts.append(f"{image.get('width', '?')}×{image.get('height', '?')} pixels")
    if manifest.get("device"):
        parts.append(f"on {manifest['device']}")
    if manifest.get("tracer"):
        parts.append(f"rays by {manifest['tracer']}")
    reference = section(manifest, "reference")
    if reference:
        spp = f", {reference['spp']} samples a pixel" if "spp" in reference else ""
        parts.append(f"scored against {reference.get('pass', 'a reference')}{spp}")
    sentence = ", ".join(parts)
    sentence = sentence[:1].upper() + sentence[1:] + "." if sentence else ""
    return sentence + ("" if manifest.get("finished") or not manifest else
                       " The run had not ended when this page was made.")


def _charts(results: Results, lights, styles, numbers, anchors) -> tuple[list[dict], list[str]]:
    # A number stands at a point where the names are too long or too many to read.
    names = list(results.ok["variant"])
    short = len(names) <= _MAX_NAMED_POINTS and all(len(name) <= _LONGEST_POINT_LABEL for name in names)
    labels = {name: name if short else numbers[name] for name in names}
    groups, not_drawn = [], set()
    for light in lights:
        for with_build in (False, True):
            drawn = []
            for metric in results.metrics[:3]:
                time = "total" if with_build else "frame"
                chart = charts.cost_error_chart(results, metric, light, with_build, styles, labels, anchors,
                                                f"{light}-{time}-{metric.key}")
                if chart:
                    drawn.append(chart)
                    not_drawn.update(f"{name} ({metric.label}, {light})" for name in chart.not_drawn)
            if drawn:
                groups.append({"light": light, "time": time, "charts": drawn, "numbered": not short})
    return groups, sorted(not_drawn)


def _bars(results: Results, colors, numbers, anchors) -> list[dict]:
    """Groups of bars, one bar a variant, each group on one scale: frame time, build time, memory."""
    groups = []
    for phase, column, heading in (("frame", "frame_ms_median", "Time of a frame"),
                                   ("build", "build_ms", "Time of the build, once a scene or light")):
        rows = results.ok[results.ok[column].fillna(0) > 0]
        parts = {row["variant"]: _pass_times(results, row, phase, column) for _, row in rows.iterrows()}
        longest = max((sum(p.values()) for p in parts.values()), default=0)
        bars = []
        for _, row in rows.iterrows():
            name = row["variant"]
            segments = [Segment(colors.get(part, "muted"), 100 * ms / longest,
                                f"{part}: {text.figures(ms)} ms")
                        for part, ms in parts[name].items()]
            bars.append(Bar(numbers[name], name, anchors[name], f"{text.figures(row[column])} ms", segments))
        groups.append({"heading": heading, "bars": bars})
    rows = results.ok[results.ok["memory_bytes"].fillna(0) > 0]
    bars = []
    for name, bytes_used in zip(rows["variant"], rows["memory_bytes"]):
        used = text.size(bytes_used)
        segments = [Segment("muted", 100 * bytes_used / rows["memory_bytes"].max(), used)]
        bars.append(Bar(numbers[name], name, anchors[name], used, segments))
    groups.append({"heading": "Device memory", "bars": bars})
    return [group for group in groups if group["bars"]]


def _pass_times(results: Results, row: pd.Series, phase: str, column: str) -> dict[str, float]:
    rows = results.passes
    mine = rows[(rows["variant"] == row["variant"]) & (rows["phase"] == phase) & (rows["ms_median"] > 0)]
    times = mine.groupby("pass", sort=False)["ms_median"].sum().to_dict()
    # Whatever no pass accounts for is shown as such; a sum of medians can also exceed the whole's median.
    rest = row[column] - sum(times.values())
    return {**times, "outside the passes": rest} if rest > 0 else times


def _picture(results: Results, folder: str, name: str, embed, warnings: list[str]) -> images.Picture | None:
    path = results.image(folder, name)
    try:
        return embed(path) if path else None
    except (ReportError, OSError) as error:
        warnings.append(f"An image is not shown: {error}")
        return None


def _reference(results: Results, lights, warnings) -> dict:
    records = results.references()
    facts = [(key.replace("_", " "), text.figures(value) if isinstance(value, float) else text.plain(value))
             for key, value in records[0].items()]
    folders = list(dict.fromkeys(str(record.get("folder") or "reference") for record in records))
    views = [{"folder": folder, "light": light,
              "picture": _picture(results, folder, IMAGES[light][0], images.embed, warnings)}
             for folder in folders for light in lights]
    if not any(view["picture"] for view in views):
        warnings.append("The reference's image is missing, so variants cannot be compared with it by eye.")
    return {"facts": facts, "views": views}


def _variant(results: Results, row: pd.Series, lights, colors, numbers, anchors, warnings) -> Variant:
    name = row["variant"]
    if row["status"] != "ok":
        return Variant(numbers[name], name, anchors[name], [],
                       row["error"] or f"status is '{row['status']}', with no error text", [])
    views = [View(light, _picture(results, name, IMAGES[light][0], images.embed, warnings),
                  _picture(results, name, IMAGES[light][1], images.embed_error, warnings))
             for light in lights]
    if not any(view.image for view in views):
        warnings.append(f"Variant {name} has no image in its results.")
    facts = [("frame", f"{text.figures(row['frame_ms_median'])} ms (p05 {text.figures(row['frame_ms_p05'])}, "
              f"p95 {text.figures(row['frame_ms_p95'])})"), ("build", f"{text.figures(row['build_ms'])} ms"),
             ("memory", f"{text.size(row['memory_bytes'])}, at the most {text.size(row['peak_bytes'])}"),
             ("rays", text.count(row["rays"]))]
    graph = section(results.manifest, "variants").get(name)
    return Variant(numbers[name], name, anchors[name], facts, "", views, _pass_rows(results, name, colors),
                   results.reference_folder(name) or "", text.yaml_like(graph) if graph else "")


def _pass_rows(results: Results, name: str, colors) -> list[dict]:
    rows = results.passes[results.passes["variant"] == name]
    longest = rows["ms_median"].max() if len(rows) else math.nan
    return [{"name": row["pass"], "phase": row["phase"], "color": colors[row["pass"]],
             "percent": 100 * row["ms_median"] / longest if row["ms_median"] > 0 else 0.0,
             "cells": [*(text.figures(row[key]) for key in ("ms_median", "ms_p05", "ms_p95")),
                       text.count(row["rays"]), text.count(row["voxel_steps"]),
                       text.size(row["memory_bytes"]), text.size(row["scratch_bytes"])]}
            for _, row in rows.iterrows()]


def _provenance(results: Results) -> list[tuple[str, str]]:
    facts = []
    for key, value in results.manifest.items():
        if key not in _SHOWN_ELSEWHERE:
            facts.append((key.replace("_", " "), text.plain(value)))
    return facts
