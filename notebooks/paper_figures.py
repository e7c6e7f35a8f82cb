# %% [markdown]
# # Figures of the papers, redrawn
#
# Draws a run of a config in `configs/papers/` as the paper's figure has it. The table below says which runs it knows; a
# figure of another one is a line there. Run it cell by cell in an editor that knows `# %%`, or whole:
#
#     ./voxray run configs/papers/cosin2022/clusters_vs_iterations.yaml --profile small
#     /usr/bin/python3 notebooks/paper_figures.py results/cosin2022_clusters_vs_iterations [chart.png]

# %%
import sys
from pathlib import Path

import matplotlib
import pandas as pd

root = Path(__file__).resolve().parents[1] if "__file__" in globals() else Path.cwd().parent
sys.path.append(str(root / "framework"))
from report.load import load  # noqa: E402

arguments = [a for a in sys.argv[1:] if not a.startswith("-")] if "__file__" in globals() else []
directory = Path(arguments[0]) if arguments else root / "results" / "cosin2022_clusters_vs_iterations"
picture = Path(arguments[1]) if len(arguments) > 1 else None
if picture:
    matplotlib.use("Agg")  # no display is needed to write a file
import matplotlib.pyplot as plt  # noqa: E402

# %% [markdown]
# ## What each figure shows
# By the experiment's name: the figure, the column along x, what is drawn along y, and the columns that tell lines apart.
# What stands along y is a column of results.csv, a value that a pass reported (`values: pass: name`), or a column of
# passes.csv (`passes: pass: column`).

# %%
FIGURES = {
    "cosin2022_clusters_vs_iterations": ("Cosin and Patow 2022, figure 8", "cluster.iterations", "values: cluster: clusters",
                                         ["voxelize.resolution", "cluster"]),
    "cosin2022_rays_per_face": ("Cosin and Patow 2022, figure 12", "see.rays", "indirect_nrmse", ["voxelize.resolution"]),
    "memory": ("Arnebäck 2017, figure 43", "voxelize.resolution", "passes: filter: memory_bytes", ["filter"]),
    "seok2021_grid_resolution": ("Seok 2021, figure 21", "mirror", "nrmse@mirror", []),
    "sun2015_resolution": ("Sun and Agu 2015, section 4", "gather", "indirect_nrmse", []),
    "magalhaes2020_ssim": ("Magalhães 2020, figures 5.3 to 5.7", "scene", "ssim", ["indirect"]),
}

results = load(directory)
config = results.manifest.get("config") or {}
if config.get("name") not in FIGURES:
    raise SystemExit(f"{directory}: '{config.get('name')}' is none of {', '.join(FIGURES)}")
title, x, y, apart = FIGURES[config["name"]]

# %% [markdown]
# ## The numbers
# One row for each variant that finished.


# %%
def along_y(what: str) -> pd.Series:
    """The number that is drawn, by variant."""
    kind, _, rest = what.partition(": ")
    own, _, name = rest.partition(": ")
    if kind == "values":
        rows = results.values[(results.values["pass"] == own) & (results.values["name"] == name)]
        return rows.groupby("variant")["value"].mean()
    if kind == "passes":
        rows = results.passes[results.passes["pass"] == own]
        return rows.groupby("variant")[name].sum()
    if what not in results.ok:
        raise SystemExit(f"{directory}: has no column '{what}'")
    return results.ok.set_index("variant")[what]


points = results.ok[["variant", x, *apart]].set_index("variant")
points[y] = along_y(y)
points = points.dropna()
print(points.to_string(index=False))

# %% [markdown]
# ## The figure
# Numbers along x have a logarithmic axis, words stand one after another.

# %%
figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
numbers = pd.to_numeric(points[x], errors="coerce")
has_numbers = bool(numbers.notna().all())
lines = points.groupby(apart, sort=False) if apart else [("", points)]
for label, line in lines:
    places = numbers[line.index] if has_numbers else line[x].str.slice(0, 40)
    label = ", ".join(map(str, label)) if isinstance(label, tuple) else str(label)
    axes.plot(places, line[y], "o-" if has_numbers else "o", label=label[:60])
if has_numbers:
    axes.set_xscale("log", base=2)
    axes.set_xticks(sorted(numbers.unique()), [f"{value:g}" for value in sorted(numbers.unique())])
    axes.minorticks_off()
else:
    axes.tick_params(axis="x", labelrotation=20, labelsize=7)
axes.set(xlabel=x, ylabel=y, title=title)
axes.set_ylim(bottom=0)
axes.grid(True, color="0.9")
if apart:
    axes.legend(fontsize=7, title=", ".join(apart))
if picture:
    figure.savefig(picture, dpi=150)
else:
    plt.show()
