#!/usr/bin/env bash
# DriveStyle.sh PROGRAM FOLDER: the example Style in a real window on an X server of its own. The pointer goes into the ball,
# and the program's own key says what the hand feels. FOLDER is emptied.
# Exit code 0: all happened as it should; 1: not, the first line says what; 77: skipped, Xvfb or xdotool is missing.
set -euo pipefail
program="$(realpath -- "$1")"
here="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)"
# shellcheck source=../Interaction/Window/Window.sh
source "$here/../Interaction/Window/Window.sh"
need_tools skipped 77
rm -rf -- "$2"
mkdir -p "$2"
cd -- "$2"

finish() {
  local code=$?
  stop_window
  exit "$code"
}
trap finish EXIT

# The window is 300 pixels wide; it takes the focus when the pointer comes in and it looks at events. Here the pointer is off
# the ball: hand mode begins in the middle of the workspace's depth, not above a surface.
takes_focus() {
  xdotool mousemove 500 400 mousemove --window "$window" 200 150
  sleep 0.1
  [[ "$(xdotool getwindowfocus 2>/dev/null)" == "$window" ]]
}
# Pixel 110 is 24 mm left of the middle, 14 mm deep in the ball: a grip of 200 N/m against a spring of 800 N/m.
feels_the_ball() {
  xdotool mousemove --window "$window" 112 150 mousemove --window "$window" 110 150 key j
  sleep 0.1
  tail -n 1 said.txt | grep -q "^2\.2[0-9] N to the right$"
}
has_ended() { ! kill -0 "$viewer" 2>/dev/null; }

start_server 640x480
stdbuf -oL "$program" >said.txt 2>&1 &
viewer=$!
until_true "there is no window" find_window "Visualization Toolkit"
until_true "the window does not take the focus" takes_focus
xdotool key f
until_true "the hand does not feel the ball" feels_the_ball
xdotool key q
until_true "key Q does not end the program" has_ended
code=0
wait "$viewer" || code=$?
viewer=""
((code == 0)) || fail "exit code $code"
