"""Runs on disks that refuse: folders that can't be written, and full disks."""
import os
import resource
import shutil
import signal
import subprocess
import unittest

from run_support import Run
from support import PROGRAM, TINY


class Disk(Run):
    def test_unwritable_folder(self):
        self.write("file", "")
        self.write("tiny.yaml", TINY)
        done = self.expect(2, "run", "tiny.yaml", "--out", "file/out")
        self.assertIn("file/out", done.stderr)
        self.assertEqual(self.bytes("file"), b"")

    def test_unwritable_cache(self):
        self.write("file", "")
        self.environment["VOXRAY_CACHE"] = self.path("file", "cache")
        said = self.run_tiny().stderr
        self.assertEqual(said.count("are not cached"), 1, said)
        self.assertIn("file/cache: Not a directory", said)
        self.assertEqual([row["status"] for row in self.rows("out", "results.csv")], ["ok", "ok"])

    def test_full_disk_loses_no_finished_variant(self):
        self.copy_finished_run()
        before = {name: self.bytes("out", name) for name in self.files("out") if name.startswith("images/resolution-8/")}
        shutil.rmtree(self.path("out", "images", "resolution-16"))
        os.remove(self.path("out", "results.csv"))

        # No file may grow beyond 2 KiB: every larger one fails in the center of being written.
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (2048, 2048))

        done = self.expect(1, "run", "tiny.yaml", "--out", "out", "--resume", preexec_fn=limit, restore_signals=False)
        self.assertIn("voxray: error: ", done.stderr)
        self.assertIn("1 of 2 variants kept; there is no room for a report of them; --resume goes on", done.stderr)
        self.assertEqual({name: self.bytes("out", name) for name in before}, before)
        self.check_whole()

        self.run_tiny("out", "--resume")
        self.assertEqual([row["status"] for row in self.rows("out", "results.csv")], ["ok", "ok"])
        self.check_whole()

    def test_full_disk_is_told_with_what_is_kept(self):
        self.write("tiny.yaml", TINY.replace("[8, 16]", "[4, 5, 6, 7, 8, 9, 10, 11]"))
        os.mkdir(self.path("out"))
        for size, kept in (("300k", r", [1-7] of 8 variants kept; (report: out/report.html|there is no room for a report of them)"
                                    "; --resume goes on"), ("32k", ", 0 of 8 variants kept$")):
            # A disk of that size, which goes with the process; without the right to mount nothing is to be told
            script = f'mount -t tmpfs -o size={size} tmpfs out || exit 77; "$0" "$@"'
            done = subprocess.run(["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", script, PROGRAM, "run",
                                   "tiny.yaml", "--out", "out"], cwd=self.folder, env=self.environment,
                                  capture_output=True, text=True)
            if done.returncode == 77 or done.stderr.startswith("unshare:"):
                return
            with self.subTest(size):
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertRegex(done.stderr.strip().splitlines()[-1], r"^voxray: error: disk full: out(/\S+)?" + kept)


if __name__ == "__main__":
    unittest.main()
