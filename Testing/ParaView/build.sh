#!/usr/bin/env bash
# Testing/ParaView/build.sh ROOT SOURCE BUILD JOBS [OPTION OF CMAKE...]: builds the plugin against the private root.
# Exit code 77, which ctest takes for skipped, where there is no root.
set -euo pipefail

readonly ROOT="$1" SOURCE="$2" BUILD="$3" JOBS="$4"
shift 4
if [[ ! -e "$ROOT/complete" ]]; then
  printf 'skipped: no ParaView in %s; Testing/ParaView/root.sh %s downloads it\n' "$ROOT" "$ROOT"
  exit 77
fi
config="$(find "$ROOT/usr/lib" -maxdepth 4 -name paraview-config.cmake -print -quit)"
cmake -S "$SOURCE" -B "$BUILD" -DPOINTHAPTICS_BUILD_PARAVIEW=ON "-DParaView_DIR=$(dirname -- "$config")" "$@"
exec cmake --build "$BUILD" --parallel "$JOBS"
