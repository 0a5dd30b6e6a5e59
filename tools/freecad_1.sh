#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run the workbench's tests in FreeCAD 1.0: a Debian 13 in a folder of its own (made once, about
# 3 GB), with a copy of this checkout inside. Needs root. Any arguments are the make targets to run
# there instead of test-in-freecad. FREECAD_1_ROOT names another folder.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
repository=$PWD
root=${FREECAD_1_ROOT:-/var/tmp/volfrep-debian13}
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(test-in-freecad)

say() { printf 'freecad-1: %s\n' "$*"; }
refuse() { printf 'freecad-1: %s\n' "$*" >&2; exit 1; }

[ "$(id -u)" = 0 ] || refuse "a Debian 13 in a folder can be made and entered by root only."
command -v debootstrap >/dev/null || apt-get install -y -qq debootstrap >/dev/null ||
  refuse "debootstrap is missing and could not be installed."

if [ ! -e "$root/.complete" ]; then
  say "making a Debian 13 in $root"
  rm -rf --one-file-system "$root"
  mkdir -p "$root"
  debootstrap --variant=minbase --include=make,ca-certificates trixie "$root" >"$root.log" 2>&1 ||
    { tail -n 20 "$root.log" >&2; refuse "debootstrap failed: see $root.log."; }
  # No manuals, and no flushing to disk of what can be made again.
  printf 'path-exclude /usr/share/doc/*\npath-exclude /usr/share/man/*\n' \
    >"$root/etc/dpkg/dpkg.cfg.d/no-manuals"
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
  touch "$root/.complete"
fi

unmount() {
  for place in repository/../shared dev sys proc; do
    mountpoint -q "$root/$place" && umount -l "$root/$place"
  done
  true
}
trap unmount EXIT
unmount
mkdir -p "$root/repository"
mount -t proc proc "$root/proc"
mount -t sysfs sys "$root/sys"
mount --rbind --make-rslave /dev "$root/dev"
if [ -d "$repository/../shared" ]; then
  mkdir -p "$root/shared"
  mount --bind -o ro "$(readlink -f "$repository/../shared")" "$root/shared"
fi
# The network and its certificates are the host's.
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"

# What git knows of, as it is now; the environment that was made there before stays.
find "$root/repository" -mindepth 1 -maxdepth 1 ! -name .venv ! -name .cache -exec rm -rf {} +
git ls-files -z --cached --others --exclude-standard | tar -c --null -T - --ignore-failed-read |
  tar -x -C "$root/repository"

inside() {
  chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
    ${PIP_INDEX_URL:+PIP_INDEX_URL="$PIP_INDEX_URL"} SSL_CERT_FILE=/etc/ssl/certs/ca-certificates.crt \
    SETUP_WITHOUT_TOOLS=1 "$@"
}
status=0
inside make --no-print-directory -C /repository setup "${targets[@]}" </dev/null || status=$?
mkdir -p build
rm -rf build/freecad-1
[ ! -d "$root/repository/build" ] || cp -r "$root/repository/build" build/freecad-1
exit $status
