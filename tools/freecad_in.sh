#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run the workbench's tests in the FreeCAD of another Debian, which gets a folder of its own (made
# once, about 3 GB) with a copy of this checkout inside. Needs root:
#     tools/freecad_in.sh trixie            # Debian 13: FreeCAD 1.0, Python 3.13
#     tools/freecad_in.sh forky setup       # Debian testing: FreeCAD 1.1, Python 3.14
#     tools/freecad_in.sh bookworm test     # Debian 12, with nothing in it but make: FreeCAD 0.20
# Further arguments are the make targets to run there instead of test-in-freecad. The folders lie
# in FREECAD_ROOTS (default: /var/tmp); what the run left in build/ comes back as build/<Debian>.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
repository=$PWD
suite=${1:-}
say() { printf 'freecad-in: %s\n' "$*"; }
refuse() { printf 'freecad-in: %s\n' "$*" >&2; exit 1; }
case "$suite" in
  bookworm) name=debian12 without= ;;
  trixie) name=debian13 without=1 ;;
  forky) name=forky without=1 ;;
  *) refuse "say which Debian: 'bookworm' (FreeCAD 0.20), 'trixie' (1.0) or 'forky' (1.1), not \
'$suite'." ;;
esac
shift
root=${FREECAD_ROOTS:-/var/tmp}/volfrep-$name
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(test-in-freecad)

[ "$(id -u)" = 0 ] || refuse "a Debian in a folder can be made and entered by root only."
command -v debootstrap >/dev/null || apt-get install -y -qq debootstrap >/dev/null ||
  refuse "debootstrap is missing and could not be installed."

# One at a time: all runs in a Debian use the same copy of the checkout.
exec 9>"$root.lock"
flock -n 9 || { say "another run is in $root: waiting for its end"; flock 9; }

if [ ! -e "$root/.complete" ]; then
  say "making a Debian '$suite' in $root"
  rm -rf --one-file-system "$root"
  mkdir -p "$root"
  # An older debootstrap does not know a younger Debian by name: all are made as 'sid' is.
  debootstrap --variant=minbase --include=make,ca-certificates "$suite" "$root" \
    http://deb.debian.org/debian /usr/share/debootstrap/scripts/sid >"$root.log" 2>&1 ||
    { tail -n 20 "$root.log" >&2; refuse "debootstrap failed: see $root.log."; }
  # No manuals, and no flushing to disk of what can be made again. A mirror's list of packages may
  # be past its date while Debian testing stands still; it is signed all the same.
  printf 'path-exclude /usr/share/doc/*\npath-exclude /usr/share/man/*\n' \
    >"$root/etc/dpkg/dpkg.cfg.d/no-manuals"
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
  echo 'Acquire::Check-Valid-Until "false";' >"$root/etc/apt/apt.conf.d/valid-until"
  touch "$root/.complete"
fi

unmount() {
  for place in parts torture dev sys proc; do
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
# The folders of real parts, where there are any: to read, not to write.
real=()
for kind in parts torture; do
  variable=VOLFREP_${kind^^}
  place=$(readlink -f "${!variable:-../shared/$kind}" || true)
  [ -d "$place" ] || continue
  mkdir -p "$root/$kind"
  mount --bind -o ro "$place" "$root/$kind"
  real+=("$variable=/$kind")
done
# The network and its certificates are the host's.
cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"

# What git knows of, as it is now; the environment that was made there before stays.
find "$root/repository" -mindepth 1 -maxdepth 1 ! -name .venv ! -name .cache -exec rm -rf {} +
git ls-files -z --cached --others --exclude-standard | tar -c --null -T - --ignore-failed-read |
  tar -x -C "$root/repository"

inside() {
  chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
    ${PIP_INDEX_URL:+PIP_INDEX_URL="$PIP_INDEX_URL"} \
    SSL_CERT_FILE=/etc/ssl/certs/ca-certificates.crt ${without:+SETUP_WITHOUT_TOOLS=1} \
    ${PYTEST_XDIST_AUTO_NUM_WORKERS:+PYTEST_XDIST_AUTO_NUM_WORKERS="$PYTEST_XDIST_AUTO_NUM_WORKERS"} \
    "${real[@]}" "$@"
}
status=0
inside make --no-print-directory -C /repository setup "${targets[@]}" </dev/null || status=$?
mkdir -p build
rm -rf "build/$name"
[ ! -d "$root/repository/build" ] || cp -r "$root/repository/build" "build/$name"
exit $status
