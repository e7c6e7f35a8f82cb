#!/usr/bin/env python3
"""Random scenes through the chain that most configs have, with the validation layer on, against the reference.

    tests/scale/random_scenes.py build/release/bin/voxray --runs 1000

Each scene runs through voxelize, inject_light_rays, trace_gather_rays and gather_rays at 32 x 32 pixels. A scene misses
where anything fails, or where the mean of the indirect light is off by more than 3 % and is not negligible next to the
direct light. What is off runs again with smaller voxels and with direct light measured at the hits: where one of these is
right, that names the cause, and the scene is no miss. Prints what is off and why; exit status 1 where there is a miss.
The same seed is the same scene: --first 17 --runs 1 --keep DIR looks at one.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile

from scene_maker import make

CHAIN = [{"gbuffer": {"samples_per_pixel_edge": 3}}, "voxelize", {"inject_light_rays": {"rays_per_light": 262144, "bounces": 7}},
         {"trace_gather_rays": {"rays_per_block": 32}}, "gather_rays", "direct_shadow_rays", "composite"]
LARGEST_ERROR = 0.03     # Of the mean
NEGLIGIBLE = 0.02        # Of the whole image's light
BATCH = 25
# By what they change: how many times the voxels along an edge, and direct light at the hits
REMEDIES = {(1, "shadow_rays"): "direct light at the hits is as coarse as voxels", (4, "voxels"): "voxels are too coarse",
            (4, "shadow_rays"): "voxels are too coarse, and direct light at the hits with them"}


def passes(resolution):
    for entry in CHAIN:
        name, parameters = (entry, {}) if isinstance(entry, str) else next(iter(entry.items()))
        yield {"pass": name, **({"resolution": resolution} if name == "voxelize" else parameters)}


def run_batch(program, seeds, folder):
    """Runs the scenes of some seeds. @return by seed: what is awkward about it, what is off and why, and whether it misses."""
    found, by_resolution = {}, {}
    for seed in seeds:
        scene, resolution, tags = make(seed, os.path.join(folder, f"{seed}.glb"))
        found[seed] = (tags, "it has no result", True)
        by_resolution.setdefault(resolution, {})[f"s{seed}"] = scene
    for resolution, scenes in by_resolution.items():
        done, rows = run(program, folder, f"r{resolution}", resolution, next(iter(scenes.values())), scene=scenes)
        # A failed variant tells why itself; where none does, the run failed for all
        is_broken = done.returncode and all(row["status"] == "ok" for row in rows)
        for name, scene in scenes.items():
            seed, tags = int(name[1:]), found[int(name[1:])][0]
            row = next((r for r in rows if len(scenes) == 1 or r["scene"] == name), None)
            if is_broken:
                found[seed] = (tags, f"exit {done.returncode}: {done.stderr.strip()[-600:]}", True)
            elif row is not None and row["status"] != "ok":
                found[seed] = (tags, f"failed: {row['error']}", True)
            elif row is not None:
                what = off(row)
                why = what and cause(program, folder, seed, resolution, scene)
                found[seed] = (tags, f"{what}: {why or 'nothing mends that'}" if what else None, bool(what and not why))
    return found


def run(program, folder, name, resolution, first, **sweep):
    """Runs the chain over a sweep, in `folder`. @return the ended process and the rows of its results."""
    config = {"name": name, "scene": first, "image": {"width": 32, "height": 32}, "seed": 1,
              "graph": list(passes(resolution)), "reference": {"pass": "path_trace", "spp": 1024, "bounces": 8},
              "measure": {"frames": 1, "warmup": 0, "second_seed": False, "metrics": ["nrmse", "mean_ratio"]},
              "sweep": {axis: values for axis, values in sweep.items() if len(values) > 1}}
    if not config["sweep"]:
        del config["sweep"]
    file, out = os.path.join(folder, name + ".yaml"), os.path.join(folder, name)
    with open(file, "w", encoding="utf-8") as written:
        json.dump(config, written, indent=1)
    done = subprocess.run([program, "run", file, "--validate", "--out", out, "--no-report"], capture_output=True,
                          text=True, check=False)
    table = os.path.join(out, "results.csv")
    if not os.path.exists(table):
        return done, []
    with open(table, encoding="utf-8", newline="") as read:
        return done, list(csv.DictReader(read))


def off(row):
    """What of a variant's mean is off; None where it is right or next to nothing of the image's light."""
    error, of_all = float(row["indirect_mean_ratio"]) - 1, float(row["mean_ratio"]) - 1
    # Direct light is exact: what the whole is off by is the indirect light's part of it
    if abs(error) < LARGEST_ERROR or abs(of_all) < NEGLIGIBLE * abs(error):
        return None
    return f"the indirect light's mean is off by {100 * error:+.2f} %, that of all light by {100 * of_all:+.2f} %"


def cause(program, folder, seed, resolution, scene):
    """What makes the scene right; None where nothing does."""
    axes = {"voxelize.resolution": [resolution, 4 * resolution], "gather_rays.direct_at_hits": ["voxels", "shadow_rays"]}
    rows = run(program, folder, f"again{seed}", resolution, scene, **axes)[1]
    means = {(int(r["voxelize.resolution"]) // resolution, r["gather_rays.direct_at_hits"]): r
             for r in rows if r["status"] == "ok"}
    for remedy, name in REMEDIES.items():
        if remedy in means and not off(means[remedy]):
            return f"{name} ({100 * float(means[remedy]['indirect_mean_ratio']) - 100:+.2f} % without)"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--first", type=int, default=1, help="the first seed")
    parser.add_argument("--keep", help="a folder for scenes, configs and results")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    misses = 0
    for first in range(arguments.first, arguments.first + arguments.runs, BATCH):
        seeds = range(first, min(first + BATCH, arguments.first + arguments.runs))
        with tempfile.TemporaryDirectory() as scratch:
            folder = os.path.abspath(os.path.join(arguments.keep, str(first))) if arguments.keep else scratch
            os.makedirs(folder, exist_ok=True)
            for seed, (tags, what, is_miss) in run_batch(program, seeds, folder).items():
                misses += is_miss
                if what:
                    print(f"seed {seed} ({', '.join(tags)}): {what}", flush=True)
        print(f"{seeds.stop - arguments.first} scenes, {misses} misses", flush=True)
    sys.exit(1 if misses else 0)


if __name__ == "__main__":
    main()
