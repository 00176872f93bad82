#!/bin/sh
# working_folder_test.sh PROGRAM: no library is loaded from the working folder, which may be somebody else's.
set -eu
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ldd "$program" | awk '$2 == "=>" { print $1 }' | while read -r library; do
  echo "not a library" > "$folder/$library"
done
[ -e "$folder/libstdc++.so.6" ] || { echo "ldd named no library" >&2; exit 1; }
cd "$folder"
"$program" --version
