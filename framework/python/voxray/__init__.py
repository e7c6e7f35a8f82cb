"""Voxray from Python: a config that stays open (open()), runs and their results (run(), load()), scores (score(), compare()).

    import voxray
    study = voxray.open("configs/quickstart.yaml")
    study.set("voxelize.resolution", 128)
    image = study.render().indirect     # numpy, (height, width, 3), linear
    results = voxray.run("configs/quickstart.yaml")
    results.pareto()                    # a DataFrame, and a chart
    voxray.compare(results["lookup"], results["cones"])

docs/python.md shows more. The module calls the program ./voxray of the clone that it lies in; PYTHONPATH has to hold
framework/python of it.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import warnings
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).resolve().parents[2]))  # of the packages `orchestration` and `report`

_missing = [name for name in ("matplotlib", "numpy", "pandas", "PIL") if importlib.util.find_spec(name) is None]
if _missing:
    raise ImportError(f"{sys.executable} has no {', '.join(_missing)}: start /usr/bin/python3, which has Debian's packages")

from orchestration.program import assignment  # noqa: E402

from voxray.compare import compare, score  # noqa: E402
from voxray.display import picture, strip  # noqa: E402
from voxray.errors import VoxrayError  # noqa: E402
from voxray.results import Reference, Results, Variant, load  # noqa: E402
from voxray.session import PROGRAM, GrowingReference, Rendering, Session  # noqa: E402

__all__ = ["PROGRAM", "GrowingReference", "Reference", "Rendering", "Results", "Session", "Variant", "VoxrayError", "compare", "load", "open",
           "picture", "run", "score", "strip"]


def open(config: str | Path, *, set: Mapping[str, Any] | None = None, profile: str | None = None, options: Iterable[str] = ()) -> Session:
    """Opens a config on a device. set: values by path, as set() of the session. options: more words of the command, such as
    ["--tracer", "embree"]. @throws VoxrayError where the config is wrong"""
    return Session(config, [*_words(set, profile), *options])


def run(config: str | Path, *, set: Mapping[str, Any] | None = None, profile: str | None = None, out: str | Path | None = None,
        options: Iterable[str] = (), program: str | Path = PROGRAM) -> Results:
    """Runs a config as the command `run` does, and loads its results: `.variants`, `.passes` and `.values` are DataFrames. out: the
    results folder, results/NAME where left out. Variants that failed are rows. A warning (UserWarning) says how many finished
    variants of an earlier run in that folder are replaced; options=["--resume"] keeps them.
    @throws VoxrayError where the config is wrong or the run was interrupted"""
    folder = Path(out) if out is not None else Path("results") / Path(config).stem
    options = list(options)
    replaced = 0 if "--resume" in options else sum(1 for _ in (folder / "images").glob("*/result.json"))
    done = subprocess.run([str(program), "run", str(config), *_words(set, profile), "--out", str(folder), "--quiet", *options],
                          stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 1) or not (folder / "results.csv").is_file():
        said = done.stderr.strip().splitlines()
        raise VoxrayError(said[-1].removeprefix("voxray: error: ") if said else f"the program ended with status {done.returncode}")
    if replaced:
        warnings.warn(f"{folder}: replaced {replaced} finished variant{'s' if replaced > 1 else ''} of an earlier run; options=[\"--resume\"] "
                      f"keeps what has the same config, another `out` keeps all", stacklevel=2)
    return load(folder)


def _words(values: Mapping[str, Any] | None, profile: str | None) -> list[str]:
    words = ["--profile", profile] if profile else []
    for path, value in (values or {}).items():
        words += ["--set", assignment(path, value)]
    return words
