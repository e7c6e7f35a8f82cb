#!/usr/bin/env bash
# Loader and config reader over mutated files under AddressSanitizer and UndefinedBehaviorSanitizer: a build of
# those layers alone, beside the release build.
# sanitized-tests.sh build: builds the programs. sanitized-tests.sh run PROGRAM: builds and runs one.
set -euo pipefail

programs=(tests_scene_mutation tests_config_mutation)
root=$(dirname "$(dirname "$(readlink -f "$0")")")
build=$root/build/sanitize
log=$build/build.log

build_programs() {
  mkdir -p "$build"
  exec 9>"$build/.lock"
  flock 9
  if [ -t 2 ]; then echo "voxray: building the sanitized tests" >&2; fi
  { [ -f "$build/build.ninja" ] || (cd "$root" && cmake --preset sanitize); } >"$log" 2>&1 9>&- &&
    cmake --build "$build" --target "${programs[@]}" >>"$log" 2>&1 9>&- || {
    tail -n 40 "$log" >&2
    echo "voxray: error: the sanitized build failed (whole log: $log)" >&2
    exit 1
  }
  exec 9>&-
}

case ${1:-} in
  build) build_programs ;;
  run)
    build_programs
    export ASAN_OPTIONS=allocator_may_return_null=0:detect_stack_use_after_return=1
    export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
    exec "$build/tests/$2"
    ;;
  *) echo "voxray: error: usage: sanitized-tests.sh build | run PROGRAM" >&2; exit 2 ;;
esac
