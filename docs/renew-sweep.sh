#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# docs/renew-sweep.sh [FOLDER]: writes the report of the sweep in FOLDER again, takes its journals and tables into
# docs/results/sweep, and renews what docs/benchmark.md and README.md quote of them, between their marks. Without FOLDER,
# from the journals that lie in docs/results/sweep. Measures nothing.
set -euo pipefail

kept=docs/results/sweep
here=$PWD
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
folder=${1:-$kept}
[ $# -eq 0 ] || [[ $folder = /* ]] || folder=$here/$folder
bench=${BENCH:-build/release/bin/shadow_bench}
[ -x "$bench" ] || { echo "renew-sweep: $bench is not there: build it, or name it in BENCH" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$bench" --sweep --report --out "$folder" --stability docs/results/technique-errors.md >"$work/log"
for file in "$folder"/*.tsv "$folder"/summary.md; do
    # The command as it is typed: paths of one machine tell nothing.
    sed -E '/^# command/ { s|[^ ]*shadow_bench|shadow_bench|; s|--out [^ ]*|--out sweep| }' "$file" >"$work/file"
    cat "$work/file" >"$kept/$(basename "$file")"
done

# renew FILE NAME TEXT: what stands between <!-- NAME --> and <!-- end of NAME -->.
renew() {
    grep -qF "<!-- $2 -->" "$1" && grep -qF "<!-- end of $2 -->" "$1" ||
        { echo "renew-sweep: $1: the marks <!-- $2 --> and <!-- end of $2 --> are missing" >&2; exit 1; }
    awk -v name="$2" -v text="$3" '
        index($0, "<!-- end of " name " -->") { inside = 0 }
        !inside { print }
        index($0, "<!-- " name " -->") {
            inside = 1
            print ""
            while ((getline line < text) > 0) print line
        }' "$1" >"$work/renewed"
    cat "$work/renewed" >"$1"
}

{
    printf 'Revision %s, %s.\n\n' "$(sed -n 's/^# revision *//p' "$kept/sweep_times.tsv")" \
        "$(sed -n 's/^# plan *\([^,]*, [^,]*\),.*/\1/p' "$kept/sweep_times.tsv")"
    sed -E 's|\]\(([a-z_]*\.tsv)\)|](results/sweep/\1)|g' "$kept/summary.md"
} >"$work/summary"
renew docs/benchmark.md sweep "$work/summary"
# The first columns of the first table.
awk -F'|' '/^\|/ { print "|" $2 "|" $3 "|" $4 "|" $6 "|" $7 "|" $8 "|"; seen = 1; next } seen { exit }' \
    "$kept/summary.md" >"$work/techniques"
echo >>"$work/techniques"
renew README.md policies "$work/techniques"
