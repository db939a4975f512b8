# Sourced by ./run and ./test: installs what is missing, configures and builds; one line a step.
# What apt, cmake and ninja say goes to build/log/ and is shown only when a step fails.
# Expects to be sourced with the repository's root as working folder, under `set -euo pipefail`.

say() { printf '== %s\n' "$*"; }

# step LABEL LOG COMMAND...: runs the command, its output in build/log/LOG.
step() {
    local label=$1 log=build/log/$2 started=$SECONDS
    shift 2
    say "$label"
    if ! "$@" >"$log" 2>&1 9>&-; then
        printf '\n'
        tail -n 100 "$log"
        printf '\nfailed: %s (all of it in %s)\n' "$label" "$log"
        exit 1
    fi >&2
    if ((SECONDS - started > 9)); then say "  took $((SECONDS - started)) s"; fi
}

# Tools want a home to keep caches in; a machine without one gets it in the build folder.
prepare() {
    mkdir -p build/log
    if [[ -z ${HOME:-} || ! -d $HOME || ! -w $HOME ]]; then
        export HOME=$PWD/build/home
        mkdir -p "$HOME"
    fi
    exec 9>build/.setup.lock  # two set-ups at once would overwrite each other's files
    if ! flock -n 9; then
        say "waiting for another set-up of this folder"
        flock 9
    fi
}

# Call before handing over to what was built.
finish() { exec 9>&-; }

# packages_of SET: `run`, or `test` for both.
packages_of() {
    awk -v set="$1" '$1 == "run" || $1 == set { print $2 }' tools/packages.txt
    # Where node comes from elsewhere, Debian's packages would conflict with it.
    if [[ $1 == test ]]; then
        command -v node >/dev/null || echo nodejs
        command -v npm >/dev/null || echo npm
    fi
}

missing_packages() {
    local package
    for package in $(packages_of "$1"); do
        [[ $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) == *" installed" ]] \
            || printf '%s ' "$package"
    done
}

as_root() {
    if ((EUID == 0)); then
        env DEBIAN_FRONTEND=noninteractive "$@"
    else
        sudo env DEBIAN_FRONTEND=noninteractive "$@"
    fi
}

# install_packages SET
install_packages() {
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        say "no apt-get here: taking it that what tools/packages.txt lists is installed"
        return
    fi
    local stamp missing
    stamp=build/.packages-$1-$(packages_of "$1" | cksum | tr ' ' -)
    [[ $stamp -nt /var/lib/dpkg/status ]] && return
    missing=$(missing_packages "$1")
    if [[ -n $missing ]]; then
        if ((EUID != 0)) && ! command -v sudo >/dev/null; then
            printf 'these packages are missing, and only root can install them:\n  %s\n' \
                "apt-get install $missing" >&2
            exit 1
        fi
        step "reading Debian's package lists" apt-update.log as_root apt-get -q update
        # shellcheck disable=SC2086  # one word a package
        step "installing $(wc -w <<<"$missing") packages: $missing" apt-install.log \
            as_root apt-get -q -y --no-install-recommends install $missing
    fi
    touch "$stamp"
}

# As many compilers at once as there are processors and 1.5 GiB each, what the largest file takes.
jobs_at_once() {
    local memory processors
    processors=$(nproc)
    memory=$(awk '/^MemAvailable/ { print int($2 / 1572864) }' /proc/meminfo)
    echo $((memory < 1 ? 1 : memory < processors ? memory : processors))
}

# build PRESET "CMAKE OPTIONS" [TARGET...]: configures if that was never done, then builds.
build() {
    local preset=$1 options=$2 folder=build/$1
    shift 2
    if [[ ! -f $folder/build.ninja || CMakePresets.json -nt $folder/build.ninja ]]; then
        # shellcheck disable=SC2086  # options are words
        step "configuring build/$preset" "cmake-$preset.log" cmake --preset "$preset" $options
    fi
    step "building build/$preset${*:+: $*}" "ninja-$preset.log" \
        ninja -C "$folder" -j "$(jobs_at_once)" "$@"
}
