#!/usr/bin/env bash
# Prints the table of docs/performance.md, "Coefficients in fewer bits": of each format of --storage bytes, errors of values and gradients at random points
# against double coefficients, and frame times, of which the formats take turns.
#   bench/storage.sh [POINTS [ROUNDS]]     200000 points, 5 rounds of 7 frames
# With QUINCUNX=PROGRAM that program is used and nothing is built.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
points=${1:-200000} rounds=${2:-5}
program=${QUINCUNX:-$root/build/release/quincunx}
[[ -n ${QUINCUNX:-} ]] || "$root/cmake/build.sh" quincunx >&2
command -v jq >/dev/null || { echo "storage.sh: found no jq, expected it (packages.txt)" >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
storages=(float32 float16 unorm16 unorm8)

random_points() {  # VOLUME: in its domain's box, whose corners `info` tells
  "$program" info "$1" | awk -v n="$points" '/^world/ {
    gsub(/[(),]/, " "); srand(1); print "x,y,z"
    for (; n > 0; --n) printf "%.9g,%.9g,%.9g\n", $2 + rand() * ($6 - $2), $3 + rand() * ($7 - $3), $4 + rand() * ($8 - $4) }'
}

# The RMS and largest difference of values in two files of eval, and of the angles between gradients where the first file's value is within a
# twentieth of itself of the isovalue; "|" before each.
errors() {  # EXACT FOUND ISOVALUE
  paste -d, "$1" "$2" | awk -F, -v iso="$3" 'NR > 1 && $4 != "nan" {
    d = $11 - $4; d = d < 0 ? -d : d; ++n; sum += d * d; most = d > most ? d : most
    off = $4 - iso; if ((off < 0 ? -off : off) > 0.05 * iso) next
    cx = $6 * $14 - $7 * $13; cy = $7 * $12 - $5 * $14; cz = $5 * $13 - $6 * $12
    a = atan2(sqrt(cx * cx + cy * cy + cz * cz), $5 * $12 + $6 * $13 + $7 * $14) * 57.29577951308232
    ++m; angles += a * a; widest = a > widest ? a : widest
  } END { printf "| %.2g | %.2g | %.2g | %.2g ", sqrt(sum / n), most, sqrt(angles / m), widest }'
}

median() { sort -g | awk '{ a[NR] = $1 } END { print NR % 2 ? a[(NR + 1) / 2] : (a[NR / 2] + a[NR / 2 + 1]) / 2 }'; }

table() {  # VOLUME ISOVALUE
  local volume=$root/data/$1
  random_points "$volume" > "$folder/points.csv"
  "$program" eval "$volume" --points "$folder/points.csv" --quiet > "$folder/exact.csv"
  rm -f "$folder"/*.ms
  for ((round = 0; round < rounds; ++round)); do
    for storage in "${storages[@]}"; do
      "$program" render "$volume" --iso "$2" --size 512 512 --storage "$storage" --repeat 7 --stats "$folder/$storage.json" --quiet
      jq .trace_ms.median "$folder/$storage.json" >> "$folder/$storage.ms"
    done
  done
  for storage in "${storages[@]}"; do
    local evaluated=()
    # Of 32-bit floats: their own rounding.
    if [[ $storage == float32 ]]; then evaluated=(--precision float); else evaluated=(--storage "$storage"); fi
    "$program" eval "$volume" --points "$folder/points.csv" "${evaluated[@]}" --quiet > "$folder/found.csv"
    printf '| %s, %s | %s | %.2f %s | %.2f |\n' "$1" "$2" "$storage" "$(jq '.device_bytes.coefficients / 1e6' "$folder/$storage.json")" \
      "$(errors "$folder/exact.csv" "$folder/found.csv" "$2")" \
      "$(paste "$folder/$storage.ms" "$folder/float32.ms" | awk '{ print $1 / $2 }' | median)"
  done
}

echo "| volume, isovalue | storage | MB | value RMS | value max | normal RMS | normal max | times float32 |"
echo "|:--|:--|--:|--:|--:|--:|--:|--:|"
table mri_head_bcc.nrrd 130
table neghip_bcc.nrrd 40
