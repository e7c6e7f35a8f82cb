#!/usr/bin/python3
"""Compares what two builds of Voxray compute: images bit for bit, and the columns of results.csv that no clock enters.

compare_builds.py TREE_A TREE_B --out DIR: runs every config of each tree (its `small` profile where it has one) with
the tree's own program, build/release/bin/voxray, on Embree, into DIR/a and DIR/b, then compares.
compare_builds.py --only-compare A B: compares two such folders of results that are there already.

Exit status 1 where results differ or are missing on one side. Times are printed and change nothing.
"""
import argparse
import csv
import dataclasses
import json
import os
import re
import shutil
import statistics
import subprocess
import sys

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "framework"))
from report import exr_pixels  # noqa: E402

TIMES = ("build_ms", "frame_ms_median", "frame_ms_p05", "frame_ms_p95", "tracer_build_ms")
MEMORY = ("memory_bytes", "peak_bytes", "tracer_bytes")


def config_names(tree):
    """Paths of a tree's configs by the name of their results folder."""
    found = {}
    for folder, folders, files in os.walk(os.path.join(tree, "configs")):
        folders.sort()
        for file in sorted(files):
            path = os.path.relpath(os.path.join(folder, file), tree)
            if path.endswith(".yaml"):
                found[path[:-len(".yaml")].replace(os.sep, "_")] = path
    return found


def has_small_profile(path):
    with open(path, encoding="utf-8") as file:
        return re.search(r"^profiles:.*\n(?:[ #].*\n|\n)*? +small:", file.read(), re.M) is not None


def run_config(tree, path, out, cache, options):
    shutil.rmtree(out, ignore_errors=True)
    os.makedirs(os.path.dirname(out), exist_ok=True)
    command = [os.path.join(tree, "build/release/bin/voxray"), "run", os.path.join(tree, path), "--out", out,
               "--tracer", "embree", "--quiet"]
    if has_small_profile(os.path.join(tree, path)):
        command += ["--profile", "small"]
    if options.scenes:
        command += ["--scenes", options.scenes]
    for assignment in options.set:
        command += ["--set", assignment]
    # Each build has its own cache: a reference of the other one would hide a difference.
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "VOXRAY_CACHE": cache})
    if done.returncode != 0:
        print(f"{path}: exit status {done.returncode}: {done.stderr.strip()[-300:]}")


def run_both(options):
    """Runs both builds by turns; the folders of the last round hold the images. Returns the times of all rounds."""
    times = {}
    configs = {side: config_names(tree) for side, tree in zip("ab", options.trees)}
    for name in sorted(set(configs["a"]) | set(configs["b"])):
        if not re.search(options.filter, name):
            continue
        for _ in range(options.repeat):
            for side, tree in zip("ab", options.trees):
                if name in configs[side]:
                    print(f"{side}: {name}", file=sys.stderr)
                    out = os.path.join(options.out, side, name)
                    run_config(tree, configs[side][name], out, os.path.join(options.out, "cache_" + side), options)
            rows = [read_rows(os.path.join(options.out, side, name)) for side in "ab"]
            times.setdefault(name, []).append(tuple(rows))
    return times


def read_rows(folder):
    """Rows of results.csv in their order, each with its sweep's columns left out. None where there is no such file."""
    path = os.path.join(folder, "results.csv")
    if not os.path.isfile(path):
        return None
    with open(path, encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file)
        rows = list(reader)
        header = reader.fieldnames
    swept = header[header.index("tracer") + 1:header.index("build_ms")]
    return [{key: value for key, value in row.items() if key not in swept} for row in rows]


def paired(rows_a, rows_b):
    """Rows of the same variant; where a sweep's words changed, what is left over is paired in its order."""
    by_name = {row["variant"]: row for row in rows_b}
    pairs = [(row, by_name.pop(row["variant"])) for row in rows_a if row["variant"] in by_name]
    left_a = [row for row in rows_a if all(row is not a for a, _ in pairs)]
    left_b = list(by_name.values())
    if len(left_a) == len(left_b):
        return pairs + list(zip(left_a, left_b)), []
    return pairs, [f"variant {row['variant']} only in a" for row in left_a] + [
        f"variant {row['variant']} only in b" for row in left_b]


