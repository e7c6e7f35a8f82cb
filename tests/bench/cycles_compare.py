"""Measures Blender's Cycles on scenes that Voxray exported, and compares it with Voxray's path tracer.

    ninja -C build/release bench_trace && mkdir rivals
    VOXRAY_EXPORT=rivals build/release/tests/bench/bench_trace --benchmark_filter=pathTraceRival \\
        --benchmark_out=rivals/ours.json --benchmark_out_format=json
    /usr/bin/python3 tests/bench/cycles_compare.py rivals [SCENE...] [--srgb-filter]

Both render the same pixels and bounces on all CPU cores; scripts/external/cycles.py sets Cycles up, and says how.
Speed is the slope between two numbers of samples, so that starting up does not count. Variance is the spread between
seeds times the samples a pixel. The last lines of a scene give samples a second at equal variance, by wall clock and
by CPU time; the latter holds on a busy machine too. Images whose means differ by more than TOLERANCE are of two scenes:
no ratio, and exit status 1.
"""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile

# By its path: within Blender, `cycles` is Blender's own module
_SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "external", "cycles.py")
_FOUND = importlib.util.spec_from_file_location("external_cycles", _SCRIPT)
cycles = importlib.util.module_from_spec(_FOUND)
_FOUND.loader.exec_module(cycles)

FEW = 4
SEEDS = 4
TOLERANCE = 0.03


def render_once(bpy, scene, folder, samples, seed):
    """Returns wall seconds, CPU seconds and the pixels."""
    import numpy

    path = os.path.join(folder, f"{samples}_{seed}.exr")
    cpu = sum(os.times()[:2])
    wall = cycles.render(bpy, scene, samples, seed, path)
    cpu = sum(os.times()[:2]) - cpu
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Linear"
    pixels = numpy.empty(image.size[0] * image.size[1] * 4, numpy.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return wall, cpu, pixels.reshape(-1, 4)[:, :3].astype(numpy.float64)


def measure_in_blender(scene_path, setup, out_path):
    import bpy
    import numpy

    with open(os.path.splitext(scene_path)[0] + ".json", encoding="utf-8") as file:
        sidecar = json.load(file) | {"bounces": setup["bounces"]}
    scene = cycles.load(bpy, sidecar, os.path.dirname(os.path.abspath(scene_path)), setup["srgb_filter"])
    with tempfile.TemporaryDirectory() as folder:
        render_once(bpy, scene, folder, 1, SEEDS)  # Loads the scene, which later renderings keep.
        few = [render_once(bpy, scene, folder, FEW, seed) for seed in range(SEEDS)]
        many = [render_once(bpy, scene, folder, setup["spp"], seed) for seed in range(SEEDS)]
    drawn = setup["width"] * setup["height"] * (setup["spp"] - FEW)
    slope = [min(m[i] for m in many) - min(f[i] for f in few) for i in (0, 1)]
    pixels = numpy.stack([m[2] for m in many])
    result = {
        "samples_per_s": drawn / slope[0],
        "samples_per_cpu_s": drawn / slope[1],
        "sample_variance": float(pixels.var(axis=0, ddof=1).mean() * setup["spp"]),
        "mean": float(pixels.mean()),
    }
    with open(out_path, "w", encoding="utf-8") as out:
        json.dump(result, out)


def measure_cycles(scene_path, setup):
    """What measure_in_blender() tells, from a process of Blender."""
    with tempfile.TemporaryDirectory() as folder:
        out_path, log_path = os.path.join(folder, "cycles.json"), os.path.join(folder, "log")
        with open(log_path, "w", encoding="utf-8") as log:
            done = subprocess.run(
                ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__, "--",
                 scene_path, json.dumps(setup), out_path],
                stdout=log, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            with open(log_path, encoding="utf-8", errors="replace") as log:
                sys.exit("Blender failed:\n" + log.read()[-2000:])
        with open(out_path, encoding="utf-8") as file:
            return json.load(file)


def compare(ours, theirs):
    """Prints a scene's numbers. Returns whether both rendered the same image, to the tolerance."""
    for key in ("mean", "sample_variance", "samples_per_s", "samples_per_cpu_s"):
        print(f"{key:18} Voxray {ours[key]:12.6g}   Cycles {theirs[key]:12.6g}   ratio {ours[key] / theirs[key]:.3f}")
    difference = ours["mean"] / theirs["mean"] - 1
    if abs(difference) > TOLERANCE:
        print(f"the means differ by {100 * difference:.1f} %: not the same image, so speeds can't be compared")
        return False
    for clock in ("samples_per_s", "samples_per_cpu_s"):
        ratio = ours[clock] / ours["sample_variance"] * theirs["sample_variance"] / theirs[clock]
        print(f"{clock} at equal variance: {ratio:.2f} times Cycles")
    return True


def main():
    filters_srgb = "--srgb-filter" in sys.argv
    folder, *wanted = (word for word in sys.argv[1:] if word != "--srgb-filter")
    with open(os.path.join(folder, "ours.json"), encoding="utf-8") as file:
        runs = [r for r in json.load(file)["benchmarks"] if r["name"].startswith("pathTraceRival/")]
    failed = [r["name"] for r in runs if r.get("error_occurred")]
    if failed or not runs:
        sys.exit(f"{folder}/ours.json: " + (f"{', '.join(failed)} failed" if failed else "no run of pathTraceRival"))
    missing = set(wanted) - {r["label"] for r in runs}
    if missing:
        sys.exit(f"{folder}/ours.json has no {', '.join(sorted(missing))}")
    agree = True
    for ours in runs:
        if wanted and ours["label"] not in wanted:
            continue
        setup = {key: int(ours[key]) for key in ("width", "height", "bounces", "spp")} | {"srgb_filter": filters_srgb}
        print(f"{ours['label']}, {setup['width']}x{setup['height']}, {setup['bounces']} bounces, {setup['spp']} spp")
        theirs = measure_cycles(os.path.join(folder, ours["label"] + ".glb"), setup)
        agree = compare(ours, theirs) and agree
    sys.exit(0 if agree else 1)


if __name__ == "__main__":
    if "--" in sys.argv:
        scene_path, setup, out_path = sys.argv[sys.argv.index("--") + 1:][:3]
        measure_in_blender(scene_path, json.loads(setup), out_path)
    else:
        main()
