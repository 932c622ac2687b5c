#!/usr/bin/env bash
# All shards of a sweep by GNU parallel, then joined:
#   gnu_parallel.sh SWEEP.toml FOLDER SHARDS
# As many shards run at once as there are processors, each with one simulation at a time; a shard that dies is run again, twice, and goes
# on where it was. FOLDER/parallel.log has a line a run. Called again, only what is missing is simulated. More options for parallel are
# taken from the variable PARALLEL: PARALLEL='--jobs 8', or PARALLEL='--sshloginfile nodes.txt --workdir .' for several machines that see
# the same folders. RASTERTLM names the program where it is not in the PATH.
set -euo pipefail

if (( $# != 3 )) || [[ ! "$3" =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: gnu_parallel.sh SWEEP.toml FOLDER SHARDS" >&2
  exit 2
fi
sweep="$1" folder="$2" shards="$3"
export RASTERTLM="${RASTERTLM:-rastertlm}"
mkdir -p "$folder"

seq "$shards" | parallel --retries 3 --joblog "$folder/parallel.log" --tagstring 'shard {}' \
  "$RASTERTLM" explore run "$sweep" --shard "{}/$shards" --store "$folder/shard_{}_of_$shards.sqlite" --resume --jobs 1 \
  '||' test '$?' -eq 1  # some points failed: they are results, and another turn would not mend them

exec "$(dirname "${BASH_SOURCE[0]}")/merge.sh" "$folder" "$shards"
