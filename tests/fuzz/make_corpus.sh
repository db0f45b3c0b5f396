#!/usr/bin/env bash
# Writes the seeds of tests/fuzz/corpus: small inputs that reach every part of each reader. Files that a fuzzer added stay.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/corpus"

# put FILE TEXT: TEXT with its backslash escapes undone.
put() {
  mkdir -p "$(dirname "$1")"
  printf '%b' "$2" >"$1"
}

cartesian='NRRD0004\n# a comment\ntype: ushort\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 3 2\nspace directions: (1,0,0) (0,1,0) (0,0.5,2.5)\nkinds: domain domain domain\nendian: little\nspace origin: (-1,2,0.5)\nprovenance:=a\\\\ntest\n'
bcc='NRRD0005\ntype: short\ndimension: 4\nsizes: 2 1 2 2\nspace dimension: 3\nspace directions: (2,0,0) (0,2,0) (0,0,2) none\nkinds: domain domain domain list\nendian: big\nlattice:=bcc\n'
samples24='abcdefghijklmnopqrstuvwx' samples16='abcdefghijklmnop'
numbers12='0 1 2,3 4 5\n6 7 8 9 10 65535\n'
put volume/raw.nrrd "${cartesian}encoding: raw\n\n$samples24"
put volume/gzip.nrrd "${cartesian}encoding: gzip\n\n"
printf %s "$samples24" | gzip -n >>volume/gzip.nrrd
put volume/ascii.nrrd "${cartesian}encoding: ascii\n\n$numbers12"
put volume/bcc_raw.nrrd "${bcc}encoding: raw\n\n$samples16"
put volume/bcc_gzip.nrrd "${bcc}encoding: gzip\nbyte skip: 2\n\n"
printf %s "zz$samples16" | gzip -n >>volume/bcc_gzip.nrrd
put volume/detached.nhdr "${cartesian}encoding: raw\ndata file: 901\nbyte skip: -1\n\nskipped $samples24"
put volume/skips.nrrd "${cartesian}encoding: raw\nline skip: 2\nbyte skip: 3\n\none\ntwo\n...$samples24"
put volume/float.nrrd 'NRRD0001\ntype: float\ndimension: 3\nsizes: 3 1 1\nspacings: 1 2e-3 -3\nencoding: txt\n\n-1.5 1e-300 nan'
put volume/uint8.nrrd 'NRRD0002\ntype: unsigned char\ndimension: 3\nsizes: 1 1 1\nencoding: raw\ncontent: one\nmin: 0\nlabels: "x" "y" "z"\n\nA'
put volume/huge.nrrd 'NRRD0004\ntype: float\ndimension: 3\nsizes: 100000 100000 100000\nendian: little\nencoding: raw\n\n1234'

put transfer_function/own.json '{"unit": 1.5, "colors": [[0, "#20408f"], [90, 0.9, 0.3, 0.1]], "opacities": [[40, 0], [90, 0.4]]}'
put transfer_function/one_color.json '{"colors": [[-1e3, "#ffFFff"]], "opacities": [[-2.5, 1], [0, 0], [1e30, 1]]}'
put transfer_function/paraview.json '[{"Name": "other"}, {"ColorSpace": "Diverging", "Name": "m", "NanColor": [1, 1, 0], "RGBPoints": [0, 0.23, 0.3, 0.75, 1, 0.7, 0.02, 0.15], "Points": [0, 0, 0.5, 0, 1, 1, 0.5, 0]}]'
put transfer_function/hsv.json '[{"ColorSpace": "HSV", "HSVWrap": 1, "RGBPoints": [0, 1, 0, 0, 0.5, 0, 1, 0, 1, 1, 0, 1]}]'
put transfer_function/lab.json '[{"ColorSpace": "CIELAB", "RGBPoints": [0, 0, 0, 0, 2, 1, 1, 1]}]'
put transfer_function/step.json '[{"ColorSpace": "Step", "RGBPoints": [0, 0, 0, 0, 2, 1, 1, 1, 3, 0, 1, 0]}]'

put camera/full.json '{"eye": [140, -60, 90], "target": [31, 31, 31], "up": [0, 0, 1], "fov": 25}'
put camera/least.json '{"eye": [1e-3, 0, 0], "target": [0, 0, 0]}'
put camera/parallel.json '{"eye": [0, 0, 5], "target": [0, 0, 0], "up": [0, 0, 1]}'
put camera/unknown.json '{"eye": [0, 0, 5], "target": [0, 0, 0], "\\u0065y\\n": [0, 0, 1], "fov": 1e999}'
put camera/large.json '{"eye": [1e300, -1e300, 0], "target": [0, 0, 1e-300], "up": [1, 0, 1e10], "fov": 179.999}'

put points/header.csv 'x,y,z\n0,-20,10\n0.5,-90.25,0\n'
put points/windows.csv '\xEF\xBB\xBFX, Y, Z\r\n 1 ,\t2, +3e2\r\n\r\n-0,1e-300,1e300'
put points/plain.csv '1,2,3\n'
put points/two_numbers.csv '1,2,3\n4,5\n'
put points/not_finite.csv '1,2,3\n4,inf,nan\n'
put points/columns.csv 'x,y,z,density,radius\n0,0,0,1,0.5\n3,0,0,-2,1e-3\n'

put values/number '-12.5e-3'
put values/list '40,150,+1e2'
put values/integer '4096'
put values/color '0.5,1,0'
put values/srgb '#4f9d69'
put values/bytes '1.5G'
put values/empty_parts ',,'
