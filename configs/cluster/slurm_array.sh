#!/usr/bin/env bash
# One shard of a sweep for each task of a Slurm array:
#   sbatch --array=1-16 slurm_array.sh SWEEP.toml FOLDER 16
#   sbatch --dependency=afterok:JOB --kill-on-invalid-dep=yes merge.sh FOLDER 16
# FOLDER must be seen by all nodes; task K of N keeps its store there, shard_K_of_N.sqlite. N is the sweep's number of shards and must
# stay: give it again with --array=5,9 when these two are to be run again. What a store has is not simulated a second time.
# RASTERTLM names the program where it is not in the PATH. Options of sbatch go before the lines below: sbatch --time=12:00:00 ...
#SBATCH --job-name=rastertlm
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --time=04:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=%x_%A_%a.log
set -euo pipefail

if (( $# != 3 )) || [[ ! "$3" =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: sbatch --array=1-SHARDS slurm_array.sh SWEEP.toml FOLDER SHARDS" >&2
  exit 2
fi
sweep="$1" folder="$2" shards="$3"
shard="${SLURM_ARRAY_TASK_ID:?this is no task of an array: submit it with sbatch --array=1-$shards}"
if (( shard < 1 || shard > shards )); then
  echo "task $shard of the array is none of $shards shards, which count from 1: submit it with --array=1-$shards" >&2
  exit 2
fi
mkdir -p "$folder"

# Two minutes before its time is over (USR1) the program is asked to stop, which it does between two points, and the task asks for
# another turn, which goes on where this one ended. A task that is cancelled (TERM) stops as well, and for good.
explorer="" again=0 caught=0
trap 'again=1 caught=1; kill -TERM $explorer' USR1
trap 'caught=1; kill -TERM $explorer' TERM

echo "$(date '+%F %T') shard $shard of $shards on $(hostname)"
"${RASTERTLM:-rastertlm}" explore run "$sweep" --shard "$shard/$shards" --store "$folder/shard_${shard}_of_$shards.sqlite" --resume \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" &
explorer=$!
while :; do
  status=0
  wait "$explorer" || status=$?
  if (( ! caught )); then break; fi  # a signal ends the waiting before the program
  caught=0
done

if (( status == 1 )); then status=0; fi  # some points failed: they are results, and another turn would not mend them

if (( again && status != 0 )); then
  echo "$(date '+%F %T') shard $shard of $shards goes on in another turn"
  exec scontrol requeue "${SLURM_ARRAY_JOB_ID}_$shard"
fi
exit "$status"
