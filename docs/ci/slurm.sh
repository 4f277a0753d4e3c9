#!/bin/sh
#SBATCH --job-name=wasmouse
#SBATCH --array=1-8
#SBATCH --cpus-per-task=4
#SBATCH --time=02:00:00
# Plays one shard of a contest for each task of an array:
#
#     sbatch docs/ci/slurm.sh
#
# and, when all have ended:
#
#     wasmouse contest merge merged.db shard-*.db
#     wasmouse contest report contest.toml --store merged.db --html contest.html
set -eu

shard=$SLURM_ARRAY_TASK_ID
wasmouse contest run contest.toml --shard "$shard/$SLURM_ARRAY_TASK_COUNT" \
    --store "shard-$shard.db" --jobs "${SLURM_CPUS_PER_TASK:-1}"
