#!/usr/bin/env bash
# A sweep on Slurm, for real: installs Slurm's daemons from Debian, starts a cluster of this one machine on the loopback,
# runs tests/scale/slurm_test.py there and stops it again. Not part of ./voxray test.
set -euo pipefail

root=$(realpath "$(dirname "$(readlink -f "$0")")/../..")
[ "${VOXRAY_SKIP_SETUP:-0}" = 1 ] || "$root/scripts/setup-debian.sh" slurm
"$root/voxray" --version
cd "$root/tests/scale"
export VOXRAY_PROGRAM=$root/build/release/bin/voxray VOXRAY_SOURCE=$root PYTHONDONTWRITEBYTECODE=1
PYTHONPATH=$root/tests/cli exec /usr/bin/python3 -m unittest -v slurm_test
