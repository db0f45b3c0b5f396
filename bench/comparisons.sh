#!/usr/bin/env bash
# comparisons.sh [FOLDER]: makes the tables and charts of docs/comparison.md again, in FOLDER (out/comparisons): the presets of `quincunx compare`, a real
# volume as its own truth, and the orders of approximation. A quarter of an hour on two cores.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export PATH="$PWD/build/release:$PATH"

out=${1:-out/comparisons}
mkdir -p "$out"
for preset in marschner-lobb table3 table5; do
  echo "== $preset" >&2
  quincunx compare --preset "$preset" -o "$out/$preset" --quiet
done
quincunx compare ../shared/data/mri_head.nrrd --iso 130 --azimuth 55 --elevation 12 --intersect exact -o "$out/mri_head" --quiet
quincunx-bench convergence --markdown --json "$out/convergence.json" >"$out/convergence.md"
echo "$out" >&2
