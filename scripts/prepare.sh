# Sourced by run.sh and test.sh: installs the packages that are missing (Debian 12), configures and builds.
# Usage: prepare TARGET...

packages="libdeal.ii-dev libcgal-dev g++ cmake ninja-build ccache lld libgtest-dev openmpi-bin python3"

say() { printf '%s\n' "$*" >&2; }

install_missing() {
  local missing="" package
  for package in $packages; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  local as_root=""
  if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "These packages are missing, and only root may install them (there is no sudo):$missing"
      exit 1
    fi
    as_root=sudo
  fi
  say "Installing:$missing"
  # shellcheck disable=SC2086
  $as_root env DEBIAN_FRONTEND=noninteractive sh -c "apt-get -q update && apt-get -qy install --no-install-recommends $missing" >&2
}

# As many compilers as there are cores and memory: a file with deal.II headers takes up to 1.5 GB.
n_jobs() {
  local memory_kb cores by_memory
  cores=$(nproc)
  memory_kb=$(awk '/MemAvailable/ { print $2 }' /proc/meminfo 2>/dev/null)
  by_memory=$(( ${memory_kb:-2000000} / 1500000 ))
  [ "$by_memory" -ge 1 ] || by_memory=1
  [ "$by_memory" -lt "$cores" ] && echo "$by_memory" || echo "$cores"
}

prepare() {
  install_missing
  export CCACHE_DIR="${CCACHE_DIR:-${XDG_CACHE_HOME:-$HOME/.cache}/ccache}"
  [ -f "$root/build/build.ninja" ] || (cd "$root" && cmake --preset release >&2)
  ninja -C "$root/build" -j "$(n_jobs)" "$@" >&2
}

# Open MPI refuses root otherwise; harmless for everyone else.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
