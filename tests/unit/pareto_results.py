"""Makes up a results folder as configs/compare.yaml leaves it: 41 variants of 16 methods in each of seven scenes.

As a program: pareto_results.py DIR [VARIANTS], of one scene with so many variants."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import report_results as made_up

SCENES = ("cornell", "sponza", "window_room", "living_room", "conference", "mirror_room", "moving")
_RAYS = ("inject_light_rays", "trace_gather_rays", "gather_rays", "filter_irradiance")
# Chain of passes; cost of a frame, of its light and of the rest of the build in ms; largest and least error; the names' ends
METHODS = {
    "lookup, links": (("place_surfels", "link_surfels", "inject_radiosity", "gather_irradiance"), 3, 30, 900, 0.22, 0.20, [""]),
    "surfels": (("place_surfels", "link_surfels", "inject_radiosity", "smooth_surfels", "gather_surfels"), 5, 35, 900, 0.12, 0.11, [""]),
    "lookup": (("inject_light_rays", "gather_irradiance"), 2, 60, 20, 0.4, 0.15, [", 64 k rays", ", 1 M rays", ", 4 M rays"]),
    "rays": (_RAYS, 6, 200, 20, 0.25, 0.03, [", few, 1 a pixel", ", few, 4 a pixel", *(f", {n} a pixel" for n in (1, 4, 16, 64))]),
    "merged": (("merge_voxels", *_RAYS), 7, 260, 90, 0.16, 0.08, [", 4 a pixel", ", 16 a pixel"]),
    **{f"cones, {name}": (("inject_light_rays", f"filter_voxels {layout}", "gather_cones"), ms, 180, 30, 0.35, 0.3, [", 6", ", 16"])
       for name, layout, ms in (("dense", "dense", 30), ("octree", "svo", 60), ("clipmap", "clipmap", 40))},
    "vpls": (("sample_vpls", "gather_vpls", "filter_irradiance"), 40, 1, 1, 0.3, 0.2, [", 256", ", 1024"]),
    "vpls, 512 of 16 k": (("sample_vpls", "select_vpls", "gather_vpls", "filter_irradiance"), 30, 15, 1, 0.17, 0.16, [""]),
    "clusters": (("place_surfels", "cluster_voxels", "inject_clusters", "gather_clusters", "gather_irradiance"), 3, 8, 2500, 0.35, 0.28, [", 1000", ", 4000"]),
    "mirrors, exact": ((*_RAYS, "gather_mirror"), 12, 200, 20, 0.13, 0.12, [""]),
    "mirrors, hybrid": ((*_RAYS, "build_hybrid_leaves", "gather_mirror"), 14, 200, 60, 0.14, 0.13, [""]),
    "cache": (("update_radiance_cache", *_RAYS[1:]), 9, 50, 1, 0.28, 0.07, [", 1 a pixel", ", 16 a pixel", ", each frame, 1 a pixel"]),
    "paths": (("path_trace",), 4, 0, 0, 1.6, 0.05, [f", {4**n}" for n in range(6)]),
    "filtered paths": (("path_trace", "filter_irradiance"), 6, 0, 0, 0.5, 0.03, [f", {4**n}" for n in range(6)]),
}


def graph(chain: tuple[str, ...], spp: int = 0) -> list[dict]:
    entries = [{"pass": "gbuffer"}, {"pass": "voxelize", "resolution": 64}]
    for name in chain:
        kind, _, layout = name.partition(" ")
        entries.append({"pass": kind, **({"layout": layout} if layout else {}), **({"spp": spp} if kind == "path_trace" else {})})
    return [*entries, {"pass": "composite"}]


def write(directory: Path, scenes=SCENES, copies: int = 1, images: bool = True, size=(320, 180)) -> Path:
    """@param copies of each variant, with other numbers and a sweep key `seed`"""
    random = np.random.default_rng(5)
    rows, passes, graphs = [], [], {}
    for s, scene in enumerate(scenes):
        for method, (chain, frame, light, build, most, least, ends) in METHODS.items():
            speed, accuracy, bright = 2 ** random.normal(0, 0.7), 2 ** random.normal(0, 0.3), 2 ** random.normal(0, 0.5)
            for copy in range(copies):
                luck = 2 ** random.normal(0, 0.4, 2) if copies > 1 else np.ones(2)
                for i, end in enumerate(ends):
                    name = ", ".join([scene, method + end, *([f"seed {copy}"] if copies > 1 else [])])
                    variant = name.replace(", ", "-").replace(" ", "-")
                    ms = frame * 3.2**i / speed * (1 + s / 3) * luck[0]
                    error = most * (least / most) ** (i / max(1, len(ends) - 1)) / accuracy * luck[1]
                    row = made_up.variant(variant, ms, error, error, name=name, scene=scene, **({"seed": str(copy)} if copies > 1 else {}))
                    row |= {"indirect": method + end, "build_ms": (build + light * (1 + i)) / 4, "memory_bytes": 2**20 * (8 + build / 10 + 3 * light**0.5)}
                    row["indirect_relmse"] *= bright
                    for key in ("nrmse", "relmse"):
                        row |= made_up.spread(f"indirect_{key}", 0.93 * row[f"indirect_{key}"], 1.07 * row[f"indirect_{key}"])
                    rows.append(row)
                    graphs[variant] = graph(chain, 4**i)
                    passes += [{"variant": variant, "pass": kind, "phase": "build", "ms_median": part / 4, "voxel_steps": 0}
                               for kind, part in (("voxelize", build), ("inject_light_rays", light * (1 + i)))]
                    passes.append({"variant": variant, "pass": "gather_rays", "phase": "frame", "ms_median": ms, "voxel_steps": 100 * ms})
    run = made_up.manifest(["scene", "indirect", *(["seed"] if copies > 1 else [])])
    run["config"]["name"] = "compare"
    run["variants"] = graphs
    run["references"] = [{"hash": scene, "folder": f"reference.{scene}", "variants": [row["variant"] for row in rows if row["scene"] == scene]}
                         for scene in scenes]
    made_up.write_results(directory, rows, run, images=False)
    made_up.write_csv(directory / "passes.csv", list(passes[0]), passes)
    for folder, error in [(f"reference.{scene}", 0.0) for scene in scenes] + [(row["variant"], row["indirect_nrmse"]) for row in rows] if images else []:
        made_up.save_image(directory / "images" / folder / "indirect.png", error, size)
        if not folder.startswith("reference"):
            made_up.save_image(directory / "images" / folder / "indirect_flip.png", error, size, grey=True)
    return directory


if __name__ == "__main__":
    if len(sys.argv) > 2:
        write(Path(sys.argv[1]), SCENES[:1], -(-int(sys.argv[2]) // 41), images=False)
    else:
        write(Path(sys.argv[1]))
