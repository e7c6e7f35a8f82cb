#!/usr/bin/python3
"""Measures how time and memory grow with the size of the work. `./voxray bench growth` builds and calls it.

Writes configs into DIR, runs the built program on them one after another, and leaves growth.csv (each number measured) and growth.png
(log-log, exponents in its legend). Exponents are slopes of least-squares lines in log-log. Targets are told, never enforced.

Exit status: 0 all is measured, 1 a run failed, 2 a wrong argument.
"""
import argparse
import base64
import csv
import json
import math
import shutil
import struct
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path.append(str(ROOT / "framework"))
from report.rows import markdown_table, read_rows  # noqa: E402

TARGETS = {("triangles", "gather_irradiance ms"): 0.05, ("triangles", "gather_cones ms"): 0.05, ("triangles", "build ms"): 1.05,
           ("voxels", "voxelize bytes"): 1.05, ("pixels", "frame ms"): 1.02,
           ("lights", "direct light, equal nRMSE ms"): 0.15, ("lights", "path_trace, equal nRMSE ms"): 0.15}
SIZES = {  # quick, usual
    "triangles": ([10_000, 100_000], [10_000, 100_000, 300_000, 1_000_000]),
    "voxels": ([32, 64, 128], [64, 128, 256]),
    "pixels": ([(160, 90), (320, 180), (640, 360)], [(160, 90), (320, 180), (640, 360), (1280, 720), (1920, 1080)]),
    "lights": ([10, 100], [10, 100, 1000, 10_000]),
    "rays": ([10_000, 100_000, 1_000_000], [10_000, 100_000, 1_000_000, 10_000_000]),
    "variants": ([10, 100], [10, 100, 1000]),
}
SPHERES = 8
EQUAL_NRMSE = 0.1  # Costs of lights are times at this error: an error of twice that takes four times as many samples.


def exponent(points):
    """Slope of the least-squares line through (log x, log y); None where fewer than two sizes have a positive value."""
    logs = [(math.log(x), math.log(y)) for x, y in points if x > 0 and y > 0]
    if len({x for x, _ in logs}) < 2:
        return None
    mean_x, mean_y = (sum(values) / len(logs) for values in zip(*logs))
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)


def series(rows):
    """Points of each (axis, measure) of rows (axis, size, measure, value), in order."""
    found = {}
    for axis, size, measure, value in rows:
        found.setdefault((axis, measure), []).append((size, value))
    return found


def table(rows):
    """Markdown: a row for each measure, its exponent and target."""
    found = []
    for (axis, measure), points in series(rows).items():
        slope, target = exponent(points), TARGETS.get((axis, measure))
        ends = [f"{value:.4g} at {size:,}" for size, value in (min(points), max(points))]
        found.append((axis, measure, *ends, "" if slope is None else f"{slope:.2f}", "" if target is None else f"at most {target:g}"))
    return "\n".join(markdown_table(("axis", "measure", "smallest", "largest", "exponent", "target"), found))


def sphere(path, triangles):
    """Writes a glTF file of a sphere of radius 1 with about `triangles` of them, and returns how many it has."""
    rings = max(3, round(math.sqrt(triangles / 4)) + 1)
    slices = 2 * rings
    points, indices = bytearray(), []
    for i in range(rings + 1):
        for j in range(slices + 1):
            a, b = math.pi * i / rings, 2 * math.pi * j / slices
            points += struct.pack("<3f", math.sin(a) * math.cos(b), math.cos(a), math.sin(a) * math.sin(b))
    for i in range(rings):
        for j in range(slices):
            p, q = i * (slices + 1) + j, (i + 1) * (slices + 1) + j
            # Quads at the poles are triangles
            indices += [p, q + 1, q] if i == 0 else [p, p + 1, q] if i == rings - 1 else [p, p + 1, q + 1, p, q + 1, q]
    data = bytes(points) + struct.pack(f"<{len(indices)}I", *indices)
    count = len(points) // 12
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": len(points)}, {"buffer": 0, "byteOffset": len(points), "byteLength": 4 * len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}]}))
    return len(indices) // 3


