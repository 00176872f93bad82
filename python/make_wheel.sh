#!/bin/sh
# The wheel of a build: make_wheel.sh BUILD FOLDER. It needs no network. The wheel has the package with its extension,
# the shared libraries of rollrig, and the assets.
set -eu
build=$1
folder=$2
staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT
cmake --install "$build" --component python_wheel --prefix "$staging" --strip >/dev/null
mkdir -p "$folder"
rm -f "$folder"/rollrig-*.whl
# The date of the release, so that every build gives the same bytes.
SOURCE_DATE_EPOCH=$(cat "$build/python/release_time_s") "${PYTHON:-/usr/bin/python3}" -m wheel pack "$staging" \
  --dest-dir "$folder"
