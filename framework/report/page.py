"""Builds the page: turns results into what template.html.j2 shows."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from pathlib import Path

import jinja2
import pandas as pd

from report import bars, charts, images, parts, style, table, text, values
from report.load import IMAGES, LIGHTS, Metric, ReportError, Results, section
from report.names import families_of, names_of
from report.setting import setting_of
from report.summary import summary, unfinished

_HERE = Path(__file__).parent
_LONGEST_POINT_LABEL = 18  # characters; longer names are drawn as the table's row numbers
_MAX_NAMED_POINTS = 12
# Of the manifest:
_SHOWN_ELSEWHERE = ("config", "metrics", "seed_metrics", "temporal_metrics", "warnings", "baselines", "reference", "references", "variants",
                    "noise_parameters", "sessions", "inputs")


@dataclass(frozen=True)
class View:
    """A variant's image and error map under one light; None where the file is absent."""

    light: str
    image: images.Picture | None
    error: images.Picture | None


@dataclass(frozen=True)
class Thumbnail:
    """A small copy of an image that the page shows elsewhere, under the id `image`."""

    light: str
    image: str
    anchor: str
    number: str
    name: str
    facts: str


@dataclass(frozen=True)
class Variant:
    number: str
    name: str
    full_name: str
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
    names = names_of(results)
    families = families_of(results, names)
    anchors = {name: f"variant-{number}" for name, number in names.numbers.items()}
    styles, legends, curves = style.variant_styles(results, families)
    colors = style.pass_colors(results)
    columns = table.columns_of(results, lights, names)
    chart_groups, not_drawn = _charts(results, lights, styles, names, anchors, curves)
    variants = [_variant(results, row, lights, colors, names, anchors, warnings)
                for _, row in results.variants.iterrows()]
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(_HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["breakable"] = text.breakable
    return environment.get_template("template.html.j2").render(
        title=_title(results), setting=setting_of(results), lights=lights, light=lights[-1],
        unfinished=unfinished(results),
        summaries={light: summary(results, light, families, names) for light in lights},
        columns=columns, metrics=[*results.metrics, *_split(results, columns)],
        rows=table.variant_rows(results, columns, names, anchors),
        baselines=table.baseline_rows(results, columns), noises=table.noise_rows(results, columns),
        charts=chart_groups, not_drawn=not_drawn, legends=legends, markers=style.MARKERS, pass_colors=colors,
        joined=bool(curves), unlabelled=any(chart.unlabelled for group in chart_groups for chart in group["charts"]),
        thumbnails=_thumbnails(results, lights, variants),
        regions=parts.regions(results, lights, names, anchors,
                              lambda folder, name: _picture(results, folder, name, images.embed, warnings)),
        sequence=parts.sequence(results, lights, styles, names, anchors),
        values=values.value_table(results, names),
        value_charts=values.value_charts(results, styles, names),
        bars=bars.bar_groups(results, colors, names, anchors), reference=_reference(results, lights, warnings),
        variants=variants,
        error_gradient=images.error_gradient(), provenance=_provenance(results),
        config=text.yaml_like(results.manifest["config"]) if results.manifest.get("config") else "",
        manifest=json.dumps(results.manifest, indent=2, ensure_ascii=False) if results.manifest else "",
        warnings=warnings, style_css=(_HERE / "style.css").read_text(encoding="utf-8"),
        viewer_js=(_HERE / "viewer.js").read_text(encoding="utf-8"))


def _title(results: Results) -> str:
    return str(section(results.manifest, "config").get("name") or results.directory.resolve().name)


def _split(results: Results, columns: list[table.Column]) -> list[Metric]:
    """The metrics of a second seed, where the table has them."""
    return [metric for metric in results.seed_metrics if any(column.metric == metric for column in columns)]


def _charts(results: Results, lights, styles, names, anchors, curves) -> tuple[list[dict], list[str]]:
    # A number stands at a point where the names are too long or too many to read.
    drawn_names = [names.short[name] for name in results.ok["variant"]]
    short = len(drawn_names) <= _MAX_NAMED_POINTS and all(len(name) <= _LONGEST_POINT_LABEL for name in drawn_names)
    labels = names.short if short else names.numbers
    groups, not_drawn = [], set()
    for light in lights:
        for with_build in (False, True):
            drawn = []
            for metric in results.metrics[:3]:
                time = "total" if with_build else "frame"
                chart = charts.cost_error_chart(results, metric, light, with_build, styles, labels, anchors,
                                                f"{light}-{time}-{metric.key}", curves, names)
                if chart:
                    drawn.append(chart)
                    not_drawn.update(f"{names.full(name)} ({metric.label}, {light})" for name in chart.not_drawn)
            if drawn:
                groups.append({"light": light, "time": time, "charts": drawn, "numbered": not short})
    return groups, sorted(not_drawn)


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


def _thumbnails(results: Results, lights, variants: list[Variant]) -> list[Thumbnail]:
    """The first reference and each variant under each light, for those that have an image."""
    folder = str(results.references()[0].get("folder") or "reference")
    rows = results.variants.set_index("variant")
    metric = results.metrics[0] if results.metrics else None
    shown = []
    for light in lights:
        if results.image(folder, IMAGES[light][0]):
            shown.append(Thumbnail(light, f"{folder}-{light}", "reference", "", "reference", ""))
        for variant in variants:
            if not any(view.light == light and view.image for view in variant.views):
                continue
            ms = f"{text.figures(rows.loc[variant.full_name, 'frame_ms_median'])} ms"
            score = (f", {metric.label} {text.figures(rows.loc[variant.full_name, LIGHTS[light] + metric.key])}"
                     if metric else "")
            shown.append(Thumbnail(light, f"{variant.anchor}-{light}", variant.anchor, variant.number, variant.name,
                                   ms + score))
    return shown


def _variant(results: Results, row: pd.Series, lights, colors, names, anchors, warnings) -> Variant:
    name = row["variant"]
    if row["status"] != "ok":
        return Variant(names.numbers[name], names.short[name], name, anchors[name], [],
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
    return Variant(names.numbers[name], names.short[name], name, anchors[name], facts, "", views, _pass_rows(results, name, colors),
                   results.reference_folder(name) or "", text.yaml_like(graph) if graph else "")


def _pass_rows(results: Results, name: str, colors) -> list[dict]:
    rows = results.passes[results.passes["variant"] == name]
    longest = rows["ms_median"].max() if len(rows) else math.nan
    return [{"name": row["pass"] if row["pass"] == row["kind"] else f"{row['pass']} ({row['kind']})",
             "phase": row["phase"], "color": colors[row["kind"]],
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
    sessions = results.sessions()
    return facts + [(f"session of {began}", ", ".join(names)) for began, names in sessions if len(sessions) > 1]
