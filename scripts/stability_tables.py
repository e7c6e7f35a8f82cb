#!/usr/bin/python3
"""Writes the tables of docs/stability.md from docs/stability.csv: what `./voxray stability` measured.

stability_tables.py [--take DIR...]

--take makes docs/stability.csv of runs of the matrix first, one folder a profile in each DIR, with today's limits and reasons
(configs/stability/matrix.csv, matrix_reasons.csv), and docs/stability_times.csv of a folder `times`. A table stands below its line
"<!-- stability: NAME -->".
"""
import argparse
import csv
import math
import re
import string
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "framework"))
from report import stability, stability_page, text  # noqa: E402
from report.rows import markdown_table, read_rows  # noqa: E402
from report.verdict import FAILS, HOLDS, NOISE, UNDECIDED  # noqa: E402

PAGE, CELLS, TIMES = ROOT / "docs" / "stability.md", ROOT / "docs" / "stability.csv", ROOT / "docs" / "stability_times.csv"
LIMITS = ROOT / "configs" / "stability" / "matrix.csv"
TABLE = re.compile(r"^<!-- stability: (\S+) -->\n((?:\|.*\n)*)", re.M)
KINDS = {"leak": ("leak",), "energy": ("energy",), "bias": ("bias",), "mean, image": ("mean", "image"), "drift": ("drift",),
         "flicker": ("flicker",), "afterglow": ("afterglow",), "hitch": ("hitch",)}
VERDICTS = (HOLDS, FAILS, UNDECIDED, NOISE)
# Of a choice of a method: one that has another's image where there is no mirror, and those that use rays of frames before.
SAME_IMAGE, WITH_HISTORY = "hybrid leaves", ("screen probes", "reservoirs", "paths with history")
# What a scene has, and the scenes of the matrix that have it.
SCENES = {
    "mirrors": ("mirror room",),
    "dark rooms behind walls thinner than a voxel": ("wall of 1/4 voxel", "wall of 1/2 voxel", "wall of 1 voxel", "shell room",
                                                     "wall behind, 0.3 m", "wall behind, 1.7 m", "inner corner"),
    "rooms lit through windows by sun and sky": ("window room", "edge of a shadow", "sun in a sky map"),
    "a room lit through a slit or hole narrower than a voxel": ("slit of 2 cm",),
    "the open: sun and sky on houses and ground": ("outdoors",),
    "leaves, or other things a few pixels wide": ("leaves",),
    "tiny lamps, or thousands of small ones": ("candles", "10,000 lamps"),
    "rough metal": ("thin metal",),
    "a camera that moves": ("camera path", "there and back", "clipmap scroll", "behind a box", "round a corner"),
    "a camera that jumps": ("jumps", "a camera that jumps"),
    "surfaces that move": ("moving objects", "skinned figure"),
    "lamps that move": ("light path", "glowing panel"),
    "lamps that go out": ("light goes out",),
    "leaves that sway": ("swaying leaves",),
    "a dark room whose door opens": ("a door opens",),
    "none of these: still walls and furniture, soft light": ("cornell", "clutter", "slivers", "white room"),
}


