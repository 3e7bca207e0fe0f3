#!/bin/sh
# python.sh FENESTRA: runs the detector in Python over its study; every trial must be a hit.
set -eu
/usr/bin/python3 -c 'import cv2' 2>/dev/null || { echo "python3-opencv is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" run examples/python/study.yaml --trials 2 --jobs 2 --out "$folder/out"
hits=$(grep -c ',dark-frame,.*,hit,' "$folder/out/trials.csv") || true
[ "$hits" -eq 4 ] || { cat "$folder/out/trials.csv"; echo "$hits hits of 4"; exit 1; }
