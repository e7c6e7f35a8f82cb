#!/usr/bin/python3
"""Prints the tables of docs/accumulation.md, docs/reservoirs.md and docs/probes.md from results of configs/stability/accumulate.yaml,
reservoirs.yaml and probes.yaml.

accumulation_table.py DIR: for each gather and length of history, or each kind of probes, the nRMSE of indirect light, the mean
over frames, and its flicker, where nothing moves, while the camera moves and while a light moves, and in how many frames a light
that is switched off is still seen; of the scenes that were run.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

AXES = {"gather": "gather", "accumulate": "history", "probes": "probes"}  # of the sweep, and their titles
COLUMNS = tuple((scene, what) for scene in ("nothing moves", "camera moves", "light moves") for what in ("nRMSE", "flicker")) + (
    ("light off", "nRMSE"), ("light off", "frames lit"))


def table(folder):
    """Headings, and rows of cells."""
    frames = {}
    for row in read_rows(folder, "frames.csv"):
        frames.setdefault(row["variant"], []).append(row)
    cells, order = {}, []
    rows = read_rows(folder, "results.csv")
    axes = [axis for axis in AXES if any(axis in row for row in rows)]
    for row in rows:
        key = tuple(row[axis] for axis in axes)
        if key not in order:
            order.append(key)
        if row["status"] != "ok":
            cells.setdefault(key, {}).update({(row["scene"], what): "fails" for what in ("nRMSE", "flicker", "frames lit")})
            continue
        own = frames[row["variant"]]
        errors = [float(frame["indirect_nrmse"]) for frame in own]
        of = cells.setdefault(key, {})
        of[row["scene"], "nRMSE"] = f"{sum(errors) / len(errors):.3f}"
        of[row["scene"], "flicker"] = f"{float(row['indirect_temporal_flicker']):.3f}"
        of[row["scene"], "frames lit"] = own[-1].get("indirect_frames_lit") or "0"
    columns = [column for column in COLUMNS if any(column in of for of in cells.values())]
    headings = [*(AXES[axis] for axis in axes), *(f"{scene}: {what}" for scene, what in columns)]
    return headings, [[*key, *(cells[key].get(column, "-") for column in columns)] for key in order]


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    print("\n".join(markdown_table(*table(sys.argv[1]))))


if __name__ == "__main__":
    main()
