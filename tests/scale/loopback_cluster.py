"""Slurm on the loopback: one controller, one node, munge, all in one folder and of this user, for a test."""
import os
import socket
import subprocess
import time

CONFIG = """\
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=batch_sched_delay=0,sched_interval=1
JobRequeue=1
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={megabytes} State=UNKNOWN
PartitionName=loopback Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""
CPUS = 2


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


class LoopbackCluster:
    """Starts the daemons; close() ends them. `environment` is what Slurm's commands want to find it."""

    def __init__(self, folder):
        self.folder, self.daemons = folder, {}
        for name in ("state", "spool"):
            os.makedirs(os.path.join(folder, name))
        megabytes = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2**20
        self.config = os.path.join(folder, "slurm.conf")
        with open(self.config, "w", encoding="utf-8") as file:
            file.write(CONFIG.format(folder=folder, host=socket.gethostname().partition(".")[0], port=free_port(),
                                     node_port=free_port(), user=subprocess.check_output(["id", "-un"], text=True).strip(),
                                     cpus=CPUS, megabytes=megabytes * 9 // 10))
        with open(os.path.join(folder, "cgroup.conf"), "w", encoding="utf-8") as file:
            file.write("CgroupPlugin=cgroup/v1\n")
        self.environment = {"SLURM_CONF": self.config}
        key = os.path.join(folder, "munge.key")
        with open(os.open(key, os.O_WRONLY | os.O_CREAT, 0o600), "wb") as file:
            file.write(os.urandom(128))
        self.start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={folder}/munge.socket",
                   f"--pid-file={folder}/munged.pid", f"--seed-file={folder}/munge.seed", f"--log-file={folder}/munged.log")
        self.wait(lambda: os.path.exists(os.path.join(folder, "munge.socket")), "munged")
        self.start("slurmctld", "-D", "-f", self.config)
        self.start("slurmd", "-D", "-f", self.config)
        self.wait(lambda: "idle" in self.ask("sinfo", "-h", "-o", "%T"), "a node that is idle")

    def start(self, name, *arguments):
        with open(os.path.join(self.folder, f"{name}.out"), "ab") as out:
            self.daemons[name] = subprocess.Popen([name, *arguments], env=self.all_environment(), stdin=subprocess.DEVNULL,
                                                  stdout=out, stderr=out)

    def restart_controller(self, pause):
        """Ends it, so that it saves its state, and starts it again after some seconds."""
        self.daemons["slurmctld"].terminate()
        self.daemons["slurmctld"].wait()
        time.sleep(pause)
        self.start("slurmctld", "-D", "-f", self.config)

    def all_environment(self):
        path = os.environ.get("PATH", "")
        return dict(os.environ, PATH=f"{path}:/usr/sbin:/sbin", **self.environment)

    def ask(self, *command):
        """What a command of Slurm says; "" where it fails."""
        done = subprocess.run(command, env=self.all_environment(), capture_output=True, text=True)
        return done.stdout if done.returncode == 0 else ""

    def running(self):
        """(job id, name) of the jobs that run."""
        lines = self.ask("squeue", "-h", "-t", "RUNNING", "-o", "%i %j").splitlines()
        return [tuple(line.split(None, 1)) for line in lines]

    def wait(self, ready, what):
        while not ready():
            if any(daemon.poll() is not None for daemon in self.daemons.values()):
                logs = "".join(self.log(name) for name in self.daemons)
                self.close()
                raise RuntimeError(f"no {what}\n{logs}")
            time.sleep(0.2)

    def log(self, name):
        text = f"-- {name}\n"
        for ending in ("out", "log"):
            path = os.path.join(self.folder, f"{name}.{ending}")
            if os.path.exists(path):
                with open(path, encoding="utf-8", errors="replace") as file:
                    text += file.read()[-3000:]
        return text

    def close(self):
        for name in ("slurmd", "slurmctld", "munged"):
            if name in self.daemons:
                self.daemons[name].kill()
                self.daemons[name].wait()
