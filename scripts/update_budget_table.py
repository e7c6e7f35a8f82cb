#!/usr/bin/python3
"""Prints the tables of docs/hit-faces.md on budgets from results of configs/bench/update_budget.yaml.

update_budget_table.py DIR...: for each scene and method the nRMSE of indirect light before the light changed, its mean over the
frames 0 to 3, and in the first, second, fourth, eighth and sixteenth frame after. With --over-frames, of a light that moves in
each frame: means over all frames of nRMSE and relMSE, the mean ratio, and flicker and bias over frames.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

CHANGE = 4  # The first frame of the changed light.
AFTER = (1, 2, 4, 8, 16)  # Frames since.


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def after_a_change(own, _row):
    errors = {int(frame["frame"]): float(frame["indirect_nrmse"]) for frame in own}
    return [mean(errors[frame] for frame in range(CHANGE)), *(errors[CHANGE + n - 1] for n in AFTER)]


def over_frames(own, row):
    return [mean(float(frame[f"indirect_{score}"]) for frame in own) for score in ("nrmse", "relmse", "mean_ratio")] + [
        float(row[f"indirect_temporal_{part}"]) for part in ("bias", "flicker")]


def table(folders, numbers_of):
    rows = []
    for folder in folders:
        frames = {}
        for frame in read_rows(folder, "frames.csv"):
            frames.setdefault(frame["variant"], []).append(frame)
        for row in read_rows(folder, "results.csv"):
            numbers = numbers_of(frames[row["variant"]], row) if row["status"] == "ok" else []
            rows.append([f"`{row['scene']}`", row["indirect"], *(f"{number:.3f}" for number in numbers)])
    return rows


def main():
    folders = [word for word in sys.argv[1:] if not word.startswith("-")]
    options = set(sys.argv[1:]) - set(folders)
    if not folders or options - {"--over-frames"}:
        raise SystemExit(__doc__)
    if options:
        headings = ["nRMSE", "relMSE", "mean ratio", "bias", "flicker"]
        rows = table(folders, over_frames)
    else:
        headings = ["before", *(f"{n}{'st' if n == 1 else 'nd' if n == 2 else 'th'} frame" for n in AFTER)]
        rows = table(folders, after_a_change)
    print("\n".join(markdown_table(["scene", "method", *headings], rows)))


if __name__ == "__main__":
    main()
