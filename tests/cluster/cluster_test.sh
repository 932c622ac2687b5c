# shellcheck shell=bash
# shellcheck disable=SC2034
# What the tests of configs/cluster share: a sweep, its store by a local run, and what must be the same in a joined one. Sourced.
#   PROGRAM SOURCE_FOLDER are the test's arguments.
program="$1" source_folder="$2"
scripts="$source_folder/configs/cluster"
here="$source_folder/tests/cluster"
shards=4

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

need() {
  local tool
  for tool in "$@"; do
    type -P "$tool" >/dev/null || fail "there is no $tool; scripts/install_dependencies --tests installs it"
  done
}

# Points that take some tenths of a second, so that a shard can be caught at work.
write_sweep() {
  cat >"$1" <<SWEEP
schema = 1
question = "How many transputers show the teapot at 50 Hz?"
machine = "$source_folder/configs/machines/imogene.toml"
scene = "$source_folder/configs/scenes/teapot.toml"
frames = 3

[[vary]]
name = "transputers"
variant = [
  { name = "2", set = { host.computation_units = 2, host.processors_per_unit = 512 } },
  { name = "4", set = { host.computation_units = 4, host.processors_per_unit = 256 } },
  { name = "8", set = { host.computation_units = 8, host.processors_per_unit = 128 } },
]

[[vary]]
path = "host.preset"
values = ["t800_20", "t800_30"]

[[vary]]
path = "object_processor.word_bits"
values = [22, 24, 26]

[[objective]]
path = "answer.frame_rate_hz"
sense = "maximise"

[[objective]]
path = "sum(memories[].total_bits)"
sense = "minimise"
SWEEP
}

# Everything that a model says of each configuration: whether it ran, why not, its figures, its whole report. No times.
model_figures() {
  sqlite3 -readonly "$1" "SELECT key, state, error, config_digest, scene_digest, hex(report) FROM result ORDER BY key;
    SELECT r.key, path, value FROM figure f JOIN result r ON r.id = f.result ORDER BY r.key, path;"
  "$program" explore show "$1" --csv
}

run_locally() {
  "$program" explore run "$1" --store "$2" --jobs 2 >"$2.log" || { cat "$2.log" >&2; fail "the local run"; }
}

# same_figures STORE STORE: and that these are not nothing.
same_figures() {
  local store lines
  for store in "$@"; do model_figures "$store" >"$store.figures"; done
  lines="$(wc -l <"$1.figures")"
  if (( lines < 3 * points )); then fail "only $lines lines of figures in $1"; fi
  cmp "$1.figures" "$2.figures" || { diff "$1.figures" "$2.figures" | cut -c1-300 | head -n 20 >&2; fail "$2 has other figures than $1"; }
}
points=18

# Of a log: the points that a run simulated and those that were there before it.
simulated() { sed -n 's/.*: \([0-9,]*\) simulated, \([0-9,]*\) had their result;.*/\1 \2/p' "$1"; }
