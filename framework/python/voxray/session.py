"""A config that stays open, changed value by value (docs/session.md)."""

from __future__ import annotations

import itertools
import json
import os
import re
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from orchestration.errors import did_you_mean
from PIL import Image
from report import exr_pixels

from voxray import display
from voxray.errors import VoxrayError

PROGRAM = Path(os.environ.get("VOXRAY_PROGRAM", Path(__file__).resolve().parents[3] / "voxray"))
PROTOCOL = 1
_PLACE = re.compile(r"^request \d+:\d+: ")  # In a text that the user does not see
SHARED_MEMORY = "/dev/shm"  # Linux; elsewhere images go through files


def _images(answer: dict) -> dict[str, np.ndarray]:
    """Images of an answer by name, shape (height, width, channels), float64."""
    return {name: np.atleast_3d(np.load(file).astype(float)) for name, file in answer["images"].items()}


@dataclass(frozen=True)
class GrowingReference:
    """The reference, of all samples so far. Images are linear Rec. 709 radiance in W/(m² sr), shape (height, width, 3), float64;
    None with fewer than 2 samples a pixel.

    samples: a pixel; of: those that the config asks for. noise: nRMSE that the images have by their own noise, by column of
    results.csv: nrmse, indirect_nrmse.
    """

    final: np.ndarray | None
    indirect: np.ndarray | None
    samples: int
    of: int
    noise: dict[str, float]

    @property
    def is_whole(self) -> bool:
        """Whether it has all samples; then it is bit for bit that of a run."""
        return self.samples == self.of

    def __repr__(self) -> str:
        return f"Reference of {self.samples} of {self.of} samples a pixel{self._noise()}"

    def _noise(self) -> str:
        return f", noise {self.noise['nrmse']:.2%} (nRMSE)" if self.noise else ""

    def _repr_html_(self) -> str:
        shown = {} if self.final is None else {"reference": self.final, "reference, indirect": self.indirect}
        return (display.strip({name: display.picture(image) for name, image in shown.items()})
                + f"<p>{self.samples} of {self.of} samples a pixel{self._noise()}</p>")


@dataclass(frozen=True)
class Comparison:
    """A rendering against a reference. errors: HDR-FLIP of "final" and "indirect", shape (height, width), 0 to 1."""

    reference: GrowingReference
    scores: dict[str, float]
    errors: dict[str, np.ndarray]


@dataclass(frozen=True)
class Rendering:
    """One frame. Images are linear Rec. 709 radiance in W/(m² sr), shape (height, width, 3), float64. In Jupyter the last one
    of a session with a reference (Session.reference()) is shown with that, its error maps and its scores.

    final: all light; indirect: light that surfaces reflect, None where no pass writes it. frame_ms: of all frame passes.
    memory_bytes: of all passes.
    """

    final: np.ndarray
    indirect: np.ndarray | None
    frame_ms: float
    memory_bytes: int
    _passes: list[dict] = field(repr=False)
    _values: list[dict] = field(repr=False)
    _compare: Callable[[], Comparison | None] = field(default=lambda: None, repr=False, compare=False)

    @cached_property
    def passes(self) -> pd.DataFrame:
        """A row for each pass in execution order, with id, phase, ms, rays, memory_bytes and whether it was reused."""
        return pd.DataFrame(self._passes)

    @cached_property
    def values(self) -> pd.DataFrame:
        """What passes reported, with pass, name, value."""
        return pd.DataFrame(self._values, columns=["pass", "name", "value"])

    def __repr__(self) -> str:
        return f"Rendering of {self.final.shape[1]} x {self.final.shape[0]} pixels"

    def _repr_html_(self) -> str:
        rows, table, compared = [], "", self._compare()
        for name, image in {"final": self.final, "indirect": self.indirect}.items():
            if image is None:
                continue
            rows.append({name: display.picture(image)})
            if compared:
                rows[-1] |= {f"reference, {name}": display.picture(getattr(compared.reference, name)),
                             f"HDR-FLIP, {name}": display.error_picture(compared.errors[name])}
        if compared:
            table = pd.DataFrame([compared.scores], index=[f"{compared.reference.samples} of {compared.reference.of} samples"]).to_html()
        strips = "".join(map(display.strip, rows)) if compared else display.strip({name: shown for row in rows for name, shown in row.items()})
        return strips + table + self.passes.to_html(index=False)


