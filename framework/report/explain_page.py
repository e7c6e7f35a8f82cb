"""The page of `voxray explain`: sentences, a waterfall of the error's parts, and an image of each."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from report import explain, images, pages, text
from report.explain import Explained, Images, percent, sentence
from report.images import Picture
from report.load import load
from report.results import IMAGES, Results
from report.style import CATEGORY_COLORS

_SIGNED_COLORS = "RdBu_r"  # blue: the stage takes light away, red: it adds light
_SMALL = 0.1  # of the whole error: a rest that needs no word


@dataclass(frozen=True)
class Shown:
    """An image with its caption."""

    picture: Picture
    title: str
    note: str


@dataclass(frozen=True)
class Step:
    """A bar of a waterfall. left, width, and the ends and the mean of its stage's part over all orders: % of the track."""

    name: str
    share: str
    color: str
    left: float
    width: float
    orders: list[float] | None


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
    return pages.render(
        "explain.html.j2", name=str(config.get("name", "")).removeprefix("explain_"),
        sentences=[line for one in explained for line in _sentences(one)],
        waterfalls=[(one.label, _waterfall(one)) for one in explained],
        tables=[(one.label, _rows(one)) for one in explained],
        stages=[(stage.name, ", ".join(stage.changes), ", ".join(stage.needs), stage.cure)
                for stage in (part.stage for part in explained[0].parts)],
        previews=_previews(results, rendered), parts=_part_images(rendered, explained[0], scale), scale=text.figures(scale, 2),
        sets=[(_name_of(chosen), *(text.figures(one.errors[chosen]) for one in explained)) for chosen in rendered.of],
        labels=[one.label for one in explained], directory=str(results.directory), gradient=images.gradient(_SIGNED_COLORS))


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
    lines += [f"Of {one.label}, the error grows by {percent(-part.share)} where {part.stage.name} is swapped: it hides what "
              "other stages do wrong." for part in one.parts if part.high < -_SMALL / 2]
    return lines


def _rows(one: Explained) -> list[tuple[str, ...]]:
    rows = [(part.stage.name, percent(part.share), f"{percent(part.low)} to {percent(part.high)}", percent(part.mean),
             f"{percent(part.least)} to {percent(part.most)}") for part in one.parts]
    total = sum(part.mean for part in one.parts)
    return rows + [("rest", percent(one.rest), f"{percent(one.rest_low)} to {percent(one.rest_high)}", percent(1 - total), "")]


def _waterfall(one: Explained) -> list[Step]:
    """From the whole error down, a stage each."""
    shares = [1.0, *(part.share for part in one.parts), one.rest]
    levels = np.array([1.0, *(1.0 - np.cumsum([0.0, *shares[1:]]))])  # where each bar begins; the last one's end
    ends = np.array([0.0, *levels[2:]])
    ranges = [None, *((levels[i + 1] - part.most, levels[i + 1] - part.mean, levels[i + 1] - part.least) for i, part in enumerate(one.parts)), None]
    drawn = [0.0, *levels, *(value for orders in ranges if orders for value in orders)]
    low, width = min(drawn), max(drawn) - min(drawn)

    def position(value: float) -> float:
        return 100 * (value - low) / width
    names = ["whole", *(part.stage.name for part in one.parts), "rest"]
    colors = ["muted", *(CATEGORY_COLORS[i % len(CATEGORY_COLORS)] for i in range(len(one.parts))), "muted"]
    return [Step(name, percent(share), color, position(min(begin, end)), 100 * abs(end - begin) / width, [position(value) for value in orders] if orders else None)
            for name, share, color, begin, end, orders in zip(names, shares, colors, levels, ends, ranges)]


def _scale(rendered: Images) -> float:
    """Difference that gets the full colour: the 98th percentile of the whole error's."""
    error = np.abs((rendered.of[frozenset()] - rendered.reference).mean(axis=-1))
    return float(np.percentile(error, 98)) or 1.0


def _signed(difference: np.ndarray, scale: float) -> Picture:
    shade = np.clip(difference.mean(axis=-1) / scale, -1, 1) * 0.5 + 0.5
    return images.embed_image(Image.fromarray(images.colors(_SIGNED_COLORS, shade)))


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
