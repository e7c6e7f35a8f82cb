# %% [markdown]
# # Memory of the octree
#
# Bytes against surface voxels of Sponza: an octree grows with its surface, so its points lie along a straight line
# through the origin, where a full grid grows with the space. Measure first, then run this cell by cell in an editor that
# knows `# %%`, or whole:
#
#     ./voxray bench octreeBuild    # builds the program
#     build/release/tests/bench/bench_octree --benchmark_filter=octreeBuild --benchmark_out=octree.json
#     /usr/bin/python3 notebooks/octree_memory.py octree.json [chart.png]

# %%
import json
import sys
from pathlib import Path

import matplotlib
import pandas as pd

arguments = [a for a in sys.argv[1:] if not a.startswith("-")] if "__file__" in globals() else []
measured = Path(arguments[0] if arguments else "octree.json")
picture = Path(arguments[1]) if len(arguments) > 1 else None
if picture:
    matplotlib.use("Agg")  # no display is needed to write a file
import matplotlib.pyplot as plt  # noqa: E402

# %% [markdown]
# ## The table
# A benchmark's name holds what it was given: `octreeBuild/resolution:64/directions:1/...`.

# %%
runs = pd.DataFrame(json.loads(measured.read_text(encoding="utf-8"))["benchmarks"])
for key in ("resolution", "directions"):
    runs[key] = runs["name"].str.extract(rf"{key}:(\d+)").astype(int)
print(runs[["resolution", "directions", "voxels", "MB", "bytes_per_voxel"]].to_string(index=False))

# %% [markdown]
# ## Bytes against surface voxels
# The dashed lines are what a full grid with all its levels takes at the same resolution, in the shape of Sponza's box:
# 8 bytes a value.

# %%
figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
for directions, group in runs.groupby("directions"):
    label = f"octree, {directions} direction{'s' if directions > 1 else ''}"
    (line,) = axes.plot(group["voxels"], group["MB"], "o-", label=label)
    full = group["grid_voxels"] * directions * 8 * 8 / 7 / 1e6
    axes.plot(group["voxels"], full, "--", color=line.get_color(), label=label.replace("octree", "full grid"))
for _, run in runs.iterrows():
    axes.annotate(f"{run['resolution']}³", (run["voxels"], run["MB"]), (4, -10), textcoords="offset points", fontsize=8)
axes.set(xscale="log", yscale="log", xlabel="surface voxels", ylabel="MB")
axes.legend()
if picture:
    figure.savefig(picture, dpi=120)
else:
    plt.show()
