#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Pictures of every screen of the study's window, on an X server of its own:
#   window_pictures.sh BIN_FOLDER OUT_FOLDER [SCALE]    1280 x 800 px; SCALE 2: 2560 x 1600 px
#   window_pictures.sh BIN_FOLDER docs                  those that docs/study-window.md shows, anew
# A robot sits through the design `quick`; xdotool presses what it would not.
set -euo pipefail
bin=$(realpath -e "${1:?the folder of study_app}")
out=${2:?the folder for the pictures, or docs}
[ "$out" = docs ] || out=$(realpath "$out")
scale=${3:-1}
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
width=$((1280 * scale)) height=$((800 * scale))
if [ -z "${STAIRWELL_XVFB-}" ]; then
    STAIRWELL_XVFB=1 exec xvfb-run -a -s "-screen 0 ${width}x${height}x24" tests/study_app/window_pictures.sh "$bin" "$out" "$scale"
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
shots=$work/pictures
cd "$work" # the screens show paths: "study" and not one of this machine
cat >pace.json <<'JSON'
{"blank_s": 0.1, "fixation_s": 0.1, "too_fast_s": 0, "feedback_s": 0.1, "break_every_trials": 30, "break_minimum_s": 5}
JSON
cat >pilot.json <<'JSON'
{"schema": {"name": "stairwell design", "major": 1, "minor": 0}, "name": "pilot", "artifact_px": [10, 20],
 "patterns": ["stair", "step"], "trials_per_condition": 5}
JSON
study() { # EVENTS ARGUMENT...: in the background
    log=$1
    shift
    : >"$log"
    "$bin/study_app" --data study --displays displays.json --event-log "$log" --window-size "$width" "$height" \
        --ui-scale "$scale" "$@" &
    app=$!
}
waitUntil() { # WHAT COMMAND...: succeeds
    local what=$1
    shift
    for _ in $(seq 3000); do
        "$@" && return
        kill -0 "$app"
        sleep 0.02
    done
    echo "window_pictures.sh: $what did not come" >&2
    return 1
}
waitFor() { waitUntil "event $1" grep -q "^$1" "$log"; }
waitForPicture() { # NAME: it is there, and whole
    waitUntil "$1.png" test -s "pictures/$1.png"
    sleep 0.5
}
end() { kill "$app" && wait "$app" 2>/dev/null || true; }
robot() { # EVENTS DESIGN ARGUMENT...
    study "$1" --design "$2" --seed 3 --start --robot 0.1 --presentation pace.json "${@:3}"
}

cat >displays.json <<JSON
{"schema": {"name": "stairwell displays", "major": 1, "minor": 0}, "displays": [
 {"name": "screen", "width_px": $width, "height_px": $height, "px_per_mm": $((4 * scale)), "distance_mm": 600, "gamma": 2.2,
  "luminance_black_cd_m2": 0.3, "luminance_grey_cd_m2": 55, "luminance_cd_m2": 250}]}
JSON

# Participants that are there already, and one who sits through it all.
for person in 07 08; do
    "$bin/study_app" --headless --data study --design quick --participant "$person" --seed "$person" \
        --observer simulated >/dev/null
done
robot trials.log quick --participant 09 --screenshots pictures
waitFor 'stimulus 8 '
xdotool key Escape
wait "$app"
# Too few trials for staircases to converge: flags and offers among the results.
robot pilot.log pilot.json --participant 11
wait "$app"
robot results.log pilot.json --participant 11 --screenshots pictures
wait "$app"
rm -r study/sub-11
# Another one who is in the middle.
robot half.log quick --participant 10
waitFor 'row 25 '
end
study panel.log --participant 10 --start --panel --robot 0.1 --screenshots pictures
waitFor 'row 26 '
end
study setup.log --participant 10 --screenshots pictures
waitForPicture setup
xdotool key Return
waitForPicture calibration
end
cd - >/dev/null
if [ "$out" = docs ]; then
    for name in setup calibration instructions trial=trials-stimulus results=end-results panel; do
        cp "$shots/${name#*=}.png" "docs/pictures/study-${name%=*}.png"
    done
else
    mkdir -p "$out"
    cp "$shots"/*.png "$out"
fi
