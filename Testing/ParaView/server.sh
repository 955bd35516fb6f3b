#!/usr/bin/env bash
# Testing/ParaView/server.sh RANKS SCRIPT: starts a pvserver of so many ranks and runs the script as its client. Called by
# run.sh. Exit code: that of the script; 77, which ctest takes for skipped, where there is no mpirun.
set -euo pipefail

readonly RANKS="$1" SCRIPT="$2"
command -v mpirun >/dev/null || {
  printf 'skipped: mpirun is missing (package openmpi-bin)\n'
  exit 77
}
folder="$(mktemp -d)"
server=""
finish() {
  local code=$?
  if [[ -n "$server" ]]; then
    kill "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
  fi
  rm -rf -- "$folder"
  exit "$code"
}
trap finish EXIT

# Another program may take the port between the question and the answer.
for attempt in 1 2 3; do
  port="$(pvpython -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')"
  mpirun -np "$RANKS" pvserver --force-offscreen-rendering "--server-port=$port" >"$folder/log" 2>&1 &
  server=$!
  for ((tries = 0; tries < 600; ++tries)); do
    if grep -q 'Accepting connection' "$folder/log" || ! kill -0 "$server" 2>/dev/null; then
      break
    fi
    sleep 0.1
  done
  if grep -q 'Accepting connection' "$folder/log"; then
    code=0
    POINTHAPTICS_SERVER_PORT="$port" POINTHAPTICS_SERVER_RANKS="$RANKS" pvpython "$SCRIPT" || code=$?
    ((code == 0)) || tail -20 "$folder/log"
    exit "$code"
  fi
  kill "$server" 2>/dev/null || true
  wait "$server" 2>/dev/null || true
  server=""
done
printf 'no pvserver of %s ranks listens; attempt %s said:\n' "$RANKS" "$attempt"
cat -- "$folder/log"
exit 1
