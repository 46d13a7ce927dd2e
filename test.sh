#!/bin/bash
# ./test.sh [options of ctest]: installs what is missing, builds, runs all tests.
# ./test.sh --benchmarks [FILTER [options of Google Benchmark]]: prints speeds instead.
set -euo pipefail
root="$(cd "$(dirname "$0")" && pwd)"
. "$root/scripts/prepare.sh"

if [ "${1:-}" = --benchmarks ]; then
  packages="$packages libbenchmark-dev"
  install_missing
  [ ! -f "$root/build/build.ninja" ] || cmake "$root/build" >/dev/null # the library may be new
  prepare fluid_benchmark smoothing_benchmark
  exec "$root/build/tests/bin/fluid_benchmark" ${2:+--benchmark_filter="$2"} "${@:3}"
fi

prepare all
cd "$root/build"
exec ctest --output-on-failure -j "$(nproc)" "$@"
