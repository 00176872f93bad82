#!/bin/sh
# Installs what is missing of lists of Debian packages in this folder, as root or through sudo:
# install_packages.sh packages.txt [packages_tests.txt ...]. A program of a package's name on the path, from wherever it
# comes, stands for the package. Messages and progress go to standard error.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck source=tools/progress.sh
. "$here/progress.sh"
wanted=$(cd "$here" && cat "$@")
# shellcheck disable=SC2086
installed=$(dpkg-query -W -f='${Package}=${Status}\n' $wanted 2>/dev/null || true)
missing=
for package in $wanted; do
  case "$installed" in
    *"$package=install ok installed"*) ;;
    *) command -v "$package" >/dev/null 2>&1 || missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0
as_root=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "rollrig: these packages are needed, and neither root nor sudo is at hand:$missing" >&2
    exit 2
  fi
  as_root=sudo
fi
echo "rollrig: installing Debian packages:$missing" >&2
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq >&2

log=$(mktemp)
trap 'rm -f "$log" "$log.status"' EXIT

# Lines of apt, among them those of its status: dlstatus or pmstatus (download, then installation), package, percent.
show_apt_progress() {
  while IFS= read -r line; do
    kind=${line%%:*}
    percent=${line#*:*:}
    percent=${percent%%[.:]*}
    case $kind in
      dlstatus) show_progress "rollrig: packages" "downloaded $percent %" "$percent" ;;
      pmstatus) show_progress "rollrig: packages" "installed $percent %" "$percent" ;;
      *) printf '%s\n' "$line" >>"$log" ;;
    esac
  done
}
# shellcheck disable=SC2086
{
  status=0
  $as_root apt-get install -y --no-install-recommends -o APT::Status-Fd=1 $missing 2>&1 || status=$?
  echo "$status" >"$log.status"
} | show_apt_progress
clear_progress
status=$(cat "$log.status")
if [ "$status" -ne 0 ]; then
  cat "$log" >&2
  exit "$status"
fi
