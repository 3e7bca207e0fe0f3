#!/bin/sh
# plugin.sh CMAKE BUILD COMPILER: installs Fenestra, builds the example against what was installed,
# and runs its study; every trial must be a hit.
set -eu
grep -Eq '^FENESTRA_(SANITIZE:STRING=.+|FUZZ:BOOL=ON)' "$2/CMakeCache.txt" && exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" --install "$2" --prefix "$folder/installed" >"$folder/log"
"$1" -S examples/plugin -B "$folder/build" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_COMPILER="$3" -DCMAKE_PREFIX_PATH="$folder/installed" >"$folder/log"
"$1" --build "$folder/build" >"$folder/log" 2>&1 || { cat "$folder/log"; exit 1; }
fenestra=$folder/installed/bin/fenestra
plugin=$folder/build/libdark_centre.so
"$fenestra" list detectors --plugin "$plugin" | grep -A1 '^dark-centre'
"$fenestra" run examples/plugin/study.yaml --trials 2 --plugin "$plugin" --out "$folder/out"
hits=$(grep -c ',dark-centre,.*,hit,' "$folder/out/trials.csv") || true
[ "$hits" -eq 4 ] || { cat "$folder/out/trials.csv"; echo "$hits hits of 4"; exit 1; }
"$fenestra" replay "$folder/out" 0/1 --plugin "$plugin" | grep 'last bit'
