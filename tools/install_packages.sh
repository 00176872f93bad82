#!/bin/sh
# Installs what is missing of lists of Debian packages in this folder, as root or through sudo: install_packages.sh
# packages.txt [packages_tests.txt ...]. A package counts as installed if a program of its name is on the path. Packages
# of packages_unpacked.txt are needed for their files alone: they are unpacked into build/packages, without the packages
# that they depend on. Messages and progress go to standard error.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
unpacked=$here/../build/packages
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
to_unpack=
while IFS= read -r package; do
  [ -e "$unpacked/$package" ] || dpkg -s "$package" >/dev/null 2>&1 || to_unpack="$to_unpack $package"
done <"$here/packages_unpacked.txt"
[ -n "$missing$to_unpack" ] || exit 0
as_root=
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "rollrig: these packages are needed, and neither root nor sudo is at hand:$missing$to_unpack" >&2
    exit 2
  fi
  as_root=sudo
fi
echo "rollrig: installing Debian packages:$missing$to_unpack" >&2
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
if [ -n "$missing" ]; then
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
fi
mkdir -p "$unpacked"
for package in $to_unpack; do
  (cd "$unpacked" && apt-get download -qq -o APT::Sandbox::User=root "$package" >&2 && dpkg -x "$package"_*.deb . &&
    rm "$package"_*.deb && touch "$package")
done
