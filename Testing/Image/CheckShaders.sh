#!/usr/bin/env bash
# CheckShaders.sh PROGRAM DATA FOLDER PICTURE...: draws the pictures with PROGRAM (PointHapticsImageTest) and
# validates each shader that the driver linked with glslangValidator, which follows the standard more strictly than
# drivers do. Only Mesa writes its shaders down (MESA_SHADER_CAPTURE_PATH).
# Exit code 77: skipped, the reason is said. A planted fault is part of the test: a shader with an error must be refused.
set -euo pipefail

program="$1" data="$2" folder="$3"
shift 3

skip() {
  echo "skipped: $1"
  exit 77
}

# stages FILE: writes the stages of a capture beside it, each under the extension that names it.
stages() {
  awk -v stem="${1%.shader_test}" '
    /^\[vertex shader\]/ { to = stem ".vert"; next }
    /^\[geometry shader\]/ { to = stem ".geom"; next }
    /^\[fragment shader\]/ { to = stem ".frag"; next }
    /^\[/ { to = ""; next }
    to { print > to }' "$1"
}

command -v glslangValidator >/dev/null || skip "glslangValidator is not installed (package glslang-tools)"
rm -rf -- "$folder"
mkdir -p "$folder/pictures" "$folder/shaders"
for picture in "$@"; do
  code=0
  MESA_SHADER_CAPTURE_PATH="$folder/shaders" "$program" -D "$data" -T "$folder/pictures" "$picture" \
    -V "$data/Baseline/$picture.png" --pixels 1000000 >"$folder/log" 2>&1 || code=$?
  ((code != 77)) || skip "$(tail -n 1 "$folder/log")"
done
for capture in "$folder"/shaders/*.shader_test; do
  [[ -e "$capture" ]] || skip "this driver does not write its shaders down"
  stages "$capture"
done

printf '#version 150\nout vec4 color;\nvoid main() { color = vec3(1); }\n' >"$folder/planted.frag"
if glslangValidator "$folder/planted.frag" >/dev/null; then
  echo "glslangValidator takes a shader with an error"
  exit 1
fi
bad=0 count=0
for shader in "$folder"/shaders/*.vert "$folder"/shaders/*.geom "$folder"/shaders/*.frag; do
  [[ -e "$shader" ]] || continue
  count=$((count + 1))
  if ! glslangValidator "$shader" >"$folder/log"; then
    cat "$folder/log"
    bad=$((bad + 1))
  fi
done
echo "$count shaders, $bad with errors"
((bad == 0 && count > 0))
