#!/usr/bin/env python3
"""Random scenes through the chain that most configs have, with the validation layer on, against the reference.

    tests/scale/random_scenes.py build/release/bin/voxray --runs 1000

Each scene runs through voxelize, inject_light_rays, trace_gather_rays and gather_rays at 32 x 32 pixels. A scene is off
where anything fails, or where the mean of the indirect light is off by more than 3 % and is not negligible: by more than
a thousandth of the scene's typical radiance (scene_maker.py), and next to the whole image's light. What is off runs again
with 16 times the samples in the reference: where it is right then, the reference was noisy. Else it runs with more camera
and gather rays, with these and smaller voxels, and with direct light measured at the hits: where one of them is right, that
names the cause, and the scene is no miss. Nor is it one where the reference's halves, of lights that stand close to surfaces,
leave its mean uncertain by as much. Prints what is off and why; exit status 1 where there is a miss. The same seed is the same
scene: --first 17 --runs 1 --keep DIR looks at one.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scene_maker import make

sys.path.append(str(Path(__file__).resolve().parents[2] / "framework"))
from report import exr_pixels  # noqa: E402

LARGEST_ERROR = 0.03     # Of the mean
NEGLIGIBLE = 0.02        # Of the whole image's light
DARK = 0.001             # Of the scene's typical radiance
NOISE = 3                # Standard errors
SAMPLES = 1024           # A pixel of the reference
BATCH = 25
# Camera rays along the edge of a pixel, and gather rays by block of pixels
SAMPLING, FINE_SAMPLING = (3, 32), (8, 1024)
# By what they change, all with fine sampling: how many times the voxels along an edge, and direct light at the hits
REMEDIES = {(1, "voxels"): "rays are few", (1, "shadow_rays"): "direct light at the hits is as coarse as voxels",
            (4, "voxels"): "voxels are too coarse",
            (4, "shadow_rays"): "voxels are too coarse, and direct light at the hits with them"}


def graph(resolution, sampling):
    camera_rays, gather_rays = sampling
    return [{"pass": "gbuffer", "samples_per_pixel_edge": camera_rays}, {"pass": "voxelize", "resolution": resolution},
            {"pass": "inject_light_rays", "rays_per_light": 262144, "bounces": 7},
            {"pass": "trace_gather_rays", "rays_per_block": gather_rays}, {"pass": "gather_rays"},
            {"pass": "direct_shadow_rays"}, {"pass": "composite"}]


def run_batch(program, seeds, folder):
    """Runs the scenes of some seeds. @return by seed: what is awkward about it, what is off and why, and whether it misses."""
    found, made = {}, {}
    for seed in seeds:
        scene, resolution, tags, typical = make(seed, os.path.join(folder, f"{seed}.glb"))
        found[seed] = tags
        made.setdefault(resolution, {})[seed] = (scene, typical)
    for resolution, scenes in made.items():
        for group in (scenes, *({seed: scene} for seed, scene in scenes.items())):
            left = {seed: scene for seed, scene in group.items() if isinstance(found[seed], list)}
            found.update((seed, (found[seed], *ending)) for seed, ending in run_group(program, left, resolution, folder).items())
    return found


def run_group(program, scenes, resolution, folder):
    """By seed what is off, None for nothing, and whether that is a miss. None of several scenes where one of them stopped the run."""
    if not scenes:
        return {}
    done, rows = run(program, folder, f"r{resolution}", resolution, {f"s{seed}": scene for seed, (scene, _) in scenes.items()})
    # A failed variant tells why itself; where none does, the run failed for all
    if not rows or (done.returncode and all(row["status"] == "ok" for row in rows)):
        why = f"exit {done.returncode}: {done.stderr.strip()[-600:]}"
        return {seed: (why, True) for seed in scenes} if len(scenes) == 1 else {}
    endings = {}
    for seed, (scene, typical) in scenes.items():
        row = next(r for r in rows if len(scenes) == 1 or r["scene"] == f"s{seed}")
        if row["status"] != "ok":
            endings[seed] = (f"failed: {row['error']}", True)
        elif what := off(row, typical):
            endings[seed] = cause(program, folder, seed, resolution, scene, typical, what)
        else:
            endings[seed] = (None, False)
    return endings


def run(program, folder, name, resolution, scenes, samples=SAMPLES, sampling=SAMPLING, **sweep):
    """Runs the chain over scenes by name and a sweep, in `folder`. @return the ended process, and the rows of its results with the
    folders of their images."""
    sweep = {axis: values for axis, values in {"scene": scenes, **sweep}.items() if len(values) > 1}
    config = {"name": name, "scene": next(iter(scenes.values())), "image": {"width": 32, "height": 32}, "seed": 1,
              "graph": graph(resolution, sampling), "reference": {"pass": "path_trace", "spp": samples, "bounces": 8},
              "measure": {"frames": 1, "warmup": 0, "build_repeats": 0, "metrics": ["nrmse", "mean_ratio"]},
              **({"sweep": sweep} if sweep else {})}
    file, out = os.path.join(folder, name + ".yaml"), os.path.join(folder, name)
    with open(file, "w", encoding="utf-8") as written:
        json.dump(config, written, indent=1)
    done = subprocess.run([program, "run", file, "--validate", "--out", out, "--no-report"], capture_output=True,
                          text=True, check=False)
    table = os.path.join(out, "results.csv")
    if not os.path.exists(table):
        return done, []
    with open(table, encoding="utf-8", newline="") as read:
        return done, [{**row, "images": Path(out, "images", row["variant"])} for row in csv.DictReader(read)]


def means(row, image):
    """Mean radiance of an image of a variant, and of the same of its reference."""
    pixels = exr_pixels.read(row["images"] / f"{image}.exr")
    mean = float(np.mean([pixels[c] for c in "RGB"]))
    return mean, mean / float(row["mean_ratio" if image == "final" else "indirect_mean_ratio"])


def standard_error(row):
    """Of the mean of the reference's indirect light, W/(m² sr), from its two halves."""
    halves = [exr_pixels.read(row["images"].parent / "reference" / f"indirect_{half}.exr") for half in "ab"]
    difference = np.mean([halves[0][c] - halves[1][c] for c in "RGB"], axis=0)
    return float(np.sqrt(np.sum(difference ** 2)) / 2 / difference.size)


