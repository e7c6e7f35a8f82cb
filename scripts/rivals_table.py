#!/usr/bin/python3
"""Prints how much faster lookups, gather rays or virtual lights are than filtered path tracing at equal error, from results of
configs/bench/rivals_still_light.yaml, rivals_new_light.yaml or configs/papers/sun2015/rivals.yaml.

rivals_table.py DIR... [--best]: for each scene and number of samples a pixel, the frame time of path tracing (G-buffer,
paths, filter) and its errors of indirect light; then that time over the time in which voxels that are looked up, gather rays
into voxels, or gather rays into a radiance cache reach as small an nRMSE / relMSE: with light and geometry that stand still
(frames alone), with light that is new in each frame (what brings light counts, too), and with geometry that is new, too (all
that is built counts). Faces that gather rays hit are lit in each frame. Where surfaces move in the run itself, updates of the
scene and of what a variant reads are rows of the frame. Of many runs of a config, whose results are the same,
the least time of each pass counts, since a machine's speed drifts while a run lasts.
"rays alone" takes the G-buffer and the filter, which both sides share, off both sides: what the column before would come to
if these cost nothing. For virtual lights what samples and selects them counts. Of a method's
variants those count that no other one beats in time and error; between them the time is interpolated, logarithm over
logarithm.
`>` where the fastest of them already has less error, `-` where none has as little. Direct light is in neither.
With --best: the least error of each method in no more time than filtered path tracing takes to it.
"""
import math
import os
import re
import sys

sys.dont_write_bytecode = True
sys.path.append(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "framework"))
from report.ranking import log_cost_at, pareto_front  # noqa: E402
from report.rows import markdown_table, read_rows  # noqa: E402

LEFT_OUT = {"direct", "composite"}
SHARED = {"gbuffer", "indirect"}  # In variants with gather rays and with paths 'indirect' is the filter.
LIGHT = {"inject", "few_rays", "light", "inject_radiosity", "smooth_surfels", "update_radiance_cache", "update_probes",
         "screen_probe_light", "sample_vpls", "select_vpls"}
ERRORS = ("indirect_nrmse", "indirect_relmse")

# Of each column: its title, the id of a pass that its methods have, whether a build pass counts, and what does not count.
COLUMNS = (("looked up", "inject_radiosity", lambda name: False, LEFT_OUT),
           ("looked up, new light", "inject_radiosity", lambda name: name in LIGHT, LEFT_OUT),
           ("surfels, gathered", "surfel_rays", lambda name: False, LEFT_OUT),
           ("voxels", "gather_rays", lambda name: False, LEFT_OUT),
           ("voxels, rays alone", "gather_rays", lambda name: False, LEFT_OUT | SHARED),
           ("cones", "filter_voxels", lambda name: False, LEFT_OUT),
           ("cache", "cached_rays", lambda name: False, LEFT_OUT),
           ("voxels, new light", "gather_rays", lambda name: name in LIGHT, LEFT_OUT),
           ("cache, new light", "cached_rays", lambda name: name in LIGHT, LEFT_OUT),
           ("hit faces", "hit_face_rays", lambda name: False, LEFT_OUT),
           ("hit faces, rays alone", "hit_face_rays", lambda name: False, LEFT_OUT | SHARED),
           ("reservoirs, new light", "resampled_rays", lambda name: name in LIGHT, LEFT_OUT),
           ("voxels, new geometry", "gather_rays", lambda name: True, LEFT_OUT),
           ("probes", "update_probes", lambda name: False, LEFT_OUT),
           ("probes, new light", "update_probes", lambda name: name in LIGHT, LEFT_OUT),
           ("screen probes, new light", "screen_probe_light", lambda name: name in LIGHT, LEFT_OUT),
           ("virtual lights", "gather_vpls", lambda name: name in LIGHT, LEFT_OUT))


def variants(*folders):
    """By scene: (passes, result row) of each variant of the first run, with the least time of all runs for each pass."""
    times = {}
    for folder in folders:
        for row in read_rows(folder, "passes.csv"):
            times.setdefault((row["variant"], row["pass"], row["phase"]), []).append(float(row["ms_median"]))
    passes = {}
    for row in read_rows(folders[0], "passes.csv"):
        least = min(times[row["variant"], row["pass"], row["phase"]])
        passes.setdefault(row["variant"], []).append({**row, "ms_median": least})
    scenes = {}
    for row in read_rows(folders[0], "results.csv"):
        if row["status"] == "ok":
            scenes.setdefault(row["scene"], []).append((passes[row["variant"]], row))
    return scenes


