#!/usr/bin/env bash
# run.sh [INPUTS [READER ...]]: builds the fuzzers with clang (preset `fuzz`) and feeds every reader INPUTS inputs (a million), or
# those that are named, from a fixed seed, beginning with corpus/. SEED=N changes it. Ends with status 1 where a reader crashed, leaked,
# hung for 10 s or took more than 1 GiB; the input is kept in build/fuzz/found.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

inputs=${1:-1000000}
readers=("${@:2}")
((${#readers[@]} > 0)) || readers=(volume transfer_function camera points values)

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --parallel "$(nproc)" >/dev/null
mkdir -p build/fuzz/found

status=0
for reader in "${readers[@]}"; do
  grown=build/fuzz/grown/$reader log=build/fuzz/$reader.log
  rm -rf "$grown"
  mkdir -p "$grown"
  # Readers that read a big part of a file at a time would fill the quarantine of freed memory, and take most of the time.
  if ASAN_OPTIONS=quarantine_size_mb=16:max_free_fill_size=0 "build/fuzz/${reader}_fuzzer" -runs="$inputs" -seed="${SEED:-1}" -max_len=4096 -timeout=10 \
    -rss_limit_mb=1024 -malloc_limit_mb=256 -print_final_stats=1 -dict="tests/fuzz/dictionaries/$reader.dict" -artifact_prefix="build/fuzz/found/$reader-" \
    "$grown" "tests/fuzz/corpus/$reader" </dev/null >"$log" 2>&1; then
    awk -v reader="$reader" '
      /DONE/ { for (n = 1; n < NF; ++n) if ($n == "cov:") edges = $(n + 1) }
      /^Done/ { inputs = $2; seconds = $5 }
      /peak_rss_mb/ { memory = $2 }
      END { print reader ": " inputs " inputs in " seconds " s, " edges " edges of the code reached, at most " memory " MiB" }' "$log"
  else
    status=1
    echo "$reader: failed; see $log" >&2
    tail -n 40 "$log" >&2
  fi
done
exit "$status"
