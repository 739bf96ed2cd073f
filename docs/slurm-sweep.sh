#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A sweep as a Slurm array job; docs/benchmark.md. Task 0 comes after the others: it draws the
# calibrated policies' frames directly, then writes the report of all.
#SBATCH --job-name=shadow-sweep
#SBATCH --array=1-16
#SBATCH --cpus-per-task=2
#SBATCH --time=01:00:00
#SBATCH --output=sweep-%A_%a.log
set -euo pipefail

bench=${STAIRWELL:?the folder of the built tree}/build/release/bin/shadow_bench
out=${OUT:?a folder that all nodes share}
parts=${PARTS:-16}
options=(--sweep --out "$out" ${SWEEP_OPTIONS:-})

if [ "${SLURM_ARRAY_TASK_ID:?}" -eq 0 ]; then
    exec "$bench" "${options[@]}" --report --direct
fi
exec "$bench" "${options[@]}" --shard "$SLURM_ARRAY_TASK_ID/$parts"
