#!/bin/sh
# fixtures.sh FENESTRA: the reader in Python finds sound files and corners where the truth has them.
set -eu
/usr/bin/python3 -c 'import cv2' 2>/dev/null || { echo "python3-opencv is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" fixtures paper --cells 3,10 --jobs 2 --out "$folder/fixtures"
examples/python/read_fixtures.py "$folder/fixtures" "$folder/pictures" | tee "$folder/said"
# Cameras that are told to 0.1 mrad, at 660 px a radian; an RGB-D sensor that is told exactly.
grep -q '3/0 stereo: 2.000 m ahead, told corners off by 0.[0-3][0-9][0-9] px' "$folder/said"
grep -q '10/0 rgbd: 1.400 m ahead, told corners off by 0.000 px, depth off by -\?[0-4]\.' "$folder/said"
[ "$(ls "$folder/pictures" | wc -l)" -eq 2 ]
printf '!' >> "$folder/fixtures/bundle/c003_t0000/observation/left.png"
! examples/python/read_fixtures.py "$folder/fixtures" "$folder/pictures" 2> "$folder/said"
grep -q 'left.png: is not the file that was written' "$folder/said"
