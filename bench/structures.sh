#!/usr/bin/env bash
# Sweeps every structure with blocks of 8 cells over a folder of Cartesian volumes, as isosurfaces of the BCC volumes that `quincunx convert` makes of them
# and through transfer functions, then makes the published experiments again (`quincunx sweep --preset`); prints the tables of docs/structures.md.
#   bench/structures.sh VOLUMES OUT   measures (a quarter of an hour on two cores) into OUT and prints
#   bench/structures.sh --table OUT   prints what OUT holds
# With QUINCUNX=PROGRAM that program is used and nothing is built.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

surfaces=(cthead:140 aneurism:40 mri_head:130 bunny_ct_256:600)
looks=(cthead:clear aneurism:clear aneurism:opaque mri_head:clear mri_head:fog)
untested=(cthead:140 aneurism:40)  # again without the test of single cells: structures alone skip
presets=(ganter-table1 ganter-figure6 ganter-figure7 ganter-figure8 ganter-figure10 zellmann-table1 zellmann-figure3 zellmann-figure4 zellmann-figure5 kinkelin-table3)

measure() {  # VOLUMES OUT
  local program=${QUINCUNX:-$root/build/release/quincunx} scene name
  [[ -n ${QUINCUNX:-} ]] || "$root/cmake/build.sh" quincunx >&2
  mkdir -p "$2"
  sweep() { "$program" sweep "$@" --blocks 8 --orbit 3 --repeat 3 --quiet; }
  for scene in "${surfaces[@]}"; do
    name=${scene%:*}
    "$program" convert "$1/$name.nrrd" "$2/$name.nrrd" --lattice bcc --encoding raw --quiet
    sweep "$2/$name.nrrd" --iso "${scene#*:}" -o "$2/${name}_${scene#*:}"
  done
  for scene in "${looks[@]}"; do
    name=${scene%:*}
    sweep "$1/$name.nrrd" --tf "$root/data/transfer/${name}_${scene#*:}.json" -o "$2/${name}_${scene#*:}"
  done
  for scene in "${untested[@]}"; do
    name=${scene%:*}
    sweep "$2/$name.nrrd" --iso "${scene#*:}" --cell-test off -o "$2/${name}_${scene#*:}_untested"
  done
  for name in "${presets[@]}"; do "$program" sweep --preset "$name" --quiet -o "$2/$name"; done
}

# A scene's line from its sweep.json: the median frame of each structure, and how many pictures were the same. What --skip auto took in another way stands behind them and is left out.
line='
def each: reduce .settings[] as $s ([]; if any(.[]; .structure == $s.structure) then . else . + [$s] end);
def short: if . >= 100 then round | tostring else (. * 10 | round / 10 | tostring) end;
each as $each | ($each | map(select(.structure != "none")) | min_by(.frame_ms_median)) as $best
| "| " + ([$scene] + [$each[] | if .structure == $best.structure then "**\(.frame_ms_median | short)**" else .frame_ms_median | short end]
  + ["\([.settings[] | select(.structure != "none" and .differing_pixels == 0)] | length) of \([.settings[] | select(.structure != "none")] | length)"] | join(" | ")) + " |"'
heading='"| scene | " + ([.settings[] | .structure] | join(" | ")) + " | same picture |\n|:--|" + ([.settings[] | "--:|"] | join("")) + "--:|"'

table() {  # OUT
  local scene name first=1
  for scene in "${surfaces[@]/:/_}" "${looks[@]/:/_}" "${untested[@]/%/_untested}"; do
    name=${scene/:/_}
    [[ -s $1/$name/sweep.json ]] || continue
    if ((first)); then jq -r "$heading" "$1/$name/sweep.json"; fi
    first=0
    jq -r --arg scene "$name" "$line" "$1/$name/sweep.json"
  done
  for name in "${presets[@]}"; do [[ ! -s $1/$name/$name.md ]] || { echo; cat "$1/$name/$name.md"; }; done
}

if (($# != 2)); then
  sed -n '2,6p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
command -v jq >/dev/null || { echo "structures.sh: found no jq, expected it (packages.txt)" >&2; exit 1; }
[[ $1 == --table ]] || measure "$1" "$2"
table "$2"
