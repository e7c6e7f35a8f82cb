#!/usr/bin/env bash
# What this machine has of the things that Voxray builds and runs on, and what the missing ones are called on
# Debian and Ubuntu, Fedora and Arch. Needs bash alone. Exit status 1 where something is missing.
set -euo pipefail

list=$(dirname "$(readlink -f "$0")")/packages.txt
include_folders=(/usr/include /usr/local/include /usr/include/*-linux-gnu)
vulkan_folders=(/usr/share/vulkan /etc/vulkan /usr/local/share/vulkan)
data_folders=(/usr/share /usr/lib /usr/local/lib)

# Whether version $1 is at least $2.
at_least() { [ "$(printf '%s\n%s\n' "$2" "$1" | sort -V | head -n 1)" = "$2" ]; }

# Prints what was found. $1: kind of probe, $2: name, $3: smallest version of a command; of headers and files any that follows.
probe() {
  local folder found version header
  case $1 in
    command)
      found=$(command -v "$2") || return 1
      [ -n "${3:-}" ] || { echo "$found"; return 0; }
      version=$("$found" -dumpfullversion 2>/dev/null || "$found" --version 2>/dev/null || true)
      [[ $version =~ [0-9]+(\.[0-9]+)+ ]] || return 1
      echo "$found ${BASH_REMATCH[0]}"
      at_least "${BASH_REMATCH[0]}" "$3"
      ;;
    header|file)
      local folders=("${include_folders[@]}")
      [ "$1" = file ] && folders=("${data_folders[@]}")
      for header in "${@:2}"; do
        for folder in "${folders[@]}"; do
          [ -e "$folder/$header" ] && { echo "$folder/$header"; return 0; }
        done
      done
      return 1
      ;;
    python)
      [ -x /usr/bin/python3 ] || return 1
      /usr/bin/python3 -c 'import importlib.util, sys
spec = importlib.util.find_spec(sys.argv[1])
print(spec.origin) if spec else sys.exit(1)' "$2" 2>/dev/null
      ;;
    vulkan)
      for folder in "${vulkan_folders[@]}"; do
        found=$(compgen -G "$folder/$2" | head -n 1) && [ -n "$found" ] && { echo "$found"; return 0; }
      done
      return 1
      ;;
  esac
}

system=unknown id=
if [ -r /etc/os-release ]; then
  system=$(. /etc/os-release && echo "${PRETTY_NAME:-unknown}")
  id=$(. /etc/os-release && echo "${ID:-} ${VERSION_ID:-}")
fi
echo "System: $system, $(uname -m), $(getconf _NPROCESSORS_ONLN) cores"
echo
echo "Packages:"
missing=()
declare -A wants=([sweep]="./voxray sweep" [test]="./voxray test" [slurm]="tests/scale/slurm.sh")
while IFS='|' read -r purpose check debian fedora arch; do
  [[ $purpose = \#* || -z ${check:-} ]] && continue
  read -r debian <<<"$debian"; read -r purpose <<<"$purpose"
  read -ra words <<<"$check"
  if found=$(probe "${words[@]}"); then
    printf '  ok       %-28s %s\n' "$debian" "$found"
  elif [[ $debian =~ \[(.*)\] && "$id " != "${BASH_REMATCH[1]} "* ]]; then
    printf '  other    %-28s tests that want it are skipped here\n' "$debian"
  elif [ "$purpose" != build ] && [ "$purpose" != run ]; then
    printf '  absent   %-28s only %s wants it\n' "$debian" "${wants[$purpose]}"
  else
    printf '  MISSING  %-28s %s%s\n' "$debian" "$check" "${found:+(found: $found)}"
    missing+=("$debian|$fedora|$arch")
  fi
done < "$list"

# ChromeDriver, by which tests look at pages in a browser, is asked for at this name
if command -v getent >/dev/null && ! getent hosts localhost >/dev/null; then
  printf '  absent   %-28s only ./voxray test wants it: it resolves to no address; add "127.0.0.1 localhost" to /etc/hosts\n' localhost
fi

[ ${#missing[@]} -eq 0 ] && exit 0
echo
echo "Missing, and what it is called (names outside Debian are from those systems' lists, untested):"
printf '  %-28s | %-24s | %s\n' "Debian 12 and 13, Ubuntu" Fedora Arch
for row in "${missing[@]}"; do
  IFS='|' read -r debian fedora arch <<<"$row"
  for name in debian fedora arch; do read -r "${name?}" <<<"${!name}"; done
  printf '  %-28s | %-24s | %s\n' "$debian" "$fedora" "$arch"
done
echo
echo "On Debian 12 and 13, './voxray run' or scripts/setup-debian.sh installs all of them; on Ubuntu they try to."
exit 1
