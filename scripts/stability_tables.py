#!/usr/bin/python3
"""Writes the tables of docs/stability.md from docs/stability.csv: what `./voxray stability` measured.

stability_tables.py [--take DIR...]

--take makes docs/stability.csv of runs of the matrix first, one folder a profile in each DIR, with today's limits and reasons
(configs/stability/matrix.csv, matrix_reasons.csv). A table stands below its line "<!-- stability: NAME -->".
"""
import argparse
import csv
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "framework"))
from report import stability, stability_page, text  # noqa: E402
from report.rows import markdown_table, read_rows  # noqa: E402
from report.verdict import FAILS, HOLDS, NOISE, UNDECIDED  # noqa: E402

PAGE, CELLS = ROOT / "docs" / "stability.md", ROOT / "docs" / "stability.csv"
LIMITS = ROOT / "configs" / "stability" / "matrix.csv"
TABLE = re.compile(r"^<!-- stability: (\S+) -->\n((?:\|.*\n)*)", re.M)
KINDS = {"leak": ("leak",), "energy": ("energy",), "bias": ("bias",), "mean, image": ("mean", "image"), "drift": ("drift",),
         "flicker": ("flicker",), "afterglow": ("afterglow",), "hitch": ("hitch",)}
VERDICTS = (HOLDS, FAILS, UNDECIDED, NOISE)


def take(folders: list[Path]) -> None:
    rows, reasons = stability.read_limits(LIMITS), stability.read_reasons(LIMITS.with_name("matrix_reasons.csv"))
    found = [cell for folder in folders for cell in stability.cells_of(folder, rows, reasons)]
    order = {row: place for place, row in enumerate(rows)}
    with open(CELLS, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(stability_page.csv_lines(sorted(found, key=lambda cell: order[cell.row])))


def counts(cells: list[dict]) -> str:
    """How many hold / fail / are undecided / are lost in noise."""
    return " / ".join(str(sum(cell["verdict"] == verdict for cell in cells)) for verdict in VERDICTS) if cells else ""


def names(cells: list[dict], key: str) -> list[str]:
    return list(dict.fromkeys(cell[key] for cell in cells))


def verdicts(cells: list[dict]) -> list[str]:
    kinds = {kind: [cell for cell in cells if cell["measure"] in measures] for kind, measures in KINDS.items()}
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
    tables = {"verdicts": verdicts, "values": values, "causes": causes}
    PAGE.write_text(TABLE.sub(lambda match: f"<!-- stability: {match[1]} -->\n" + "\n".join(tables[match[1]](cells)) + "\n",
                              PAGE.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
