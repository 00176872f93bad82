#!/bin/sh
# A campaign in four processes of mpirun, with fixed parts and with items that the first process hands out. One process
# is killed; the same command again completes the campaign. The results are those of one process.
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
as_four="mpirun --allow-run-as-root --oversubscribe -n 4"

# kill_and_resume NAME FILE OPTIONS: FILE is there while the process to be killed works
kill_and_resume() {
  name=$1
  file=$2
  shift 2
  # shellcheck disable=SC2086
  "$program" campaign new "$name" $runs --quiet
  # shellcheck disable=SC2086
  $as_four "$program" campaign run "$name" "$@" --quiet 2>mpirun.log &
  launcher=$!  # mpirun itself, whose children are the four processes
  for _ in $(seq 1 600); do
    [ ! -e "$name/$file.progress" ] || break
    sleep 0.05
  done
  [ "$(pgrep -P "$launcher" | wc -l)" = 4 ] || { cat mpirun.log; echo "mpirun has not four processes"; exit 1; }
  kill -9 "$(pgrep -P "$launcher" | tail -1)"
  wait "$launcher" && { echo "mpirun did not notice that a process was killed"; exit 1; }
  "$program" campaign status "$name"
  "$program" campaign status "$name" --json - | grep -q '"done": 201' && { echo "all was done before the kill"; exit 1; }
  # shellcheck disable=SC2086
  $as_four "$program" campaign run "$name" "$@" --quiet
  "$program" campaign export "$name" --csv "$name.csv" --quiet
  cmp alone.csv "$name.csv"
}
kill_and_resume four results_0002_of_0004.sqlite --threads 1
if [ -x "$(dirname "$program")/rollrig_mpi" ]; then
  kill_and_resume queue results_mpi_0002_of_0003.sqlite --mpi
  [ "$(ls queue/results_mpi_*.sqlite | wc -l)" = 3 ] || { echo "not all processes had items"; exit 1; }
fi
echo "the same results in 4 processes as in one: $(($(wc -l <alone.csv) - 1)) items"
