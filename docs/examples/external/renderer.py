"""The smallest renderer: a grey image. What every program for `external` has to do. Needs numpy."""
import json
import sys
import time
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "framework" / "python"))
import voxray.exr  # writes EXR files; any other writer does

sidecar = Path(sys.argv[-1])
asked = json.loads(sidecar.read_text())
scene = sidecar.parent / asked["scene"]  # glTF
width, height = asked["image"]["width"], asked["image"]["height"]

start = time.time()
image = numpy.full((height, width, 3), 0.1)  # here it would render `scene` with asked["spp"] samples and asked["seed"]
seconds = time.time() - start

voxray.exr.write(sidecar.parent / "final.exr", image)
(sidecar.parent / "time.json").write_text(json.dumps({"render_seconds": seconds}))
