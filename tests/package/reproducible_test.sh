#!/bin/sh
# The same source gives the same packages, to the byte: reproducible_test.sh FOLDER. It builds the packages again, from a
# copy of the source in another folder, without a compiler cache, with another umask, time zone and language, and
# compares them with those in FOLDER.
# Exit status 77 where FOLDER has no packages.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
first=$(cd "$1" && pwd)
if [ -z "$(find "$first" -maxdepth 1 -name 'rollrig*.deb')" ]; then
  echo "packages: not built. To build them: cmake --workflow --preset package" >&2
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
copy=$work/a/folder/with/a/longer/name
mkdir -p "$copy"
umask 027
tar -C "$root" --exclude-vcs --exclude=./build --exclude='./build-*' --exclude=node_modules -c . |
  tar -C "$copy" --no-same-permissions -x
if [ -d "$root/build/packages" ]; then  # what tools/install_packages.sh unpacked
  mkdir "$copy/build"
  cp -r "$root/build/packages" "$copy/build"
fi
cd "$copy"
env CCACHE_DISABLE=1 TZ=Pacific/Chatham LC_ALL=C cmake --workflow --preset package >"$work/log" 2>&1 || {
  cat "$work/log" >&2
  exit 1
}
status=0
for package in "$first"/*rollrig*.deb; do
  again=$copy/build/package/$(basename "$package")
  sha256sum "$package" "$again"
  cmp "$package" "$again" || status=1
done
exit "$status"
