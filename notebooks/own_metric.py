# %% [markdown]
# # A metric of one's own
#
# Reads the linear radiance of every variant and of its reference and scores them by a function of your own. A metric that
# every run shall have belongs into `framework/image` (docs/architecture.md says where). Run it cell by cell in an editor
# that knows `# %%`, or whole:
#
#     /usr/bin/python3 notebooks/own_metric.py results/quickstart [table.csv]

# %%
import sys
from pathlib import Path

import numpy as np
import pandas as pd

root = Path(__file__).resolve().parents[1] if "__file__" in globals() else Path.cwd().parent
sys.path.append(str(root / "framework"))
from report import exr_pixels  # noqa: E402
from report.load import load  # noqa: E402

arguments = [a for a in sys.argv[1:] if not a.startswith("-")] if "__file__" in globals() else []
directory = Path(arguments[0]) if arguments else root / "results" / "quickstart"
target = Path(arguments[1]) if len(arguments) > 1 else None

# %% [markdown]
# ## The metric
# Of two images of radiance, shape (height, width, 3), in W/(m² sr): a number. This one is the error in stops that 95 % of
# the pixels stay below: light that is twice or half as bright is off by one. `floor` keeps black pixels from being off
# without end; it is a hundredth of the reference's mean.


# %%
def luminance(radiance: np.ndarray) -> np.ndarray:
    """Of linear sRGB primaries (Rec. 709)."""
    return radiance @ np.array([0.2126, 0.7152, 0.0722])


def stops_off(test: np.ndarray, reference: np.ndarray) -> float:
    """The 95th percentile of the pixels' error in stops."""
    floor = 0.01 * luminance(reference).mean()
    off = np.abs(np.log2((luminance(test) + floor) / (luminance(reference) + floor)))
    return float(np.percentile(off, 95))


# %% [markdown]
# ## The scores
# Indirect light where the run has it apart, else the total. The two halves of the reference, of half its samples each,
# tell how much of a score its own noise can be.


# %%
def read(folder: str, name: str) -> np.ndarray:
    channels = exr_pixels.read(results.directory / "images" / folder / f"{name}.exr")
    return np.stack([channels[color] for color in "RGB"], axis=-1).astype(float)


results = load(directory)
light = "indirect" if "indirect" in results.lights() else "total"
name = {"indirect": "indirect", "total": "final"}[light]
rows = []
for variant in results.ok["variant"]:
    if results.image(variant, f"{name}.exr"):
        folder = results.reference_folder(variant)
        rows.append({"variant": variant, "stops_off": stops_off(read(variant, name), read(folder, name)),
                     "of_noise": stops_off(read(folder, f"{name}_a"), read(folder, f"{name}_b"))})
scores = pd.DataFrame(rows).merge(results.ok[["variant", "frame_ms_median"]], on="variant").sort_values("stops_off")
print(f"{light} light")
print(scores.to_string(index=False, float_format="%.4g"))
if target:
    scores.to_csv(target, index=False)
