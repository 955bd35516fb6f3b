#!/usr/bin/env bash
# DriveWindow.sh PROGRAM FOLDER [DROPFILE]: a real window on an X server of its own, driven by keys, drags and dropped
# files as a person would.
# Exit code 0: all happened as it should; 1: not, the last line says what; 77: skipped, Xvfb or xdotool is missing.
set -euo pipefail
program="$1"
folder="$2"
drop_file="${3:-}"
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
key() { xdotool key "$1"; }

# element FILE [COLUMN]: of row 0 of the written model matrix, columns from 0; without it column 2.
element() { tr -d ' \n' <"$1" | sed -E 's/.*"matrix":\[([^]]*)\].*/\1/' | cut -d, -f$((${2:-2} + 1)); }
# setting NAME FILE: its value, without blanks, numbers to eight digits.
setting() {
  tr -d ' \n' <"$2" | { grep -oE "\"$1\":(\[[^]]*\]|\"[^\"]*\"|[^,}]*)" || true; } | sed -E 's/(\.[0-9]{8})[0-9]+/\1/g'
}
# pointer_x: where the mouse pointer stands in the window.
pointer_x() { xdotool getmouselocation --shell | sed -n 's/^X=//p'; }
pointer_is_left_of() { (($(pointer_x) < $1)); }

start_server 800x600

"$program" generate sphere -n 3000 -o first.ply >/dev/null
"$program" generate plane -n 3000 -o second.ply >/dev/null
"$program" view first.ply second.ply --watch --size 640x480 --device simulated --bind "screenshot=s F2" \
  >said.txt 2>&1 &
viewer=$!
until_true "no window appeared" find_window "PointHaptics: first.ply"
until_true "the window does not take the focus" takes_keys

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
# With Ctrl or Alt a letter is another command: nothing of these may happen.
for letter in ctrl+o alt+o ctrl+a alt+a ctrl+s alt+s ctrl+shift+x ctrl+q alt+q; do key "$letter"; done
key w
said "settings: pointhaptics-003.json"
grep -q "screenshot" said.txt && fail "a key with Ctrl or Alt saved a picture"
[[ "$(element pointhaptics-001.json)" == "$(element pointhaptics-003.json)" ]] || fail "U did not take the drag back"
[[ "$(setting figure pointhaptics-003.json) $(setting axes pointhaptics-003.json)" == '"figure":false "axes":false' ]] || fail "a key with Ctrl or Alt acted as the letter"

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

key v
key F2
said "screenshot: pointhaptics-001.png"
[[ -s pointhaptics-001.png ]] || fail "the screenshot is empty"

# The view, for the camera in the settings.
xdotool mousemove --window "$window" 320 150 mousedown 1 mousemove_relative -- 20 8 mousemove_relative -- 20 8 mouseup 1

# The hand holds the model as long as key 1 is down, which repeats as keys do, and goes aside with the mouse.
xdotool mousemove --window "$window" 300 150
key f
xdotool keydown 1
sleep 0.8
xdotool mousemove --window "$window" 360 150
sleep 0.5
xdotool keyup 1
sleep 0.3
key a
key o
key w
said "settings: pointhaptics-006.json"
[[ "$(setting axes pointhaptics-005.json) $(setting axes pointhaptics-006.json)" == '"axes":false "axes":true' ]] || fail "key A did not show the axes"
[[ "$(setting figure pointhaptics-005.json) $(setting figure pointhaptics-006.json)" == '"figure":false "figure":true' ]] || fail "key O did not make the figure"
# The figure has no words, but the help comes for whoever asks for it.
key s
said "screenshot: pointhaptics-002.png"
key h
key s
said "screenshot: pointhaptics-003.png"
bytes() { stat -c %s "$1"; }
words=10000 # bytes that a page of them adds to a picture, at least
(($(bytes pointhaptics-003.png) > $(bytes pointhaptics-002.png) + words)) || fail "key H shows no help in the figure"
key h
key s
said "screenshot: pointhaptics-004.png"
(($(bytes pointhaptics-004.png) < $(bytes pointhaptics-002.png) + words)) || fail "the help stays in the figure"
key o
key m
said "coloured by Density, as soon as it is computed"
until_true "the status still waits for Density" grep -qxF "coloured by Density" said.txt
key l
[[ "$(setting camera pointhaptics-005.json)" != "$(setting camera pointhaptics-006.json)" ]] || fail "the camera is not written"
[[ "$(element pointhaptics-005.json 3)" != "$(element pointhaptics-006.json 3)" ]] || fail "the hand did not shift the model"
xdotool mousemove --window "$window" 300 150
sleep 0.3
key w
said "settings: pointhaptics-007.json"
[[ "$(element pointhaptics-006.json 3)" == "$(element pointhaptics-007.json 3)" ]] || fail "the hand still holds the model"
[[ "$(setting color-by pointhaptics-006.json)" == "" ]] || fail "a colour that nobody chose"
[[ "$(setting color-by pointhaptics-007.json)" == '"color-by":"Density"' ]] || fail "key M did not change the colours"
[[ "$(setting ambient pointhaptics-006.json) $(setting ambient pointhaptics-007.json)" == '"ambient":false "ambient":true' ]] || fail "key L did not light the cloud"
key m
key m
said "coloured by Residual, as soon as it is computed"
until_true "the status still waits for Residual" grep -qxF "coloured by Residual" said.txt
key m
said "coloured by Height"

# From the left into a sphere: the touch pushes the pointer back.
key b
until_true "key B did not go back to the sphere" xdotool search --name "PointHaptics: first.ply"
xdotool mousemove --window "$window" 225 180
for ((i = 0; i < 23; ++i)); do key Prior; done
sleep 0.3
key g
xdotool mousemove --window "$window" 290 180
until_true "the touch did not push the pointer" pointer_is_left_of 275
key g
key f

