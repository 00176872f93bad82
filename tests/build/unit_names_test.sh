#!/bin/sh
# Files that are compiled as one unit have no name in common in their unnamed namespaces: of two functions of one name,
# a call could mean the other file's. unit_names_test.sh BUILD_FOLDER
set -eu
if ! command -v ctags >/dev/null 2>&1; then
  echo "skipped: ctags is not installed (package universal-ctags)"
  exit 77
fi
status=0
units=$(find "$1" -name 'unity_*_cxx.cxx')
for unit in $units; do
  sed -n 's/^#include "\(.*\)"/\1/p' "$unit" |
    ctags -x --_xformat='%N|%F|%Z' --kinds-C++=fv --language-force=C++ -L - |
    awk -F'|' '
      $3 ~ /__anon[0-9a-f]*$/ {
        if (($1 in file) && file[$1] != $2) { print $1 " is in " file[$1] " and in " $2; found = 1 }
        file[$1] = $2
      }
      END { exit found }' || status=1
done
exit "$status"
