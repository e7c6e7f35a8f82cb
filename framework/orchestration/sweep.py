"""`voxray sweep`: has Snakemake run the parts of an experiment, here or on other machines.

Its workflow lies in parts/sweep of the results folder: plan.json, Snakefile, done/ with an empty file for each part that is
done, logs/."""

from __future__ import annotations

import fcntl
import json
import os
import pwd
import shlex
import shutil
import struct
from pathlib import Path
from types import SimpleNamespace

from orchestration.errors import Failed, UsageError
from orchestration.program import Program

ENGINE = "snakemake"
SNAKEFILE = Path(__file__).resolve().parent / "Snakefile"
LATENCY_S = "60"  # for which a network file system may hide a new file
_FLOCK = "@hhqqi"  # struct flock: type, whence, start, length, process


def lock(path: Path, results: Path) -> int:
    """Keeps other engines away until this process, or the one that it becomes, ends. @return the file's descriptor

    A lock as framework/base/process_lock.h makes it, which works over network file systems."""
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
    try:
        fcntl.lockf(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError) as error:
        asked = struct.pack(_FLOCK, fcntl.F_WRLCK, os.SEEK_SET, 0, 0, 0)
        holder = struct.unpack(_FLOCK, fcntl.fcntl(descriptor, fcntl.F_GETLK, asked))[4]
        raise UsageError(f"{results}: process {holder} is writing results there; wait until it ends or choose another folder "
                         "with --out") from error
    return descriptor


def reference_parts(options: SimpleNamespace, plan: dict) -> int:
    if options.reference_parts:
        return int(options.reference_parts)
    samples = (plan["reference"] or {}).get("spp", 1)
    return min(samples, int(options.cores or 1))


def plan_of(options: SimpleNamespace, program: Program, out: Path, jobs: list[dict]) -> dict:
    """What the Snakefile needs to know."""
    slurm = {"slurm_partition": options.partition, "slurm_account": options.account}
    return {"program": options.program or shlex.quote(program.path), "arguments": program.part_words(options.config),
            "out": str(out), "from": os.getcwd(), "timed": not options.untimed,
            "cores": int(options.cores) if options.cores else None, "threads": int(options.threads),
            "paths_per_second": float(options.paths_per_second), "seconds_per_run": float(options.seconds_per_run),
            "slurm": {key: value for key, value in slurm.items() if value}, "jobs": jobs}


def write_workflow(folder: Path, out: Path, plan: dict) -> int:
    """Parts whose result isn't there count as not done, whatever an earlier workflow left; the merge is always to be done.
    @return the descriptor of the lock"""
    (folder / "done").mkdir(parents=True, exist_ok=True)
    held = lock(folder / ".lock", out)
    for job in plan["jobs"]:
        if job["kind"] == "merge" or not (out / job["writes"]).exists():
            (folder / "done" / job["id"]).unlink(missing_ok=True)
    shutil.copyfile(SNAKEFILE, folder / "Snakefile")
    (folder / "plan.json").write_text(json.dumps(plan, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return held


def engine_words(options: SimpleNamespace, folder: Path) -> list[str]:
    """The engine's command line. A mark is touched once its part is done, so it is whole, and its age tells nothing."""
    words = [ENGINE, "--snakefile", str(folder / "Snakefile"), "--directory", str(folder), "--nolock", "--rerun-incomplete",
             "--rerun-triggers", "mtime", "--drop-metadata", "--scheduler", "greedy", "--keep-going",
             "--retries", options.retries, "--show-failed-logs", "--quiet", "rules"]
    if options.cores:
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") >> 20
        words += ["--cores", options.cores, "--resources", f"mem_mb={memory}"]
    elif options.slurm:
        words += ["--slurm", "--jobs", options.jobs, "--latency-wait", LATENCY_S]
    else:
        words += ["--profile", options.snakemake_profile, "--latency-wait", LATENCY_S]
    return words + options.snakemake


def main(program: Program, options: SimpleNamespace) -> int:
    """Hands over to the engine, which runs the program for each part; returns only to print its command line."""
    if sum(map(bool, (options.cores, options.slurm, options.snakemake_profile))) != 1:
        raise UsageError("sweep: say where it runs, by one of --cores, --slurm and --snakemake-profile")
    plan = program.plan(options.config)
    out = Path.cwd() / (options.out or f"results/{plan['name']}")
    folder = out / "parts" / "sweep"
    jobs = program.jobs(options.config, ["--claim", str(out), "--reference-parts", str(reference_parts(options, plan))])
    held = write_workflow(folder, out, plan_of(options, program, out, jobs))
    words = engine_words(options, folder)
    if options.print:
        (folder / ".lock").unlink()
        print(" ".join("'" + word.replace("'", "'\\''") + "'" for word in words))
        return 0

    # Its executor for Slurm wants to know whose jobs it looks for
    os.environ.setdefault("USER", pwd.getpwuid(os.geteuid()).pw_name)
    os.set_inheritable(held, True)
    try:
        os.execvp(ENGINE, words)
    except FileNotFoundError:
        raise Failed(f"{ENGINE} is not installed; on Debian, scripts/setup-debian.sh sweep installs it") from None
