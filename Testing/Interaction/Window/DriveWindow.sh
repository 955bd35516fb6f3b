#!/usr/bin/env bash
# DriveWindow.sh PROGRAM FOLDER BEHAVIOR: a real window on an X server of its own, driven by keys, drags and dropped files as
# a person would. BEHAVIOR is a function of WindowBehaviors.sh; FOLDER is emptied. The environment names the helpers that
# some behaviors need: DROP_FILE, CLOSE_WINDOW and HOLD_FILE, the last a library for LD_PRELOAD.
# Exit code 0: all happened as it should; 1: not, the first line says what; 77: skipped, Xvfb or xdotool is missing.
set -euo pipefail
program="$(realpath -- "$1")"
behavior="$3"
here="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)"
# shellcheck source=Window.sh
source "$here/Window.sh"
need_tools skipped 77
rm -rf -- "$2"
mkdir -p "$2"
cd -- "$2"
folder="$PWD"
export XDG_STATE_HOME="$folder/state"

finish() {
  local code=$?
  stop_window
  exit "$code"
}
trap finish EXIT

# make SHAPE FILE: a cloud of 3000 points.
make() { "$program" generate "$1" -n 3000 -o "$2" >/dev/null; }

environment=()
input=/dev/null # of the program
# start_viewer FILE ARGUMENT...: does not wait for its window. A shell lets what runs in the background ignore Ctrl+C; the
# program must not.
start_viewer() {
  env --default-signal=INT "${environment[@]}" "$program" view "$@" --size 640x480 <"$input" >said.txt 2>&1 &
  viewer=$!
}
# has_keys: until the window in $window takes them.
has_keys() { until_true "the window does not take the focus" takes_keys; }
# shows FILE: until the window's title has it; its number comes into $window.
shows() { until_true "$1 is not shown" find_window "PointHaptics: $1"; }
# open_viewer FILE ARGUMENT...: waits until the window shows the file and takes keys.
open_viewer() {
  start_viewer "$@"
  shows "$1"
  has_keys
}
# open_held FILE ARGUMENT...: the program with its bar in the window, because HOLD_FILE holds slow.ply back until let_it_read.
open_held() {
  hold_slow_file
  start_viewer "$@" --device none
  is_reading
  has_keys
}
hold_slow_file() {
  rm -f go
  environment=(LD_PRELOAD="$HOLD_FILE" HELD_FILE=slow.ply HELD_UNTIL="$folder/go")
}
is_reading() { until_true "slow.ply is not read" find_window "PointHaptics: reading slow.ply"; }
let_it_read() { : >go; }

has_ended() { ! kill -0 "$viewer" 2>/dev/null; }
# ends_with CODE WORDS
ends_with() {
  local code=0
  until_true "$2 did not end the program" has_ended
  wait "$viewer" || code=$?
  viewer=""
  ((code == $1)) || fail "exit code $code, not $1, after $2"
}

said() { until_true "it never said: $1" grep -qF -- "$1" said.txt; }
never_said() { ! grep -qF -- "$1" said.txt || fail "it said: $1"; }
key() {
  local each
  for each in "$@"; do xdotool key "$each"; done
}
move_to() { xdotool mousemove --window "$window" "$1" "$2"; }
# drag X Y X Y: with the left button, from and to, in the window.
drag() {
  xdotool mousemove --window "$window" "$1" "$2" mousedown 1 \
    mousemove --window "$window" $((($1 + $3) / 2)) $((($2 + $4) / 2)) mousemove --window "$window" "$3" "$4" mouseup 1
}
# click X Y: with the left button, in the window.
click() { xdotool mousemove --window "$window" "$1" "$2" click 1; }
turn_model() {
  xdotool keydown shift
  drag 320 150 420 150
  xdotool keyup shift
}

written=0
# write_settings: key W; the name of the file comes into $settings, that of the one before into $before.
settings=""
write_settings() {
  before="$settings"
  written=$((written + 1))
  settings="$(printf 'pointhaptics-%03d.json' "$written")"
  key w
  said "settings: $settings"
}
# setting NAME FILE: its value, without blanks, numbers to eight digits.
setting() {
  tr -d ' \n' <"$2" | { grep -oE "\"$1\":(\[[^]]*\]|\"[^\"]*\"|[^,}]*)" || true; } | sed -E 's/(\.[0-9]{8})[0-9]+/\1/g'
}
# changed NAME, same NAME: between $before and $settings.
changed() { [[ "$(setting "$1" "$before")" != "$(setting "$1" "$settings")" ]]; }
same() { ! changed "$1"; }
# is NAME VALUE: in $settings.
is() { [[ "$(setting "$1" "$settings")" == "\"$1\":$2" ]]; }

# shellcheck source=WindowBehaviors.sh
source "$here/WindowBehaviors.sh"
[[ "$(type -t -- "$behavior")" == function ]] || fail "WindowBehaviors.sh has no $behavior"
start_server 800x600
"$behavior"
if [[ -n "$viewer" ]]; then
  key q
  ends_with 0 "key Q"
fi
echo "the window did what it was told"
