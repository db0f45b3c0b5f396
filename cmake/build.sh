#!/usr/bin/env bash
# build.sh [TARGET ...]: configures the preset PRESET (of the environment; `release`) and builds the targets given (all
# without any), with as many jobs as processors and memory allow.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# A compiler may take a good 1 GiB with the largest of the headers.
gib=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo)
jobs=$(nproc)
((jobs <= gib)) || jobs=$((gib > 1 ? gib : 1))

preset=${PRESET:-release}
cmake --preset "$preset"
if (($# > 0)); then
  cmake --build --preset "$preset" --parallel "$jobs" --target "$@"
else
  cmake --build --preset "$preset" --parallel "$jobs"
fi
