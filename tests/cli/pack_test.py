"""`voxray pack` and `voxray verify`, end to end: what was packed is confirmed, and what was changed is not."""
import functools
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

from support import PROGRAM, SOURCE, TINY, CommandTest

sys.path.insert(0, os.path.join(SOURCE, "framework", "python"))
sys.path.insert(0, os.path.join(SOURCE, "framework"))
import voxray.exr  # noqa: E402
from report import exr_pixels  # noqa: E402

STUDY = TINY.replace("spp: 8", "spp: 1024")
LAMP = "{point: [0, 1.8, 0], intensity: [2, 2, 2]}"
ROOM = STUDY.replace("{builtin: cornell}", f"{{file: room.glb, keep_file_lights: false, lights: [{LAMP}]}}")


@functools.cache
def packed(text=STUDY):
    """A folder with study.yaml, its results and study.zip; made once."""
    folder = tempfile.TemporaryDirectory(prefix="voxray-pack-")
    call = functools.partial(subprocess.run, cwd=folder.name, check=True, capture_output=True, text=True)
    Path(folder.name, "study.yaml").write_text(text, encoding="utf-8")
    if "room.glb" in text:
        cornell = STUDY.replace("{builtin: cornell}", "{builtin: cornell, lights: point}")
        Path(folder.name, "cornell.yaml").write_text(cornell, encoding="utf-8")
        call([PROGRAM, "export-scene", "cornell.yaml", "room.glb"])
    call([PROGRAM, "pack", "study.yaml", "-o", "study.zip", "--licence", "room.glb=CC0", "--quiet"])
    return folder


class Pack(CommandTest):
    def copy(self, text=STUDY):
        shutil.copytree(packed(text).name, self.folder, dirs_exist_ok=True)

    def repack(self, change, keeps_hashes=False):
        """Changes files of the pack, given as bytes by name; hashes follow, so that nothing but what it says is wrong."""
        with zipfile.ZipFile(self.path("study.zip")) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
        change(files)
        record = json.loads(files["pack.json"])
        if not keeps_hashes:
            record["files"] = {name: hashlib.sha256(data).hexdigest() for name, data in files.items() if name != "pack.json"}
            files["pack.json"] = json.dumps(record).encode()
        with zipfile.ZipFile(self.path("study.zip"), "w") as archive:
            for name, data in files.items():
                archive.writestr(name, data)

    def change_claims(self, factor):
        """@param factor of a claim's numbers, given the claim"""
        def change(files):
            record = json.loads(files["pack.json"])
            for claim in record["claims"]:
                for key in ("value", "low", "high"):
                    if isinstance(claim[key], float):
                        claim[key] *= factor(claim)
            files["pack.json"] = json.dumps(record).encode()
        self.repack(change)

    def verify(self, status, *arguments):
        done = self.expect(status, "verify", "study.zip", *arguments)
        return done.stdout

    def lines(self, said, verdict):
        return [line[18:] for line in said.splitlines() if line.startswith(f"{verdict} ")]


class Confirmed(Pack):
    def test_the_same_machine_confirms_each_score(self):
        self.copy()
        said = self.verify(0)
        print(said)
        self.assertEqual(self.lines(said, "not"), [])
        self.assertEqual(self.lines(said, "within tolerance"), [])
        for metric in self.metrics():
            self.assertTrue(any(f"resolution 16: {metric}: " in line for line in self.lines(said, "same")), metric)
        self.assertIn("tiny: confirmed: ", said)

    def test_a_pack_holds_what_others_need(self):
        self.copy()
        with zipfile.ZipFile(self.path("study.zip")) as archive:
            names, record = archive.namelist(), json.loads(archive.read("pack.json"))
            self.assertEqual(json.loads(archive.read("config.json"))["reference"]["spp"], 1024)
        for name in ("original/study.yaml", "results/results.csv", "results/manifest.json",
                     *(f"results/images/reference/{light}_{half}.exr" for light in ("final", "indirect") for half in "ab")):
            self.assertIn(name, names)
            self.assertIn(name, record["files"])
        for key in ("versions", "device", "machine", "scenes", "claims"):
            self.assertTrue(record[key] or key == "scenes", key)
        scored = {claim["what"]: claim for claim in record["claims"] if claim["of"] == "resolution 16"}
        for metric in self.metrics():
            self.assertLess(scored[metric]["low"], scored[metric]["high"], metric)
        row = {row["variant"]: row for row in self.rows("results", "tiny", "results.csv")}["resolution-16"]
        self.assertEqual([scored["nrmse"][end] for end in ("low", "high")], [float(row[f"nrmse_{end}"]) for end in ("low", "high")])

    def test_options_of_the_run_are_in_the_pack(self):
        self.write("study.yaml", STUDY)
        self.expect(0, "pack", "study.yaml", "-o", "study.zip", "--profile", "smaller", "--only", "voxelize.resolution=8",
                    "--tracer", "embree", "--set", "reference.spp=16", "--set", "scene.environment=none")
        said = self.verify(0)
        self.assertEqual(self.lines(said, "not"), [])
        self.assertNotIn("resolution 16", said)

    def test_rounding_is_within_tolerance(self):
        """As another kind of machine or driver has it."""
        self.copy()
        self.change_claims(lambda claim: 1 + 1e-6)
        said = self.verify(0)
        self.assertIn("within tolerance  resolution 8: nrmse: ", said)
        self.assertIn("within tolerance  reference, total light: mean radiance: ", said)