@dataclasses.dataclass
class Change:
    """How far images of two builds are apart, as parts of 1; of several images the largest."""
    nrmse: float = 0.0  # Root mean square of the difference over the first image's mean.
    mean: float = 0.0  # Difference of means over the first image's.
    error: float = 0.0  # Change of a score (nrmse against the reference) over the first build's.

    def widen(self, nrmse=0.0, mean=0.0, error=0.0):
        self.nrmse, self.mean, self.error = max(self.nrmse, nrmse), max(self.mean, mean), max(self.error, error)


def compare_images(path_a, path_b, change):
    """What differs between two EXR files, None where all pixels have the same bits. Widens `change`."""
    with open(path_a, "rb") as a, open(path_b, "rb") as b:
        if a.read() == b.read():
            return None
    a, b = exr_pixels.read(path_a), exr_pixels.read(path_b)
    if list(a) != list(b):
        return f"channels {', '.join(a)} and {', '.join(b)}"
    shapes = [next(iter(image.values())).shape for image in (a, b)]
    if shapes[0] != shapes[1]:
        return f"{shapes[0][1]} x {shapes[0][0]} and {shapes[1][1]} x {shapes[1][0]} pixels"
    differing = numpy.zeros(shapes[0], bool)
    largest = average = squares = mean = mean_b = 0.0
    for name in a:
        differing |= a[name].view(f"u{a[name].itemsize}") != b[name].view(f"u{b[name].itemsize}")
        difference = numpy.abs(a[name].astype(float) - b[name].astype(float))
        largest = max(largest, float(numpy.nanmax(difference)))
        average += float(numpy.nanmean(difference)) / len(a)
        squares += float(numpy.nanmean(difference ** 2)) / len(a)
        mean += float(numpy.nanmean(numpy.abs(a[name].astype(float)))) / len(a)
        mean_b += float(numpy.nanmean(numpy.abs(b[name].astype(float)))) / len(a)
    if not differing.any():
        return None
    if mean > 0:
        change.widen(nrmse=squares ** 0.5 / mean, mean=abs(mean_b / mean - 1))
    return f"{differing.sum()} of {differing.size} pixels, by at most {largest:.3g}, on average {average:.3g} (mean {mean:.3g})"


def exr_files(folder):
    found = set()
    for at, _, files in os.walk(folder):
        found |= {os.path.relpath(os.path.join(at, name), folder) for name in files if name.endswith(".exr")}
    return found


def image_folder(folder, variant):
    """Where a variant's images are: its name, shortened where it is too long for a folder."""
    images = os.path.join(folder, "images")
    if os.path.isdir(os.path.join(images, variant)):
        return os.path.join(images, variant)
    for name in sorted(os.listdir(images)) if os.path.isdir(images) else []:
        result = os.path.join(images, name, "result.json")
        if os.path.isfile(result):
            with open(result, encoding="utf-8") as file:
                if json.load(file).get("variant") == variant:
                    return os.path.join(images, name)
    return os.path.join(images, variant)


def compare_config(folder_a, folder_b, ignored):
    """Returns (images compared, differences that count, remarks, their Change)."""
    rows = [read_rows(folder) for folder in (folder_a, folder_b)]
    if None in rows:
        return 0, [f"no results.csv in {'a' if rows[0] is None else 'b'}"], [], Change()
    pairs, differences = paired(*rows)
    remarks, images, change = [], 0, Change()
    folders = [(image_folder(folder_a, a["variant"]), image_folder(folder_b, b["variant"]), a["variant"])
               for a, b in pairs]
    references = sorted({name for folder in (folder_a, folder_b) if os.path.isdir(os.path.join(folder, "images"))
                         for name in os.listdir(os.path.join(folder, "images")) if name.startswith("reference")})
    folders += [(os.path.join(folder_a, "images", name), os.path.join(folder_b, "images", name), name)
                for name in references]
    for a, b in pairs:
        if a["variant"] != b["variant"]:
            remarks.append(f"paired by order: {a['variant']} and {b['variant']}")
        for column in a:
            if column in TIMES or column in ("variant", "name", "error", "device", "tracer") or column not in b:
                continue
            if a[column] != b[column]:
                if column.endswith("nrmse") and float(a[column] or 0) > 0 and b[column]:
                    change.widen(error=abs(float(b[column]) / float(a[column]) - 1))
                text = f"{a['variant']}: {column} is {a[column] or 'empty'} in a, {b[column] or 'empty'} in b"
                is_ignored = column in ignored or ("memory" in ignored and column in MEMORY)
                (remarks if is_ignored else differences).append(text)
        if a["error"] != b["error"]:
            remarks.append(f"{a['variant']}: error '{a['error']}' in a, '{b['error']}' in b")
    for path_a, path_b, name in folders:
        files_a, files_b = exr_files(path_a), exr_files(path_b)
        for file in sorted(files_a ^ files_b):
            differences.append(f"{name}: {file} only in {'a' if file in files_a else 'b'}")
        for file in sorted(files_a & files_b):
            images += 1
            found = compare_images(os.path.join(path_a, file), os.path.join(path_b, file), change)
            if found:
                differences.append(f"{name}: {file}: {found}")
    only = [sorted(set(x[0]) - set(y[0])) for x, y in (rows, rows[::-1])] if all(rows) else [[], []]
    remarks += [f"columns only in {side}: {', '.join(names)}" for side, names in zip("ab", only) if names]
    return images, differences, remarks, change


