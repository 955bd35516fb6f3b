#!/usr/bin/env bash
# DriveWindow.sh PROGRAM FOLDER: a real window on an X server of its own, driven by keys and drags as a person would.
# Exit code 0: all happened as it should; 1: not, the last line says what; 77: skipped, Xvfb or xdotool is missing.
set -euo pipefail
program="$1"
folder="$2"
for tool in Xvfb xdotool; do
  if ! command -v "$tool" >/dev/null; then
    echo "skipped: $tool is not installed (package ${tool,,})"
    exit 77
  fi
done
rm -rf -- "$folder"
mkdir -p "$folder"
cd -- "$folder"
export XDG_STATE_HOME="$folder/state"

server=""
viewer=""
finish() {
  local code=$?
  [[ -z "$viewer" ]] || kill "$viewer" 2>/dev/null || true
  [[ -z "$server" ]] || kill "$server" 2>/dev/null || true
  exit "$code"
}
trap finish EXIT

fail() {
  echo "failed: $*"
  echo "the program said:"
  cat said.txt
  exit 1
}

# until_true WORDS COMMAND...: waits for the command to succeed, for 20 s at most.
until_true() {
  local words="$1" tries
  shift
  for ((tries = 0; tries < 400; ++tries)); do
    if "$@" >/dev/null 2>&1; then
      return
    fi
    sleep 0.05
  done
  fail "$words"
}
said() { until_true "it never said: $1" grep -qF -- "$1" said.txt; }
key() { xdotool key "$1"; }

# element FILE: row 0, column 2 of the written model matrix.
element() { tr -d ' \n' <"$1" | sed -E 's/.*"matrix":\[[^,]*,[^,]*,([^,]*),.*/\1/'; }

: >said.txt
Xvfb -displayfd 3 -noreset -nolisten tcp -screen 0 800x600x24 3>display >/dev/null 2>&1 &
server=$!
until_true "Xvfb did not start" test -s display
DISPLAY=":$(<display)"
export DISPLAY

"$program" generate sphere -n 3000 -o first.ply >/dev/null
"$program" generate plane -n 3000 -o second.ply >/dev/null
"$program" view first.ply second.ply --watch --size 640x480 --device simulated >said.txt 2>&1 &
viewer=$!
until_true "no window appeared" xdotool search --name "PointHaptics: first.ply"
window="$(xdotool search --name "PointHaptics: first.ply" | head -n 1)"
xdotool mousemove --window "$window" 320 150

key n
said "file 2 of 2: second.ply"
key n
said "file 1 of 2: first.ply"
key b
until_true "key B did not go back" xdotool search --name "PointHaptics: second.ply"

"$program" generate plane -n 4000 -o second.ply >/dev/null
said "read again: second.ply"

key w
said "settings: pointhaptics-001.json"
xdotool keydown shift mousedown 1 mousemove_relative -- 60 0 mousemove_relative -- 40 0 mouseup 1 keyup shift
key w
said "settings: pointhaptics-002.json"
[[ "$(element pointhaptics-001.json)" != "$(element pointhaptics-002.json)" ]] || fail "Shift+drag did not turn the model"
key u
key w
said "settings: pointhaptics-003.json"
[[ "$(element pointhaptics-001.json)" == "$(element pointhaptics-003.json)" ]] || fail "U did not take the drag back"

# The sliders of friction and of the voxel size, from where they stand to the middle of their ways.
key v
sleep 0.3
xdotool mousemove --window "$window" 535 240 mousedown 1 mousemove --window "$window" 579 240 mouseup 1
key w
said "settings: pointhaptics-004.json"
grep -qE '"mu-d": 0\.[45]' pointhaptics-004.json || fail "the slider did not set the friction"
grep -q '"voxel"' pointhaptics-004.json && fail "a voxel size that nobody chose"
xdotool mousemove --window "$window" 558 336 mousedown 1 mousemove --window "$window" 579 336 mouseup 1
key w
said "settings: pointhaptics-005.json"
grep -q '"voxel"' pointhaptics-005.json || fail "the slider did not set the voxel size"

key s
said "screenshot: pointhaptics-001.png"
[[ -s pointhaptics-001.png ]] || fail "the screenshot is empty"
key q
until_true "key Q did not end the program" bash -c "! kill -0 $viewer"
wait "$viewer" || fail "exit code $?"
viewer=""
grep -q '"stiffness"' state/pointhaptics/view.json || fail "the settings are not remembered"
"$program" view first.ply --recent --write-config recent.json >/dev/null
grep -q '"size": "640x480"' recent.json || fail "--recent does not bring the settings back"
echo "the window did what it was told"
