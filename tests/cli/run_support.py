"""Runs of TINY, for the tests of `voxray run`."""
import functools
import os
import re
import shutil
import subprocess
import tempfile

from support import PROGRAM, TINY, CommandTest

VARIANTS = ["resolution-8", "resolution-16"]


@functools.cache
def finished_run():
    """A folder with a finished run of TINY in 'out'; made once, for copies of it."""
    folder = tempfile.TemporaryDirectory(prefix="voxray-cli-")
    with open(os.path.join(folder.name, "tiny.yaml"), "w", encoding="utf-8") as file:
        file.write(TINY)
    subprocess.run([PROGRAM, "run", "tiny.yaml", "--out", "out", "--no-report"], cwd=folder.name, check=True,
                   capture_output=True)
    return folder


class Run(CommandTest):
    def run_tiny(self, out="out", *more, report=False):
        self.write("tiny.yaml", TINY)
        return self.expect(0, "run", "tiny.yaml", "--out", out, *more, *([] if report else ["--no-report"]))

    def copy_finished_run(self, out="out"):
        self.write("tiny.yaml", TINY)
        shutil.copytree(os.path.join(finished_run().name, "out"), self.path(out))

    def header(self, *parts):
        return self.bytes(*parts).split(b"\n")[0].decode().strip().split(",")

    def marker(self, variant, out="out"):
        return self.path(out, "images", variant, "result.json")

    def check_whole(self, out="out"):
        """Whatever lies in a results folder is whole: no temporary files, no variant without its result."""
        self.assertEqual([name for name in self.files(out) if re.search(r"\.(tmp|part)|~$|(^|/)\.", name)], [])
        for row in self.rows(out, "results.csv") if os.path.exists(self.path(out, "results.csv")) else []:
            if row["status"] != "ok":
                continue
            for name in ("final.exr", "indirect.exr", "final.png", "flip.png", "result.json"):
                self.assertTrue(os.path.getsize(self.path(out, "images", row["variant"], name)) > 0, row["variant"])
            self.assertTrue(all(row[column] for column in ("build_ms", "nrmse", "indirect_nrmse")), row)
