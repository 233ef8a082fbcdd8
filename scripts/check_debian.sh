#!/usr/bin/env bash
# Tries both commands of the README, scripts/demo.sh and scripts/test.sh, on a fresh Debian of any release, with
# warnings as errors. A long check: it downloads a system and its packages, builds everything and runs all tests.
#
#   scripts/check_debian.sh SUITE [FOLDER]    SUITE: bookworm, trixie, ...; FOLDER: /var/tmp/wavepath-SUITE if not given
#
# The system is a chroot in FOLDER, some 4 GB, which stays and is taken up by the next run; the last commit is cloned into
# it anew each time. Needs root and debootstrap, on a Debian: packages come from where its apt gets its own. What is
# mounted is mounted for this script and its children alone, and is gone when they are, however they end.
set -euo pipefail

fail() {
    echo "check_debian: error: $1" >&2
    exit 1
}

(($# == 1 || $# == 2)) || fail "usage: check_debian.sh SUITE [FOLDER]"
suite=$1 folder=$(realpath --canonicalize-missing "${2:-/var/tmp/wavepath-$1}")
((EUID == 0)) || fail "a chroot needs root: run it as root or by sudo"
command -v debootstrap >/dev/null || fail "no debootstrap here: run: apt-get install debootstrap"

if [[ ${WAVEPATH_CHECK_INSIDE:-} != yes ]]; then
    WAVEPATH_CHECK_INSIDE=yes exec unshare --mount --pid --fork --kill-child "$0" "$suite" "$folder"
fi

source_folder=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
if [[ ! -e $folder ]]; then
    mirror=$(apt-get indextargets --format "\$(REPO_URI)" 'Created-By: Packages' 'Label: Debian' | head -n 1)
    [[ -n $mirror ]] || fail "apt knows no package source of Debian: run: apt-get update"
    echo "check_debian: making a Debian of suite $suite in $folder"
    debootstrap --variant=minbase --include=ca-certificates,git "$suite" "$folder" "$mirror" >"$folder.log" 2>&1 ||
        fail "debootstrap could not make it: $(tail -n 1 "$folder.log"); remove $folder and try again"
fi
if [[ -e $folder/debootstrap ]] || ! grep -qs " $suite " "$folder/etc/apt/sources.list"; then
    fail "$folder is no complete Debian of suite $suite: remove it or name another folder"
fi

cp --dereference /etc/resolv.conf "$folder/etc/resolv.conf"
mount -t proc proc "$folder/proc"
mount --rbind /sys "$folder/sys"
mount --rbind /dev "$folder/dev"
rm -rf "$folder/root/wavepath"
git clone --quiet "$source_folder" "$folder/root/wavepath"

for command in scripts/demo.sh scripts/test.sh; do
    echo "check_debian: running $command on $suite"
    chroot "$folder" env --ignore-environment HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 CI=true \
        "/root/wavepath/$command" || fail "$command fails on $suite; the clone is $folder/root/wavepath"
done
echo "check_debian: both commands pass on $suite"
