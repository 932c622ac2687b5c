#!/usr/bin/env bash
# Joins the shards of a sweep into FOLDER/sweep.sqlite and tells what they found, in FOLDER/sweep.txt. As a job after slurm_array.sh
# (sbatch --dependency=...), or by hand:
#   merge.sh FOLDER SHARDS
#SBATCH --job-name=rastertlm_merge
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --mem=1G
#SBATCH --time=00:30:00
#SBATCH --output=%x_%j.log
set -euo pipefail

if (( $# != 2 )) || [[ ! "$2" =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: merge.sh FOLDER SHARDS" >&2
  exit 2
fi
folder="$1" shards="$2"
stores=()
missing=()
for ((shard = 1; shard <= shards; ++shard)); do
  store="$folder/shard_${shard}_of_$shards.sqlite"
  stores+=("$store")
  if [[ ! -e "$store" ]]; then missing+=("$shard"); fi
done
if (( ${#missing[@]} > 0 )); then
  (IFS=,; echo "$folder lacks shards ${missing[*]} of $shards: run these first (sbatch --array=${missing[*]})" >&2)
  exit 1
fi

# Beside the last one, which stays until the new one is whole.
new="$folder/sweep.new.$$.sqlite"
trap 'rm -f "$new" "$new".* "$folder/sweep.txt.new"' EXIT
"${RASTERTLM:-rastertlm}" explore merge "$new" "${stores[@]}"
"${RASTERTLM:-rastertlm}" explore show "$new" >"$folder/sweep.txt.new"
mv "$new" "$folder/sweep.sqlite"
mv "$folder/sweep.txt.new" "$folder/sweep.txt"
cat "$folder/sweep.txt"
