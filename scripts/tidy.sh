#!/usr/bin/env bash
# Runs clang-tidy 14 (.clang-tidy) on the named sources, or on all of the framework and the passes.
# Wants a configured build/release (any ./voxray command makes it). Exit status 77: clang-tidy is not installed.
set -euo pipefail

cd "$(dirname "$(readlink -f "$0")")/.."
build=${VOXRAY_BUILD:-build/release}
program=$(command -v clang-tidy-14) || { echo "clang-tidy-14 is not installed; Debian 12 has it, and versions differ in what they find"; exit 77; }
[ -f "$build/compile_commands.json" ] || { echo "voxray: error: no $build/compile_commands.json: build first" >&2; exit 1; }

files=("$@")
if [ ${#files[@]} -eq 0 ]; then
  mapfile -t files < <(find framework passes -name '*.cpp' | sort)
fi
# GCC's precompiled headers mean nothing to clang.
database=$(mktemp -d)
trap 'rm -rf "$database"' EXIT
sed -E 's/ -include [^ ]*cmake_pch\.hxx//g' "$build/compile_commands.json" >"$database/compile_commands.json"

# GCC knows warnings that clang doesn't; clang-tidy's own count of hidden warnings is noise.
printf '%s\0' "${files[@]}" |
  xargs -0 -n 4 -P "$(getconf _NPROCESSORS_ONLN)" "$program" -p "$database" --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option 2> >(grep -v 'warnings generated\|^Suppressed\|^Use -header' >&2)
