#!/bin/bash
# ./test.sh [options of ctest]: installs what is missing, builds, runs all tests.
set -euo pipefail
root="$(cd "$(dirname "$0")" && pwd)"
. "$root/scripts/prepare.sh"

prepare all
cd "$root/build"
exec ctest --output-on-failure -j "$(nproc)" "$@"
