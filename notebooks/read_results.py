# %% [markdown]
# # Reading a run's results
#
# Loads a results folder with pandas and redraws its chart of speed against error. It renders nothing: make
# the results first, with `./voxray run CONFIG`. Run it cell by cell in an editor that knows `# %%`, or whole:
#
#     /usr/bin/python3 notebooks/read_results.py results/quickstart [chart.png]

# %%
import sys
from pathlib import Path

import matplotlib
import pandas as pd

root = Path(__file__).resolve().parents[1] if "__file__" in globals() else Path.cwd().parent
sys.path.append(str(root / "framework"))
from report.load import load  # noqa: E402
from report.ranking import pareto_front  # noqa: E402
from report.results import interval_of  # noqa: E402

arguments = [a for a in sys.argv[1:] if not a.startswith("-")] if "__file__" in globals() else []
directory = Path(arguments[0]) if arguments else root / "results" / "quickstart"
picture = Path(arguments[1]) if len(arguments) > 1 else None
if picture:
    matplotlib.use("Agg")  # no display is needed to write a file
import matplotlib.pyplot as plt  # noqa: E402

# %% [markdown]
# ## The table
# `results.variants` is results.csv: names and sweep keys are text, costs and scores are numbers.

# %%
results = load(directory)
prefix = "indirect_" if "indirect" in results.lights() else ""
columns = ["name", *results.sweep_keys, "build_ms", "frame_ms_median"]
columns += [prefix + name for name in ("nrmse", "relmse", "flip", "mean_ratio")]
with pd.option_context("display.width", 160, "display.max_columns", None):
    print(results.ok[columns].sort_values(prefix + "nrmse").to_string(index=False))
for warning in results.warnings:
    print("warning:", warning)

# %% [markdown]
# ## Where a frame's time goes
# One row for each variant, one column for each pass, in milliseconds.

# %%
frame = results.passes[results.passes["phase"] == "frame"]
if len(frame):
    print(frame.merge(results.ok[["variant", "name"]]).pivot_table(index="name", columns="pass", values="ms_median", sort=False).round(2))

# %% [markdown]
# ## Speed against error
# Left is faster, lower is closer to the reference. Bars are 95 % confidence intervals; the staircase is the Pareto
# front of their upper ends: what lies wholly above it is beaten.

# %%
error = prefix + "nrmse"
points = results.ok[(results.ok["frame_ms_median"] > 0) & (results.ok[error] > 0)]
figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
groups = [("all variants", points)]
if results.sweep_keys:
    groups = points.groupby(results.sweep_keys[0], sort=False)
for value, group in groups:
    ends = [interval_of(row, error) for _, row in group.iterrows()]
    bars = [(group[error] - [low for low, _ in ends]).clip(lower=0), ([high for _, high in ends] - group[error]).clip(lower=0)]
    axes.errorbar(group["frame_ms_median"], group[error], bars, fmt="o", label=str(value), zorder=3)
for _, row in points.iterrows():
    axes.annotate(row["name"], (row["frame_ms_median"], row[error]), (4, 4),
                  textcoords="offset points", fontsize=8, parse_math=False)

# The Pareto front, and what a black and a constant image score.
reached = [(row["frame_ms_median"], interval_of(row, error)[1]) for _, row in points.iterrows()]
front = [reached[i] for i in pareto_front(reached)]
axes.step([time for time, _ in front], [high for _, high in front], where="post", color="grey", zorder=1)
levels = {f"{name} image": results.baseline(name, error, results.only_reference) for name in ("black", "constant")}
for name, level in levels.items():
    if level > 0:
        axes.axhline(level, color="grey", linestyle="--", linewidth=1)
        axes.annotate(name, (1, level), (-2, 2), xycoords=("axes fraction", "data"), ha="right",
                      textcoords="offset points", fontsize=8, color="grey")
axes.set(xscale="log", yscale="log", xlabel="time of one frame, ms (median)",
         ylabel=f"nRMSE, {'indirect' if prefix else 'total'} light (lower is better)")
axes.legend(title=results.sweep_keys[0] if results.sweep_keys else None)
if picture:
    figure.savefig(picture, dpi=150)
else:
    plt.show()
