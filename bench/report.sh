#!/usr/bin/env bash
# Measures again what docs/performance.md shows. In the page a generated part stands between two lines:
#   <!-- quincunx-bench ARGUMENTS -->
#   <!-- end of quincunx-bench -->
# Everything between them is replaced by what the command of the first line prints. All of the page is replaced at
# the end or nothing, where a measurement fails.
#   bench/report.sh [PAGE]
# With QUINCUNX_BENCH=PROGRAM that program measures and nothing is built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

page=${1:-docs/performance.md}
begin='<!-- quincunx-bench ' end='<!-- end of quincunx-bench -->'
program=${QUINCUNX_BENCH:-build/release/quincunx-bench}
if [[ -z ${QUINCUNX_BENCH:-} ]]; then
  # What the build says is of no use here unless it fails.
  log=$(cmake/build.sh quincunx-bench 2>&1) || { echo "$log" >&2; exit 1; }
fi

made=$page.tmp-$$
trap 'rm -f "$made"' EXIT
inside=""
while IFS= read -r line; do
  if [[ -n $inside && $line != "$end" ]]; then
    [[ $line != "$begin"* ]] || { echo "report.sh: $page: '$inside' has no '$end' after it" >&2; exit 1; }
    continue
  fi
  if [[ $line == "$begin"*' -->' ]]; then
    inside=$line
    arguments=${line#"$begin"}
    read -ra words <<<"${arguments% -->}"
    echo "report.sh: quincunx-bench ${words[*]}" >&2
    printf '%s\n\n' "$line"
    "$program" "${words[@]}" </dev/null
    printf '\n'
  else
    inside=""
    printf '%s\n' "$line"
  fi
done <"$page" >"$made"
[[ -z $inside ]] || { echo "report.sh: $page: '$inside' has no '$end' after it" >&2; exit 1; }
mv "$made" "$page"
