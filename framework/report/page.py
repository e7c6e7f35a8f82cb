"""Builds the report: turns results into what report.html.j2 shows."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from report import charts, details, images, pages, parts, selection, style, table, text
from report.results import Results, folder_of, number, section
from report.setting import setting_of
from report.summary import summary, unfinished

_SCRIPTS = ("d3", "toolkit.js", "chart.js", "state.js", "filter.js", "pixels.js", "shade.js", "layer.js", "readout.js", "viewer.js",
            "report.js")  # in the order in which they run
_LONGEST_POINT_LABEL = 18  # characters; longer names are drawn as the table's row numbers
_MAX_NAMED_POINTS = 12
_MAX_LISTED = 12  # variants that a note names
_MAX_ROWS = 500  # of the table that are in sight at first: browsers take long to lay out thousands
# Entries of the manifest
_SHOWN_ELSEWHERE = ("identity", "config", "metrics", "seed_metrics", "temporal_metrics", "warnings", "baselines", "reference",
                    "references", "names", "variants", "noise_parameters", "light_independent", "sessions", "inputs")


def render(results: Results, wanted: list[str] | None = None) -> str:
    """The whole page. Nothing in it refers to anything outside it.

    @param wanted The variants to show with their images, as selected() reads it.
    """
    results = replace(results, warnings=list(results.warnings))
    lights = results.lights()
    shown = results.only(selection.selected(results, lights, wanted or []))
    with_floats = selection.with_floats(results, lights, list(shown.variants["variant"]))
    # Where links to a variant lead: to its images, or to its row where the page has none
    in_detail = set(shown.variants["variant"])
    anchors = {name: f"{'variant' if name in in_detail else 'row'}-{number}" for name, number in results.numbers.items()}
    styles, legends, joined = style.variant_styles(results)
    colors = style.pass_colors(results)
    columns = table.columns_of(results, lights)
    labels = _point_labels(results)
    drawn, not_drawn = charts.error_charts(results, lights)
    sequence, frame_charts = parts.sequence(results, shown, lights, styles, anchors) or (None, [])
    value_charts = parts.value_charts(shown, results)
    chart_data = {"charts": [*drawn, *frame_charts, *value_charts], "joined": joined, **charts.variants(results, styles, labels, anchors)}
    variants = details.variants(shown, lights, anchors, with_floats)
    reference = _reference(results, lights, with_floats)
    split = [metric for metric in results.seed_metrics if any(column.metric == metric for column in columns)]
    return pages.render(
        "report.html.j2", scripts=_SCRIPTS, data=chart_data, title=_title(results), setting=setting_of(results), lights=lights,
        light=lights[-1], unfinished=unfinished(results), summaries={light: summary(results, light) for light in lights},
        metrics=[*results.metrics, *split], results=table.results_table(results, "Results", columns, anchors), max_rows=_MAX_ROWS,
        failed=[(results.full(row["variant"]), details.error_of(row)) for row in results.variants.to_dict("records")
                if row["status"] != "ok"],
        charts=list(enumerate(drawn)), frame_charts=list(enumerate(frame_charts, len(drawn))),
        value_charts=list(enumerate(value_charts, len(drawn) + len(frame_charts))), 
        not_drawn=text.first(sorted(f"{results.full(name)} ({what})" for name, what in not_drawn), _MAX_LISTED),
        legends=legends, pass_colors=colors and colors | {"outside the passes": "var(--muted)"}, joined=joined, numbered=labels is results.numbers,
        copies=details.copies(shown, lights, variants), others=_others(variants),
        regions=parts.regions(results, lights, anchors, lambda folder, name: details.picture(results, results.image(folder, name), images.embed)),
        sequence=sequence, values=parts.value_table(shown), bars=parts.bar_groups(shown, colors, anchors), reference=reference,
        viewer=_viewer(results, variants, reference), variants=variants, left_out=len(results.variants) - len(variants),
        error_gradient=images.gradient(images.ERROR_COLORS), provenance=_provenance(results),
        config=text.yaml_of(results.manifest["config"]) if results.manifest.get("config") else "",
        warnings=results.warnings)


def _title(results: Results) -> str:
    return str(section(results.manifest, "config").get("name") or results.directory.resolve().name)


def _point_labels(results: Results) -> dict[str, str]:
    """Names where they can be read at points of a chart, else numbers."""
    drawn = [results.names[name] for name in results.ok["variant"]]
    is_legible = len(drawn) <= _MAX_NAMED_POINTS and all(len(name) <= _LONGEST_POINT_LABEL for name in drawn)
    return results.names if is_legible else results.numbers


def _others(variants: list[details.Variant]) -> list[tuple[str, str]]:
    """The variants that others can be compared with: what ids of their images begin with, and a name."""
    found = [(variant.anchor, f"{variant.number} {variant.name}") for variant in variants if any(view.image for view in variant.views)]
    return found if len(found) > 1 else []


def _viewer(results: Results, variants: list[details.Variant], reference: dict) -> dict:
    """How the viewers show radiance at first, and their false colors: `low` and `high` are the powers of ten between which
    the luminances of all half-float images lie."""
    pictures = [view.image for variant in variants for view in variant.views] + [view["picture"] for view in reference["views"]]
    ranges = [picture.luminance for picture in pictures if picture and picture.luminance] or [(1, 1)]
    low, high = np.log10(ranges).T
    first = math.floor(low.min())
    stops = number(results.manifest.get("exposure_stops"))
    return {"tone": "pbr_neutral" if results.manifest.get("tone") == "pbr_neutral" else "srgb",
            "stops": stops if math.isfinite(stops) else 0, "low": first, "high": max(math.ceil(high.max()), first + 1),
            "luminance": images.gradient(images.LUMINANCE_COLORS, 33), "error": images.gradient(images.SIGNED_ERROR_COLORS, 33)}


def _reference(results: Results, lights, with_floats) -> dict:
    facts = [(key.replace("_", " "), text.figures(value) if isinstance(value, float) else text.plain(value))
             for key, value in results.references[0].items()]
    views = [{"folder": folder, "light": light, "picture": details.photo(results, folder, light, folder in with_floats)}
             for folder in dict.fromkeys(map(folder_of, results.references)) for light in lights]
    if not any(view["picture"] for view in views):
        results.warnings.append("The reference's image is missing, so variants cannot be compared with it by eye.")
    return {"facts": facts, "views": views}


def _provenance(results: Results) -> list[tuple[str, str]]:
    facts = [(key.replace("_", " "), text.plain(value)) for key, value in results.manifest.items()
             if key not in _SHOWN_ELSEWHERE]
    sessions = results.sessions()
    return facts + [(f"session of {began}", ", ".join(names)) for began, names in sessions if len(sessions) > 1]
