"""A program in place of another renderer, for external_test.py: stand_in_renderer.py [WORD...] SIDECAR

It appends what it was asked for to the file `runs.jsonl` of its working folder, then does what its words say: `time=S`
tells S seconds, `sleep=S` waits, `fail` ends with status 3, `nan` and `wide` write wrong images, `nothing` writes none."""
import json
import os
import sys
import time
from pathlib import Path

import numpy

sys.path.insert(0, os.path.join(os.environ["VOXRAY_SOURCE"], "framework", "python"))
import voxray.exr  # noqa: E402

*words, sidecar = sys.argv[1:]
values = dict(word.partition("=")[::2] for word in words)
folder = Path(sidecar).parent
asked = json.loads(Path(sidecar).read_text(encoding="utf-8"))
with open("runs.jsonl", "a", encoding="utf-8") as log:
    log.write(json.dumps(asked | {"files": sorted(os.listdir(folder)), "process": os.getpid()}) + "\n")
time.sleep(float(values.get("sleep", 0)))
if "fail" in values:
    print("reading the scene", flush=True)
    sys.exit("no licence for\nthis machine")

size = asked["image"]
image = numpy.full((size["height"], size["width"] + ("wide" in values), 3), 0.25)
if "nan" in values:
    image[2, 3, 1] = numpy.nan
if "nothing" not in values:
    for name, part in (("direct", 1), ("indirect", 3)) if asked["light"] == "parts" else (("final", 4),):
        voxray.exr.write(folder / f"{name}.exr", part * image)
if "time" in values:
    (folder / "time.json").write_text(json.dumps({"render_seconds": float(values["time"])}), encoding="utf-8")
