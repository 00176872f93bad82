#!/bin/sh
# The wheel of a build: make_wheel.sh BUILD FOLDER [--bundle]. It needs no network. The wheel has the package with its
# extension, the shared libraries of rollrig, and the assets; with --bundle also the libraries of Debian that these
# need, with their licenses, for machines that do not have them.
set -eu
build=$1
folder=$2
bundle=${3:-}
staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT
cmake --install "$build" --component python_wheel --prefix "$staging" --strip >/dev/null

# What the target machine must have: glibc, libstdc++ and libgcc_s of Debian 12 or newer.
is_on_target() {
  case $(basename "$1") in
    ld-linux* | libc.so.* | libm.so.* | libdl.so.* | libpthread.so.* | librt.so.* | libresolv.so.* | libgcc_s.so.* | \
      libstdc++.so.*) return 0 ;;
  esac
  return 1
}
if [ "$bundle" = --bundle ]; then
  licenses=$(echo "$staging"/rollrig-*.dist-info)/licenses
  mkdir "$licenses"
  ldd "$staging"/rollrig/_rollrig.*.so "$staging"/rollrig/lib/* | awk '$2 == "=>" && $3 ~ /^\// { print $3 }' |
    sort -u | while read -r library; do
    is_on_target "$library" || [ -e "$staging/rollrig/lib/$(basename "$library")" ] && continue
    cp -L "$library" "$staging/rollrig/lib/"
    # By the name alone, since /lib is a link to /usr/lib.
    package=$(dpkg-query -S "*/$(basename "$(readlink -f "$library")")" | sed 's/:.*//; q')
    cp "/usr/share/doc/$package/copyright" "$licenses/$package"
  done
fi
mkdir -p "$folder"
rm -f "$folder"/rollrig-*.whl
# The date of the release, so that every build gives the same bytes.
SOURCE_DATE_EPOCH=$(cat "$build/python/release_time_s") "${PYTHON:-/usr/bin/python3}" -m wheel pack "$staging" \
  --dest-dir "$folder"
