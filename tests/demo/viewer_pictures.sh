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

window() { # NAME FRAMES ARGUMENT...
    xvfb-run -a -s "-screen 0 1120x700x24" "$bin/shadow_demo" --width 1120 --height 700 --state "$work/$1.json" \
        --frames "$2" --window-picture "$out/$1.png" "${@:3}"
}
# Two frames more than a lamp's eight maps need to be asked 16 times each.
window viewer 6 --scene yard --resolution 256 --view split --compare 4096
window viewer-lamps 18 --scene lamps --budget-texels 1000000

"$bin/shadow_demo" --headless --scene yard --resolution auto --width 640 --height 360 --screenshot "$out/yard-auto.png"
"$bin/shadow_demo" --headless --scene yard --resolution 4096 --width 640 --height 360 --screenshot "$out/yard-4096.png"
