#!/usr/bin/env bash
# Installs what Voxray needs on Debian 12 and 13 from Debian packages alone, and tries the same names on systems made
# from Debian or Ubuntu. Does nothing where nothing is missing.
# setup-debian.sh [build|run|sweep|test|slurm]: packages of the build, those of every command, and those of `voxray
# sweep`, of the tests, or of the test on Slurm as well.
#
# Lavapipe has ray tracing from Mesa 25 on. Debian 12 has that in bookworm-backports: that suite is added through the
# mirror that this machine's own apt configuration names for bookworm.
set -euo pipefail

purpose=${1:-run}
case $purpose in
  build) groups=build ;;
  slurm) groups="build run sweep slurm" ;;
  *)     groups="build run $purpose" ;;
esac
mesa_wanted_major=25

say() { printf 'voxray set-up: %s\n' "$*" >&2; }
die() { printf 'voxray: error: %s\n' "$*" >&2; exit 1; }

# What system this is, as packages.txt marks it: "debian 12", "ubuntu 24.04"; one that is made from another counts as
# that, of no version.
system=
if [ -r /etc/os-release ]; then . /etc/os-release; fi
for id in ${ID:-} ${ID_LIKE:-}; do
  case $id in debian|ubuntu) system=$id; break ;; esac
done
if [ "${ID:-}" = "$system" ]; then system+=" ${VERSION_ID:-}"; fi

# Packages of the list for this system that are not installed. Debian 12's Mesa is apart, because of its version.
list=$(dirname "$(readlink -f "$0")")/packages.txt
wanted=$(awk -F'|' -v groups=" $groups " -v system_name="$system " '!/^#/ && NF {
  gsub(/ /, "", $1)
  split($3, package, /[][]/)
  gsub(/ /, "", package[1])
  if (package[1] == "mesa-vulkan-drivers" && system_name == "debian 12 ") next
  isHere = package[2] == "" || index(system_name, package[2] " ") == 1
  if (isHere && index(groups, " " $1 " ")) print package[1] }' "$list")
installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $wanted 2>/dev/null | sed -n 's/ installed$//p') || true
missing=$(comm -23 <(sort -u <<<"$wanted") <(sort -u <<<"$installed") | tr '\n' ' ')

mesa_is_new_enough() {
  local version
  version=$(dpkg-query -W -f '${db:Status-Status} ${Version}' mesa-vulkan-drivers 2>/dev/null) || return 1
  [[ $version =~ ^installed\ ([0-9]+:)?([0-9]+)\. ]] && [ "${BASH_REMATCH[2]}" -ge "$mesa_wanted_major" ]
}

wants_backports() { [ "$purpose" != build ] && [ "$system" = "debian 12" ] && ! mesa_is_new_enough; }

if [ -z "${missing// /}" ] && ! wants_backports; then
  exit 0
fi

case $system in
  "debian 12"|"debian 13") ;;
  debian*|ubuntu*) say "not tried on ${PRETTY_NAME:-this system}: it goes on with Debian's names of packages" ;;
  *) die "set-up knows Debian 12 and 13, and systems made from Debian or Ubuntu, and this is ${PRETTY_NAME:-unknown}: './voxray doctor' lists what is needed and how it is called here; VOXRAY_SKIP_SETUP=1 goes on without set-up" ;;
esac

# Become root only where something has to be installed.
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null ||
    die "packages are missing and there is no sudo: run '$0' as root once (missing: ${missing:-Mesa $mesa_wanted_major})"
  say "needs root to install packages"
  exec sudo -- "$(readlink -f "$0")" "$purpose"
fi

export DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes
apt_get() {
  apt-get -qq -o Dpkg::Use-Pty=0 -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 "$@" >/dev/null ||
    die "apt-get $1 failed (its own message stands above)"
}

say "installing packages (a minute or two): ${missing}"
apt_get update

if wants_backports; then
  # The suite that holds Mesa 25, through the mirror that already serves bookworm here.
  suites=$(apt-get indextargets --format '$(CODENAME) $(REPO_URI)' 'Created-By: Packages' 'Origin: Debian')
  suites+=$'\n'$(apt-get indextargets --format '$(CODENAME) $(REPO_URI)' 'Created-By: Packages' 'Origin: Debian Backports')
  if ! grep -q '^bookworm-backports ' <<<"$suites"; then
    mirror=$(awk '$1 == "bookworm" && !seen { print $2; seen = 1 }' <<<"$suites")
    [ -n "$mirror" ] || die "apt's configuration names no Debian mirror for bookworm: add one, then try again"
    printf 'Types: deb\nURIs: %s\nSuites: bookworm-backports\nComponents: main\nSigned-By: %s\n' \
      "$mirror" /usr/share/keyrings/debian-archive-keyring.gpg \
      > /etc/apt/sources.list.d/voxray-backports.sources
    say "added the suite bookworm-backports in /etc/apt/sources.list.d/voxray-backports.sources"
    apt_get update
  fi
fi

if [ -n "${missing// /}" ]; then
  apt_get install -y --no-install-recommends $missing
fi
if wants_backports; then
  apt_get install -y --no-install-recommends -t bookworm-backports mesa-vulkan-drivers
  mesa_is_new_enough || die "mesa-vulkan-drivers from bookworm-backports is older than $mesa_wanted_major"
fi
[ "$purpose" = build ] || mesa_is_new_enough ||
  say "Mesa is older than $mesa_wanted_major here, so its lavapipe traces no rays: Embree does, as with --tracer embree"
