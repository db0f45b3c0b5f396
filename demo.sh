#!/usr/bin/env bash
# Installs what is missing, builds, and renders the bundled head to out/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

./setup.sh
cmake/build.sh quincunx
mkdir -p out
build/release/quincunx render data/mri_head_bcc.nrrd --iso 130 -o out/mri_head.png -o out/mri_head.exr
echo
echo "The picture:                          $PWD/out/mri_head.png"
echo "The same with depth and normals:      $PWD/out/mri_head.exr"
echo "More of them:                         build/release/quincunx render --help"
