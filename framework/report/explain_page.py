"""The page of `voxray explain`: sentences, a bar of the error's parts, and an image of each."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image

from report import explain, images, pages, style, text
from report.explain import Explained, Images, percent, sentence
from report.images import Picture
from report.load import load
from report.parts import Bar, Bars, Segment, Shown
from report.results import IMAGES, Results
from report.table import Table

_SCRIPTS = ("toolkit.js",)  # without d3: scripts write no numbers here
_SMALL = 0.1  # of the whole error: a rest that needs no word
_WIDE = 0.12  # of the bar: a part that has room for its name


def write(directory: Path) -> str:
    """Makes explain.html and explain.csv of a run of `voxray explain`. @return what brings the largest part
    @throws ReportError where the folder is no such run"""
    results = load(directory)
    stages, shown = explain.read(results)
    explained = [explain.explain(stages, shown, label) for label in explain.METRICS]
    pages.write_whole(directory / "explain.html", render(results, shown, explained))
    pages.write_whole(directory / "explain.csv", pages.csv_text(csv_lines(explained)))
    return sentence(explained[0])


def render(results: Results, rendered: Images, explained: list[Explained]) -> str:
    """The whole page, self-contained."""
    scale = _scale(rendered)
    config = results.manifest.get("config", {})
    stages = [part.stage for part in explained[0].parts]
    colors = {stage.name: style.background(i) for i, stage in enumerate(stages)} | {"rest": "var(--muted)"}
    labels = [one.label for one in explained]
    counterparts = Table("Counterparts", ["stage", "what its counterpart changes", "along with", "what lowers its error"],
                         [(stage.name, ", ".join(stage.changes), ", ".join(stage.needs), stage.cure) for stage in stages],
                         words=range(4))
    sets = Table("Errors of all images that were rendered", ["swapped", *labels],
                 [(_name_of(chosen), *(text.figures(one.errors[chosen]) for one in explained)) for chosen in rendered.of])
    return pages.render(
        "explain.html.j2", scripts=_SCRIPTS, name=str(config.get("name", "")).removeprefix("explain_"),
        sentences=[line for one in explained for line in _sentences(one)], colors=colors,
        bars=Bars("Parts of the error, % of the whole", [_bar(one, colors) for one in explained]), tables=[*map(_table, explained), counterparts, sets],
        previews=_previews(results, rendered), parts=_part_images(rendered, explained[0], scale), scale=text.figures(scale, 2),
        directory=str(results.directory))


def csv_lines(explained: list[Explained]):
    yield ["error", "stage", "changes", "part", "share", "share_low", "share_high", "orders_mean", "orders_min",
           "orders_max"]
    for one in explained:
        yield [one.label, "whole", "", f"{one.whole:.9g}", 1, "", "", "", "", ""]
        for part in one.parts:
            yield [one.label, part.stage.name, "; ".join(part.stage.changes), f"{part.share * one.whole:.9g}",
                   *(f"{value:.6g}" for value in (part.share, part.low, part.high, part.mean, part.least, part.most))]
        yield [one.label, "rest", "", f"{one.rest * one.whole:.9g}", f"{one.rest:.6g}", f"{one.rest_low:.6g}",
               f"{one.rest_high:.6g}", "", "", ""]
        yield [one.label, "all swapped", "", f"{one.left * one.whole:.9g}", f"{one.left:.6g}", "", "", "", "", ""]


def _name_of(chosen: frozenset[str]) -> str:
    return " + ".join(sorted(chosen)) or "as it is"


def _sentences(one: Explained) -> list[str]:
    lines = [sentence(one)]
    others = [f"{part.stage.name} {percent(part.share)}" for part in one.ranked()[1:]]
    if others:
        lines[0] += f" Then {', '.join(others)}; the rest is {percent(one.rest)}."
    if abs(one.rest) > _SMALL:
        spread = max(one.parts, key=lambda part: part.most - part.least)
        lines.append(f"The parts of {one.label} do not add up: {percent(one.rest)} is left. "
                     + (f"With all stages swapped {percent(one.left)} of the error remain, which no counterpart takes out. "
                        if abs(one.left) > _SMALL else "")
                     + f"What a stage brings depends on the others: {spread.stage.name} between {percent(spread.least)} and "
                       f"{percent(spread.most)}, by the order in which stages are swapped.")
    return lines


def _table(one: Explained) -> Table:
    rows = [(part.stage.name, percent(part.share), f"{percent(part.low)} to {percent(part.high)}", percent(part.mean),
             f"{percent(part.least)} to {percent(part.most)}") for part in one.parts]
    total = sum(part.mean for part in one.parts)
    rows.append(("rest", percent(one.rest), f"{percent(one.rest_low)} to {percent(one.rest_high)}", percent(1 - total), ""))
    return Table(f"Parts of {one.label}", ["stage", "swapped alone", "95 % interval", "in sequence, mean", "least and most, by order"],
                 rows, "In sequence: over all orders in which stages can be swapped one after another.")


def _bar(one: Explained, colors: dict[str, str]) -> Bar:
    """Parts below 0 before the whole's 0 %, the others after it. All parts add up to 100 %."""
    shares = {part.stage.name: part.share for part in one.parts} | {"rest": one.rest}
    length = sum(map(abs, shares.values()))
    ordered = sorted(shares.items(), key=lambda entry: entry[1] >= 0)
    return Bar("", one.label, "", text.figures(one.whole), [
        Segment(colors[name], 100 * abs(share) / length, f"{name}: {percent(share)}",
                f"{name} {percent(share)}" if abs(share) / length > _WIDE else "", "below" if share < 0 else "")
        for name, share in ordered])


def _scale(rendered: Images) -> float:
    """Difference that gets the full colour: the 98th percentile of the whole error's."""
    error = np.abs((rendered.of[frozenset()] - rendered.reference).mean(axis=-1))
    return float(np.percentile(error, 98)) or 1.0


def _signed(difference: np.ndarray, scale: float) -> Picture:
    shade = np.clip(difference.mean(axis=-1) / scale, -1, 1) * 0.5 + 0.5
    return images.embed_image(Image.fromarray(images.colors(images.SIGNED_ERROR_COLORS, shade)))


def _part_images(rendered: Images, one: Explained, scale: float) -> list[Shown]:
    error = rendered.of[frozenset()] - rendered.reference
    shown = [Shown(_signed(error, scale), "whole error", "image − reference")]
    rest = error
    for part in one.parts:
        added = rendered.part(part.stage)
        rest = rest - added
        shown.append(Shown(_signed(added, scale), part.stage.name, f"{percent(part.share)} of {one.label}"))
    return shown + [Shown(_signed(rest, scale), "rest", f"{percent(one.rest)} of {one.label}")]


def _previews(results: Results, rendered: Images) -> list[Shown]:
    every = frozenset(set().union(*rendered.of))
    name = results.reference_folder(rendered.names[frozenset()]) or "reference"
    listed = (("reference", name), ("as it is", rendered.names[frozenset()]), ("all stages swapped", rendered.names[every]))
    return [Shown(images.embed(path), title, "indirect light") for title, folder in listed
            if (path := results.image(folder, IMAGES["indirect"][0]))]
