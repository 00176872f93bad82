#!/bin/sh
# A campaign in four processes of mpirun, with fixed parts and with items that the first process hands out. One process
# is killed; the same command again completes the campaign. The results are those of one process.
# on_mpi.sh PROGRAM; exit status 77 where Debian's openmpi-bin is missing
set -eu
program=$(realpath "$1")
command -v mpirun >/dev/null || { echo "skipped: no mpirun on this machine"; exit 77; }
# Open MPI keeps memory of plug-ins that it has unloaded. The names of these are no longer known to a sanitizer, so that
# no suppression can name them.
export ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=0"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
runs="iso_28580 --tire a50 --vary ambient_degC=20:30:0.05"
# shellcheck disable=SC2086  # words
"$program" campaign new alone $runs --quiet
"$program" campaign run alone --quiet
"$program" campaign export alone --csv alone.csv --quiet
as_four="mpirun --allow-run-as-root --oversubscribe -n 4"

# kill_and_resume NAME FILE WHICH OPTIONS: FILE is there while the processes work; WHICH of them is killed, from 1
kill_and_resume() {
  name=$1
  file=$2
  which=$3
  shift 3
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
  kill -9 "$(pgrep -P "$launcher" | sed -n "${which}p")"
  wait "$launcher" && { echo "mpirun did not notice that a process was killed"; exit 1; }
  "$program" campaign status "$name"
  "$program" campaign status "$name" --json - | grep -q '"done": 201' && { echo "all was done before the kill"; exit 1; }
  # shellcheck disable=SC2086
  $as_four "$program" campaign run "$name" "$@" --quiet
  "$program" campaign export "$name" --csv "$name.csv" --quiet
  cmp alone.csv "$name.csv"
}
kill_and_resume four results_0002_of_0004.sqlite 4 --threads 1
if [ -x "$(dirname "$program")/rollrig_mpi" ]; then
  kill_and_resume worker results_mpi_0002_of_0003.sqlite 3 --mpi
  set -- worker/results_mpi_*.sqlite
  [ $# = 3 ] || { echo "not all processes had items"; exit 1; }
  kill_and_resume first results_mpi_0002_of_0003.sqlite 1 --mpi
  $as_four "$program" campaign run first --mpi --quiet --threads 2 && { echo "--threads was not refused"; exit 1; }
  "$program" campaign new failing iso_28580 --tire a50 --fidelity quasi_static --draw pressure_kPa=uniform:-100:400 \
    --points 12 --seed 2 --quiet
  status=0
  $as_four "$program" campaign run failing --mpi --json state.json || status=$?
  [ "$status" = 3 ] || { echo "failed items: status $status"; exit 1; }
  grep -q '"done": 12' state.json
fi
echo "the same results in 4 processes as in one: $(($(wc -l <alone.csv) - 1)) items"
