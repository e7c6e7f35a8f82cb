"""Which variants the page shows in detail: with their images, their passes and their graph."""

from __future__ import annotations

import math

from report.comparisons import comparisons
from report.film import film_bytes
from report.names import Names
from report.ranking import pareto_front
from report.results import IMAGES, LIGHTS, ReportError, Results, folder_of, interval_ends

FRONT, ALL = "front", "all"
_MAX_BYTES = 50e6  # of images and rows in a page: charts and the text of some hundred variants take less than 10 MB
_ROW_BYTES = 2500  # of a variant's row and its points
_MAX_VARIANTS = 500
_TEXT_BYTES = 4 / 3  # of a byte in base64


def selected(results: Results, lights: list[str], names: Names, wanted: list[str]) -> list[str]:
    """The variants to show in detail, in the order of the table.

    @param wanted "front" (those on the Pareto front of a chart, as many as fit into a page), "all", numbers or names of
        variants, or several of these; empty: all where they fit, else "front".
    @throws ReportError where a word is none of these.
    """
    variants = list(results.variants["variant"])
    meant = {called: name for of in (names.short, names.numbers) for name, called in of.items()}
    meant |= {name: name for name in variants}
    chosen = set()
    for word in wanted or [ALL if _all_fit(results, lights) else FRONT]:
        if word == FRONT:
            chosen.update(_that_fit(results, lights))
        elif word == ALL:
            chosen.update(variants)
        elif word in meant:
            chosen.add(meant[word])
        else:
            raise ReportError(f"--images: '{word}' is neither '{FRONT}' nor '{ALL}', nor the number or the name of a variant")
    return [name for name in variants if name in chosen]


def front_of(results: Results, lights: list[str]) -> list[str]:
    """The variants on the Pareto front of any chart, of each scene and reference its own; those on most fronts first."""
    counts = dict.fromkeys(results.variants["variant"], 0)
    for _, compared in comparisons(results):
        for column in (LIGHTS[light] + metric.key for light in lights for metric in results.metrics[:3]):
            _, high = interval_ends(compared.ok, column)
            for build in (0.0, compared.ok["build_ms"]):
                points = [(cost, error, name) for cost, error, name in zip(compared.ok["frame_ms_median"] + build, high,
                                                                           compared.ok["variant"])
                          if 0 < cost < math.inf and 0 < error < math.inf]
                for i in pareto_front([point[:2] for point in points]):
                    counts[points[i][2]] += 1
    return sorted((name for name, count in counts.items() if count), key=lambda name: -counts[name])


def _bytes_left(results: Results, lights: list[str]) -> float:
    """What the images of variants may take."""
    references = sum(_bytes(results, folder_of(record), lights) for record in results.references())
    return _MAX_BYTES - references - _ROW_BYTES * len(results.variants)


def _all_fit(results: Results, lights: list[str]) -> bool:
    variants = results.variants["variant"]
    return len(variants) <= _MAX_VARIANTS and sum(_bytes(results, name, lights) for name in variants) <= _bytes_left(results, lights)


def _that_fit(results: Results, lights: list[str]) -> list[str]:
    """The variants that are on most fronts, as many as fit."""
    left, chosen = _bytes_left(results, lights), []
    for name in front_of(results, lights)[:_MAX_VARIANTS]:
        left -= _bytes(results, name, lights)
        if left < 0:
            break
        chosen.append(name)
    return chosen


def _bytes(results: Results, folder: str, lights: list[str]) -> float:
    """About what a folder's images take in the page."""
    paths = [results.image(folder, file) for light in lights for file in IMAGES[light]]
    return _TEXT_BYTES * (sum(path.stat().st_size for path in paths if path) + film_bytes(results, folder, lights[-1]))
