"""Builds the page: turns results into what template.html.j2 shows."""

from __future__ import annotations

import json
import math

import numpy as np

from report import bars, charts, details, images, pages, parts, selection, style, table, text, values
from report.names import Names, families_of, names_of
from report.results import IMAGES, Metric, Results, folder_of, number, section
from report.setting import setting_of
from report.summary import summary, unfinished

_SCRIPTS = ("d3", "tables.js", "chart.js", "state.js", "table.js", "pixels.js", "shade.js", "layer.js", "readout.js", "viewer.js", "pair.js",
            "report_charts.js", "keys.js")  # in the order in which they run
_LONGEST_POINT_LABEL = 18  # characters; longer names are drawn as the table's row numbers
_MAX_NAMED_POINTS = 12
_MAX_LISTED = 12  # variants that a note names
_MAX_ROWS = 500  # of the table that are in sight at first: browsers take long to lay out thousands
# Entries of the manifest
_SHOWN_ELSEWHERE = ("identity", "config", "metrics", "seed_metrics", "temporal_metrics", "warnings", "baselines", "reference",
                    "references", "names", "variants", "noise_parameters", "sessions", "inputs")


def render(results: Results, wanted: list[str] | None = None) -> str:
    """The whole page. Nothing in it refers to anything outside it.

    @param wanted The variants to show with their images, as selected() reads it.
    """
    warnings = list(results.warnings)
    lights = results.lights()
    names = names_of(results)
    families = families_of(results, names)
    shown = results.only(selection.selected(results, lights, names, wanted or []))
    with_floats = selection.with_floats(results, lights, list(shown.variants["variant"]))
    anchors = _anchors(names, shown)
    styles, legends, curves = style.variant_styles(results, families)
    colors = style.pass_colors(results)
    columns = table.columns_of(results, lights)
    labels = _point_labels(results, names)
    drawn, not_drawn = charts.error_charts(results, lights)
    sequence = parts.sequence(results, shown, lights, styles, names, anchors)
    value_charts = values.value_charts(shown, results)
    chart_data = {"charts": [*drawn, *(sequence.charts if sequence else ()), *value_charts],
                  **charts.variants(results, styles, names, labels, anchors, curves)}
    variants = details.variants(shown, lights, colors, names, anchors, with_floats, warnings)
    reference = _reference(results, lights, with_floats, warnings)
    thumbnails = details.thumbnails(shown, lights, variants)
    manifest = _manifest_of(results, shown)
    return pages.render(
        "template.html.j2", scripts=_SCRIPTS, title=_title(results), setting=setting_of(results), lights=lights, light=lights[-1],
        unfinished=unfinished(results),
        summaries={light: summary(results, light, families, names) for light in lights},
        columns=columns, metrics=[*results.metrics, *_split(results, columns)],
        rows=table.variant_rows(results, columns, names, anchors),
        baselines=table.baseline_rows(results, columns), noises=table.noise_rows(results, columns),
        charts=chart_data["charts"], chart_data=pages.json_text(chart_data) if chart_data["charts"] else "",
        error_charts=len(drawn), value_charts=len(value_charts), not_drawn=_listed(not_drawn, names), legends=legends,
        markers=style.MARKERS, pass_colors=colors, joined=bool(curves), numbered=labels is names.numbers,
        thumbnails=thumbnails, leads=details.leads(shown, lights, variants, thumbnails),
        pictured=_pictured(results, lights, variants),
        regions=parts.regions(results, lights, names, anchors,
                              lambda folder, name: details.picture(results, folder, name, images.embed, warnings)),
        sequence=sequence,
        values=values.value_table(shown, names),
        bars=bars.bar_groups(shown, colors, names, anchors), reference=reference,
        viewer=_viewer(results, variants, reference),
        variants=variants, max_rows=_MAX_ROWS, left_out=len(results.variants) - len(variants),
        error_gradient=images.gradient(images.ERROR_COLORS), provenance=_provenance(results),
        config=text.yaml_like(results.manifest["config"]) if results.manifest.get("config") else "",
        manifest=json.dumps(manifest, indent=2, ensure_ascii=False) if manifest else "",
        warnings=warnings)


def _anchors(names: Names, shown: Results) -> dict[str, str]:
    """Where a variant's links lead: to its images, or to its row where the page has none."""
    in_detail = set(shown.variants["variant"])
    return {name: f"{'variant' if name in in_detail else 'row'}-{number}" for name, number in names.numbers.items()}


