#!/usr/bin/env bash
# SlowFirstFile.sh PROGRAM FOLDER HELDFILE CLOSEWINDOW: a real window that opens before its first file is read, because
# HELDFILE holds that file back; then it must hear keys, drags and its close button as any other window.
# Exit code 0: all happened as it should; 1: not, the last line says what; 77: skipped, Xvfb or xdotool is missing.
set -euo pipefail
program="$1"
folder="$2"
held_file="$3"
close_window="$4"
here="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)"
# shellcheck source=Window.sh
source "$here/Window.sh"
need_tools skipped 77
rm -rf -- "$folder"
mkdir -p "$folder"
cd -- "$folder"
export XDG_STATE_HOME="$folder/state"

finish() {
  local code=$?
  stop_window
  exit "$code"
}
trap finish EXIT
said() { until_true "it never said: $1" grep -qF -- "$1" said.txt; }
has_ended() { ! kill -0 "$viewer" 2>/dev/null; }
# ends_with CODE WORDS
ends_with() {
  local code=0
  until_true "$2 did not end the program" has_ended
  wait "$viewer" || code=$?
  viewer=""
  ((code == $1)) || fail "exit code $code after $2"
}
# open_slowly ARGUMENT...: the program with these files after slow.ply stands with its bar in the window, whose number is
# in $window.
open_slowly() {
  rm -f go
  env LD_PRELOAD="$held_file" HELD_FILE=slow.ply HELD_UNTIL="$folder/go" \
    "$program" view slow.ply "$@" --size 640x480 --device none >said.txt 2>&1 &
  viewer=$!
  until_true "no window with a bar appeared" find_window "PointHaptics: reading slow.ply"
}
# let_it_read: the same window shows the cloud.
let_it_read() {
  local waiting="$window"
  : >go
  until_true "the cloud is not shown" find_window "PointHaptics: slow.ply"
  [[ "$window" == "$waiting" ]] || fail "the window was replaced by another one"
  until_true "the window does not take the focus" takes_keys
}
matrix() { tr -d ' \n' <"$1" | sed -E 's/.*"matrix":\[([^]]*)\].*/\1/'; }

start_server 800x600
"$program" generate sphere -n 3000 -o slow.ply >/dev/null

open_slowly
until_true "the window with the bar does not take the focus" takes_keys
xdotool key ctrl+q key alt+q # other commands than Q
let_it_read
xdotool key w
said "settings: pointhaptics-001.json"
xdotool keydown shift mousedown 1 mousemove_relative -- 60 0 mousemove_relative -- 40 0 mouseup 1 keyup shift
xdotool key w
said "settings: pointhaptics-002.json"
[[ "$(matrix pointhaptics-001.json)" != "$(matrix pointhaptics-002.json)" ]] || fail "Shift+drag did not turn the model"
xdotool key q
ends_with 0 "key Q"

open_slowly
let_it_read
"$close_window" "$window" || fail "the window does not listen for its close button"
ends_with 0 "the close button"
grep -q "X connection" said.txt && fail "the close button broke the connection"

# While it reads, both end the program as a cancel does.
open_slowly
"$close_window" "$window" || fail "the window with the bar does not listen for its close button"
: >go
ends_with 130 "the close button while it reads"
said "slow.ply: reading was stopped on request"
open_slowly
until_true "the window with the bar does not take the focus" takes_keys
xdotool key q
: >go
ends_with 130 "key Q while it reads"
said "slow.ply: reading was stopped on request"
# A first file that cannot be read: the same window goes on to the next, and says what it left out.
"$program" generate sphere -n 3000 -o good.ply >/dev/null
echo "no cloud" >slow.ply
open_slowly good.ply
waiting="$window"
: >go
until_true "the next file is not shown" find_window "PointHaptics: good.ply"
[[ "$window" == "$waiting" ]] || fail "the window was replaced by another one"
until_true "the window does not take the focus" takes_keys
said "warning: skipped: slow.ply: "
xdotool key n
said "pointhaptics view: slow.ply: "
xdotool key q
ends_with 0 "key Q after a skipped file"
echo "the window heard all that it was told"
