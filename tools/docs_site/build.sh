#!/bin/sh
# Builds the documentation site and checks its links: build.sh [FOLDER]; the folder is build/site unless one is given.
# Exit status: 1 where MkDocs warns or a link is dead, 77 where a package of tools/packages_docs.txt is missing.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
site=${1:-$root/build/site}
if ! command -v mkdocs >/dev/null 2>&1 || [ ! -d /usr/share/mkdocs/themes/material ] ||
  [ ! -f /usr/share/javascript/katex/katex.min.js ]; then
  echo "documentation site: not built, a package is missing. On Debian 12:" >&2
  echo "  apt-get install $(tr '\n' ' ' <"$root/tools/packages_docs.txt")" >&2
  exit 77
fi
case $site in
  /*) ;;
  *) site=$PWD/$site ;;
esac
cd "$root"
mkdocs build --strict --site-dir "$site"
python3 "$here/check_links.py" "$site"
echo "documentation site: $site/index.html"
