#!/bin/sh
# fixtures.sh FENESTRA: the reader in Python finds sound files and corners where the truth has them.
set -eu
/usr/bin/python3 -c 'import cv2' 2>/dev/null || { echo "python3-opencv is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/exact.yaml" <<STUDY
name: exact
repetitions: 1
factors:
  distance_m: 2
  frame_reflectance_830nm: 0.4
  stereo_calibration: exact
  rgbd_calibration: exact
STUDY
"$1" fixtures "$folder/exact.yaml" --jobs 2 --out "$folder/fixtures"
examples/python/read_fixtures.py "$folder/fixtures" "$folder/pictures" | tee "$folder/said"
# Cameras that are told exactly, and noise of the depth camera.
grep -q 'stereo: 2.000 m ahead, told corners off by 0.000 px' "$folder/said"
grep -q 'rgbd: 2.000 m ahead, told corners off by 0.000 px, depth off by -\?[0-4]\.' "$folder/said"
[ "$(ls "$folder/pictures" | wc -l)" -eq 2 ]
printf '!' >> "$folder/fixtures/bundle/c000_t0000/observation/left.png"
! examples/python/read_fixtures.py "$folder/fixtures" "$folder/pictures" 2> "$folder/said"
grep -q 'left.png: is not the file that was written' "$folder/said"
