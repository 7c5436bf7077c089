# SPDX-License-Identifier: Apache-2.0
# Functions of ./do and of other scripts that source this file, and changes to the folder of the project.
set -u
script=$(cd "$(dirname "$0")" && pwd)/${0##*/}
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

BUILD=build/release
LOGS=build/log
export LC_ALL=C.UTF-8

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# wrong MESSAGE: ends the script because of wrong arguments.
wrong() { fail "${script##*/}: $*; see $0 --help"; }

# help_if_asked [ARGUMENT...]: if the first argument asks for help, prints the comment at the beginning of the script,
# and ends the script.
help_if_asked() {
  case "${1:-}" in help | -h | --help) ;; *) return ;; esac
  sed -n '3,/^[^#]/{s/^# \{0,1\}//p}' "$script"
  exit
}

# fit TEXT COLUMNS: prints the start of the text that COLUMNS columns of a terminal can show. Characters outside of ASCII
# count as two columns, the width of the widest characters.
fit() {
  local text=${1:0:$2} wide
  wide=${text//[ -~]/}
  while [ $((${#text} + ${#wide})) -gt "$2" ]; do
    text=${text%?}
    wide=${text//[ -~]/}
  done
  printf '%s' "$text"
}

# watch LABEL LOG: prints the last line of the log while a step runs, in one line of the terminal.
watch() {
  local size columns
  exec 3<&1
  while kill -0 $$ 2>/dev/null; do
    size=$(stty size <&3 2>/dev/null)
    columns=${size#* }
    [ "${columns:-0}" -gt 0 ] || columns=80
    printf '\r\033[K%s' "$(fit "$1: $(tail -n 1 "$2" | tr '\t' ' ' | tr -d '[:cntrl:]')" $((columns - 1)))"
    sleep 0.3
  done
}

# logged LABEL LOG COMMAND...: runs a command with its output in the file LOG, and prints the last line of the output
# while the command runs.
logged() {
  local label=$1 log=$2 watcher= result=0
  shift 2
  mkdir -p "${log%/*}" && : >"$log" || exit 1
  if [ -t 1 ]; then
    watch "$label" "$log" &
    watcher=$!
  fi
  "$@" >"$log" 2>&1 </dev/null || result=$?
  if [ -n "$watcher" ]; then
    kill $watcher
    wait $watcher 2>/dev/null
    printf '\r\033[K'
  fi
  return $result
}

# step NAME LABEL COMMAND...: runs a command with its output in build/log/NAME.log. If the command fails, prints the
# log.
step() {
  local label=$2 log=$LOGS/$1.log start=$SECONDS
  shift 2
  if ! logged "$label" "$log" "$@"; then
    tail -n 40 "$log" >&2
    fail "$label: failed; the whole log is $log"
  fi
  printf '%s (%d s)\n' "$label" $((SECONDS - start))
}

# side_by_side COMMAND ITEM...: runs the command with each item, in parallel on all cores.
side_by_side() {
  local command=$1 item running=() result=0
  shift
  for item; do
    if [ ${#running[@]} -ge "$(nproc)" ]; then
      wait "${running[0]}" || result=1
      running=("${running[@]:1}")
    fi
    $command "$item" &
    running+=($!)
  done
  for item in "${running[@]}"; do wait "$item" || result=1; done
  return $result
}

# install GROUP|PACKAGE...: installs what is missing of these packages.
install() { toolchains/install.sh "$@" || exit 1; }

# lab LABEL ARGUMENT...: runs starfocus-lab, which prints progress if stderr is a terminal.
lab() {
  local label=$1 start=$SECONDS
  shift
  $BUILD/starfocus-lab "$@" >/dev/null || fail "$label: failed"
  printf '%s (%d s)\n' "$label" $((SECONDS - start))
}
