#!/bin/sh
# What is in the Debian packages: contents_test.sh FOLDER, the folder of the packages. Their names, what they depend on,
# where files are, that binaries are stripped and hold no path of the build, and what lintian says where it is installed.
# Exit status 77 where the packages are not built.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
version=$(sed -n 's/^project(rollrig VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
architecture=$(dpkg --print-architecture)
program=$1/rollrig_$version-1_$architecture.deb
library=$1/rollrig-dev_$version-1_$architecture.deb
python=$1/python3-rollrig_$version-1_$architecture.deb
if [ ! -f "$program" ] || [ ! -f "$library" ] || [ ! -f "$python" ]; then
  echo "packages: not built. To build them: cmake --workflow --preset package" >&2
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
  echo "FAILED: $*" >&2
  failures=$((failures + 1))
}

expect_field() { # package field value
  value=$(dpkg-deb --field "$1" "$2")
  [ "$value" = "$3" ] || fail "$(basename "$1"): $2 is '$value', not '$3'"
}

expect_file() { # folder of an unpacked package, path
  [ -e "$1/$2" ] || fail "$(basename "$1"): $2 is missing"
}

expect_field "$program" Package rollrig
expect_field "$library" Package rollrig-dev
expect_field "$program" Version "$version-1"
expect_field "$library" Depends "rollrig (= $version-1)"
expect_field "$python" Package python3-rollrig

# Shared libraries of Debian that the program cannot run without, and nothing that only the build needs.
depends=$(dpkg-deb --field "$program" Depends)
for name in libc6 libstdc++6 libsimbody libfmt libspdlog libtbb libhdf5 libmatio libedlib libmd0 libminizip1 libsqlite3 libxml2; do
  case ", $depends" in
    *", $name"*) ;;
    *) fail "rollrig does not depend on $name: $depends" ;;
  esac
done
case $depends in
  *-dev* | *mpi*) fail "rollrig depends on what it does not need: $depends" ;;
esac

# For one minor version of Python.
depends=$(dpkg-deb --field "$python" Depends)
case $depends in
  "rollrig (= $version-1), python3 (>= 3."*"), python3 (<< 3."*"), python3-numpy, "*) ;;
  *) fail "python3-rollrig depends on: $depends" ;;
esac
dpkg-deb --extract "$program" "$work/rollrig"
dpkg-deb --extract "$python" "$work/python3-rollrig"
dpkg-deb --extract "$library" "$work/rollrig-dev"
triplet=$(dpkg-architecture -qDEB_HOST_MULTIARCH)
for file in usr/bin/rollrig usr/bin/rollrig_serve "usr/lib/$triplet/librollrig.so.$version" "usr/lib/$triplet/librollrig_cvodes.so.$version" \
  "usr/lib/$triplet/librollrig_multibody.so.$version" "usr/lib/$triplet/librollrig_least_squares.so.$version" \
  usr/share/rollrig/assets/tires/a50.toml usr/share/man/man1/rollrig.1.gz usr/share/doc/rollrig/copyright \
  usr/share/doc/rollrig/changelog.Debian.gz usr/share/doc/rollrig/changelog.gz usr/share/doc/rollrig/NOTICE.md \
  usr/share/doc/rollrig/docs/tutorial.md \
  usr/share/bash-completion/completions/rollrig usr/share/zsh/vendor-completions/_rollrig \
  usr/share/fish/vendor_completions.d/rollrig.fish; do
  expect_file "$work/rollrig" "$file"
done
for file in usr/include/rollrig/rollrig.h "usr/lib/$triplet/librollrig.so" "usr/lib/$triplet/pkgconfig/rollrig.pc" \
  "usr/lib/$triplet/cmake/rollrig/rollrigConfig.cmake" usr/share/doc/rollrig-dev/copyright; do
  case $file in
    *librollrig.so) [ -L "$work/rollrig-dev/$file" ] || fail "rollrig-dev: $file is no link" ;;
    *) expect_file "$work/rollrig-dev" "$file" ;;
  esac
done
for file in __init__.py _rollrig.pyi py.typed; do
  expect_file "$work/python3-rollrig" "usr/lib/python3/dist-packages/rollrig/$file"
done
(cd "$work/rollrig" && find . ! -type d | sort) >"$work/files"
(cd "$work/rollrig-dev" && find . ! -type d | sort) >"$work/files-dev"
both=$(comm -12 "$work/files" "$work/files-dev")
[ -z "$both" ] || fail "in both packages: $both"
for package in "$program" "$library" "$python"; do
  others=$(dpkg-deb --contents "$package" | awk '$2 != "root/root" || $1 !~ /^(drwxr-xr-x|-rw-r--r--|-rwxr-xr-x|l)/')
  [ -z "$others" ] || fail "owner or permissions: $others"
done

# The license of every library whose code is in the binaries, by the names of NOTICE.md.
linked=$(sed -n '/^## Linked/,/^## In the pages/s/^| `\([^`]*\)`.*/\1/p' "$root/NOTICE.md")
for name in $linked echarts zrender tslib; do
  grep -qi "$name" "$work/rollrig/usr/share/doc/rollrig/copyright" || fail "the copyright file does not name $name"
done

module=$(cd "$work/python3-rollrig/usr/lib/python3/dist-packages/rollrig" && echo _rollrig.*.so)
for binary in usr/bin/rollrig usr/bin/rollrig_serve "usr/lib/$triplet/librollrig.so.$version" "usr/lib/$triplet/librollrig_cvodes.so.$version" \
  "usr/lib/$triplet/librollrig_multibody.so.$version" "usr/lib/$triplet/librollrig_least_squares.so.$version" \
  "../python3-rollrig/usr/lib/python3/dist-packages/rollrig/$module"; do
  sections=$(readelf --sections --wide "$work/rollrig/$binary")
  case $sections in
    *.symtab* | *.debug_*) fail "$binary is not stripped" ;;
  esac
  dynamic=$(readelf --dynamic --wide "$work/rollrig/$binary")
  case $dynamic in
    *RPATH* | *RUNPATH*) fail "$binary searches libraries in a folder of its own" ;;
  esac
done
places=$(grep -rlaF -e "$root" -e "$(cd "$1" && pwd)" "$work/rollrig" "$work/rollrig-dev" "$work/python3-rollrig" || true)
[ -z "$places" ] || fail "hold a path of the build: $places"

if command -v lintian >/dev/null 2>&1; then
  lintian --allow-root --fail-on error,warning "$program" "$library" "$python" >&2 || fail "lintian has errors or warnings"
else
  echo "packages: lintian is not installed, so its checks are left out" >&2
fi
[ "$failures" -eq 0 ] || exit 1
echo "packages: $(stat -c %s "$program") and $(stat -c %s "$library") and $(stat -c %s "$python") bytes, as they should be"
