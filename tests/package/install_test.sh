#!/bin/sh
# In a fresh Debian 12, rollrig installs from its package, runs, serves programs of others, and leaves nothing behind:
# BASE=DEBIAN install_test.sh FOLDER. FOLDER has the packages. DEBIAN is a minimal system, which is copied and not
# changed; to make one: debootstrap --variant=minbase bookworm DEBIAN. Needs root and a mirror of Debian.
# Exit status 77 where BASE is not set, the packages are not built, or the user is not root.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
skip() {
  echo "packages: not installed for a test: $*" >&2
  exit 77
}
[ -n "${BASE:-}" ] || skip "BASE names no folder with a minimal Debian 12"
[ "$(id -u)" -eq 0 ] || skip "only root may change the root folder of a process"
[ -n "$(find "$1" -maxdepth 1 -name 'rollrig*.deb')" ] || skip "the packages are not built"
# In a mount namespace of its own, what is mounted ends with this program.
[ -n "${ROLLRIG_OWN_MOUNTS:-}" ] || exec env ROLLRIG_OWN_MOUNTS=1 unshare --mount "$0" "$@"

system=$(mktemp -d)
clean_up() {
  umount "$system/proc" 2>/dev/null || true
  rm -rf --one-file-system "$system"
}
trap clean_up EXIT
cp -ax "$BASE/." "$system"
cp /etc/resolv.conf /etc/hosts "$system/etc/"
mount -t proc proc "$system/proc"
mkdir "$system/packages"
cp "$1"/*rollrig*.deb "$system/packages"
chmod 755 "$system"
cp -r "$root/tests/install/program" "$system/root/program"

log=$system/root/log
run_inside() {
  chroot "$system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
}
run_apt() {
  run_inside apt-get -y --no-install-recommends "$@" >"$log" 2>&1 || fail "apt-get $*"
}
fail() {
  cat "$log" >&2
  echo "FAILED: $*" >&2
  exit 1
}
elapsed_s() { echo "$1 $(date +%s.%N)" | awk '{ printf "%.1f", $2 - $1 }'; }

run_apt update
start=$(date +%s.%N)
run_apt install "/packages/$(cd "$system/packages" && echo rollrig_*.deb)"
installed_s=$(elapsed_s "$start")
# As a user who may write nowhere in the system.
chroot --userspec=nobody:nogroup "$system" env -i PATH=/usr/bin rollrig run iso_28580 --tire a50 >"$log" 2>&1 ||
  fail "rollrig ended with an error"
first_result_s=$(elapsed_s "$start")
grep -q 'RRc at 25 degC, 2 m drum *5\.200 ' "$log" || fail "another rolling resistance than the tire file has"
echo "packages: installed in $installed_s s, first result after $first_result_s s"
run_inside dpkg-query -W -f '${Package}: installed size ${Installed-Size} KiB\n' rollrig
run_inside sh -c 'zcat /usr/share/man/man1/rollrig.1.gz' | grep -q iso_28580 || fail "the manual page is not readable"

run_apt install "/packages/$(cd "$system/packages" && echo python3-rollrig_*.deb)"
run_inside python3 -c '
import rollrig
result = rollrig.run("iso_28580", tire="a50")
print(result["rrc_25degC_2m_N_per_kN"], result.channels["drum_torque_Nm"].unit)' >"$log" 2>&1 ||
  fail "the Python package does not run"
grep -q '^5\.20.* N/kN N m$' "$log" || fail "the Python package finds another rolling resistance"

run_apt install g++ cmake make pkg-config "/packages/$(cd "$system/packages" && echo rollrig-dev_*.deb)"
run_inside sh -euc '
  g++ -std=c++17 $(pkg-config --cflags rollrig) /root/program/main.cpp $(pkg-config --libs rollrig) -o /root/by_pkg_config
  cmake -S /root/program -B /root/by_cmake
  cmake --build /root/by_cmake' >"$log" 2>&1 || fail "a program does not compile with rollrig-dev"
for program in by_pkg_config by_cmake/program_17_on by_cmake/program_17_off by_cmake/program_20_on \
  by_cmake/program_20_off; do
  run_inside "/root/$program" >"$log" 2>&1 || fail "$program does not run"
  grep -q '^5\.[12][0-9]* N/kN$' "$log" || fail "$program: another rolling resistance"
  grep -qx '/usr/share/rollrig/assets/tires/a50.toml' "$log" || fail "$program: assets from elsewhere"
done

run_inside dpkg -L rollrig rollrig-dev python3-rollrig | grep / | sort -u >"$system/root/paths"
run_apt purge rollrig rollrig-dev python3-rollrig
while read -r path; do
  [ ! -e "$system$path" ] || run_inside dpkg -S "$path" >/dev/null 2>&1 || fail "left behind: $path"
done <"$system/root/paths"
left=$(find "$system" -xdev -name '*rollrig*' ! -path "$system/packages/*")
[ -z "$left" ] || fail "left behind: $left"
! run_inside ldconfig -p | grep rollrig || fail "the cache of the loader still has the libraries"
run_inside dpkg --audit >"$log"
[ ! -s "$log" ] || fail "dpkg finds the system damaged"
echo "packages: a program compiles with pkg-config and with CMake; after the purge, nothing is left"
