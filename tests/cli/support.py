"""What the command-line tests share: the program, a folder of their own, configs small enough for seconds."""
import csv
import json
import os
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["VOXRAY_PROGRAM"]
SOURCE = os.environ["VOXRAY_SOURCE"]
CACHE = os.environ.get("VOXRAY_CACHE")

# Two variants of the whole first chain.
TINY = """\
name: tiny
scene: {builtin: cornell}
image: {width: 32, height: 24}
seed: 7
graph:
  - {pass: gbuffer}
  - {pass: voxelize, resolution: 16}
  - {pass: inject_light_rays, id: inject, rays_per_light: 4096, bounces: 2}
  - {pass: direct_shadow_rays}
  - {pass: gather_irradiance}
  - {pass: composite}
reference: {pass: path_trace, spp: 8, bounces: 2}
sweep:
  voxelize.resolution: [8, 16]
measure: {frames: 2, warmup: 1}
profiles:
  smaller: {image: {width: 16, height: 12}, reference.spp: 2}
"""


class CommandTest(unittest.TestCase):
    """Each test runs in a folder of its own; SPIR-V and references are cached for all of them together."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="voxray-cli-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.environment = dict(os.environ)
        self.environment.pop("VOXRAY_SCENES", None)

    def use_own_references(self, name):
        """References from here on are cached in a folder of the test."""
        os.makedirs(self.path(name))
        if CACHE:
            os.symlink(os.path.join(CACHE, "spirv"), self.path(name, "spirv"))
        self.environment["VOXRAY_CACHE"] = self.path(name)

    def take_drivers_away(self):
        """No Vulkan device from here on."""
        for name in ("VK_DRIVER_FILES", "VK_ICD_FILENAMES"):
            self.environment[name] = self.path("none.json")

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def voxray(self, *arguments, **options):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, env=self.environment, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, **options)

    def expect(self, status, *arguments, **options):
        """Runs the program and checks its exit status; an error is one line, with the program's name before it."""
        done = self.voxray(*arguments, **options)
        said = f"voxray {' '.join(arguments)}\n-- stdout:\n{done.stdout}\n-- stderr:\n{done.stderr}"
        self.assertEqual(done.returncode, status, said)
        errors = [line for line in done.stderr.splitlines() if "error" in line.lower()]
        if status == 2:
            self.assertEqual(len(errors), 1, said)
            self.assertTrue(errors[0].startswith("voxray: error: "), said)
        self.assertNotIn("terminate called", done.stderr)
        return done

    def metrics(self):
        """Names of all metrics, in the order of their table."""
        schema = json.loads(self.expect(0, "schema").stdout)
        return schema["properties"]["measure"]["properties"]["metrics"]["items"]["enum"]

    def start_until(self, ready, *arguments, through=(), **options):
        """Starts the program and returns it once ready() is true. Fails where it ends before that.

        @param through words of a command that becomes the program"""
        process = subprocess.Popen([*through, PROGRAM, *arguments], cwd=self.folder, env=self.environment,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   stdin=subprocess.DEVNULL, **options)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        while not ready():
            if process.poll() is not None:
                self.fail(f"ended before it was to be interrupted:\n{process.communicate()[1]}")
            time.sleep(0.01)
        return process

    def rows(self, *parts):
        with open(self.path(*parts), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def json(self, *parts):
        with open(self.path(*parts), encoding="utf-8") as file:
            return json.load(file)

    def files(self, *parts):
        """All files below a folder, relative to it."""
        top = self.path(*parts)
        return sorted(os.path.relpath(os.path.join(folder, name), top)
                      for folder, _, names in os.walk(top) for name in names)

    def bytes(self, *parts):
        with open(self.path(*parts), "rb") as file:
            return file.read()
