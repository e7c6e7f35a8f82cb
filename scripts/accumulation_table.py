#!/usr/bin/python3
"""Prints the table of docs/accumulation.md from results of configs/stability/accumulate.yaml.

accumulation_table.py DIR: for each gather and length of history, the nRMSE of indirect light, the mean over frames, and its
flicker, while the camera moves and while a light moves, and in how many frames a light that is switched off is still seen.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

COLUMNS = (("camera moves", "nRMSE"), ("camera moves", "flicker"), ("light moves", "nRMSE"), ("light moves", "flicker"),
           ("light off", "nRMSE"), ("light off", "frames lit"))


def table(folder):
    """Rows of cells."""
    frames = {}
    for row in read_rows(folder, "frames.csv"):
        frames.setdefault(row["variant"], []).append(row)
    cells, order = {}, []
    for row in read_rows(folder, "results.csv"):
        key = (row["gather"], row["accumulate"])
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
    return [[*key, *(cells[key].get(column, "-") for column in COLUMNS)] for key in order]


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    headings = ["gather", "history", *(f"{scene}: {what}" for scene, what in COLUMNS)]
    print("\n".join(markdown_table(headings, table(sys.argv[1]))))


if __name__ == "__main__":
    main()
