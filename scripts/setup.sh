#!/usr/bin/env bash
# Installs the distribution's packages that are missing, and says which.
#
#   scripts/setup.sh demo    what it takes to build and run wavepath
#   scripts/setup.sh test    also what it takes to build and run all tests; installs the commit-msg hook in a clone
#
# Debian 12 and 13. Needs root only where something is missing: sudo where not root.
set -euo pipefail

fail() {
    echo "setup: error: $1" >&2
    exit 1
}

build_packages=(
    cmake ninja-build g++
    ocl-icd-opencl-dev opencl-clhpp-headers pocl-opencl-icd
    libcli11-dev libdraco-dev libembree-dev libfmt-dev libmeshoptimizer-dev libopenexr-dev libspdlog-dev libstb-dev
    libtinygltf-dev libwebp-dev nlohmann-json3-dev pkgconf zlib1g-dev
    gnuplot-nox
)
test_packages=(libbenchmark-dev libgmock-dev libgtest-dev)
# The tests that use one of these are skipped, with the reason, where the distribution does not have it.
checker_packages=(clang clang-format-14 clang-tidy dpkg-dev file oclgrind openexr openimageio-tools
                  python3 shellcheck)

case "${1:-}" in
    demo) required=("${build_packages[@]}") optional=() ;;
    test) required=("${build_packages[@]}" "${test_packages[@]}") optional=("${checker_packages[@]}") ;;
    *) fail "usage: setup.sh demo|test" ;;
esac

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    fail "no apt-get here: on this system install the equivalents of: ${required[*]}; then build with cmake --preset release"
fi

# Prints those of its arguments that are not installed.
missing_of() {
    local package
    for package in "$@"; do
        [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || echo "$package"
    done
}

install_hook() {
    local hooks
    hooks=$(git -C "$(dirname "${BASH_SOURCE[0]}")" rev-parse --path-format=absolute --git-path hooks 2>/dev/null) || return 0
    [[ -e $hooks/commit-msg ]] || { mkdir -p "$hooks" && cp "$(dirname "${BASH_SOURCE[0]}")/commit-msg" "$hooks/"; } 2>/dev/null || true
}
[[ $1 != test ]] || install_hook

mapfile -t missing < <(missing_of "${required[@]}")
mapfile -t missing_checkers < <(missing_of "${optional[@]}")
if ((${#missing[@]} + ${#missing_checkers[@]} == 0)); then
    echo "setup: every package is installed"
    exit 0
fi

as_root=()
if ((EUID != 0)); then
    command -v sudo >/dev/null ||
        fail "packages are missing and there is no sudo: as root run: apt-get install ${missing[*]} ${missing_checkers[*]}"
    sudo -n true 2>/dev/null || { [[ -t 0 ]] && sudo -v; } ||
        fail "packages are missing and sudo does not let you install them: as root run: apt-get install ${missing[*]} ${missing_checkers[*]}"
    as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Without a prompt; waits up to 5 minutes for another apt to end. `env` because sudo drops variables.
apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@" >"$log" 2>&1 </dev/null
}
last_error() { grep -E '^(E|Err):' "$log" | tail -n 1 || true; }

apt update || true  # a dead third-party source is no reason to stop: what matters is whether the packages install

available_checkers=()
for package in "${missing_checkers[@]}"; do
    if apt-cache show "$package" >/dev/null 2>&1; then
        available_checkers+=("$package")
    else
        echo "setup: this distribution has no $package: the tests that use it will be skipped"
    fi
done
install=("${missing[@]}" "${available_checkers[@]}")
((${#install[@]} > 0)) || exit 0

echo "setup: installing ${install[*]}"
apt install -y --no-install-recommends "${install[@]}" ||
    fail "apt-get could not install them (no network, or a package source is off): $(last_error)"
echo "setup: done"
