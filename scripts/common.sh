# shellcheck shell=bash disable=SC2034
# What the scripts share; sourced, never run. Leaves the caller in the repository's root.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)"
cd "$root"

# Compilers that may run at once: one a processor, but no more than memory holds (a file with SystemC or GoogleTest needs up to
# 1.5 GB).
jobs_that_fit() {
  local processors memory_kb jobs
  processors="$(nproc)"
  memory_kb="$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo 2>/dev/null || true)"
  jobs=$(( ${memory_kb:-1500000} / 1500000 ))
  if (( jobs > processors )); then jobs="$processors"; fi
  if (( jobs < 1 )); then jobs=1; fi
  echo "$jobs"
}

# configure PRESET [ARGUMENT...]: quiet where it succeeds.
configure() {
  local preset="$1" log status=0
  shift
  log="$(mktemp)"
  cmake --preset "$preset" "$@" >"$log" 2>&1 || status=$?
  if (( status != 0 )); then cat "$log" >&2; fi
  rm -f "$log"
  return "$status"
}

# run_tests BUILD_FOLDER [CTEST_ARGUMENT...]: runs the tests, fails where one fails or none ran, and leaves the counts in
# tests_passed and tests_failed (skipped ones in tests_skipped).
run_tests() {
  local folder="$1" results status=0
  shift
  results="$(cd "$folder" && pwd -P)/test_results.xml"
  rm -f "$results"
  ctest --test-dir "$folder" -j "$(nproc)" --output-on-failure --no-tests=error --output-junit "$results" "$@" || status=$?
  read_counts "$results"
  if (( tests_passed + tests_failed == 0 )); then
    echo "no test ran in $folder" >&2
    tests_failed=1
  fi
  if (( status != 0 && tests_failed == 0 )); then tests_failed=1; fi
  (( tests_failed == 0 ))
}

# The counts of CTest's JUnit file. A test that asked to be skipped is skipped, and so is a disabled one; one that could not be run
# (no such program, a missing file) has failed, although the file calls it skipped too.
read_counts() {
  tests_passed=0 tests_failed=0 tests_skipped=0
  if [[ ! -s "$1" ]]; then return; fi
  read -r tests_passed tests_failed tests_skipped < <(awk '
    /^\t<testcase / { status = $0; sub(/.*status="/, "", status); sub(/".*/, "", status); ++total }
    /^\t<testcase / && status == "disabled" { ++skipped }
    /^\t<testcase / && status == "fail" { ++failed }
    /^\t\t<skipped message="/ && status == "notrun" { if (/message="SKIP_/) ++skipped; else ++failed; status = "" }
    END { print total - failed - skipped, failed + 0, skipped + 0 }' "$1")
}
