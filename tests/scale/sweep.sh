#!/usr/bin/env bash
# Sweeps on Snakemake, on this machine: against a run, and through kills of the engine and of its jobs
# (VOXRAY_SWEEP_KILLS, 3). Installs Snakemake from Debian. Not part of ./voxray test, for Snakemake brings 70 packages.
set -euo pipefail

root=$(realpath "$(dirname "$(readlink -f "$0")")/../..")
[ "${VOXRAY_SKIP_SETUP:-0}" = 1 ] || "$root/scripts/setup-debian.sh" sweep
"$root/voxray" --version
cd "$root/tests/scale"
export VOXRAY_PROGRAM=$root/build/release/bin/voxray VOXRAY_SOURCE=$root PYTHONDONTWRITEBYTECODE=1
PYTHONPATH=$root/tests/cli exec /usr/bin/python3 -m unittest -v sweep_test
