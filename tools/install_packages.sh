#!/bin/sh
# Installs what is missing of tools/packages.txt, as root or through sudo. A program of a package's name on the path,
# from wherever it comes, stands for the package. Messages go to standard error.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
missing=
while read -r package; do
  state=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  [ "$state" = "install ok installed" ] || command -v "$package" >/dev/null 2>&1 || missing="$missing $package"
done < "$here/packages.txt"
[ -n "$missing" ] || exit 0
echo "rollrig: installing Debian packages:$missing" >&2
as_root=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "rollrig: these packages are needed, and neither root nor sudo is at hand:$missing" >&2
    exit 2
  fi
  as_root=sudo
fi
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq >&2
# shellcheck disable=SC2086
$as_root apt-get install -y -qq --no-install-recommends $missing >&2