def time_ratio(rounds, column):
    """Median of b's time over a's, over all variants and rounds; '-' where there is none."""
    ratios = []
    for rows_a, rows_b in rounds:
        for a, b in paired(rows_a, rows_b)[0] if rows_a and rows_b else []:
            if float(a.get(column) or 0) > 0 and float(b.get(column) or 0) > 0:
                ratios.append(float(b[column]) / float(a[column]))
    return f"{statistics.median(ratios):.3f}" if ratios else "-"


def compare(options, folder_a, folder_b, rounds):
    names = sorted({name for folder in (folder_a, folder_b) if os.path.isdir(folder)
                    for name in os.listdir(folder) if os.path.isdir(os.path.join(folder, name))})
    names = [name for name in names if re.search(options.filter, name)]
    if not names:
        sys.exit("no results to compare")
    width = max(map(len, names))
    print(f"{'config':{width}}  images  differences    nRMSE     mean    error  frame b/a  build b/a")
    listed = []
    for name in names:
        a, b = os.path.join(folder_a, name), os.path.join(folder_b, name)
        images, differences, remarks, change = compare_config(a, b, options.ignore)
        times = rounds.get(name) or [(read_rows(a), read_rows(b))]
        print(f"{name:{width}}  {images:6}  {len(differences):11}  {change.nrmse:7.1e}  {change.mean:7.1e}  "
              f"{change.error:7.1e}  {time_ratio(times, 'frame_ms_median'):>9}  {time_ratio(times, 'build_ms'):>9}")
        listed += [(name, differences, remarks)]
    for name, differences, remarks in listed:
        lines = ["  " + text for text in differences] + ["  (" + text + ")" for text in remarks]
        if lines:
            print("\n".join([f"\n{name}:"] + lines[:options.lines]))
            if len(lines) > options.lines:
                print(f"  and {len(lines) - options.lines} more")
    return any(differences for _, differences, _ in listed)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trees", nargs=2, metavar="TREE", help="root of a built tree; a results folder with --only-compare")
    parser.add_argument("--only-compare", action="store_true", help="run nothing: the two folders hold results")
    parser.add_argument("--out", help="folder for the results of both builds")
    parser.add_argument("--filter", default="", metavar="RE", help="only configs whose name (configs_bench_...) matches")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE", help="as for voxray run")
    parser.add_argument("--scenes", metavar="DIR", help="as for voxray run")
    parser.add_argument("--repeat", type=int, default=1, metavar="N", help="rounds, by turns, for the times")
    parser.add_argument("--ignore", action="append", default=[], metavar="COLUMN",
                        help="a column of results.csv that may differ; 'memory' for both columns of memory")
    parser.add_argument("--lines", type=int, default=20, metavar="N", help="differences listed of each config")
    options = parser.parse_args()
    if options.only_compare:
        sys.exit(compare(options, *options.trees, {}))
    if not options.out:
        parser.error("--out is missing")
    rounds = run_both(options)
    sys.exit(compare(options, os.path.join(options.out, "a"), os.path.join(options.out, "b"), rounds))


if __name__ == "__main__":
    main()