if [[ -n "$drop_file" ]]; then
  "$program" generate torus -n 3000 -o dropped.ply >/dev/null
  "$drop_file" "$window" 320 100 "$PWD/dropped.ply" || fail "the drop did not end well"
  until_true "the dropped file is not shown" xdotool search --name "PointHaptics: dropped.ply"
  "$drop_file" "$window" 320 100 "$PWD/nothing.ply" || fail "the drop of nothing did not end well"
  said "nothing.ply"
  xdotool search --name "PointHaptics: dropped.ply" >/dev/null || fail "a bad drop took the cloud away"
fi
key q
until_true "key Q did not end the program" bash -c "! kill -0 $viewer"
wait "$viewer" || fail "exit code $?"
viewer=""
grep -q '"stiffness"' state/pointhaptics/view.json || fail "the settings are not remembered"
"$program" view first.ply --recent --write-config recent.json >/dev/null
grep -q '"size": "640x480"' recent.json || fail "--recent does not bring the settings back"

# A shell lets what runs in the background ignore Ctrl+C; this program must not.
env --default-signal=INT "$program" view first.ply --config pointhaptics-006.json >said.txt 2>&1 &
viewer=$!
until_true "no second window appeared" find_window "PointHaptics: first.ply"
said "3000 points"
until_true "the second window does not take the focus" takes_keys
key w
said "settings: pointhaptics-008.json"
for name in camera matrix bind size axes figure; do
  [[ "$(setting $name pointhaptics-006.json)" == "$(setting $name pointhaptics-008.json)" ]] || fail "--config lost $name"
  [[ -n "$(setting $name pointhaptics-008.json)" ]] || fail "no $name in the written settings"
done
kill -INT "$viewer"
until_true "Ctrl+C did not end the program" bash -c "! kill -0 $viewer"
wait "$viewer" || fail "exit code $? after Ctrl+C"
viewer=""
# A file that is read for long: Escape leaves the former cloud, and ends a program that has none yet. The key is pressed
# while the program stands still with the bar in the window, so that it is never too late; where a machine reads the
# file before the bar is there, a larger one is tried.
is_reading() { xdotool search --name "PointHaptics: reading large.csv" >/dev/null 2>&1; }
reads_or_has_read() { is_reading || grep -qE "file 2 of 2: large.csv|^[0-9]{6,} points" said.txt; }
# escape_while_it_reads: false: the bar was not seen.
escape_while_it_reads() {
  until_true "the file is not read" reads_or_has_read
  kill -STOP "$viewer"
  local seen=1
  if is_reading; then
    seen=0
    xdotool key --window "$(xdotool search --name "PointHaptics: reading large.csv" | head -n 1)" Escape
  fi
  kill -CONT "$viewer"
  return "$seen"
}
# interrupts_while_it_reads: Ctrl+C where Escape was in time already; left out where the bar is not seen.
interrupts_while_it_reads() {
  env --default-signal=INT "$program" view large.csv --size 640x480 --device none >said.txt 2>&1 &
  viewer=$!
  until_true "the file is not read again" reads_or_has_read
  kill -STOP "$viewer"
  local expected=0 code=0
  if is_reading; then
    expected=130
    kill -INT "$viewer"
  else
    kill -TERM "$viewer"
  fi
  kill -CONT "$viewer"
  wait "$viewer" || code=$?
  ((code == expected)) || fail "exit code $code after Ctrl+C at the start"
}
answered() { grep -qE "large.csv: not read|file 2 of 2: large.csv|reading was stopped|^[0-9]{6,} points" said.txt; }
kept="" ended=""
for points in 500000 2000000 8000000; do
  "$program" generate plane -n "$points" -o large.csv >/dev/null
  if [[ -z "$kept" ]]; then
    "$program" view first.ply large.csv --size 640x480 --device none >said.txt 2>&1 &
    viewer=$!
    until_true "no third window appeared" find_window "PointHaptics: first.ply"
    until_true "the third window does not take the focus" takes_keys
    key n
    if escape_while_it_reads; then
      until_true "Escape was not heard" answered
      if grep -qF "large.csv: not read, it was cancelled" said.txt; then
        kept=yes
        until_true "the former cloud is gone" xdotool search --name "PointHaptics: first.ply"
        key s
        said "screenshot: pointhaptics-"
        grep -qF "file 2 of 2" said.txt && fail "the cancelled file is shown"
      fi
    fi
    kill -0 "$viewer" || fail "Escape while a file is read ended the program"
    kill -TERM "$viewer"
    wait "$viewer" || fail "exit code $? after a cancel"
    viewer=""
  fi
  if [[ -z "$ended" ]]; then
    "$program" view large.csv --size 640x480 --device none >said.txt 2>&1 &
    viewer=$!
    code=0
    if escape_while_it_reads; then
      until_true "Escape was not heard at the start" answered
      if grep -qF "large.csv: reading was stopped on request" said.txt; then
        ended=yes
        wait "$viewer" || code=$?
        ((code == 130)) || fail "exit code $code after Escape at the start"
        interrupts_while_it_reads
      fi
    fi
    kill "$viewer" 2>/dev/null || true
    wait "$viewer" 2>/dev/null || true
    viewer=""
  fi
  [[ -z "$kept" || -z "$ended" ]] || break
done
rm -f large.csv
[[ -n "$kept" ]] || fail "Escape never left the former cloud: each file was read too soon"
[[ -n "$ended" ]] || fail "Escape never ended the start: each file was read too soon"
echo "the window did what it was told"