def take(folders: list[Path]) -> None:
    rows, reasons = stability.read_limits(LIMITS), stability.read_reasons(LIMITS.with_name("matrix_reasons.csv"))
    found = [cell for folder in folders for cell in stability.cells_of(folder, rows, reasons)]
    order = {row: place for place, row in enumerate(rows)}
    with open(CELLS, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(stability_page.csv_lines(sorted(found, key=lambda cell: order[cell.row])))
    for folder in (folder / "times" for folder in folders if (folder / "times").is_dir()):
        lines = [(row["method"], f"{float(row['frame_ms_median']):.1f}", f"{float(row['build_ms']):.1f}") for row in read_rows(folder, "results.csv")]
        with open(TIMES, "w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows([("method", "frame_ms", "build_ms"), *lines])


def counts(cells: list[dict]) -> str:
    """How many hold / fail / are undecided / are lost in noise."""
    return " / ".join(str(sum(cell["verdict"] == verdict for cell in cells)) for verdict in VERDICTS) if cells else ""


def names(cells: list[dict], key: str) -> list[str]:
    return list(dict.fromkeys(cell[key] for cell in cells))


def verdicts(cells: list[dict]) -> list[str]:
    kinds = {kind: [cell for cell in cells if cell["measure"].partition("@")[0] in measures] for kind, measures in KINDS.items()}
    kinds = {kind: own for kind, own in kinds.items() if own}
    lines = [[method, *(counts([cell for cell in own if cell["method"] == method]) for own in [*kinds.values(), cells])]
             for method in names(cells, "method")]
    lines.append(["all", *(counts(own) for own in [*kinds.values(), cells])])
    return list(markdown_table(["method", *kinds, "all"], lines))


def value(cell: dict | None) -> str:
    if cell is None:
        return ""
    marks = {HOLDS: "{}", FAILS: "**{}**", UNDECIDED: "{} ?", NOISE: "{} ~"}
    return marks[cell["verdict"]].format(text.figures(100 * float(cell["value"]), 2) if cell["value"] else "does not run")


def values(cells: list[dict]) -> list[str]:
    found = {(cell["scene"], cell["measure"], cell["method"]): cell for cell in cells}
    methods = names(cells, "method")
    rows = dict.fromkeys((cell["scene"], cell["measure"], cell["limit"]) for cell in cells)
    return list(markdown_table(["scene", "measure", "limit, %", *methods],
                               ([scene, measure, text.figures(100 * float(limit), 2), *(value(found.get((scene, measure, method))) for method in methods)]
                                for scene, measure, limit in rows)))


def over(cell: dict) -> float:
    """What a value is at most, by the end of its interval, over its limit: noise counts against a method."""
    return float(cell["high"]) / float(cell["limit"]) if cell["high"] else math.inf


def worst(cells: list[dict], method: str, scenes: tuple[str, ...]) -> float:
    """The largest of these in the scenes; NaN where nothing is measured."""
    return max((over(cell) for cell in cells if cell["method"] == method and cell["scene"] in scenes), default=math.nan)


def compared(cells: list[dict]) -> list[str]:
    """The methods that are chosen among."""
    return [method for method in names(cells, "method") if method != SAME_IMAGE]


def least(cells: list[dict], scenes: tuple[str, ...]) -> str:
    """The methods that are nearest to their limits."""
    ranked = sorted((value, method) for method in compared(cells) if not math.isnan(value := worst(cells, method, scenes)))
    none = [method for value, method in ranked if times(value) == "0"]
    return f"{len(none)} methods (0)" if len(none) > 3 else ", ".join(f"{method} ({times(value)})" for value, method in ranked[:3])


def kinds(cells: list[dict]) -> list[str]:
    """What a scene may have, with the methods that are nearest to their limits there."""
    lines = []
    for letter, (kind, scenes) in zip(string.ascii_uppercase, SCENES.items()):
        shown = [f"`{scene}`" for scene in scenes if any(cell["scene"] == scene for cell in cells)]
        lines.append([letter, kind, least(cells, scenes), ", ".join(shown)])
    return list(markdown_table(["line", "your scene has", "least error, over its limit", "measured in"], lines))


def times(value: float) -> str:
    """What a value is at most, over its limit, as a reader compares it."""
    return "-" if math.isnan(value) else text.figures(value, 2) if value >= 0.01 else "0"


def choice(cells: list[dict]) -> list[str]:
    """Of each method the largest value over its limit, by what a scene has, and its times."""
    took = {row["method"]: [text.figures(float(row[column]), 2) for column in ("frame_ms", "build_ms")] for row in read_rows(TIMES)}
    lines = [[method + (" *" if method in WITH_HISTORY else ""), *(times(worst(cells, method, scenes)) for scenes in SCENES.values()),
              *took.get(method, ("-", "-"))] for method in compared(cells)]
    return list(markdown_table(["method", *string.ascii_uppercase[:len(SCENES)], "frame, ms", "build, ms"], lines))


def causes(cells: list[dict]) -> list[str]:
    """Cells that fail, by measure and reason, those that most have first."""
    groups: dict[tuple[str, str], list[dict]] = {}
    for cell in cells:
        if cell["verdict"] == FAILS:
            groups.setdefault((cell["measure"], cell["reason"]), []).append(cell)
    lines = []
    for (measure, reason), own in sorted(groups.items(), key=lambda group: -len(group[1])):
        found = [100 * float(cell["value"]) for cell in own if cell["value"]]
        span = " to ".join(dict.fromkeys(text.figures(end, 2) for end in (min(found), max(found)))) if found else ""
        lines.append([str(len(own)), measure, span, ", ".join(names(own, "method")), ", ".join(f"`{scene}`" for scene in names(own, "scene")), reason])
    return list(markdown_table(["cells", "measure", "values, %", "methods", "scenes", "cause"], lines))


def main() -> None:
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--take", nargs="+", type=Path, default=[])
    options = parser.parse_args()
    if options.take:
        take(options.take)
    cells = read_rows(CELLS)
    tables = {"verdicts": verdicts, "values": values, "causes": causes, "kinds": kinds, "choice": choice}
    PAGE.write_text(TABLE.sub(lambda match: f"<!-- stability: {match[1]} -->\n" + "\n".join(tables[match[1]](cells)) + "\n",
                              PAGE.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