def config(axis, size, out):
    """The config of one size as data (JSON is YAML), and the size as measured."""
    scene, image, voxels, rays = {"builtin": "cornell", "boxes": False, "lights": "spot"}, (160, 90), 64, 65536
    extra = {}
    if axis == "triangles":
        mesh = out / f"sphere{size}.gltf"
        size = SPHERES * sphere(mesh, size / SPHERES)
        scene["add"] = [{"file": str(mesh), "transform": {"translate": [x, y, z], "scale": 0.25}}
                        for x in (-0.5, 0.5) for y in (0.5, 1.4) for z in (-0.5, 0.5)]
    elif axis == "voxels":
        scene, voxels = {"file": "sponza.glb", "lights": [{"directional": [-0.12, -1, -0.08], "irradiance": [10, 10, 10]}],
                         "camera": {"position": [-8, 2, 0], "target": [0, 2, 0], "fov_deg": 60}}, size
    elif axis == "pixels":
        image, size = size, size[0] * size[1]
    elif axis == "lights":  # A hall of lamps of the same power, whatever their number; all are sampled. Points: no image of lamps.
        return {"name": f"lights_{size}", "scene": {"builtin": "lamps", "kind": "point", "count": size}, "image": {"width": 160, "height": 90}, "seed": 7,
                "reference": {"pass": "path_trace", "spp": 1024, "bounces": 0},
                "graph": [{"pass": "path_trace", "id": "chain", "bounces": 0}],
                "sweep": {"chain": {
                    "path_trace": {"pass": "path_trace", "spp": 16, "bounces": 0},
                    "direct light": [{"pass": "gbuffer", "samples_per_pixel_edge": 4},
                                     {"pass": "direct_shadow_rays", "light_samples": 1, "exact_lights": 0}, "composite"]}},
                "measure": {"frames": 3, "warmup": 1}}, size
    elif axis == "rays":
        rays = size
    elif axis == "variants":
        extra["sweep"] = {"inject.rays_per_light": list(range(1, size + 1))}
    graph = [{"pass": "gbuffer"}, {"pass": "voxelize", "resolution": voxels},
             {"pass": "inject_light_rays", "id": "inject", "rays_per_light": rays, "bounces": 3},
             {"pass": "direct_shadow_rays", "id": "direct"}]
    if axis == "voxels":  # counts surface voxels
        graph += [{"pass": "compare_voxels", "inputs": {"truth": "voxelize.voxels", "voxels": "voxelize.voxels"}}]
    if axis == "triangles":  # A pass whose output nobody reads does not run: so each gather is a variant.
        graph += [{"pass": "composite", "id": "chain"}]
        extra["sweep"] = {"chain": {
            "lookup": ["gather_irradiance", "composite"],
            "cones": ["filter_voxels", {"pass": "gather_cones", "cones": 6, "stride": 4, "specular": 0, "visibility": "voxels"}, "composite"],
            "rays": [{"pass": "trace_gather_rays", "rays_per_block": 16, "block": 8}, "gather_rays", "filter_irradiance", "composite"]}}
    else:
        graph += [{"pass": "gather_irradiance"}, {"pass": "composite"}]
    return {"name": f"{axis}_{size}", "scene": scene, "image": {"width": image[0], "height": image[1]}, "seed": 7, "graph": graph,
            "measure": {"frames": 3, "warmup": 1}, **extra}, size


def measures(axis, size, folder):
    """Rows (axis, size, measure, value) of a run: whole times and memory of its first variant, and the time of each pass in the
    first variant that has it."""
    results, passes = read_rows(folder, "results.csv"), read_rows(folder, "passes.csv")
    for failed in (row for row in results if row["status"] != "ok"):
        raise RuntimeError(failed["error"])
    if axis == "lights":
        return light_costs(size, results, passes)
    result = results[0]
    if axis == "voxels":
        size = next(int(float(row["value"])) for row in read_rows(folder, "values.csv") if row["name"] == "voxels")
    timed = {}
    for row in passes:
        if row["pass"] != "compare_voxels":
            timed.setdefault(row["pass"], row)
    passes = [row for row in passes if row["variant"] == result["variant"] and row["pass"] != "compare_voxels"]
    rows = [(axis, size, "build ms", float(result["build_ms"])), (axis, size, "frame ms", float(result["frame_ms_median"])),
            (axis, size, "memory bytes", sum(float(row["memory_bytes"]) for row in passes)),
            (axis, size, "scratch bytes", max(float(row["scratch_bytes"]) for row in passes))]
    # What a surface voxel takes; images and light rays don't grow with them.
    rows += [(axis, size, "voxelize bytes", float(timed["voxelize"]["memory_bytes"]))]
    return rows + [(axis, size, f"{row['pass']} ms", float(row["ms_median"])) for row in timed.values()]