def off(row, typical):
    """What of a variant's mean is off; None where it is right or negligible."""
    indirect, expected = means(row, "indirect")
    all_light = means(row, "final")[1]
    difference = abs(indirect - expected)
    if difference <= max(LARGEST_ERROR * expected, DARK * typical) or max(indirect, expected) < NEGLIGIBLE * all_light:
        return None
    return f"the indirect light's mean is {indirect:.4g} W/(m² sr), not {expected:.4g}; typical of the scene is {typical:.4g}"


def cause(program, folder, seed, resolution, scene, typical, what):
    """What makes the scene right, and whether nothing does."""
    rows = run(program, folder, f"again{seed}", resolution, {"": scene}, 16 * SAMPLES)[1]
    if rows and rows[0]["status"] == "ok":
        what = off(rows[0], typical)
        if not what:
            return None, False  # The reference was noisy
    axes = {"voxelize.resolution": [resolution, 4 * resolution], "gather_rays.direct_at_hits": ["voxels", "shadow_rays"]}
    rows = run(program, folder, f"fine{seed}", resolution, {"": scene}, 16 * SAMPLES, FINE_SAMPLING, **axes)[1]
    fine = {(int(r["voxelize.resolution"]) // resolution, r["gather_rays.direct_at_hits"]): r for r in rows if r["status"] == "ok"}
    for remedy, name in REMEDIES.items():
        if remedy in fine and not off(fine[remedy], typical):
            return f"{what}: {name} ({100 * float(fine[remedy]['indirect_mean_ratio']) - 100:+.2f} % without)", False
    for row in fine.values():
        mean, expected = means(row, "indirect")
        if abs(mean - expected) <= NOISE * standard_error(row):
            return f"{what}: the reference is noisy (its mean's standard error is {100 * standard_error(row) / expected:.1f} %)", False
    return f"{what}: nothing mends that", True


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
