#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The numbers of the study's window, measured now on an X server of its own:
#   window_numbers.sh BIN_FOLDER [PART...]    parts: start idle speed memory kills; speed:KIND for one kind alone
#   (stair step line box gauss taps taps64 noise frames)
# `./run numbers` runs it. A robot answers that looks at the pixels alone.
set -uo pipefail
bin=$(realpath -e "${1:?the folder of study_app}") || exit 1
shift
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." || exit 1
if [ -z "${STAIRWELL_XVFB-}" ]; then
    STAIRWELL_XVFB=1 exec xvfb-run -a -s '-screen 0 1280x800x24' tests/study_app/window_numbers.sh "$bin" "$@"
fi
[ $# -gt 0 ] || set -- start idle speed memory kills

printf 'revision %s, %s, %s cores, load %s\n\n' "$("$bin/study_app" --version)" \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)" "$(nproc)" "$(cut -d' ' -f1 /proc/loadavg)"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
study() { # NAME ARGUMENT...: starts study_app in the background, its events in $work/NAME.log
    local name=$1
    shift
    "$bin/study_app" --data "$work/$name" --participant 01 --seed 1 --displays "$work/displays.json" \
        --event-log "$work/$name.log" "$@" >"$work/$name.out" 2>&1 &
    app=$!
}
waitFor() { # NAME EVENT
    until grep -q "^$2" "$work/$1.log" 2>/dev/null; do
        kill -0 "$app" 2>/dev/null || { cat "$work/$1.out" >&2; exit 1; }
        sleep 0.002
    done
}
design() { # NAME WINDOW_PX TRIALS_PER_CONDITION FIELDS: a design without pauses or practice
    cat >"$work/$1.json" <<JSON
{"schema": {"name": "stairwell design", "major": 1, "minor": 0}, "name": "$1", "description": "for numbers",
 "window_px": $2, "trials_per_condition": $3, $4,
 "presentation": {"blank_s": 0, "fixation_s": 0, "too_fast_s": 0, "break_every_trials": 0, "practice": {"correct": 0}}}
JSON
}
processorSeconds() { awk -v hertz="$(getconf CLK_TCK)" '{ print ($14 + $15) / hertz }' "/proc/$app/stat"; }
percentOfACore() { # over 10 s
    local before
    before=$(processorSeconds)
    sleep 10
    awk -v a="$before" -v b="$(processorSeconds)" 'BEGIN { printf "%.1f %% of a core over 10 s\n", 10 * (b - a) }'
}
end() { kill "$app" 2>/dev/null && wait "$app" 2>/dev/null; }

startTimes() {
    echo "start to the first screen, ms, five times (the first one may read the program from the disk):"
    for i in 1 2 3 4 5; do
        began=$(date +%s%N)
        study "start$i" --design paper16
        waitFor "start$i" "screen setup"
        printf '%s ' $((($(date +%s%N) - began) / 1000000))
        end
    done
    printf '\n\n'
}

idle() { # NAME EVENT WORDS ARGUMENT...: what waiting costs once the event has come
    local name=$1 event=$2 words=$3
    shift 3
    study "$name" "$@"
    waitFor "$name" "$event"
    sleep 1
    printf 'idle, %s: ' "$words"
    percentOfACore
    end
}
idleTimes() {
    # --robot 60 does not answer as long as this takes.
    design waiting 600 10 '"artifact_px": [20], "patterns": ["stair"]'
    idle setup "screen setup" "set-up screen" --design paper16
    idle stimulus "stimulus 1" "stimulus on screen" --design "$work/waiting.json" --start --robot 60
    idle panel "stimulus 1" "stimulus on screen and the experimenter's window open" \
        --design "$work/waiting.json" --start --robot 60 --panel
    echo
}

trials=${STAIRWELL_TRIALS:-200}
speed() { # KIND FIELDS CONDITIONS WORDS: an observer who is quick
    case " $wanted " in *" speed "* | *" speed:$1 "*) ;; *) return ;; esac
    design "$1" 600 $((trials / $3)) "$2"', "catch_share": 0'
    study "$1" --design "$work/$1.json" --start --robot 0.3 --timing
    wait "$app" || { cat "$work/$1.out" >&2; exit 1; }
    printf '%-34s %s\n' "$4" "$(sed 's/.*pause: //' "$work/$1.out")"
}
speeds() {
    printf 'answer to next stimulus, 2 x 600 x 600 px, answers after 0.3 s, no pause between:\n'
    local line='{"pattern": "line", "angle_deg": 10}, {"pattern": "line", "angle_deg": 22.5}'
    speed stair '"artifact_px": [10, 30], "patterns": ["stair"]' 2 "stair"
    speed step '"artifact_px": [10, 30], "patterns": ["step"]' 2 "step"
    speed line '"artifact_px": [10, 30], "patterns": ['"$line"']' 4 "lines of 10 and 22.5 degrees"
    speed box '"artifact_px": [10, 30], "patterns": ['"$line"'], "kernels": ["box"]' 4 "the same, box"
    speed gauss '"artifact_px": [10, 30], "patterns": ['"$line"'], "kernels": ["gaussian"]' 4 "the same, gaussian"
    speed taps '"artifact_px": [10, 30], "patterns": ["stair"], "kernels": ["poisson16"]' 2 "stair, 16 turned taps"
    speed taps64 '"artifact_px": [10, 30], "patterns": ["step"], "kernels": ["poisson64"]' 2 "step, 64 turned taps"
    speed noise '"artifact_px": [10, 30], "patterns": ["stair"], "noise_levels": [4], "dither": true' 2 \
        "stair, image noise and dither"
    case " $wanted " in *" speed "* | *" speed:frames "*)
        "$bin/shadow_demo" --write-frames "$work/pairs" --scene yard --technique pcf_disc --radius-uv 0.03 \
            >/dev/null 2>&1 || { echo "shadow_demo failed" >&2; exit 1; } ;;
    esac
    speed frames '"frames": "pairs"' 1 "rendered frames of 600 x 600"
    echo
}

memory() {
    printf 'memory (resident, MB) over 2,000 trials at 240 px:\n'
    design memory 240 1000 '"artifact_px": [10], "patterns": ["stair", "step"], "catch_share": 0, "radius_px": {"max": 120}'
    study memory --design "$work/memory.json" --start --robot 0
    for row in 200 1000 2000; do
        waitFor memory "row $row "
        printf 'after trial %d: %s\n' "$row" "$(awk '/^VmRSS/ { printf "%.1f", $2 / 1024 }' "/proc/$app/status")"
    done
    end
    echo
}

kills() {
    printf 'a power cut at random moments:\n'
    STAIRWELL_KILLS=${STAIRWELL_KILLS:-200} "$bin/study_window_test" --gtest_filter='WindowKills*' >"$work/kills.out" ||
        { cat "$work/kills.out" >&2; exit 1; }
    grep -E '^[0-9]+ kills' "$work/kills.out"
}

wanted="$*"
case " $wanted " in *" start "*) startTimes ;; esac
case " $wanted " in *" idle "*) idleTimes ;; esac
case " $wanted " in *" speed"*) speeds ;; esac
case " $wanted " in *" memory "*) memory ;; esac
case " $wanted " in *" kills "*) kills ;; esac
