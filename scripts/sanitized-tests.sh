#!/usr/bin/env bash
# The scene loader over mutated files under AddressSanitizer and UndefinedBehaviorSanitizer: a build of that layer
# alone, beside the release build. (The config reader's test carries its sanitizers in every build.)
# sanitized-tests.sh [build]: builds it, and runs it unless told to build only.
set -euo pipefail

program=tests_scene_mutation
root=$(dirname "$(dirname "$(readlink -f "$0")")")
build=$root/build/sanitize
log=$build/build.log

mkdir -p "$build"
exec 9>"$build/.lock"
flock 9
if [ -t 2 ]; then echo "voxray: building the sanitized tests" >&2; fi
# Lightly optimized: with sanitizers the compiler takes longer than the test.
{ [ -f "$build/build.ninja" ] ||
  (cd "$root" && cmake --preset sanitize -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1"); } >"$log" 2>&1 9>&- &&
  cmake --build "$build" --target "$program" >>"$log" 2>&1 9>&- || {
  tail -n 40 "$log" >&2
  echo "voxray: error: the sanitized build failed (whole log: $log)" >&2
  exit 1
}
exec 9>&-

if [ "${1:-run}" = build ]; then exit 0; fi
export ASAN_OPTIONS=detect_stack_use_after_return=1
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
exec "$build/tests/$program"
