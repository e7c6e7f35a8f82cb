"""Makes up result folders as a run would leave them. As a program, it writes one: report_results.py DIR."""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from exr_writer import exr

METRICS = [{"name": name, "label": label, "unit": unit, "better": better, "meaning": f"what {label} measures",
            "interval": name in ("nrmse", "relmse")}
           for name, label, unit, better in (
               ("nrmse", "nRMSE", "", "low"), ("relmse", "relMSE", "", "low"), ("flip", "HDR-FLIP", "", "low"),
               ("flip_ldr", "LDR-FLIP", "", "low"), ("ssim", "SSIM", "", "high"), ("psnr_db", "PSNR", "dB", "high"),
               ("mean_ratio", "mean ratio", "", "one"))]
SEED_METRICS = [{"name": name, "label": label, "unit": "", "better": "low", "meaning": f"what {label} measures",
                 "interval": True} for name, label in (("bias_nrmse", "bias"), ("noise_nrmse", "noise"))]
TEMPORAL_METRICS = [{"name": name, "label": label, "unit": "", "better": "low", "meaning": f"what {label} measures",
                     "interval": True}
                    for name, label in (("temporal_nrmse", "temporal nRMSE"), ("temporal_bias", "temporal bias"),
                                        ("temporal_flicker", "flicker"))]
SCORES = tuple(metric["name"] for metric in METRICS)
COSTS = ("build_ms", "frame_ms_median", "frame_ms_p05", "frame_ms_p95", "memory_bytes", "peak_bytes", "rays")
SIZE = (64, 36)


def scores(error: float) -> dict[str, float]:
    """Scores that all worsen with `error`."""
    return {"flip": 0.5 * error, "ssim": 1 - 0.5 * error, "psnr_db": 30 - 20 * error, "nrmse": error,
            "relmse": error * error, "mean_ratio": 1 - 0.1 * error, "flip_ldr": 0.4 * error}


def spread(column: str, low: float, high: float) -> dict[str, float]:
    """The ends of a score's interval."""
    return {f"{column}_low": low, f"{column}_high": high}


def variant(id: str, frame_ms: float, error: float, indirect: float | None = None, **sweep) -> dict:
    """A row of results.csv of a finished variant; `indirect` is its error in the indirect light."""
    row = {"variant": id, "status": "ok", "error": "", "device": "llvmpipe", "tracer": "embree", **sweep,
           "build_ms": 2 * frame_ms, "frame_ms_median": frame_ms, "frame_ms_p05": 0.95 * frame_ms,
           "frame_ms_p95": 1.05 * frame_ms, "memory_bytes": 2**24 * frame_ms,
           "peak_bytes": 2**25 * frame_ms, "rays": 262144, **scores(error)}
    if indirect is not None:
        row.update({f"indirect_{key}": value for key, value in scores(indirect).items()})
    return row


def failed(id: str, error: str, **sweep) -> dict:
    """A row of results.csv of a failed variant."""
    return {"variant": id, "status": "failed", "error": error, "device": "llvmpipe", "tracer": "embree",
            **sweep}


def with_sequence(rows: list[dict], frames: int) -> list[dict]:
    """Adds temporal errors to rows of results.csv. @return rows of frames.csv."""
    table = []
    for row in rows:
        error = row["nrmse"]
        row.update({"temporal_nrmse": error / 2, "temporal_bias": error / 10, "temporal_flicker": error * 0.49,
                    **spread("temporal_nrmse", 0.4 * error, 0.6 * error)})
        for frame in range(frames):
            table.append({"variant": row["variant"], "frame": frame, **scores(error * (1 + 0.1 * frame)),
                          "temporal_nrmse": error / 2 if frame else ""})
    return table


def manifest(sweep_keys: list[str]) -> dict:
    """The manifest of a finished run."""
    baselines = {name: {**scores(error), **{f"indirect_{k}": v for k, v in scores(error * 1.2).items()}}
                 for name, error in (("black", 1.6), ("constant", 0.9))}
    return {"voxray_version": "0.1.0", "commit": "a042f5e", "started": "2026-01-01T10:00:00Z",
            "finished": "2026-01-01T10:03:00Z", "device": "llvmpipe", "driver": "Mesa 25.0",
            "tracer": "embree", "validation": False, "sweep_keys": sweep_keys, "seed": 7,
            "config": {"name": "synthetic", "scene": {"file": "cornell", "lights": [{"point": [0, 1, 0]}]},
                       "graph": [{"pass": "gbuffer"}, {"pass": "voxelize", "resolution": 64}]},
            "image": {"width": SIZE[0], "height": SIZE[1]}, "exposure_stops": 0.0,
            "metrics": METRICS, "seed_metrics": SEED_METRICS, "temporal_metrics": TEMPORAL_METRICS, "flip_exposures": {"start": -2.0, "stop": 3.0, "count": 5},
            "reference": {"pass": "path_trace", "spp": 64, "seconds": 12.5, "cached": False,
                          "hash": "0123abcd", "flip_noise": 0.01, "ssim_noise": 0.98,
                          "indirect_flip_noise": 0.02},
            "light_independent": ["voxelize", "place_surfels", "link_surfels", "cluster_voxels", "build_hybrid_leaves"],
            "baselines": baselines, "auto": {"tracer": "embree"}, "warnings": [],
            "versions": {"glslang": "15"}, "machine": {"cpu": "a CPU", "cores": 2}}


