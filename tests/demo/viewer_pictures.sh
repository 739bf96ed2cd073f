#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Renews the pictures of README and docs that shadow_demo makes, the windows on an X server of their own:
#   viewer_pictures.sh BIN_FOLDER [OUT_FOLDER]    OUT_FOLDER: docs/pictures by default
set -euo pipefail
bin=$(realpath -e "${1:?the folder of shadow_demo}")
out=$(realpath "${2:-$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../docs/pictures}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_STATE_HOME=$work # the user's own last state shows in no picture

window() { # NAME WIDTH HEIGHT FRAMES ARGUMENT...
    xvfb-run -a -s "-screen 0 $2x$3x24" "$bin/shadow_demo" --width "$2" --height "$3" --state "$work/$1.json" \
        --frames "$4" --window-picture "$out/$1.png" "${@:5}"
}
# Near enough that the stair-steps of the small map are seen in README.
"$bin/shadow_demo" --headless --scene yard --frames 1 --state "$work/viewer.json"
sed -i 's/"camera_distance_m": null/"camera_distance_m": 4.8/; s/"camera_pitch_deg": null/"camera_pitch_deg": 30/' \
    "$work/viewer.json"
window viewer 1120 790 36 --scene yard --view split --compare 256 --split 0.66
# Two frames more than a lamp's eight maps need to be asked 16 times each.
window viewer-lamps 1120 900 18 --scene lamps --budget-texels 1000000

"$bin/shadow_demo" --headless --scene contact_posts --technique pcss --view demand --frames 1 --width 1120 --height 630 \
    --screenshot "$out/demand.png"
view() { # NAME ARGUMENT...: of the same place as the viewer's picture
    "$bin/shadow_demo" --headless --scene yard --view "$1" --frames 1 --width 560 --height 315 \
        --state "$work/viewer.json" --screenshot "$out/view-$1.png" "${@:2}"
}
view difference --compare 256
view penumbra
view texels --resolution 128
"$bin/shadow_demo" --headless --scene yard --resolution auto --width 640 --height 360 --screenshot "$out/yard-auto.png"
"$bin/shadow_demo" --headless --scene yard --resolution 4096 --width 640 --height 360 --screenshot "$out/yard-4096.png"
