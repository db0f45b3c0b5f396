#!/usr/bin/env bash
# test.sh [PRESET ...]: installs what is missing, builds, and runs the tests of each preset; without one, every test as it is used
# (release) and those of lattices and files once more under AddressSanitizer and UndefinedBehaviorSanitizer (sanitize-day). The last line says
# how many passed and failed. `./test.sh sanitize` runs every test under the sanitizers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

presets=("$@")
((${#presets[@]} > 0)) || presets=(release sanitize-day)
./setup.sh
status=0
folders=()
for preset in "${presets[@]}"; do
  # What the tests did goes to tests.xml and tests/ of the build folder.
  case $preset in
    release | debug | sanitize) build=$preset targets=() ;;
    sanitize-day) build=sanitize targets=(sanitize_day_tests) ;;
    *)
      echo "test.sh: found preset $preset, expected release, debug, sanitize or sanitize-day" >&2
      exit 2
      ;;
  esac
  folder=$PWD/build/$build
  PRESET=$build cmake/build.sh ${targets[@]+"${targets[@]}"}
  rm -rf "$folder/tests.xml" "$folder"/tests/*.xml
  folders+=("$folder")
  ctest --preset "$preset" --output-junit "$folder/tests.xml" </dev/null || status=$?
  if [[ ! -s $folder/tests.xml ]]; then
    echo "test.sh: ctest --preset $preset ended with status $status and without results" >&2
    echo "0 passed, 1 failed"
    exit 1
  fi
done
tests/count_results.py "${folders[@]}" || status=1
exit "$status"
