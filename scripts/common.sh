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
  results="$root/$folder/test_results.xml"
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

# The counts of the first <testsuite> of a JUnit file; a test that was not run although it should have been is a failed one.
read_counts() {
  local total=0 failed=0 skipped=0 disabled=0
  if [[ -s "$1" ]]; then
    total="$(junit_count tests "$1")"
    failed="$(junit_count failures "$1")"
    skipped="$(junit_count skipped "$1")"
    disabled="$(junit_count disabled "$1")"
  fi
  tests_failed="$failed"
  tests_skipped=$(( skipped + disabled ))
  tests_passed=$(( total - failed - skipped - disabled ))
}

junit_count() {
  awk -v name="$1" '
    /<testsuite / { inside = 1 }
    inside && match($0, "(^|[ \t])" name "=\"[0-9]+\"") {
      text = substr($0, RSTART, RLENGTH); gsub(/[^0-9]/, "", text); print text; found = 1; exit
    }
    inside && />/ { exit }
    END { if (!found) print 0 }' "$2"
}
