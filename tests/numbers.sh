# SPDX-License-Identifier: MIT
# Sourced by `run numbers`: prints every number of speed and of recovery that the project states, measured here and
# now. Close other programs first; the numbers are medians, but a busy machine has slow medians.

section() { printf '\n== %s\n' "$*"; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

printf 'revision %s, %s, %s cores\n' "$("$bin/study_app" --version)" \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)" "$(nproc)"
for part in quest stimulus controller study_app; do
    section "$part"
    "$bin/${part}_benchmark" --benchmark_min_time=0.2 2>/dev/null || die "${part}_benchmark failed"
done

section "the study's window"
"$root/tests/study_app/window_numbers.sh" "$bin" || die "window_numbers.sh failed"

section "simulated study: paper16, 10 observers x 16 conditions x 40 trials, three times"
for seed in 1 2 3; do
    "$bin/study_app" --headless --design paper16 --data "$work/study-$seed" --observers 10 \
        --observer simulated --seed "$seed" | tail -n 1 || die "study_app failed"
done

section "fit_slope on its 6,400 trials, figures and report included (seconds, three times)"
for _ in 1 2 3; do
    ( TIMEFORMAT='%R'; time "$bin/fit_slope" "$work/study-1" --out "$work/fit" >"$work/fit.txt" ) 2>&1
done
head -n 1 "$work/fit.txt"

section "reference_filter --all, R1/2 and R1 (seconds)"
( TIMEFORMAT='%R'; time "$bin/reference_filter" --all >"$work/reference.tsv" ) 2>&1

section "fit_slope on 64,000 trials: where the time goes, peak memory"
"$bin/study_app" --headless --design paper16 --data "$work/large" --observers 100 \
    --observer simulated --seed 4 >/dev/null || die "study_app failed"
"$bin/fit_slope" "$work/large" --out "$work/fit" --timing 2>/dev/null | grep -E '^ .* (s|MB)  ' ||
    die "fit_slope failed"

section "the same on the 6,400 trials, with 1,000 draws of the observers"
"$bin/fit_slope" "$work/study-1" --out "$work/fit" --timing --bootstrap 1000 2>/dev/null |
    grep -E '^ .* (s|MB)  ' || die "fit_slope failed"

# docs/results/coverage.txt holds these, some minutes each.
coverage() {
    section "coverage: $*"
    "$bin/fit_slope" --coverage "$@" || die "fit_slope failed"
}
coverage paper16 --studies 500 --observer observer_sd=.10,condition_sd=.05,stair=1,contrast_exponent=0
coverage paper16 --studies 500
coverage paper16 --studies 500 --observer beta=2,lapse=.04
coverage paper16 --studies 500 --observers 20 --trials 20
coverage paper16 --studies 500 --observers 5 --trials 80
coverage paper16 --studies 500 --observer observer_sd=0,condition_sd=0
coverage "$root/docs/results/paper16-with-catch-trials.json" --studies 200 --guessing 1
