#!/usr/bin/python3
"""Prints the tables of docs/hit-faces.md on budgets from results of configs/bench/update_budget.yaml.

update_budget_table.py DIR...: for each scene and method the nRMSE of indirect light: its mean over the frames before the light
changed, and in the first, fourth and eighth frame of the changed light.
update_budget_table.py --over-frames DIR...: of a light that moves in each frame, means over all frames of nRMSE and relMSE, the
mean ratio, and bias and flicker over frames.
"""
import os
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

CHANGE = 4  # The first frame of the changed light.
AFTER = (1, 4, 8)  # Frames of the changed light, the first is 1.


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def finished(folders):
    """Rows of results.csv, each with its frames."""
    for folder in folders:
        frames = {}
        for frame in read_rows(folder, "frames.csv"):
            frames.setdefault(frame["variant"], []).append(frame)
        for row in read_rows(folder, "results.csv"):
            if row["status"] == "ok":
                yield row, frames[row["variant"]]


def after_a_change(folders):
    cells = {}
    for row, own in finished(folders):
        errors = {int(frame["frame"]): float(frame["indirect_nrmse"]) for frame in own}
        shown = [mean(errors[frame] for frame in range(CHANGE)), *(errors[CHANGE + n - 1] for n in AFTER)]
        cells.setdefault(row["scene"], {})[row["indirect"]] = " / ".join(f"{error:.3f}" for error in shown)
    methods = list(dict.fromkeys(method for of in cells.values() for method in of))
    return ["scene", *methods], [[f"`{scene}`", *(of.get(method, "-") for method in methods)] for scene, of in cells.items()]


def over_frames(folders):
    rows = []
    for row, own in finished(folders):
        numbers = [mean(float(frame[f"indirect_{score}"]) for frame in own) for score in ("nrmse", "relmse", "mean_ratio")]
        numbers += [float(row[f"indirect_temporal_{part}"]) for part in ("bias", "flicker")]
        rows.append([f"`{row['scene']}`", row["indirect"], *(f"{number:.3f}" for number in numbers)])
    return ["scene", "method", "nRMSE", "relMSE", "mean ratio", "bias", "flicker"], rows


def main():
    words = sys.argv[1:]
    table = over_frames if words[:1] == ["--over-frames"] else after_a_change
    folders = words[1:] if table is over_frames else words
    if not folders or any(folder.startswith("-") for folder in folders):
        raise SystemExit(__doc__)
    print("\n".join(markdown_table(*table(folders))))


if __name__ == "__main__":
    main()
