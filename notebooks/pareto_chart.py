# %% [markdown]
# # The Pareto chart of many runs
#
# Reads the table that `./voxray pareto` leaves next to its page and draws cost against error, a chart for each scene:
# all variants, and the Pareto front of each method. Run it cell by cell in an editor that knows `# %%`, or whole:
#
#     ./voxray pareto results/compare --out methods.html
#     /usr/bin/python3 notebooks/pareto_chart.py methods.csv [chart.png]

# %%
import sys
from pathlib import Path

import matplotlib
import pandas as pd

root = Path(__file__).resolve().parents[1] if "__file__" in globals() else Path.cwd().parent
sys.path.append(str(root / "framework"))
from report.ranking import pareto_front  # noqa: E402

arguments = [a for a in sys.argv[1:] if not a.startswith("-")] if "__file__" in globals() else []
measured = Path(arguments[0] if arguments else "methods.csv")
picture = Path(arguments[1]) if len(arguments) > 1 else None
if picture:
    matplotlib.use("Agg")  # no display is needed to write a file
import matplotlib.pyplot as plt  # noqa: E402

# %% [markdown]
# ## The table
# One row for each variant. `cost` may be any column of costs: "frame + light" is what a light that moves takes, "rays" does
# not depend on the machine.

# %%
table = pd.read_csv(measured)
cost = "frame"
error = next(column.removesuffix("_low") for column in table if column.endswith("_low"))
table = table[(table[cost] > 0) & (table[error] > 0)]


def front_of(variants: pd.DataFrame) -> pd.DataFrame:
    """Those that no other one beats, by rising cost."""
    chosen = pareto_front(list(zip(variants[cost], variants[error])))
    return variants.iloc[chosen]


# %% [markdown]
# ## Who is on the front
# By scene, of all methods together.

# %%
for scene, variants in table.groupby("scene", sort=False):
    print(f"\n{scene}")
    print(front_of(variants)[["method", "name", cost, error]].to_string(index=False))

# %% [markdown]
# ## The charts
# A line is a method's own front; the grey staircase is that of all.

# %%
scenes = list(table.groupby("scene", sort=False))
columns = min(len(scenes), 3)
rows = -(-len(scenes) // columns)
figure, charts = plt.subplots(rows, columns, figsize=(6 * columns, 4.5 * rows), squeeze=False, layout="constrained")
methods = {method: f"C{i % 10}" for i, method in enumerate(table["method"].unique())}
for axes, (scene, variants) in zip(charts.flat, scenes):
    for method, own in variants.groupby("method", sort=False):
        bars = [(own[error] - own[f"{error}_low"]).clip(lower=0), (own[f"{error}_high"] - own[error]).clip(lower=0)]
        axes.errorbar(own[cost], own[error], bars, fmt=".", color=methods[method], elinewidth=0.6)
        line = front_of(own)
        axes.plot(line[cost], line[error], color=methods[method], label=method)
    whole = front_of(variants)
    axes.step(whole[cost], whole[error], where="post", color="grey", linewidth=3, alpha=0.4, zorder=0)
    axes.set(xscale="log", yscale="log", title=scene, xlabel=cost, ylabel=error)
for axes in charts.flat[len(scenes):]:
    axes.set_axis_off()
handles = {label: handle for axes in charts.flat for handle, label in zip(*axes.get_legend_handles_labels())}
charts.flat[0].legend(handles.values(), handles.keys(), fontsize=6)
if picture:
    figure.savefig(picture, dpi=150)
else:
    plt.show()