def light_costs(size, results, passes):
    """Rows of each method: time of a frame without the G-buffer, error, and time at EQUAL_NRMSE."""
    rows = []
    for result in results:
        gbuffer = sum(float(row["ms_median"]) for row in passes if row["variant"] == result["variant"] and row["pass"] == "gbuffer")
        name, nrmse, ms = result["chain"], float(result["nrmse"]), float(result["frame_ms_median"]) - gbuffer
        rows += [("lights", size, f"{name} ms", ms), ("lights", size, f"{name} nRMSE", nrmse),
                 ("lights", size, f"{name}, equal nRMSE ms", ms * (nrmse / EQUAL_NRMSE) ** 2)]
    return rows


def measure(axis, size, options):
    data, size = config(axis, size, options.out)
    path = options.out / f"{data['name']}.yaml"
    path.write_text(json.dumps(data, indent=1))
    shutil.rmtree(options.out / data["name"], ignore_errors=True)
    scenes = ["--scenes", str(options.scenes)] if options.scenes else []
    commands = {"validate": ["validate", str(path)], "jobs": ["jobs", str(path)]} if axis == "variants" else {
        "run": ["run", str(path), "--out", str(options.out / data["name"])]}
    rows = []
    for name, words in commands.items():
        began = time.monotonic()
        done = subprocess.run([str(options.program), *words, *scenes], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(done.stderr.strip()[-500:])
        rows.append((axis, size, f"{name} ms", 1000 * (time.monotonic() - began)))
    return rows if axis == "variants" else measures(axis, size, options.out / data["name"])


def chart(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    found = {key: points for key, points in series(rows).items() if key[1].endswith("ms") or key in TARGETS}
    axes = list(dict.fromkeys(axis for axis, _ in found))
    columns = min(3, len(axes))
    figure, panels = pyplot.subplots(-(-len(axes) // columns), columns, figsize=(7 * columns, 5 * -(-len(axes) // columns)), squeeze=False)
    for panel in panels.flat[len(axes):]:
        panel.axis("off")
    for panel, axis in zip(panels.flat, axes):
        panel.set_prop_cycle(color=pyplot.get_cmap("tab20").colors)
        for (_, measure), points in ((key, points) for key, points in found.items() if key[0] == axis):
            slope = exponent(points)
            panel.loglog(*zip(*sorted(points)), "o--" if measure.endswith("bytes") else "o-",
                         label=measure if slope is None else f"{measure}: {slope:.2f}")
        panel.set(xlabel=axis, ylabel="ms; dashed: bytes")
        panel.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1, 1))
    figure.tight_layout()
    figure.savefig(path, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(prog="voxray bench growth", description="How time and memory grow with the size of the work.")
    parser.add_argument("--axis", nargs="+", default=list(SIZES), choices=list(SIZES), metavar="NAME", help=", ".join(SIZES))
    parser.add_argument("--quick", action="store_true", help="small sizes")
    parser.add_argument("--full", action="store_true", help="ten million triangles, too")
    parser.add_argument("--out", type=Path, default=Path("results/growth"), metavar="DIR", help="default results/growth")
    parser.add_argument("--scenes", type=Path, metavar="DIR", help="folder in which scene files are looked for first")
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/bin/voxray", metavar="PATH", help="the built voxray")
    options = parser.parse_args()
    options.out = options.out.resolve()
    options.out.mkdir(parents=True, exist_ok=True)
    rows, failed = [], False
    for axis in options.axis:
        for size in SIZES[axis][not options.quick] + ([10_000_000] if options.full and axis == "triangles" else []):
            try:
                rows += measure(axis, size, options)
                print(f"{axis} {size}: done", file=sys.stderr, flush=True)
            except (RuntimeError, OSError) as error:
                failed = True
                print(f"{axis} {size}: {error}", file=sys.stderr, flush=True)
            with open(options.out / "growth.csv", "w", encoding="utf-8", newline="") as file:
                csv.writer(file).writerows([("axis", "size", "measure", "value"), *rows])
    print(table(rows))
    if rows:
        chart(rows, options.out / "growth.png")
        print(options.out / "growth.png")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
