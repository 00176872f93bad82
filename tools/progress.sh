# shellcheck shell=sh
# To be read by a script: a line of progress on standard error, which is written anew on a terminal. Elsewhere, as in a
# log, a line appears each time another tenth is done.
progress_tenth=-1

# show_progress LABEL TEXT PERCENT
show_progress() {
  if [ -t 2 ]; then
    printf '\r\033[K%s: %s' "$1" "$2" >&2
  elif [ "$(($3 / 10))" -ne "$progress_tenth" ]; then
    progress_tenth=$(($3 / 10))
    printf '%s: %s\n' "$1" "$2" >&2
  fi
}

clear_progress() {
  if [ -t 2 ]; then printf '\r\033[K' >&2; fi
}
