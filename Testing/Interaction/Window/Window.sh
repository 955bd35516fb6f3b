# shellcheck shell=bash
# Sourced by the scripts that drive a window of the viewer as a person would, on an X server of its own: DriveWindow.sh
# and Documentation/MakePictures.sh. What the program says is in said.txt of the current folder. $viewer is the number of
# its process, set by whoever starts it, and taken away when it has ended.
server=""
viewer=""
patience=60 # seconds that until_true waits at most
exec {report}>&1 # what fail says is seen within until_true, too

# need_tools WORD CODE: ends with the code and the word where Xvfb or xdotool is missing.
need_tools() {
  local tool
  for tool in Xvfb xdotool; do
    if ! command -v "$tool" >/dev/null; then
      echo "$1: $tool is not installed (package ${tool,,})"
      exit "$2"
    fi
  done
}
# stop_window: ends what runs still; for a trap.
stop_window() {
  [[ -z "$viewer" ]] || kill "$viewer" 2>/dev/null || true
  [[ -z "$server" ]] || kill "$server" 2>/dev/null || true
}
fail() {
  {
    echo "failed: $*"
    echo "the program said:"
    cat said.txt
  } >&"$report"
  exit 1
}
# until_true WORDS COMMAND...: waits for the command to succeed; it may be a function that sets variables.
until_true() {
  local words="$1" tries
  shift
  for ((tries = 0; tries < 20 * patience; ++tries)); do
    if "$@" >/dev/null 2>&1; then
      return
    fi
    sleep 0.05
  done
  fail "$words"
}
# start_server WIDTHxHEIGHT [OPTION]: sets DISPLAY. The option is -noreset where none is given.
start_server() {
  : >said.txt
  rm -f display
  Xvfb -displayfd 3 "${2:--noreset}" -nolisten tcp -screen 0 "$1x24" 3>display >/dev/null 2>&1 &
  server=$!
  until_true "Xvfb did not start" test -s display
  DISPLAY=":$(<display)"
  export DISPLAY
}
# find_window NAME: its number comes into $window; fails where there is none yet. For until_true.
find_window() {
  window="$(xdotool search --name "$1" | head -n 1)" && [[ -n "$window" ]]
}
# takes_keys: the pointer goes into the window, which takes the focus as soon as it looks at events.
takes_keys() {
  xdotool mousemove 9999 9999 mousemove --window "$window" 320 150
  sleep 0.1
  [[ "$(xdotool getwindowfocus 2>/dev/null)" == "$window" ]]
}
