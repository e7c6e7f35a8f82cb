"""Mistakes that newcomers make in configs: each is stopped before anything is rendered, with file, line and a way out."""
import os
import unittest

from mistakes import CAMERA, CONFIG, MISTAKES
from support import CommandTest
from suspicions import WARNINGS


class Mistakes(CommandTest):
    def told(self, table):
        """What `validate` tells of each entry's config, all in one process: {what: (lines about it, line named, names)}."""
        for number, (right, other, *_) in enumerate(table.values()):
            self.assertIn(right, CONFIG)
            os.mkdir(self.path(str(number)))
            self.write(f"{number}/mine.yaml", CONFIG.replace(right, other, 1))
        done = self.voxray("validate", *(f"{number}/mine.yaml" for number in range(len(table))))
        lines = [line for line in done.stderr.splitlines() if "(with --profile smaller)" not in line]
        return done, {what: ([text for text in lines if f": {number}/mine.yaml:" in text], f"{number}/mine.yaml:{line}: ", names)
                      for number, (what, (_, _, line, *names)) in enumerate(table.items())}

    def test_each_is_stopped_where_it_stands(self):
        done, told = self.told(MISTAKES)
        self.assertEqual(done.returncode, 2)
        for what, (lines, place, names) in told.items():
            with self.subTest(what):
                errors = [line for line in lines if line.startswith("voxray: error: ")]
                self.assertEqual(len(errors), 1, errors)
                for words in (place, *names):
                    self.assertIn(words, errors[0])

    def test_what_may_be_meant_is_warned_of(self):
        done, told = self.told(WARNINGS)
        self.assertEqual(done.returncode, 0, done.stderr)
        for what, (lines, place, (name,)) in told.items():
            with self.subTest(what):
                said = [line for line in lines if name in line]
                self.assertEqual(len(said), 1, lines)
                self.assertTrue(said[0].startswith("voxray: warning: " + place), said)

    def test_a_dark_view_is_warned_of(self):
        # A room that light must not leak into
        self.write("dark.yaml", CONFIG.replace("builtin: cornell\n  " + CAMERA, "builtin: thin_wall").replace("grey", "white"))
        self.assertIn("warning: dark.yaml:2: scene.camera: ", self.expect(0, "validate", "dark.yaml").stderr)

    def test_a_profiles_mistake_leaves_nothing_valid(self):
        self.write("mine.yaml", CONFIG.replace("smaller: {image:", "smaller: {imgae:"))
        self.assertEqual(self.expect(2, "validate", "mine.yaml").stdout, "")

    def test_mistakes_on_the_command_line(self):
        self.write("mine.yaml", CONFIG)
        self.write("sponza.glb", "")
        for name, line in (("'--dry-run'", "run mine.yaml --dryrun"), ("'--profile'", "run mine.yaml --profil=x"),
                           ("'--out'", "run mine.yaml -o x"), ("--out DIR", "run mine.yaml --set output=x"),
                           ("voxray devices --help", "devices x"), ("voxray run --help", "run mine.yaml --spp 4"),
                           ("SCENE", "scene"), ("RESULTS", "pareto"), ("voxray run mine.yaml", "mine.yaml"),
                           ("'mine.yaml'", "run mime.yaml"), ("'mine.yaml'", "compare mime.yaml mine.yaml"),
                           ("'./voxray scene room.glb --write-config room.yaml'", "run room.glb"),
                           ("'./voxray scene room.glb --write-config room.yaml'", "validate room.glb"),
                           ("nowhere", "run mine.yaml --scenes nowhere"), ("'sponza.glb'", "scene sponzaa --scenes ."),
                           ("'sponza.glb'", "scene sponza --scenes ."), (".png", "scene cornell --picture x.jpg"),
                           (".glb", "export-scene mine.yaml x.gltf"), ("'smaller'", "run mine.yaml --profile smallest --out out")):
            with self.subTest(line):
                self.assertIn(name, self.expect(2, *line.split()).stderr)

    def test_the_config_without_a_mistake(self):
        self.write("mine.yaml", CONFIG)
        self.assertEqual(self.expect(0, "validate", "mine.yaml").stderr, "")


if __name__ == "__main__":
    unittest.main()
