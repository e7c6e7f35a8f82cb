"""Mistakes that newcomers make in configs: each is stopped before anything is rendered, with file, line and a way out."""
import os
import unittest

from mistakes import CAMERA, CONFIG, MISTAKES
from support import CommandTest
from suspicions import WARNINGS


class Mistakes(CommandTest):
    def test_each_is_stopped_where_it_stands(self):
        for what, (right, wrong, line, words) in MISTAKES.items():
            with self.subTest(what):
                self.assertIn(right, CONFIG)
                self.write("mine.yaml", CONFIG.replace(right, wrong, 1))
                error = self.expect(2, "run", "mine.yaml", "--out", "out").stderr
                self.assertIn(f"mine.yaml:{line}: ", error)
                self.assertIn(words, error)
                self.assertFalse(os.path.exists(self.path("out")), "a bad config leaves no results folder")

    def test_what_may_be_meant_is_warned_of(self):
        for what, (right, other, line, words) in WARNINGS.items():
            with self.subTest(what):
                self.assertIn(right, CONFIG)
                self.write("mine.yaml", CONFIG.replace(right, other, 1))
                warnings = self.expect(0, "validate", "mine.yaml").stderr.splitlines()
                said = [warning for warning in warnings if words in warning and "(with --profile smaller)" not in warning]
                self.assertEqual(len(said), 1, warnings)
                self.assertTrue(said[0].startswith(f"voxray: warning: mine.yaml:{line}: "), said)

    def test_a_dark_view_is_warned_of(self):
        # A room that light must not leak into
        self.write("dark.yaml", CONFIG.replace("builtin: cornell\n  " + CAMERA, "builtin: thin_wall").replace("grey", "white"))
        error = self.expect(0, "validate", "dark.yaml").stderr
        self.assertIn("warning: dark.yaml:2: scene.camera: no light was found in its view", error)

    def test_a_profiles_mistake_leaves_nothing_valid(self):
        self.write("mine.yaml", CONFIG.replace("smaller: {image:", "smaller: {imgae:"))
        self.assertEqual(self.expect(2, "validate", "mine.yaml").stdout, "")

    def test_mistakes_on_the_command_line(self):
        self.write("mine.yaml", CONFIG)
        self.write("sponza.glb", "")
        for words, *arguments in (("unknown option '--dryrun'; did you mean '--dry-run'?", "run", "mine.yaml", "--dryrun"),
                                  ("unknown option '--profil'; did you mean '--profile'?", "run", "mine.yaml", "--profil=x"),
                                  ("unknown option '-o'; did you mean '--out'?", "run", "mine.yaml", "-o", "x"),
                                  ("it is said on the command line: --out DIR", "run", "mine.yaml", "--set", "output=x"),
                                  ("unknown argument 'x'; see voxray devices --help", "devices", "x"),
                                  ("unknown option '--spp'; see voxray run --help", "run", "mine.yaml", "--spp", "4"),
                                  ("SCENE is required; see voxray scene --help", "scene"),
                                  ("RESULTS is required; see voxray pareto --help", "pareto"),
                                  ("to render a config, write: voxray run mine.yaml", "mine.yaml"),
                                  ("did you mean 'mine.yaml'?", "run", "mime.yaml"),
                                  ("room.glb: a scene, not a config; './voxray scene room.glb --write-config room.yaml' writes one", "run", "room.glb"),
                                  ("'./voxray scene room.glb --write-config room.yaml'", "validate", "room.glb"),
                                  ("did you mean 'mine.yaml'?", "compare", "mime.yaml", "mine.yaml"),
                                  ("--scenes: Directory does not exist: nowhere", "run", "mine.yaml", "--scenes", "nowhere"),
                                  ("no built-in scene 'sponzaa'; did you mean 'sponza.glb'?", "scene", "sponzaa", "--scenes", "."),
                                  ("no built-in scene 'sponza'; did you mean 'sponza.glb'?", "scene", "sponza", "--scenes", "."),
                                  ("'x.jpg' does not end in .png", "scene", "cornell", "--picture", "x.jpg"),
                                  ("'x.gltf' does not end in .glb", "export-scene", "mine.yaml", "x.gltf")):
            with self.subTest(arguments):
                self.assertIn(words, self.expect(2, *arguments).stderr)

    def test_the_config_without_a_mistake(self):
        self.write("mine.yaml", CONFIG)
        self.assertEqual(self.expect(0, "validate", "mine.yaml").stderr, "")
        self.assertIn("did you mean 'smaller'?",
                      self.expect(2, "run", "mine.yaml", "--profile", "smallest", "--out", "out").stderr)


if __name__ == "__main__":
    unittest.main()
