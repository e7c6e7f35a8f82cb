"""The page of `voxray tune`: what was chosen, trials by their cost and error, and images of the choice."""

from __future__ import annotations

from pathlib import Path

from report import images, pages, style, text
from report.load import load
from report.parts import Shown
from report.results import IMAGES, number
from report.style import Legend
from report.table import Table

_SCRIPTS = ("d3", "toolkit.js", "chart.js", "tune.js")
_KINDS = {"small": "small image", "full": "full size", "chosen": "chosen"}  # of trials, in the order in which they are drawn


def write(directory: Path, trail: list[list[str]], cost: str, chosen: str, axis: str, light: str, sentence: str) -> Path:
    """Makes tune.html. @return the page

    @param trail, cost rows of trail.csv, and the name of its column of costs. @param chosen a variant, by its value of `axis` in
    the results in directory/full. @param light whose images are shown"""
    styles = dict(zip(_KINDS, style.styles(len(_KINDS))))
    trials = [{"number": i, "kind": "chosen" if (size, name) == ("full", chosen) else size, "name": name, "x": number(price),
               "y": number(error)} for i, (size, name, error, price, _) in enumerate(trail, 1)]
    table = Table("Trials", ["#", "size", "variant", "error over target", cost, f"{cost} of the trial"],
                  [[str(i), size, name, *(text.figures(number(value)) for value in numbers)]
                   for i, (size, name, *numbers) in enumerate(trail, 1)], words=(1, 2))
    page = pages.render(
        "tune.html.j2", scripts=_SCRIPTS, sentence=sentence, directory=str(directory), trials=table,
        legends=[Legend("trial", [(words, styles[kind]) for kind, words in _KINDS.items()])],
        pictures=_pictures(directory / "full", axis, chosen, light),
        data={"cost": cost, "trials": trials,
              "styles": {kind: {"color": own.color, "mark": own.mark} for kind, own in styles.items()}})
    pages.write_whole(directory / "tune.html", page)
    return directory / "tune.html"


def _pictures(directory: Path, axis: str, chosen: str, light: str) -> list[Shown]:
    """The reference, the chosen variant and its error map, those that the trials left."""
    results = load(directory)
    [variant] = results.ok["variant"][results.ok[axis] == chosen]
    image, error_map = IMAGES[light]
    listed = (("reference", results.reference_folder(variant), image, images.embed), (chosen, variant, image, images.embed),
              ("its error (FLIP)", variant, error_map, images.embed_error))
    return [Shown(embed(path), title, f"{light} light") for title, folder, name, embed in listed
            if folder and (path := results.image(folder, name))]