def passes(rows: list[dict]) -> list[dict]:
    """Rows of passes.csv that add up to nearly the whole time of each finished variant."""
    parts = (("voxelize", "build", 0.7), ("inject", "build", 0.28), ("gbuffer", "frame", 0.2),
             ("gather", "frame", 0.7), ("composite", "frame", 0.05))
    table = []
    for row in rows:
        for name, phase, fraction in parts if row["status"] == "ok" else ():
            ms = fraction * row["build_ms" if phase == "build" else "frame_ms_median"]
            table.append({"variant": row["variant"], "pass": name, "phase": phase, "ms_median": ms,
                          "ms_p05": 0.9 * ms, "ms_p95": 1.1 * ms, "rays": 1000, "voxel_steps": 0,
                          "memory_bytes": 2**20, "scratch_bytes": 2**19, "dispatches": 3, "host_waits": 1, "host_bytes": 2**10})
    return table


def sphere(error: float, size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """A picture of a lit sphere, the further from right the larger `error`, and the right one."""
    x, y = np.meshgrid(np.linspace(-1.8, 1.8, size[0]), np.linspace(-1, 1, size[1]))
    z = np.sqrt(np.clip(0.6 - x * x - y * y, 0, None))
    right = np.stack([0.2 + z, 0.2 + 0.5 * z + 0.1 * x, 0.4 - 0.3 * y], axis=-1)
    return right + error * np.sin(12 * x)[..., None] * 0.3, right


def radiance(error: float, size: tuple[int, int]) -> np.ndarray:
    """The sphere in a light of up to 50, in the shadow some thousandths of it."""
    return (60 * sphere(error, size)[0].clip(0, None) ** 4).astype(np.float32)


def save_image(path: Path, error: float, size: tuple[int, int], grey: bool = False) -> None:
    """The sphere as PNG, or the grey map of its error."""
    path.parent.mkdir(parents=True, exist_ok=True)
    test, right = sphere(error, size)
    pixels = np.abs(test - right).mean(axis=-1) if grey else test
    Image.fromarray((pixels.clip(0, 1) * 255).astype(np.uint8)).save(path)


def write_results(directory: Path, rows: list[dict], run: dict, *, reference: bool = True,
                  indirect: bool = True, images: bool = True, floats: bool = False,
                  size: tuple[int, int] = SIZE) -> Path:
    """Writes a results folder; `run` is its manifest. `floats`: with EXR files of radiance()."""
    rows = [{"name": row["variant"], **row} for row in rows]
    text = ("variant", "name", "status", "error", "device", "tracer")
    numbers = [*COSTS, *SCORES, *(f"indirect_{key}" for key in SCORES)]
    ends = ("_low", "_high")
    numbers += [key for row in rows[:1] for key in row
                if "@" in key or key.startswith(("temporal_", "bias_", "noise_")) or (key.endswith(ends) and key not in numbers)]
    sweep = [key for row in rows[:1] for key in row if key not in (*text, *numbers)]
    columns = [*text, *sweep, *numbers]
    directory.mkdir(parents=True, exist_ok=True)
    write_csv(directory / "results.csv", columns, rows)
    write_csv(directory / "passes.csv", ["variant", "pass", "phase", "ms_median", "ms_p05", "ms_p95", "rays",
                                          "voxel_steps", "memory_bytes", "scratch_bytes", "dispatches", "host_waits", "host_bytes"], passes(rows))
    (directory / "manifest.json").write_text(json.dumps(run), encoding="utf-8")

    folders = [("reference", 0.0)] * reference
    folders += [(row["variant"], row["nrmse"]) for row in rows if row["status"] == "ok"]
    for folder, error in folders if images else []:
        for name in ("final", "indirect") if indirect else ("final",):
            save_image(directory / "images" / folder / f"{name}.png", error, size)
            if floats:
                (directory / "images" / folder / f"{name}.exr").write_bytes(exr(radiance(error, size), zipped=True))
        for name in (("flip", "indirect_flip") if indirect else ("flip",)) if folder != "reference" else ():
            save_image(directory / "images" / folder / f"{name}.png", error, size, grey=True)
    return directory


def write_csv(path: Path, columns: list[str], rows: list[dict]) -> None:
    with path.open("w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, columns, restval="")
        writer.writeheader()
        writer.writerows(rows)


def sweep_of_two_keys() -> list[dict]:
    """Six variants, two of them tied, one worse than a constant image, and a failed one."""
    table = ((64, "light_rays", 12.0, 0.62, 0.95), (128, "light_rays", 21.0, 0.35, 0.50),
             (256, "light_rays", 60.0, 0.211, 0.300), (64, "rsm", 9.0, 0.70, 1.3),
             (128, "rsm", 16.0, 0.44, 0.61), (256, "rsm", 44.0, 0.217, 0.310))
    rows = [variant(f"{inject}-{resolution}", ms, error, indirect, **{"name": f"resolution {resolution}, {inject}",
                    "voxelize.resolution": resolution, "inject": inject}) for resolution, inject, ms, error, indirect in table]
    for row in rows:
        for light in ("", "indirect_"):
            row.update(spread(f"{light}nrmse", 0.97 * row[f"{light}nrmse"], 1.03 * row[f"{light}nrmse"]))
    error = "pass 'voxelize': needs 34.4 GiB, the device has 7.7 GiB; lower resolution"
    return rows + [failed("rsm-2048", error, **{"name": "resolution 2048, rsm", "voxelize.resolution": 2048, "inject": "rsm"})]


if __name__ == "__main__":
    print(write_results(Path(sys.argv[1]), sweep_of_two_keys(), manifest(["voxelize.resolution", "inject"]),
                        size=(320, 180)))
