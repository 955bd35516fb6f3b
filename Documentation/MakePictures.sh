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
# shellcheck source=../Testing/Interaction/Window/Window.sh
source "$here/../Testing/Interaction/Window/Window.sh"
need_tools failed 1
patience=60
work="$(mktemp -d)"
finish() {
  local code=$?
  stop_window
  rm -rf -- "$work"
  exit "$code"
}
trap finish EXIT
cd -- "$work"
export XDG_STATE_HOME="$work/state"
start_server 1600x1200

# open_window ARGUMENTS...: a window with the pointer in it; its number is in $window.
open_window() {
  rm -f pointhaptics-*.png
  "$program" view "$@" --device simulated >said.txt 2>&1 &
  viewer=$!
  until_true "no points in the window for $*" grep -q points said.txt
  until_true "no window for $*" find_window "PointHaptics: "
  sleep 2 # the first window may make room for another
  until_true "no window stays for $*" find_window "PointHaptics: "
  until_true "the window does not take the focus for $*" takes_keys
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

# Tour: axes and bounds; the figure; where the felt surface and the voxel means differ, and light.
"$program" view idol.ply --unit m --axes --size 1000x700 --screenshot "$folder/tour-axes.png"
"$program" view idol.ply --unit m --figure --path "$here/../Data/Paths/idol-touch.csv" --size 760x600 \
  --screenshot "$folder/tour-figure.png"
"$program" view idol.ply --unit m --color-by residual --size 760x600 --screenshot "$folder/tour-residual.png"
"$program" view idol.ply --unit m --ambient --size 760x600 --screenshot "$folder/tour-ambient.png"

# Tour: the hand of the mouse presses on the statue.
open_window idol.ply --size 1000x700
keys f $(printf "Prior %.0s" {1..24})
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
xdotool keydown F2
sleep 0.4
for ((i = 0; i < 10; ++i)); do
  xdotool mousemove_relative -- 12 3
  sleep 0.1
done
keep tour-hold
xdotool keyup F2 || true
ls -l "$folder"/idol.png "$folder"/idol-force.png "$folder"/idol-radius.png "$folder"/tour-*.png
