#!/bin/sh
# A campaign in four processes of mpirun, one of which is killed; the same command again completes it. The results are
# those of one process.
# on_mpi.sh PROGRAM; exit status 77 where Debian's openmpi-bin is missing
set -eu
program=$(realpath "$1")
command -v mpirun >/dev/null || { echo "skipped: no mpirun on this machine"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
runs="iso_28580 --tire a50 --vary ambient_degC=20:30:0.05"
# shellcheck disable=SC2086  # words
"$program" campaign new alone $runs --quiet
"$program" campaign run alone --quiet
"$program" campaign export alone --csv alone.csv --quiet
# shellcheck disable=SC2086
"$program" campaign new four $runs --quiet
as_four="mpirun --allow-run-as-root --oversubscribe -n 4"
# shellcheck disable=SC2086  # words
$as_four "$program" campaign run four --threads 1 --quiet 2>mpirun.log &
launcher=$!  # mpirun itself, whose children are the four processes
for _ in $(seq 1 600); do
  [ ! -e four/results_0002_of_0004.sqlite.progress ] || break
  sleep 0.05
done
[ "$(pgrep -P "$launcher" | wc -l)" = 4 ] || { echo "mpirun has not four processes"; exit 1; }
kill -9 "$(pgrep -P "$launcher" | tail -1)"
wait "$launcher" && { echo "mpirun did not notice that a process was killed"; exit 1; }
"$program" campaign status four
"$program" campaign status four --json - | grep -q '"done": 201' && { echo "all was done before the kill"; exit 1; }
# shellcheck disable=SC2086
$as_four "$program" campaign run four --threads 1 --quiet
"$program" campaign export four --csv four.csv --quiet
cmp alone.csv four.csv
echo "the same results in 4 processes as in one: $(($(wc -l <four.csv) - 1)) items"