class Caught(Pack):
    def test_a_changed_config(self):
        self.copy()
        def change(files):
            files["config.json"] = files["config.json"].replace(b'"bounces": 2', b'"bounces": 1')
        self.repack(change, keeps_hashes=True)
        self.assertIn("config.json: not what was packed", self.verify(1))

        # Who changes the hash, too, has another config than the results' manifest says, and other scores
        self.copy()
        self.repack(change)
        wrong = self.lines(self.verify(1), "not")
        self.assertTrue(any(line.startswith("config: ") and "bounces" in line for line in wrong), wrong)
        self.assertTrue(any("indirect light: mean radiance" in line for line in wrong), wrong)

    def test_lights_brighter_by_1_percent(self):
        """Both reference and variants are brighter then: scores stay, the reference's brightness does not."""
        self.copy(ROOM)
        def brighten(files):
            for name in ("config.json", "results/manifest.json"):
                data = json.loads(files[name])
                data.get("config", data)["scene"]["lights"][0]["intensity"] = [2.02, 2.02, 2.02]
                files[name] = json.dumps(data).encode()
        self.repack(brighten)
        wrong = self.lines(self.verify(1), "not")
        for light in ("total", "indirect"):
            self.assertTrue(any(f"{light} light: mean radiance" in line for line in wrong), wrong)

    def test_a_reference_brighter_by_1_percent(self):
        self.copy()
        self.change_claims(lambda claim: 1 / 1.01 if claim["what"] == "mean radiance" else 1)
        wrong = self.lines(self.verify(1, "--quiet"), "not")
        self.assertEqual([line.partition(": ")[0] for line in wrong], ["reference, total light", "reference, indirect light"])

    def test_an_image_brighter_by_1_percent(self):
        self.copy()
        self.change_claims(lambda claim: 1 / 1.01 if (claim["of"], claim["what"]) == ("resolution 8", "mean_ratio") else 1)
        wrong = self.lines(self.verify(1, "--quiet"), "not")
        self.assertEqual(len(wrong), 1, wrong)
        self.assertTrue(wrong[0].startswith("resolution 8: mean_ratio: "), wrong)

    def test_a_reference_of_another_view(self):
        self.copy()
        def mirror(files):
            for name in [name for name in files if name.endswith(".exr")]:
                path = Path(self.write("light.exr", ""))
                path.write_bytes(files[name])
                voxray.exr.write(path, exr_pixels.rgb(path)[:, ::-1])
                files[name] = path.read_bytes()
        self.repack(mirror)
        wrong = self.lines(self.verify(1), "not")
        for light in ("total", "indirect"):
            self.assertTrue(any(f"{light} light: error of the image" in line for line in wrong), wrong)

    def test_a_variant_that_fails(self):
        self.copy()
        def limit(files):
            record = json.loads(files["config.json"])
            record["measure"]["memory_limit_mb"] = 1
            record["sweep"]["voxelize.resolution"] = [8, 256]
            files["config.json"] = json.dumps(record).encode()
        self.repack(limit)
        wrong = self.lines(self.verify(1), "not")
        self.assertIn("resolution 16: status: ok, here -", wrong)

    def test_a_program_of_the_packs_author_is_not_run(self):
        self.copy()
        def change(files):
            files["config.json"] = files["config.json"].replace(
                b'"pass": "composite"', b'"pass": "external", "command": ["/usr/bin/touch", "%s"]' % self.path("ran").encode())
        self.repack(change)
        self.assertIn("may run a program", self.expect(2, "verify", "study.zip").stderr)
        self.assertFalse(os.path.exists(self.path("ran")))

    def test_a_file_that_is_no_pack(self):
        self.write("study.zip", "nothing")
        self.assertIn("no pack of Voxray", self.expect(2, "verify", "study.zip").stderr)
        with zipfile.ZipFile(self.path("study.zip"), "w") as archive:
            archive.writestr("../pack.json", "{}")
        self.assertIn("would be written elsewhere", self.expect(2, "verify", "study.zip").stderr)
        self.assertFalse(os.path.exists(os.path.join(os.path.dirname(self.folder), "pack.json")))
        self.assertIn("no such file", self.expect(2, "verify", "none.zip").stderr)


class Scenes(Pack):
    def test_a_small_scene_with_a_licence_is_packed(self):
        self.copy(ROOM)
        os.remove(self.path("room.glb"))
        self.assertIn("room.glb", self.verify(0))

    def test_a_changed_scene(self):
        self.copy(ROOM)
        def change(files):
            files["scenes/room.glb"] = files["scenes/room.glb"][:-4] + b"\0\0\0\1"
        self.repack(change)
        self.assertIn("scene room.glb: room.glb is another", self.verify(1))

    def test_a_scene_without_licence_stays_out_unless_asked_for(self):
        self.copy(ROOM)
        done = self.expect(0, "pack", "study.yaml", "-o", "study.zip", "--resume", "--quiet")
        self.assertIn("without room.glb", done.stdout)
        self.assertIn("states no licence", done.stdout)
        self.assertIn("is not in the pack", self.expect(2, "verify", "study.zip").stderr)
        os.makedirs(self.path("mine"))
        shutil.move(self.path("room.glb"), self.path("mine"))
        self.verify(0, "--scenes", "mine")
        with open(self.path("mine", "room.glb"), "ab") as file:
            file.write(b"\0")
        self.assertIn("room.glb is another", self.verify(1, "--scenes", "mine"))

    def test_a_path_that_others_cannot_have(self):
        self.copy(ROOM)
        self.write("study.yaml", ROOM.replace("room.glb", self.path("room.glb")))
        self.assertIn("others have no such path", self.expect(2, "pack", "study.yaml").stderr)


if __name__ == "__main__":
    unittest.main()
