#!/usr/bin/env bash
# README's two commands in a bare Debian: makes a root by debootstrap, through the mirror of this machine's own apt
# configuration, clones HEAD into it (with ../shared next to it, where there is one) and runs both commands there. Prints
# the time of each and what was skipped. Exit status 1 where one fails. Wants root; not part of ./voxray test.
# fresh.sh [--first] SUITE [ROOT]: --first runs the first command alone. SUITE is bookworm or trixie. ROOT is a new or
# an empty folder, which is kept; without it the root goes again at the end.
set -euo pipefail

die() { echo "fresh.sh: error: $*" >&2; exit 2; }

commands=("./voxray run configs/quickstart.yaml" "./voxray test")
if [ "${1:-}" = --first ]; then
  commands=("${commands[0]}")
  shift
fi
[ $# -ge 1 ] && [ $# -le 2 ] || die "usage: fresh.sh [--first] SUITE [ROOT]"
suite=$1
[ "$(id -u)" -eq 0 ] || die "debootstrap and chroot want root"
command -v debootstrap >/dev/null || die "debootstrap is not installed"
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' | sed -n 1p)
[ -n "$mirror" ] || die "apt's configuration names no Debian mirror"

repository=$(realpath "$(dirname "$(readlink -f "$0")")/../..")
kept=${2:-}
mkdir -p "${kept:-/var/tmp}"
[ -z "$kept" ] || [ -z "$(ls -A "$kept")" ] || die "$kept is not empty"
root=$(realpath "${kept:-$(mktemp -d /var/tmp/voxray-fresh-XXXXXX)}")

# Mounts go before files do: no rm may reach the machine's own /dev.
leave() {
  local place
  for place in root/shared sys dev proc; do
    if mountpoint -q "$root/$place"; then umount -R "$root/$place"; fi
  done
  if [ -z "$kept" ]; then rm -rf --one-file-system "$root"; fi
}
trap leave EXIT
chmod 755 "$root"

echo "fresh.sh: making $suite in $root" >&2
made=$(mktemp)
debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$made" 2>&1 || {
  tail -n 20 "$made" >&2
  die "debootstrap failed (whole log: $made)"
}
rm "$made"
mount -t proc proc "$root/proc"
for place in dev sys; do
  mount --rbind "/$place" "$root/$place"
  mount --make-rslave "$root/$place"
done
apt-config dump Acquire >"$root/etc/apt/apt.conf.d/90as-outside"
echo "127.0.0.1 localhost" >"$root/etc/hosts"
if [ -e /etc/resolv.conf ]; then cp -L /etc/resolv.conf "$root/etc/resolv.conf"; fi
git clone --quiet "$repository" "$root/root/voxray"
if [ -d "$repository/../shared" ]; then
  mkdir "$root/root/shared"
  mount --bind -o ro "$repository/../shared" "$root/root/shared"
fi

log=$root/root/fresh.log
: >"$log"
told=() failed=0
for command in "${commands[@]}"; do
  echo "fresh.sh: $command" >&2
  began=$SECONDS status=0
  chroot "$root" env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb \
    sh -c "cd /root/voxray && $command" </dev/null 2>&1 | tee -a "$log" || status=${PIPESTATUS[0]}
  took=$((SECONDS - began))
  told+=("$(printf '%-38s exit status %d after %d min %02d s' "$command" "$status" $((took / 60)) $((took % 60)))")
  if [ "$status" -ne 0 ]; then failed=1; fi
done

echo
echo "$(. "$root/etc/os-release"; echo "$PRETTY_NAME"), $(getconf _NPROCESSORS_ONLN) cores, $(git -C "$repository" rev-parse --short HEAD):"
printf '%s\n' "${told[@]}"
grep -E '^skipped |^[0-9]+ tests skipped$' "$log" || true
exit $failed
