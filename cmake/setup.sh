# SPDX-License-Identifier: MIT
# Sourced by run, test and .ci/run: everything from a fresh Debian 12 machine to a built tree.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '%s\n' "$*" >&2; }
die() {
    say "$(basename "$0"): $*"
    exit 1
}

# Prints the packages of packages.txt that are not installed; nothing where the system has no dpkg.
missingPackages() {
    command -v dpkg-query >/dev/null || return 0
    local wanted
    mapfile -t wanted < "$root/cmake/packages.txt"
    comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) \
        <(dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' "${wanted[@]}" 2>/dev/null |
            sed -n 's/^[hi]i *//p' | sort -u)
}

# Installs what is missing, or says the one command that does.
installPackages() {
    command -v dpkg-query >/dev/null ||
        { say "not a Debian system: taking the libraries of cmake/packages.txt as installed"; return 0; }
    local missing asRoot=()
    mapfile -t missing < <(missingPackages)
    [ ${#missing[@]} -gt 0 ] || return 0
    if [ "$(id -u)" -ne 0 ]; then
        if command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
            asRoot=(sudo)
        else
            die "these packages are missing and neither root nor sudo is at hand; install them with:
  apt-get install --no-install-recommends ${missing[*]}"
        fi
    fi
    say "installing ${#missing[@]} packages: ${missing[*]}"
    local log
    log=$(mktemp)
    if ! { "${asRoot[@]}" apt-get update -q &&
        "${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install -q -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
        tail -n 15 "$log" >&2
        die "apt-get could not install the packages above; its whole output is in $log"
    fi
    rm -f "$log"
}

# Runs a command without its chatter, and shows the chatter when it fails.
quietly() {
    local what=$1 log status=0
    shift
    log=$(mktemp)
    "$@" >"$log" 2>&1 || status=$?
    if [ "$status" -eq 0 ]; then
        rm -f "$log"
        return 0
    fi
    cat "$log" >&2
    rm -f "$log"
    die "$what failed with exit code $status, see above"
}

# setUp PRESET [TARGET...]: packages, configure (only where it is not yet done), build.
setUp() {
    local preset=$1 build=(cmake --build --preset "$1" -j "$(nproc 2>/dev/null || echo 2)")
    [ $# -eq 1 ] || build+=(--target "${@:2}")
    installPackages
    cd "$root" || die "cannot enter $root"
    # Ninja reconfigures by itself when a CMake file changes. A tree keeps the warning rule that it was made with:
    # CI starts from none, and a switch would compile everything anew.
    if [ ! -f "build/$preset/build.ninja" ]; then
        say "configuring ($preset)"
        quietly "configuring" cmake --preset "$preset"
    fi
    if [ -t 2 ]; then
        "${build[@]}" >&2 || die "building failed, see above"
    else
        quietly "building" "${build[@]}"
    fi
    cd "$OLDPWD" || exit 1
}
