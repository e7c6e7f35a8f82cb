"""Builds the page: turns results into what template.html.j2 shows."""

from __future__ import annotations

import json

from report import bars, charts, details, images, pages, parts, style, table, text, values
from report.names import Names, families_of, names_of
from report.results import IMAGES, Metric, Results, folder_of, section
from report.selection import selected
from report.setting import setting_of
from report.summary import summary, unfinished

_SCRIPTS = ("state.js", "table.js", "viewer.js", "pair.js", "keys.js")  # in the order in which they run
_LONGEST_POINT_LABEL = 18  # characters; longer names are drawn as the table's row numbers
_MAX_NAMED_POINTS = 12
_MAX_LISTED = 12  # variants that a note names
_MAX_ROWS = 500  # of the table that are in sight at first: browsers take long to lay out thousands
# Entries of the manifest
_SHOWN_ELSEWHERE = ("identity", "config", "metrics", "seed_metrics", "temporal_metrics", "warnings", "baselines", "reference",
                    "references", "variants", "noise_parameters", "sessions", "inputs")


def render(results: Results, wanted: list[str] | None = None) -> str:
    """The whole page. Nothing in it refers to anything outside it.

    @param wanted The variants to show with their images, as selected() reads it.
    """
    warnings = list(results.warnings)
    lights = results.lights()
    names = names_of(results)
    families = families_of(results, names)
    shown = results.only(selected(results, lights, names, wanted or []))
    anchors = _anchors(names, shown)
    styles, legends, curves = style.variant_styles(results, families)
    colors = style.pass_colors(results)
    columns = table.columns_of(results, lights)
    chart_groups, not_drawn = _charts(results, lights, styles, names, anchors, curves)
    variants = details.variants(shown, lights, colors, names, anchors, warnings)
    thumbnails = details.thumbnails(shown, lights, variants)
    manifest = _manifest_of(results, shown)
    return pages.render(
        "template.html.j2", scripts=_SCRIPTS, title=_title(results), setting=setting_of(results), lights=lights, light=lights[-1],
        unfinished=unfinished(results),
        summaries={light: summary(results, light, families, names) for light in lights},
        columns=columns, metrics=[*results.metrics, *_split(results, columns)],
        rows=table.variant_rows(results, columns, names, anchors),
        baselines=table.baseline_rows(results, columns), noises=table.noise_rows(results, columns),
        charts=chart_groups, not_drawn=not_drawn, legends=legends, markers=style.MARKERS, pass_colors=colors,
        joined=bool(curves), unlabelled=any(chart.unlabelled for group in chart_groups for chart in group["charts"]),
        dots=max((chart.dots for group in chart_groups for chart in group["charts"]), default=0),
        thumbnails=thumbnails, leads=details.leads(shown, lights, variants, thumbnails),
        overviews=_overviews(results, lights, styles, names, anchors, curves), pictured=_pictured(results, lights, variants),
        regions=parts.regions(results, lights, names, anchors,
                              lambda folder, name: details.picture(results, folder, name, images.embed, warnings)),
        sequence=parts.sequence(results, shown, lights, styles, names, anchors),
        values=values.value_table(shown, names),
        value_charts=values.value_charts(shown, styles, names),
        bars=bars.bar_groups(shown, colors, names, anchors), reference=_reference(results, lights, warnings),
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


def _overviews(results: Results, lights, styles, names, anchors, curves) -> dict[str, charts.Chart]:
    """The chart next to the first images, by light: the first error against the time of one frame."""
    labels = _point_labels(results, names)
    drawn = {light: charts.cost_error_chart(results, metric, light, False, styles, labels, anchors, f"overview-{light}", curves, names)
             for light in lights for metric in results.metrics[:1]}
    return {light: chart for light, chart in drawn.items() if chart}


def _charts(results: Results, lights, styles, names, anchors, curves) -> tuple[list[dict], list[str]]:
    labels = _point_labels(results, names)
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
                groups.append({"light": light, "time": time, "charts": drawn, "numbered": labels is names.numbers})
    more = len(not_drawn) - _MAX_LISTED
    return groups, sorted(not_drawn)[:_MAX_LISTED] + ([f"and {more} more"] if more > 0 else [])


def _pictured(results: Results, lights, variants: list[details.Variant]) -> list[tuple[str, str]]:
    """The references and variants whose images the page has: what ids of these begin with, and a name."""
    references = [folder_of(record) for record in results.references()]
    found = [(folder, folder) for folder in dict.fromkeys(references)
             if any(results.image(folder, IMAGES[light][0]) for light in lights)]
    return found + [(variant.anchor, f"{variant.number} {variant.name}") for variant in variants
                    if any(view.image for view in variant.views)]


def _reference(results: Results, lights, warnings) -> dict:
    records = results.references()
    facts = [(key.replace("_", " "), text.figures(value) if isinstance(value, float) else text.plain(value))
             for key, value in records[0].items()]
    folders = list(dict.fromkeys(folder_of(record) for record in records))
    views = [{"folder": folder, "light": light,
              "picture": details.picture(results, folder, IMAGES[light][0], images.embed, warnings)}
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
    return {key: {"variants": own(section(results.manifest, "variants")), "noise_parameters": noise}.get(key, value)
            for key, value in results.manifest.items()}


def _provenance(results: Results) -> list[tuple[str, str]]:
    facts = [(key.replace("_", " "), text.plain(value)) for key, value in results.manifest.items()
             if key not in _SHOWN_ELSEWHERE]
    sessions = results.sessions()
    return facts + [(f"session of {began}", ", ".join(names)) for began, names in sessions if len(sessions) > 1]
