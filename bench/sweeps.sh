#!/usr/bin/env bash
# Sweeps a folder of Cartesian volumes made BCC, at two isovalues each, exact and marching, and prints the table of
# docs/structures.md: for each kind of structure the best of its blocks against none, and how far auto was from the best. Every
# structure once a view, exact; the fast ones five times a view, so that what is left of their order is not chance; marching.
#   bench/sweeps.sh VOLUMES OUT       sweeps (three quarters of an hour on two cores) into OUT and prints
#   bench/sweeps.sh --table OUT       prints what OUT holds
# With QUINCUNX=PROGRAM that program is used and nothing is built.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

scenes=(mri_head:130 mri_head:700 cthead:40 cthead:140 vhf_pelvis:60 vhf_pelvis:155 bunny_ct_256:-700 bunny_ct_256:600
        aneurism:40 aneurism:120)

sweep() {  # VOLUMES OUT
  local program=${QUINCUNX:-$root/build/release/quincunx}
  [[ -n ${QUINCUNX:-} ]] || "$root/cmake/build.sh" quincunx >&2
  mkdir -p "$2"
  for scene in "${scenes[@]}"; do
    local name=${scene%:*} isovalue=${scene#*:}
    local volume=$2/$name.nrrd
    [[ -s $volume ]] || "$program" convert "$1/$name.nrrd" "$volume" --lattice bcc --encoding raw --quiet
    local flags=("$volume" --iso="$isovalue" --orbit 3 --quiet) fast=none,grid,octree,distance,kdtree:shallow
    "$program" sweep "${flags[@]}" --blocks 4,8,16 -o "$2/${name}_${isovalue}_exact"
    "$program" sweep "${flags[@]}" --blocks 4,8,16 --repeat 5 --structures $fast -o "$2/${name}_${isovalue}_fast"
    "$program" sweep "${flags[@]}" --blocks 8,16 --intersect march --structures $fast -o "$2/${name}_${isovalue}_march"
  done
}

# One line of the table from a sweep.json: the kinds of structure in a fixed order, each "ms (block)".
line='
def short: if . >= 100 then round | tostring else (. * 10 | round / 10 | tostring) end;
def best(kind): [.settings[] | select(.structure == kind)] | if length == 0 then "" else min_by(.frame_ms_median)
  | "\(.frame_ms_median | short)" + (if .block then " (\(.block))" else "" end) end;
. as $s | (.settings | map(select(.structure != "none")) | min_by(.frame_ms_median)) as $b
| "| " + ([(.volume | split("/") | last | rtrimstr(".nrrd")), (.isovalues | map(tostring) | join(",")), best("none"), best("grid"), best("octree"),
    best("distance"), best("bvh"), best("bvh:cubes"), best("bvh:boxes"), best("bih"), best("kdtree:shallow"), best("kdtree:deep"),
    "\($b.structure) \($b.block)", ($b.speedup_median | short), (.auto | "\(.structure) \(.block): \(.times_best * 100 | round / 100)")]
  | join(" | ")) + " |"'

table() {  # OUT exact|fast|march
  echo "| volume | isovalue | none | grid | octree | distance | bvh | bvh:cubes | bvh:boxes | bih | kdtree:shallow | kdtree:deep | best | speed-up | auto, times the best |"
  echo "|:--|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|:--|--:|:--|"
  for scene in "${scenes[@]}"; do
    local json=$1/${scene%:*}_${scene#*:}_$2/sweep.json
    [[ ! -s $json ]] || jq -r "$line" "$json"
  done
}

if (($# != 2)); then
  sed -n '2,7p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
command -v jq >/dev/null || { echo "sweeps.sh: found no jq, expected it (packages.txt)" >&2; exit 1; }
out=$2
[[ $1 == --table ]] || sweep "$1" "$out"
for method in exact fast march; do
  printf '%s:\n\n' "$method"
  table "$out" $method
  echo
done
