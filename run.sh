#!/bin/bash
# ./run.sh [FILE.prm ...] [options of breakwater]: installs what is missing, builds, runs each scene.
# Without a file: the dam break that bends an elastic obstacle.
set -euo pipefail
root="$(cd "$(dirname "$0")" && pwd)"
. "$root/scripts/prepare.sh"

scenes=()
options=()
while [ $# -gt 0 ]; do
  case "$1" in
    --set | --output | --plugin-path) options+=("$1" "${2:?$1 needs a value}"); shift ;;
    -*) options+=("$1") ;;
    *) scenes+=("$1") ;;
  esac
  shift
done
[ ${#scenes[@]} -gt 0 ] || scenes=("$root/parameter_files/cookbooks/dam_break_elastic_obstacle.prm")

prepare breakwater breakwater_plugins
for scene in "${scenes[@]}"; do
  say "Running $scene"
  "$root/build/bin/breakwater" "$scene" ${options[@]+"${options[@]}"}
done
