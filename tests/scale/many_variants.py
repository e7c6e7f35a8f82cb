#!/usr/bin/python3
"""How long planning and merging take with many variants: many_variants.py PROGRAM [--variants N] [--out DIR].

Times `validate`, `jobs`, one `run --part` and `merge` with its report of a sweep of a tiny config. One variant is rendered; the
others' results are copies of it under their own names and sweep values. Prints seconds, those of the CPU, and the page's size."""
import argparse
import json
import os
import resource
import shutil
import subprocess
import time

CONFIG = """\
name: many
scene: {{builtin: cornell}}
image: {{width: 32, height: 18}}
graph:
  - {{pass: gbuffer}}
  - {{pass: voxelize, resolution: 16}}
  - {{pass: inject_light_rays, id: inject, rays_per_light: 1024, bounces: 1}}
  - {{pass: direct_shadow_rays}}
  - {{pass: gather_irradiance}}
  - {{pass: composite}}
reference: {{pass: path_trace, spp: 8, bounces: 2}}
sweep:
  inject.rays_per_light: [{rays}]
  voxelize.resolution: [8, 16, 24, 32]
measure: {{frames: 1, warmup: 0}}
"""
RESOLUTIONS = 4


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--variants", type=int, default=10000)
    parser.add_argument("--out", default="many_variants")
    options = parser.parse_args()
    program, folder = os.path.abspath(options.program), os.path.abspath(options.out)
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    with open(os.path.join(folder, "many.yaml"), "w", encoding="utf-8") as file:
        file.write(CONFIG.format(rays=", ".join(str(256 + i) for i in range(options.variants // RESOLUTIONS))))

    def timed(*arguments):
        began, worked = time.monotonic(), cpu_seconds()
        done = subprocess.run([program, *arguments], cwd=folder, check=True, capture_output=True, text=True)
        print(f"{arguments[0]:10} {' '.join(arguments[1:])[:60]:60} {time.monotonic() - began:7.1f} s, "
              f"{cpu_seconds() - worked:7.1f} s of CPU", flush=True)
        return done.stdout

    timed("validate", "many.yaml")
    jobs = json.loads(timed("jobs", "many.yaml", "--json"))["jobs"]
    for job in [job for job in jobs if job["kind"] == "reference"] + [job for job in jobs if job["kind"] == "variant"][:1]:
        timed("run", "many.yaml", "--part", job["id"], "--out", "out")
    copy_results(os.path.join(folder, "out", "images"), [job["id"].removeprefix("variant.") for job in jobs if job["kind"] == "variant"])
    timed("merge", "out", "--out", "out")
    print(f"report.html: {os.path.getsize(os.path.join(folder, 'out', 'report.html')) / 1e6:.1f} MB")


def cpu_seconds():
    """Of all processes that ended, user and system: what a busy machine changes least."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def copy_results(images, names):
    """Gives the first name's result to all others."""
    with open(os.path.join(images, names[0], "result.json"), encoding="utf-8") as file:
        first = json.load(file)
    for name in names[1:]:
        shutil.copytree(os.path.join(images, names[0]), os.path.join(images, name))
        rays, resolution = name.split("-")[1::2]
        result = dict(first, variant=name, name=f"rays_per_light {rays}, resolution {resolution}", sweep_values=[rays, resolution], frame_ms=[x * (1 + int(rays) / 256) for x in first["frame_ms"]])
        with open(os.path.join(images, name, "result.json"), "w", encoding="utf-8") as file:
            json.dump(result, file)


if __name__ == "__main__":
    main()