def _title(results: Results) -> str:
    return str(section(results.manifest, "config").get("name") or results.directory.resolve().name)


def _split(results: Results, columns: list[table.Column]) -> list[Metric]:
    """The metrics of a second seed, where the table has them."""
    return [metric for metric in results.seed_metrics if any(column.metric == metric for column in columns)]


def _point_labels(results: Results, names: Names) -> dict[str, str]:
    """Names where they can be read at points of a chart, else numbers."""
    drawn = [names.short[name] for name in results.ok["variant"]]
    is_legible = len(drawn) <= _MAX_NAMED_POINTS and all(len(name) <= _LONGEST_POINT_LABEL for name in drawn)
    return names.short if is_legible else names.numbers


def _listed(not_drawn: set[tuple[str, str]], names: Names) -> list[str]:
    listed = sorted(f"{names.full(name)} ({what})" for name, what in not_drawn)
    more = len(listed) - _MAX_LISTED
    return listed[:_MAX_LISTED] + ([f"and {more} more"] if more > 0 else [])


def _pictured(results: Results, lights, variants: list[details.Variant]) -> list[tuple[str, str]]:
    """The references and variants whose images the page has: what ids of these begin with, and a name."""
    references = [folder_of(record) for record in results.references()]
    found = [(folder, folder) for folder in dict.fromkeys(references)
             if any(results.image(folder, IMAGES[light][0]) for light in lights)]
    return found + [(variant.anchor, f"{variant.number} {variant.name}") for variant in variants
                    if any(view.image for view in variant.views)]


def _viewer(results: Results, variants: list[details.Variant], reference: dict) -> dict:
    """How the viewers show radiance at first, and their false colors: `low` and `high` are the powers of ten between which
    the luminances of all half-float images lie."""
    pictures = [view.image for variant in variants for view in variant.views] + [view["picture"] for view in reference["views"]]
    ranges = [picture.luminance for picture in pictures if picture and picture.luminance]
    low, high = (np.log10([edge[i] for edge in ranges] or [1]) for i in (0, 1))
    first = math.floor(low.min())
    stops = number(results.manifest.get("exposure_stops"))
    return {"tone": "pbr_neutral" if results.manifest.get("tone") == "pbr_neutral" else "srgb",
            "stops": stops if math.isfinite(stops) else 0, "low": first, "high": max(math.ceil(high.max()), first + 1),
            "luminance": images.gradient(images.LUMINANCE_COLORS, 33), "error": images.gradient(images.SIGNED_ERROR_COLORS, 33)}


def _reference(results: Results, lights, with_floats, warnings) -> dict:
    records = results.references()
    facts = [(key.replace("_", " "), text.figures(value) if isinstance(value, float) else text.plain(value))
             for key, value in records[0].items()]
    folders = list(dict.fromkeys(folder_of(record) for record in records))
    views = [{"folder": folder, "light": light,
              "picture": details.photo(results, folder, light, folder in with_floats, warnings)}
             for folder in folders for light in lights]
    if not any(view["picture"] for view in views):
        warnings.append("The reference's image is missing, so variants cannot be compared with it by eye.")
    return {"facts": facts, "views": views}


def _manifest_of(results: Results, shown: Results) -> dict:
    """The manifest, of what it lists for each variant that of the shown ones."""
    names = set(shown.variants["variant"])
    if len(names) == len(results.variants):
        return results.manifest

    def own(entries: dict) -> dict:
        return {name: entry for name, entry in entries.items() if name in names}

    noise = {image: own(section(section(results.manifest, "noise_parameters"), image))
             for image in section(results.manifest, "noise_parameters")}
    shown_entries = {key: own(section(results.manifest, key)) for key in ("names", "variants")} | {"noise_parameters": noise}
    return {key: shown_entries.get(key, value) for key, value in results.manifest.items()}


def _provenance(results: Results) -> list[tuple[str, str]]:
    facts = [(key.replace("_", " "), text.plain(value)) for key, value in results.manifest.items()
             if key not in _SHOWN_ELSEWHERE]
    sessions = results.sessions()
    return facts + [(f"session of {began}", ", ".join(names)) for began, names in sessions if len(sessions) > 1]
