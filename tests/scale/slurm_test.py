"""`voxray sweep --slurm` on a cluster of this machine: the same results as a run, whatever happens to jobs, controller and disk."""
import errno
import glob
import os
import signal
import subprocess
import time
import unittest

import parts_test
from loopback_cluster import CPUS, LoopbackCluster
from support import PROGRAM

ENGINE = ("--", "--max-status-checks-per-second", "1", "--latency-wait", "5")
SLOW = ("--set", "reference.spp=16384", "--set", "sweep.voxelize.resolution=[8, 10, 12, 14, 16, 18]",
        "--set", "measure.frames=40")
FEW = ("--set", "sweep.voxelize.resolution=[8, 12]")


def parts_at_work():
    """Process ids by part, of this program's `run --part`."""
    found = {}
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/cmdline", "rb") as file:
                words = file.read().decode(errors="replace").split("\0")
        except OSError:  # It has ended.
            continue
        if words[0] == PROGRAM and "--part" in words:
            found[words[words.index("--part") + 1]] = int(process)
    return found


class SweepOnSlurm(parts_test.Parts):
    def setUp(self):
        super().setUp()
        os.makedirs(self.path("slurm"))
        self.cluster = LoopbackCluster(self.path("slurm"))
        self.addCleanup(self.cluster.close)

    def start(self, changes, *options):
        """A run into `whole`, then a sweep into `out`, which goes on. @param changes of the config, of both"""
        self.expect(0, "run", "tiny.yaml", *changes, "--out", "whole")
        self.environment |= self.cluster.environment | {"VOXRAY_CACHE": self.path("other-cache")}
        with open(self.path("engine.log"), "w", encoding="utf-8") as log:
            engine = subprocess.Popen([PROGRAM, "sweep", "tiny.yaml", *changes, "--out", "out", "--slurm", "--partition", "loopback",
                                       *options, *ENGINE], cwd=self.folder, env=self.environment, stdout=log, stderr=log)
        self.addCleanup(engine.wait)
        self.addCleanup(engine.kill)
        return engine

    def engine_log(self):
        with open(self.path("engine.log"), encoding="utf-8") as file:
            return file.read()

    def watch(self, engine, seen):
        """Calls seen(running jobs) until the engine ends, which must be well."""
        while engine.poll() is None:
            seen(self.cluster.running())
            time.sleep(0.2)
        said = self.engine_log()
        self.assertEqual(engine.poll(), 0, said + self.cluster.log("slurmctld") + self.cluster.log("slurmd"))

    def test_kills_requeues_and_a_restarted_controller(self):
        engine = self.start(SLOW, "--untimed", "--reference-parts", "4", "--jobs", "8", "--retries", "3")
        at_once, done = [], []

        def disturb(running):
            at_once.append(len(running))
            at_work = parts_at_work()
            if "kill" not in done and any(part.startswith("reference.") for part in at_work):
                os.kill(next(pid for part, pid in at_work.items() if part.startswith("reference.")), signal.SIGKILL)
                done.append("kill")
            elif "requeue" not in done and any("variant" in name for _, name in running):
                job = next(job for job, name in running if "variant" in name)
                subprocess.run(["scontrol", "requeue", job], env=self.cluster.all_environment(), check=True)
                done.append("requeue")
            elif "requeue" in done and "restart" not in done and running:
                self.cluster.restart_controller(3)
                done.append("restart")

        self.watch(engine, disturb)
        self.assertEqual(done, ["kill", "requeue", "restart"])
        self.assertEqual(max(at_once), CPUS)
        self.check_same("whole", "out")

    def test_timed_variants_have_the_node_for_themselves(self):
        engine = self.start(SLOW, "--reference-parts", "2")
        largest = {"reference": 0, "timed_variant": 0}

        def count(running):
            for rule in largest:
                jobs = [name for _, name in running if rule in name]
                if jobs:
                    largest[rule] = max(largest[rule], len(running))

        self.watch(engine, count)
        self.assertEqual(largest["timed_variant"], 1)
        self.check_same("whole", "out")

    @unittest.skipUnless(os.geteuid() == 0, "only root may mount the small disk that it needs")
    def test_a_full_disk_in_one_job(self):
        images = self.path("out", "images")
        os.makedirs(images)
        subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "voxray-test", images], check=True)
        self.addCleanup(subprocess.run, ["umount", "--lazy", images], check=True)
        filler, failed = os.path.join(images, "filler"), []
        engine = self.start(FEW, "--untimed", "--reference-parts", "2", "--jobs", "1", "--retries", "3")

        def fill_until_a_job_fails(running):
            if failed or not running:
                return
            if not os.path.exists(filler):
                fill(filler)
            for log in glob.glob(self.path("out", "parts", "sweep", "logs", "*.log")):
                with open(log, encoding="utf-8") as file:
                    if "disk full" in file.read():
                        failed.append(os.path.basename(log))
            if failed:
                os.remove(filler)

        self.watch(engine, fill_until_a_job_fails)
        self.assertEqual(len(failed), 1, self.engine_log())
        self.assertEqual(self.engine_log().count("Trying to restart job"), 1, self.engine_log())
        self.check_same("whole", "out")


def fill(path):
    """Writes a file as long as its disk has room."""
    with open(path, "wb", buffering=0) as file:
        try:
            while True:
                file.write(bytes(4096))
        except OSError as error:
            if error.errno != errno.ENOSPC:
                raise


if __name__ == "__main__":
    unittest.main()