class Session:
    """A config on a device. It is closed by close(), or at the end of a `with` block."""

    def __init__(self, config: str | Path, options: Iterable[str] = (), program: str | Path = PROGRAM) -> None:
        """@throws VoxrayError where the config or an option is wrong."""
        self._folder = tempfile.TemporaryDirectory(prefix="voxray-", dir=SHARED_MEMORY if os.access(SHARED_MEMORY, os.W_OK) else None)
        self._said = tempfile.TemporaryFile("w+")
        self._numbers = itertools.count()
        self._changes = 0
        self._has_reference = False
        self._process = subprocess.Popen([str(program), "session", str(config), "--stdio", "--images", self._folder.name, "--format", "npy",
                                          *options],
                                         stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._said, text=True)
        greeting = self._read()
        if greeting["protocol"] != PROTOCOL:
            self.close()
            raise VoxrayError(f"the program speaks protocol {greeting['protocol']} of sessions, this module {PROTOCOL}")
        self.variants: dict[str, str] = {one["id"]: one["name"] for one in greeting["variants"]}
        self.warnings: list[str] = greeting["warnings"]

    def set(self, path: str, value: Any) -> None:
        """Sets a value of the config as `--set` does; None takes it out. @throws VoxrayError; nothing is changed then."""
        self.warnings = self._ask("set", path=path, value=value)["warnings"]
        self._changes += 1

    def select(self, variant: str, *, keep: bool | None = None) -> None:
        """Takes a variant's values, by its id or its name, in place of all that were set.

        @param keep True: what was set is set in the variant, too, but `graph`, which would take the variant's place; False: it is
            dropped; None: it is dropped, and a warning (UserWarning) names it
        @throws VoxrayError for a name that no variant has; for what can't be set in the variant; nothing is changed then
        """
        answer = self._ask("select", variant=variant, keep=bool(keep))
        self._changes += 1
        self.warnings = answer["warnings"]
        if answer["dropped"] and keep is not False:
            warnings.warn(f"select: '{variant}' takes the place of what was set: {', '.join(answer['dropped'])}", stacklevel=2)

    def kernel(self, id: str, source: str, *, after: str | None = None, **parameters: Any) -> None:
        """Puts the pass `glsl` with a GLSL text into the graph (docs/writing-a-pass.md); one with that id gives way to it.

        @param after the id of the pass that it follows; None: the last one
        @param parameters of the pass, such as writes="indirect", and `inputs`
        @throws VoxrayError where there is no such pass; mistakes of the text show when it is rendered
        """
        graph = [entry if isinstance(entry, dict) else {"pass": entry} for entry in self.config["graph"]]
        ids = [entry.get("id", entry["pass"]) for entry in graph]
        if after is not None and after not in ids:
            raise VoxrayError(f"no pass '{after}'{did_you_mean(after, ids)}")
        own = {"pass": "glsl", "id": id, "source": source, **parameters}
        if id in ids:
            graph[ids.index(id)] = own
        else:
            graph.insert(len(graph) if after is None else ids.index(after) + 1, own)
        self.set("graph", graph)

    @property
    def config(self) -> dict:
        """The config with all values that were set."""
        return self._ask("config")["config"]

    def render(self) -> Rendering:
        """Renders the compared frame; only what changed is built again. @throws VoxrayError"""
        answer = self._ask("render")
        self._changes += 1
        number = self._changes
        pixels = _images(answer)
        return Rendering(pixels["final"], pixels.get("indirect"), answer["frame_ms"], answer["memory_bytes"], answer["passes"], answer["values"],
                         lambda: self._compared() if number == self._changes else None)

    def reference(self, seconds: float | None = None) -> GrowingReference:
        """Renders samples of the config's reference for about this time, at least one a pixel, and keeps them: another call goes
        on from there. None: until it is whole; 0: nothing is rendered. It begins anew where scene, camera, image size or the
        `reference` entry change. A cached one is whole at once. @throws VoxrayError where the config has none"""
        answer = self._ask("reference", **({} if seconds is None else {"ms": round(1000 * seconds)}))
        self._has_reference = bool(answer["images"])
        pixels = _images(answer)
        return GrowingReference(pixels.get("final"), pixels.get("indirect"), answer["samples"], answer["of"], answer["noise"])

    def score(self) -> dict[str, float]:
        """Scores against the config's reference, by column of results.csv, with the ends of their 95 % intervals (`nrmse_low`,
        `nrmse_high`) or what a perfect image would score (`flip_noise`). The last rendering is scored; where values were set
        since, they are rendered first. A reference that has no samples yet is rendered first, to the end. @throws VoxrayError"""
        return self._ask("score")["scores"]

    def _compared(self) -> Comparison | None:
        if not self._has_reference or self._process.poll() is not None:
            return None
        try:
            reference = self.reference(0)
        except VoxrayError:  # The config has none any more
            self._has_reference = False
        if not self._has_reference:
            return None
        answer = self._ask("score")
        return Comparison(reference, answer["scores"], {name: error[..., 0] for name, error in _images(answer).items()})

    @property
    def views(self) -> pd.DataFrame:
        """What can be looked at of a rendering besides its image: a row for each view, by pass in execution order. It is that of
        the last rendering; where values were set since, they are rendered first.

        name: for view(), "PASS.WHAT". kind: aov, image, buffer, voxels. type, shape: of the array; None for voxels. channels:
        names of its last axis, or of its only channel; empty where it has none. quantity: radiance (or irradiance), fraction,
        direction, number, other, as in docs/look.md. @throws VoxrayError"""
        return pd.DataFrame(self._ask("views")["views"], columns=["name", "pass", "kind", "type", "shape", "channels", "quantity"])

    def view(self, name: str, **parameters: Any) -> np.ndarray:
        """A view of the rendering that `views` tells of, by its name there. Nothing else is rendered again, but for voxels.

        AOVs are float32, shape (height, width) or (height, width, channels), as `run --aovs` writes them (units:
        docs/writing-a-config.md); radiance of passes is float32, shape (height, width, 3), W/(m² sr). Other images have the
        device's type and channels, shape (height, width[, channels]) or (depth, height, width, channels). Buffers have the shape
        (elements,) or (elements, values): uint32 words unless the type is known; ndarray.view() reads them as another.
        "show_voxels" draws voxels with `parameters` of that pass, such as show="irradiance"; shape (height, width, 3).
        @throws VoxrayError for a name or a parameter that isn't there"""
        answer = self._ask("view", name=name, parameters=parameters)
        if answer["file"].endswith(".npy"):
            return np.load(answer["file"])
        channels = exr_pixels.read(answer["file"])
        return np.stack([channels[channel] for channel in answer["channels"]], axis=-1).reshape(answer["shape"])

    def view_picture(self, name: str, **parameters: Any) -> Image.Image:
        """The same as the page of `voxray look` shows it, 8-bit sRGB. Its `info["legend"]` says in words what the colors mean.
        @throws VoxrayError, as view()"""
        answer = self._ask("view", name=name, parameters=parameters, picture=True)
        with Image.open(answer["picture"]) as picture:
            shown = picture.convert("RGB")
        shown.info["legend"] = answer["legend"]
        return shown

    @property
    def process_id(self) -> int:
        return self._process.pid

    def close(self) -> None:
        """Ends the program; more calls do nothing."""
        if self._process.poll() is None:
            self._process.stdin.close()
            self._process.wait()
        self._process.stdout.close()
        self._said.close()
        self._folder.cleanup()

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_) -> None:
        self.close()

    def _ask(self, command: str, **keys: Any) -> dict:
        number = next(self._numbers)
        try:
            self._process.stdin.write(json.dumps({"id": number, "command": command, **keys}, ensure_ascii=False) + "\n")
            self._process.stdin.flush()
        except (BrokenPipeError, ValueError):
            pass  # _read() says why it ended
        answer = self._read()
        if not answer["ok"]:
            raise VoxrayError(_PLACE.sub("", answer["error"]))
        return answer

    def _read(self) -> dict:
        line = "" if self._process.stdout.closed else self._process.stdout.readline()
        if line:
            return json.loads(line)
        if self._said.closed:
            raise VoxrayError("the session is closed")
        self._process.wait()
        self._said.seek(0)
        said = self._said.read().strip().splitlines()
        self.close()
        raise VoxrayError(said[-1].removeprefix("voxray: error: ") if said else "the session ended")
