#!/usr/bin/env bash
# Sweeps a folder of Cartesian volumes through two transfer functions each, and one function with opacity at every value, and prints the
# tables of docs/structures.md: for each kind of structure the best of its blocks against none, how many pictures were the same, bit for bit;
# and the sizes of bricks. At the end the same of the BCC volumes that `quincunx convert` makes of them, with bcc7.
#   bench/volumes.sh VOLUMES OUT      sweeps (a quarter of an hour on two cores) into OUT and prints
#   bench/volumes.sh --table OUT      prints what OUT holds
# With QUINCUNX=PROGRAM that program is used and nothing is built.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

scenes=(cthead:opaque cthead:clear mri_head:opaque mri_head:clear aneurism:opaque aneurism:clear bunny_ct_256:opaque bunny_ct_256:clear
        vhf_pelvis:opaque vhf_pelvis:clear mri_head:fog)
bcc_scenes=(mri_head:clear aneurism:clear)

sweep() {  # VOLUMES OUT
  local program=${QUINCUNX:-$root/build/release/quincunx}
  [[ -n ${QUINCUNX:-} ]] || "$root/cmake/build.sh" quincunx >&2
  mkdir -p "$2"
  for scene in "${scenes[@]}"; do
    local name=${scene%:*} kind=${scene#*:}
    local flags=(--tf "$root/data/transfer/${name}_$kind.json" --orbit 2 --repeat 2 --quiet)
    # Nothing is empty in a fog: there cells are best not asked.
    if [[ $kind == fog ]]; then flags+=(--blocks 16,64 --cell-test both); else flags+=(--blocks 8,16); fi
    "$program" sweep "$1/$name.nrrd" "${flags[@]}" --bricks 8,16,32,64 -o "$2/${name}_$kind"
  done
  for scene in "${bcc_scenes[@]}"; do
    local name=${scene%:*} kind=${scene#*:}
    "$program" convert "$1/$name.nrrd" "$2/$name.nrrd" --lattice bcc --encoding raw --quiet
    "$program" sweep "$2/$name.nrrd" --tf "$root/data/transfer/${name}_$kind.json" --orbit 2 --repeat 2 --quiet --blocks 8,16 --bricks 8,16,32,64 \
      -o "$2/${name}_${kind}_bcc"
    rm "$2/$name.nrrd"
  done
}

# One line of the first table from a sweep.json: the kinds of structure in a fixed order, each "ms (block)".
frames='
def short: if . >= 100 then round | tostring else (. * 10 | round / 10 | tostring) end;
def best(kind): [.settings[] | select(.structure == kind)] | if length == 0 then "" else min_by(.frame_ms_median)
  | "\(.frame_ms_median | short)" + (if .block then " (\(.block)\(if .cell_test then "" else "-" end))" else "" end) end;
. as $s | (.settings | map(select(.structure != "none")) | min_by(.frame_ms_median)) as $b
| ([.settings[] | select(.differing_pixels > 0)] | length) as $other
| "| " + ([$name, best("none"), best("grid"), best("octree"), best("distance"), best("bvh"), best("bvh:cubes"), best("bvh:boxes"),
    best("bih"), best("kdtree:shallow"), best("kdtree:deep"), "\($b.structure) \($b.block)", ($b.speedup_median * 100 | round / 100 | tostring),
    (.auto | "\(.structure) \(.block): \(.times_best * 100 | round / 100)"), "\((.settings | length) - $other) of \(.settings | length)"]
  | join(" | ")) + " |"'

# One line of the second: frame times by size of brick.
bricks='
def short: if . >= 100 then round | tostring else (. * 10 | round / 10 | tostring) end;
def mib: . / 1048576 * 10 | round / 10 | tostring;
([.bricks[] | select(.differing_pixels > 0)] | length) as $other
| "| " + ([$name] + [.bricks[] | "\(.frame_ms_median | short)" + (if .brick then " (\(.resident) of \(.count), \(.device_bytes | mib) MiB)" else " (\(.device_bytes | mib) MiB)" end)]
  + ["\((.bricks | length) - $other) of \(.bricks | length)"] | join(" | ")) + " |"'

table() {  # OUT FILTER
  for scene in "${scenes[@]}" "${bcc_scenes[@]/%/_bcc}"; do
    local name=${scene/:/_}
    [[ ! -s $1/$name/sweep.json ]] || jq -r --arg name "${name//_bcc/, bcc7}" "$2" "$1/$name/sweep.json"
  done
}

if (($# != 2)); then
  sed -n '2,8p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
command -v jq >/dev/null || { echo "volumes.sh: found no jq, expected it (packages.txt)" >&2; exit 1; }
out=$2
[[ $1 == --table ]] || sweep "$1" "$out"
printf 'Frame times in ms, the best block in parentheses, "-" without the cell test:\n\n'
echo "| scene | none | grid | octree | distance | bvh | bvh:cubes | bvh:boxes | bih | kdtree:shallow | kdtree:deep | best | speed-up | auto, times the best | same picture |"
echo "|:--|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|:--|--:|:--|:--|"
table "$out" "$frames"
printf '\nFrame times in ms, bricks resident of all, and what the samples take on the device:\n\n'
echo "| scene | whole | bricks of 8 | of 16 | of 32 | of 64 | same picture |"
echo "|:--|--:|--:|--:|--:|--:|:--|"
table "$out" "$bricks"