def unread(passes):
    """Voxels of the graph that a variant has no use for: paths read none, variants with coarse ones read these alone."""
    names = {p["pass"] for p in passes}
    return {"voxelize"} if names & {"paths", "coarse"} else set()


def time_of(passes, counts_build, left_out):
    """Milliseconds a frame."""
    left_out = left_out | unread(passes)
    return sum(float(p["ms_median"]) for p in passes
               if p["pass"] not in left_out and (p["phase"] == "frame" or counts_build(p["pass"])))


def frame_time(passes):
    """Milliseconds of a frame of indirect light, without what is built."""
    return time_of(passes, lambda name: False, LEFT_OUT)


def front(points):
    """Of points (ms, error) those that no other one beats, from fast to slow."""
    return [points[i] for i in pareto_front(points)]


def time_to(error, points):
    """(ms in which a front reaches an error, ">" where its fastest point already has as little); None where none has."""
    if not points:
        return None
    times, errors = zip(*points)
    ms = math.exp(log_cost_at(error, times, errors))
    return None if math.isnan(ms) else (ms, ">" if errors[0] <= error else "")


def speed_up(ms, error, points):
    """How much longer `ms` is than what the points take to an error."""
    reached = time_to(error, points)
    return f"{reached[1]}{ms / reached[0]:.1f}" if reached else "-"


def samples_of(passes, row):
    """Samples a pixel of filtered path tracing, None for another method."""
    return int(re.search(r"^filtered paths, (\d+)$", row["indirect"])[1]) if any(p["pass"] == "paths" for p in passes) else None


def is_no_slower(ms, error, rivals):
    """Whether filtered path tracing takes at least `ms` to the error, or never gets there."""
    reached = time_to(error, rivals)
    return reached is None or ms <= reached[0]


def best(*folders):
    """Of each scene and method the variant of the least nRMSE among those that are no slower than filtered path tracing
    at the same nRMSE."""
    rows = []
    for scene, found in variants(*folders).items():
        rivals = front([(frame_time(passes), float(row["indirect_nrmse"]))
                        for passes, row in found if samples_of(passes, row)])
        for title, gather in (("looked up", "inject_radiosity"), ("voxels", "gather_rays"), ("cache", "cached_rays")):
            mine = [(float(row["indirect_nrmse"]), frame_time(passes), row)
                    for passes, row in found if any(p["pass"] == gather for p in passes)]
            fast = [entry for entry in mine if is_no_slower(entry[1], entry[0], rivals)]
            if mine and not fast:
                rows.append([scene, title, "none", "", ""])
            elif fast:
                error, ms, row = min(fast, key=lambda entry: entry[:2])
                scores = f"{error:.3f} / {float(row['indirect_relmse']):.4f} / {float(row['indirect_mean_ratio']):.3f}"
                rows.append([scene, title, row["indirect"], f"{ms:.0f}", scores])
    return markdown_table(["scene", "method", "variant", "ms", "nRMSE / relMSE / mean ratio"], rows)


def table(*folders):
    scenes = variants(*folders)
    present = {p["pass"] for found in scenes.values() for passes, _ in found for p in passes}
    columns = [column for column in COLUMNS if column[1] in present]
    rows = []
    for scene, found in scenes.items():
        fronts = {}
        for title, gather, counts_build, left_out in columns:
            mine = [(passes, row) for passes, row in found if any(p["pass"] == gather for p in passes)]
            for name in ERRORS:
                fronts[title, name] = front([(time_of(passes, counts_build, left_out), float(row[name]))
                                             for passes, row in mine])
        for passes, row in found:
            samples = samples_of(passes, row)
            if samples is None:
                continue
            ms = frame_time(passes)
            cells = [" / ".join(speed_up(time_of(passes, lambda name: False, left_out), float(row[name]), fronts[title, name])
                                for name in ERRORS)
                     for title, _, _, left_out in columns]
            errors = " / ".join(f"{float(row[name]):.3f}" for name in ERRORS)
            rows.append([scene, str(samples), f"{ms:.0f}", errors, *cells])
    return markdown_table(["scene", "spp", "ms", "nRMSE / relMSE", *(title for title, *_ in columns)], rows)


if __name__ == "__main__":
    runs = [argument for argument in sys.argv[1:] if argument != "--best"]
    if not runs:
        sys.exit("rivals_table.py DIR... [--best]")
    print("\n".join((best if "--best" in sys.argv else table)(*runs)))
