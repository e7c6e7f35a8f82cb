"""What other programs ask: `voxray plan`, `--only`, and commands that the program hands over to Python."""
import json
import os
import pty
import signal
import subprocess
import unittest

from stability_test import OWN_MATRIX
from support import PROGRAM, TINY, CommandTest

SWAPS = TINY.replace("sweep:\n  voxelize.resolution: [8, 16]\n", "sweep:\n  voxelize.resolution: [8, 16]\n"
                     "  gather_irradiance: {lookup: gather_irradiance, nothing: [{pass: path_trace, spp: 1, light: indirect}]}\n")


class Plan(CommandTest):
    def plan(self, config, *arguments):
        self.write("tiny.yaml", config)
        return json.loads(self.expect(0, "plan", "tiny.yaml", *arguments).stdout)

    def test_what_a_config_asks_for(self):
        plan = self.plan(TINY, "--set", "seed=9")
        self.assertEqual((plan["name"], plan["place"], plan["profiles"]), ("tiny", "tiny.yaml:1", ["smaller"]))
        self.assertEqual(plan["config"]["seed"], 9)
        self.assertEqual((plan["reference"]["spp"], plan["reference"]["light"]), (8, "all"))
        self.assertEqual(plan["axes"], [{"path": "voxelize.resolution", "place": "tiny.yaml:14"}])
        self.assertEqual([variant["name"] for variant in plan["variants"]], ["resolution 8", "resolution 16"])
        self.assertEqual([variant["id"] for variant in plan["variants"]], ["resolution-8", "resolution-16"])
        self.assertIn("indirect_nrmse", plan["columns"])
        for variant, resolution in zip(plan["variants"], (8, 16)):
            self.assertEqual(variant["values"], [str(resolution)])
            self.assertEqual(variant["config"]["graph"][1], {"pass": "voxelize", "resolution": resolution})
            self.assertEqual(variant["places"][:2], ["tiny.yaml:6", "tiny.yaml:7"])
            self.assertNotIn("sweep", variant["config"])
        self.assertIsNone(self.plan(TINY, "--set", "reference=null")["reference"])
        self.assertIn("'smaller'", self.expect(2, "plan", "tiny.yaml", "--profile", "small").stderr)

    def test_passes_that_nothing_needs_are_told(self):
        left_out = {variant["values"][1]: variant["left_out"] for variant in self.plan(SWAPS)["variants"]}
        self.assertEqual(left_out["lookup"], [])
        self.assertIn("inject", left_out["nothing"])


class Only(CommandTest):
    def test_values_that_stay(self):
        self.write("tiny.yaml", SWAPS)
        names = lambda *choices: [variant["name"] for variant in json.loads(self.expect(
            0, "plan", "tiny.yaml", *(word for choice in choices for word in ("--only", choice))).stdout)["variants"]]
        self.assertEqual(len(names()), 3)
        self.assertEqual(names("voxelize.resolution=16", "gather_irradiance=lookup"), ["resolution 16, lookup"])
        # Passes that other values need are no mistake
        one = ("validate", "tiny.yaml", "--set", "sweep.voxelize.resolution=null")
        self.assertIn("is never run", self.expect(0, *one, "--set", "sweep.gather_irradiance=[{pass: path_trace, spp: 1, light: indirect}]").stderr)
        self.assertNotIn("is never run", self.expect(0, *one, "--only", "gather_irradiance=nothing").stderr)

    def test_mistakes(self):
        self.write("tiny.yaml", TINY)
        for choice, said in (("voxelize.resolution", "AXIS=VALUE"), ("voxelize.resolution=9", "'8'"),
                             ("voxelize.resoluton=8", "'voxelize.resolution'")):
            self.assertIn(said, self.expect(2, "run", "tiny.yaml", "--dry-run", "--only", choice).stderr)


class Interrupts(CommandTest):
    """A command in Python ends as the run that it waits for does."""

    def setUp(self):
        super().setUp()
        self.environment["VOXRAY_CACHE"] = self.path("cache")
        self.write("own.yaml", OWN_MATRIX.replace("spp: 16", "spp: 1048576"))
        self.write("own.csv", "profile,scene,measure,methods,limit,scale,why\nplain,cornell,energy,,0,,\n")
        self.words = ["stability", "--config", "own.yaml", "--tracer", "embree", "--out", "out"]

    def is_rendering(self):
        return os.path.exists(self.path("out", "plain", "manifest.json"))

    def test_by_another_process(self):
        process = self.start_until(self.is_rendering, *self.words)
        process.send_signal(signal.SIGINT)
        self.check_end(process.wait(), process.stderr.read())

    def test_by_a_terminal(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        # The first to open a terminal in a session of its own is the one that Ctrl-C goes to
        line = f"exec <{os.ttyname(theirs)}; exec \"$@\""
        process = self.start_until(lambda: True, *self.words, through=["sh", "-c", line, "sh"], start_new_session=True)
        while not self.is_rendering():
            self.assertIsNone(process.poll())
        os.write(ours, b"\x03")
        self.check_end(process.wait(), process.stderr.read())
        os.close(theirs)

    def check_end(self, status, said):
        self.assertEqual(status, 130, said)
        self.assertEqual(said.count("finished variants are kept in out/plain, --resume goes on"), 1, said)
        self.assertNotIn("Traceback", said)
        listed = subprocess.run(["ps", "-eo", "args"], stdout=subprocess.PIPE, text=True, check=True).stdout
        self.assertFalse([line for line in listed.splitlines() if line.startswith(PROGRAM) and self.folder in line])


if __name__ == "__main__":
    unittest.main()
