# SPDX-License-Identifier: MIT
# Sourced by `run numbers [PART...]`: prints every number of speed and of recovery that the project states, measured
# here and now; all parts unless some are named. Close other programs first; the numbers are medians, but a busy
# machine has slow medians.

section() { printf '\n== %s\n' "$*"; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

numbers_of_benchmarks() {
    local part
    for part in quest stimulus controller study_app; do
        section "$part"
        "$bin/${part}_benchmark" --benchmark_min_time=0.2 2>/dev/null || die "${part}_benchmark failed"
    done
}

numbers_of_window() {
    section "the study's window"
    "$root/tests/study_app/window_numbers.sh" "$bin" || die "window_numbers.sh failed"
}

numbers_of_study() {
    local seed
    section "simulated study: paper16, 10 observers x 16 conditions x 40 trials, three times"
    for seed in 1 2 3; do
        "$bin/study_app" --headless --design paper16 --data "$work/study-$seed" --observers 10 \
            --observer simulated --seed "$seed" | tail -n 1 || die "study_app failed"
    done
    section "reference_filter --all, R1/2 and R1 (seconds)"
    ( TIMEFORMAT='%R'; time "$bin/reference_filter" --all >"$work/reference.tsv" ) 2>&1
}

# --timing's lines alone: "  1.234 s  fit of the law".
timed_fit() {
    "$bin/fit_slope" "$@" --out "$work/fit" --timing >"$work/fit.txt" 2>/dev/null || die "fit_slope failed"
    grep -E '^ .* (s|MB)  ' "$work/fit.txt"
}

numbers_of_fit() {
    local observers
    for observers in 10 25 100; do
        "$bin/study_app" --headless --design paper16 --data "$work/of-$observers" --observers "$observers" \
            --observer simulated --seed 1 >/dev/null || die "study_app failed"
    done
    section "fit_slope on 6,400 trials, figures and report included (seconds, three times)"
    for _ in 1 2 3; do
        ( TIMEFORMAT='%R'; time "$bin/fit_slope" "$work/of-10" --out "$work/fit" >"$work/fit.txt" ) 2>&1
    done
    head -n 1 "$work/fit.txt"
    section "cost by trials: fit_slope in processor seconds, and that per 1,000 trials"
    for observers in 10 25 100; do
        ( TIMEFORMAT='%U'; time "$bin/fit_slope" "$work/of-$observers" --out "$work/fit" >/dev/null 2>&1 ) 2>&1 |
            awk -v trials=$((640 * observers)) '{ printf "%6d trials  %6.2f s  %.3f s per 1,000\n", trials, $1, 1000 * $1 / trials }'
    done
    section "where the time goes on 64,000 trials, peak memory"
    timed_fit "$work/of-100"
}

numbers_of_bootstrap() {
    "$bin/study_app" --headless --design paper16 --data "$work/of-10" --observers 10 \
        --observer simulated --seed 1 >/dev/null || die "study_app failed"
    section "fit_slope on 6,400 trials with 1,000 draws of the observers"
    timed_fit "$work/of-10" --bootstrap 1000
}

coverage() {
    section "coverage: $*"
    "$bin/fit_slope" --coverage "$@" || die "fit_slope failed"
}

# docs/results/coverage.txt holds these, some minutes each.
numbers_of_coverage() {
    coverage paper16 --studies 500 --observer observer_sd=.10,condition_sd=.05,stair=1,contrast_exponent=0
    coverage paper16 --studies 500
    coverage paper16 --studies 500 --observer beta=2,lapse=.04
    coverage paper16 --studies 500 --observers 20 --trials 20
    coverage paper16 --studies 500 --observers 5 --trials 80
    coverage paper16 --studies 500 --observer observer_sd=0,condition_sd=0
    coverage "$root/docs/results/paper16-with-catch-trials.json" --studies 200 --guessing 1
}

# docs/results/technique-times.md and technique-errors.md.
numbers_of_techniques() {
    "$bin/technique_times" planar_occluder 0 || die "technique_times failed"
    "$bin/technique_times" yard 0 9 || die "technique_times failed"
    "$bin/technique_times" terrain 0 evsm4 lvsm csm || die "technique_times failed"
    "$bin/technique_times" lamps 0 evsm4 || die "technique_times failed"
    "$bin/technique_errors" || die "technique_errors failed"
}

# docs/results/automatic-size.md.
numbers_of_sizes() {
    "$bin/size_numbers" paths || die "size_numbers failed"
    "$bin/size_numbers" cost || die "size_numbers failed"
}

# README's headline, with the slope that lies beside the logs: docs/results/software-rasteriser.
numbers_of_headline() {
    local logs=$root/docs/results/software-rasteriser
    section "the automatic size against fixed ones: full-disc PCF; then PCSS and VSM"
    "$bin/shadow_bench" --techniques pcf_disc --slope "$logs/simulated-slope.json" --out "$work/pcf" 2>/dev/null ||
        die "shadow_bench failed"
    "$bin/shadow_bench" --techniques pcss,vsm --resolutions auto,2048,4096 --rounds 3 \
        --slope "$logs/simulated-slope.json" --out "$work/others" 2>/dev/null || die "shadow_bench failed"
    headline_means "$work/pcf/benchmark.tsv" "$work/others/benchmark.tsv"
}

# Geometric means over the scenes of what benchmark.tsv holds.
headline_means() {
    awk -F'\t' '
        /^#/ { next }
        $1 == "scene" { for (i = 1; i <= NF; ++i) at[$i] = i; next }
        $at["resolution_mode"] == "auto" {
            automatic[$2, $1] = $at["frame_ms"]
            size[$2, $1] = $at["resolution"]
            rmse[$2, $1] = $at["rmse"]
            next
        }
        # A map finer than the reference is not wrong by what the two differ in.
        $at["is_reference"] == 1 && size[$2, $1] <= $at["resolution"] && rmse[$2, $1] > worst[$2] { worst[$2] = rmse[$2, $1] }
        { key = $2 "\t" $at["resolution"]; logs[key] += log($at["frame_ms"] / automatic[$2, $1]); ++scenes[key] }
        END {
            for (key in logs) {
                split(key, part, "\t")
                printf "%-10s %5d  %.2f times as fast, %d scenes; automatic: RMSE at most %.4f\n", part[1], part[2],
                    exp(logs[key] / scenes[key]), scenes[key], worst[part[1]]
            }
        }' "$@" | sort
}

parts=(benchmarks window study fit bootstrap techniques sizes headline coverage)
[ $# -eq 0 ] || parts=("$@")
printf 'revision %s, %s, %s cores\n' "$("$bin/study_app" --version)" \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)" "$(nproc)"
for part in "${parts[@]}"; do
    declare -F "numbers_of_$part" >/dev/null ||
        die "numbers: no part '$part': one of benchmarks, window, study, fit, bootstrap, techniques, sizes, headline, coverage"
    "numbers_of_$part"
done
