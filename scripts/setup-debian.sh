#!/usr/bin/env bash
# Installs what Voxray needs on Debian 12, from Debian packages alone. Does nothing where nothing is missing.
#
# Mesa comes from bookworm-backports (lavapipe has ray tracing from Mesa 25 on). That suite is added
# through the mirror that this machine's own apt configuration names for bookworm.
set -euo pipefail

# Each package and why it is here: docs/dependencies.md.
packages=(
  g++ cmake ninja-build pkg-config
  libvulkan-dev glslang-dev glslang-tools spirv-tools libspirv-cross-c-shared-dev
  libembree-dev libtbb-dev libopenimageio-dev libtinygltf-dev nlohmann-json3-dev libglm-dev
  libyaml-cpp-dev libcli11-dev libspdlog-dev libfmt-dev libxxhash-dev libgtest-dev libbenchmark-dev
  python3 python3-numpy python3-pandas python3-matplotlib python3-jinja2 python3-pil
  vulkan-validationlayers vulkan-tools
)
backports_packages=(mesa-vulkan-drivers)
mesa_wanted_major=25

say() { printf 'voxray setup: %s\n' "$*" >&2; }
die() { say "$*"; exit 1; }

installed() { dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null | grep -qx installed; }

mesa_is_new_enough() {
  local version
  version=$(dpkg-query -W -f '${Version}' mesa-vulkan-drivers 2>/dev/null) || return 1
  [ "${version%%.*}" -ge "$mesa_wanted_major" ] 2>/dev/null
}

missing=()
for package in "${packages[@]}"; do
  installed "$package" || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ] && mesa_is_new_enough; then
  exit 0
fi

# Become root only where something has to be installed.
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || die "missing packages need root, and there is no sudo. As root: apt-get install ${missing[*]}"
  exec sudo -- "$0" "$@"
fi

. /etc/os-release
[ "${ID:-}" = debian ] && [ "${VERSION_ID:-}" = 12 ] ||
  die "set-up knows Debian 12; this is ${PRETTY_NAME:-unknown}. './voxray doctor' lists what is needed and how it is called elsewhere"

export DEBIAN_FRONTEND=noninteractive
apt_get() { apt-get -qq -o Dpkg::Use-Pty=0 -o Acquire::Retries=3 "$@"; }

if ! mesa_is_new_enough; then
  # The suite that holds Mesa 25, through the mirror that already serves bookworm here.
  if ! apt-cache policy 2>/dev/null | grep -q 'n=bookworm-backports'; then
    apt_get update
    mirror=$(apt-get indextargets --format '$(REPO_URI)' \
      'Created-By: Packages' 'Codename: bookworm' 'Origin: Debian' | head -n 1)
    [ -n "$mirror" ] || die "apt's configuration names no Debian mirror for bookworm: add one, then try again"
    printf 'Types: deb\nURIs: %s\nSuites: bookworm-backports\nComponents: main\nSigned-By: %s\n' \
      "$mirror" /usr/share/keyrings/debian-archive-keyring.gpg \
      > /etc/apt/sources.list.d/voxray-backports.sources
    say "added bookworm-backports"
  fi
fi

say "installing ${#missing[@]} packages and Mesa ${mesa_wanted_major} (a few minutes)"
apt_get update
if [ ${#missing[@]} -gt 0 ]; then
  apt_get install -y --no-install-recommends "${missing[@]}" >/dev/null
fi
if ! mesa_is_new_enough; then
  apt_get install -y --no-install-recommends -t bookworm-backports "${backports_packages[@]}" >/dev/null
  mesa_is_new_enough || die "mesa-vulkan-drivers from bookworm-backports is older than $mesa_wanted_major"
fi
