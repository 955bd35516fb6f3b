#!/usr/bin/env bash
# ResettingServer.sh PROGRAM FOLDER: pictures on an X server that begins anew whenever its last client has gone, as the one
# of xvfb-run does. Without care one picture of five ends the program: it asks whether there is a display, goes, and comes
# back in the middle of the reset.
# Exit code 0: all pictures were drawn; 1: not, the last line says what; 77: skipped, Xvfb or xdotool is missing.
set -euo pipefail
program="$1"
folder="$2"
here="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)"
# shellcheck source=Window.sh
source "$here/Window.sh"
need_tools skipped 77
rm -rf -- "$folder"
mkdir -p "$folder"
cd -- "$folder"

finish() {
  local code=$?
  stop_window
  exit "$code"
}
trap finish EXIT

start_server 320x240 -reset
"$program" generate sphere -n 2000 -o cloud.ply >/dev/null
for ((i = 1; i <= 30; ++i)); do
  "$program" view cloud.ply --size 64x64 --screenshot picture.png >said.txt 2>&1 || fail "picture $i: exit code $?"
done
echo "all pictures were drawn"
