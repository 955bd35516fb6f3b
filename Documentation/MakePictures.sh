#!/usr/bin/env bash
# MakePictures.sh PROGRAM [FOLDER]: makes the pictures of README.md, Tour.md and Method.md anew, by the program itself on an
# X server of its own, into FOLDER (default: Images beside this script). Those of the benchmarks are made by
# `pointhaptics bench`. Needs Xvfb and xdotool. Exit code 0: all were made; 1: not, the last line says which.
set -euo pipefail
if (($# < 1 || $# > 2)); then
  echo "usage: MakePictures.sh PROGRAM [FOLDER]" >&2
  exit 2
fi
here="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)"
program="$(realpath -- "$1")"
folder="$(realpath -- "${2:-$here/Images}")"
for tool in Xvfb xdotool; do
  command -v "$tool" >/dev/null || {
    echo "failed: $tool is not installed (package ${tool,,})"
    exit 1
  }
done
work="$(mktemp -d)"
server=""
viewer=""
finish() {
  local code=$?
  [[ -z "$viewer" ]] || kill "$viewer" 2>/dev/null || true
  [[ -z "$server" ]] || kill "$server" 2>/dev/null || true
  rm -rf -- "$work"
  exit "$code"
}
trap finish EXIT
cd -- "$work"
export XDG_STATE_HOME="$work/state"
Xvfb -displayfd 3 -noreset -nolisten tcp -screen 0 1600x1200x24 3>display >/dev/null 2>&1 &
server=$!
for ((i = 0; i < 200; ++i)); do
  [[ ! -s display ]] || break
  sleep 0.05
done
DISPLAY=":$(<display)"
export DISPLAY

# until_true WORDS COMMAND...: waits for the command to succeed, for 60 s at most.
until_true() {
  local words="$1" tries
  shift
  for ((tries = 0; tries < 1200; ++tries)); do
    if "$@" >/dev/null 2>&1; then
      return
    fi
    sleep 0.05
  done
  echo "failed: $words"
  exit 1
}

# open_window ARGUMENTS...: a window with the pointer in it; its number is in $window.
open_window() {
  rm -f pointhaptics-*.png
  "$program" view "$@" --device simulated >said.txt 2>&1 &
  viewer=$!
  until_true "no window for $*" xdotool search --name "PointHaptics: "
  window="$(xdotool search --name "PointHaptics: " | head -n 1)"
  until_true "no points in the window for $*" grep -q points said.txt
  sleep 2
  xdotool mousemove --window "$window" 500 260
}
keys() {
  local each
  for each in "$@"; do
    xdotool key "$each"
    sleep 0.12
  done
}
# keep NAME: what the window shows, at rest, as NAME.png; then closes it.
keep() {
  sleep 5
  xdotool key s
  until_true "no screenshot for $1" test -s pointhaptics-001.png
  sleep 0.5
  mv pointhaptics-001.png "$folder/$1.png"
  xdotool key q
  wait "$viewer"
  viewer=""
}

"$program" generate idol -n 543652 -o idol.ply
"$program" generate sphere -n 47516 -o sphere.ply

# README: the statue touched, and the force along the way.
"$program" view idol.ply --unit m --path "$here/../Data/Paths/idol-touch.csv" --size 900x720 \
  --screenshot "$folder/idol.png" --force-chart "$folder/idol-force.png"
# Method: the radii.
"$program" view idol.ply --unit m --color-by ProxyRadius --size 760x600 --screenshot "$folder/idol-radius.png"

# Tour: axes and bounds; the figure.
"$program" view idol.ply --unit m --axes --size 1000x700 --screenshot "$folder/tour-axes.png"
"$program" view idol.ply --unit m --figure --path "$here/../Data/Paths/idol-touch.csv" --size 760x600 \
  --screenshot "$folder/tour-figure.png"

# Tour: the hand of the mouse presses on the statue.
open_window idol.ply --size 1000x700
keys f Prior Prior Prior Prior Prior Prior Prior Prior Prior Prior Prior Prior Prior Prior
for ((i = 0; i < 4; ++i)); do
  xdotool mousemove_relative -- -4 2
  sleep 0.1
done
keep tour-touch
# The list of keys.
open_window sphere.ply --size 1000x700
keys h
keep tour-help
# Sliders, servo loop, and the point under the mouse.
open_window idol.ply --size 1000x700
keys v i p
keep tour-panels
# A hand that holds the model has turned it.
open_window idol.ply --size 1000x700
keys f
xdotool keydown 2
sleep 0.4
for ((i = 0; i < 10; ++i)); do
  xdotool mousemove_relative -- 12 3
  sleep 0.1
done
keep tour-hold
xdotool keyup 2 || true
ls -l "$folder"/idol.png "$folder"/idol-force.png "$folder"/idol-radius.png "$folder"/tour-*.png
