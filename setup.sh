#!/usr/bin/env bash
# ./setup.sh demo | test: does all a fresh Debian 12 or Ubuntu machine needs, then shows or tests PointHaptics.
set -euo pipefail

ROOT="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)"
readonly ROOT
readonly BUILD="$ROOT/build/release"
readonly OUTPUT="$ROOT/output"
# A compiler of one VTK source file may need this much; fewer jobs are run where memory is short.
readonly KILOBYTES_PER_JOB=1500000
readonly DEMO_POINTS=543652
PACKAGES=(
  cmake ninja-build g++
  libvtk9-dev libpcl-dev libx11-dev libgl1-mesa-dri xvfb xdotool
  libusb-1.0-0-dev libhidapi-dev libumockdev-dev umockdev pkg-config
  libcli11-dev libfmt-dev nlohmann-json3-dev libgtest-dev libnanoflann-dev)
# In CI no test shall be skipped for want of a program.
if [[ "${1:-}" == test && -n "${CI:-}" ]]; then
  PACKAGES+=(doxygen glslang-tools)
  # Another version formats differently; Debian 12 has this one.
  if [[ -n "$(apt-cache search --names-only '^clang-format-14$' 2>/dev/null)" ]]; then
    PACKAGES+=(clang-format-14)
  fi
fi
readonly PACKAGES
readonly TEST_PACKAGES=(python3-vtk9 python3-numpy python3-mypy openmpi-bin dpkg-dev file fakeroot)

usage() {
  cat <<'TEXT'
Usage: ./setup.sh COMMAND

Commands:
  demo    install what is missing, build, make a cloud of 543,652 points, feel it along a path, and draw it:
          output/idol.png, output/idol-force.png, output/OUT.csv; opens the viewer where there is a display
  test    install what is missing, build, run every test; ParaView is unpacked in build/paraview-root (83 MB are
          downloaded, 670 MB kept), not installed

Packages are installed with apt-get, through sudo where this user is not root; nothing is ever removed.
The last line says what happened; exit code 0: done, 1: failed, 2: usage.

Environment:
  CI            set: compiler warnings are errors; test installs what checks sources too, and runs the unit tests
                of Core, Haptics and IO under the address and undefined-behaviour sanitizers
  BUILD_JOBS    compilers run at once; default: one per core, fewer where memory is short
TEXT
}

command_name=""
# The present step, for the last line when the script fails.
step="reading the command line"
xvfb_pid=""
xvfb_folder=""

say() { printf '== %s\n' "$*"; }

fail() {
  step="$1"
  exit 1
}

finish() {
  local code=$?
  trap - EXIT INT TERM
  # The X server, and tests that run beside one that failed.
  kill $(jobs -p) 2>/dev/null || true
  wait || true
  if [[ -n "$xvfb_folder" ]]; then
    rm -rf -- "$xvfb_folder"
  fi
  if ((code != 0)); then
    printf '%s: failed: %s\n' "$command_name" "$step"
    # A signal keeps its code; whatever failed inside is a plain failure here.
    code=$((code > 128 ? code : 1))
  fi
  exit "$code"
}

# The packages among the arguments that are not installed.
missing_packages() {
  local package
  for package in "$@"; do
    # A package that was never seen makes dpkg-query fail; one that was removed has another state.
    if ! dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^ii'; then
      printf '%s\n' "$package"
    fi
  done
}

install_packages() {
  local packages=("${PACKAGES[@]}" "$@")
  step="finding out which packages are missing"
  if ! command -v dpkg-query >/dev/null; then
    say "This is no Debian or Ubuntu: going on with what is installed. Needed: ${packages[*]} or their like."
    return
  fi
  local missing=()
  mapfile -t missing < <(missing_packages "${packages[@]}")
  if ((${#missing[@]} == 0)); then
    say "All packages are installed"
    return
  fi
  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      fail "packages are missing and there is no sudo; as root run: apt-get install ${missing[*]}"
    fi
    as_root=(sudo)
  fi
  say "Installing ${missing[*]}"
  step="installing ${missing[*]} (apt-get)"
  # Old lists may do: whether the packages can be had shows in the next command.
  "${as_root[@]}" apt-get update || say "apt-get update failed; going on with the old package lists"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends --no-remove "${missing[@]}"
}

number_of_jobs() {
  local cores kilobytes limit jobs
  cores="$(nproc)"
  kilobytes="$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo 2>/dev/null || true)"
  limit="$(cat /sys/fs/cgroup/memory.max 2>/dev/null || true)"
  if [[ "$limit" =~ ^[0-9]+$ ]] && ((limit / 1024 < ${kilobytes:-limit})); then
    kilobytes=$((limit / 1024))
  fi
  jobs=$((${kilobytes:-KILOBYTES_PER_JOB} / KILOBYTES_PER_JOB))
  jobs=$((jobs < cores ? jobs : cores))
  printf '%d\n' $((jobs > 1 ? jobs : 1))
}

# build ON|OFF [TARGET]...: with or without the tests; all, or the targets and what they need.
build() {
  local tests="$1" jobs options
  shift
  jobs="${BUILD_JOBS:-$(number_of_jobs)}"
  options=(-DCMAKE_BUILD_TYPE=Release "-DPOINTHAPTICS_BUILD_TESTING=$tests" "-DPOINTHAPTICS_BUILD_PYTHON=$tests"
    "-DPOINTHAPTICS_BUILD_BENCHMARKS=$tests"
    "-DPOINTHAPTICS_WARNINGS_AS_ERRORS=$([[ -n "${CI:-}" ]] && echo ON || echo OFF)")
  if command -v ccache >/dev/null; then
    options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  # The cache of a checkout that has been moved names files of the old place.
  if [[ -f "$BUILD/CMakeCache.txt" ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$ROOT" "$BUILD/CMakeCache.txt"; then
    rm -rf -- "$BUILD"
  fi
  step="configuring the build in build/release"
  say "Building in build/release ($jobs at once)"
  cmake -S "$ROOT" -B "$BUILD" -G Ninja "${options[@]}"
  step="building in build/release"
  cmake --build "$BUILD" --parallel "$jobs" ${1+--target "$@"}
}

# The code that reads strangers' files and computes forces, with every access and every operation checked.
run_sanitized() {
  local build="$ROOT/build/sanitized" test options jobs shard shards
  step="building in build/sanitized"
  say "Building the unit tests of Core, Haptics and IO with sanitizers in build/sanitized"
  options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DPOINTHAPTICS_SANITIZE=address,undefined
    -DPOINTHAPTICS_BUILD_BENCHMARKS=OFF)
  if command -v ccache >/dev/null; then
    options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
  cmake -S "$ROOT" -B "$build" -G Ninja "${options[@]}"
  jobs="${BUILD_JOBS:-$(number_of_jobs)}"
  cmake --build "$build" --parallel "$jobs" \
    --target PointHapticsCoreTest PointHapticsHapticsTest PointHapticsIOTest
  # Two sets of tests take minutes and check how a ball moves, not memory.
  for test in Core Haptics IO; do
    step="running the unit tests of $test with sanitizers"
    shards=()
    for ((shard = 0; shard < jobs; ++shard)); do
      GTEST_TOTAL_SHARDS="$jobs" GTEST_SHARD_INDEX="$shard" UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 \
        "$build/bin/PointHaptics${test}Test" --gtest_brief=1 \
        --gtest_filter='-BallCells.GathersEveryPointInReach*:Seeds/*' &
      shards+=("$!")
    done
    for shard in "${shards[@]}"; do
      wait "$shard"
    done
  done
}

# An X server of our own, without a screen: pictures come out the same with and without a desktop.
start_display() {
  local tries
  step="starting Xvfb"
  command -v Xvfb >/dev/null || fail "Xvfb is not installed (package xvfb)"
  xvfb_folder="$(mktemp -d)"
  Xvfb -displayfd 3 -noreset -nolisten tcp -screen 0 1600x1200x24 \
    3>"$xvfb_folder/number" >/dev/null 2>"$xvfb_folder/log" &
  xvfb_pid=$!
  for ((tries = 0; tries < 300; ++tries)); do
    if [[ -s "$xvfb_folder/number" ]]; then
      break
    fi
    if ! kill -0 "$xvfb_pid" 2>/dev/null; then
      cat "$xvfb_folder/log" >&2
      fail "Xvfb did not start; its messages are above"
    fi
    sleep 0.1
  done
  [[ -s "$xvfb_folder/number" ]] || fail "Xvfb did not start within 30 s"
}

on_own_display() {
  env -u WAYLAND_DISPLAY -u XAUTHORITY DISPLAY=":$(<"$xvfb_folder/number")" "$@"
}

run_demo() {
  local program="$BUILD/bin/pointhaptics" cloud="$OUTPUT/idol.ply" path="$ROOT/Data/Paths/idol-touch.csv" file
  install_packages
  build OFF pointhaptics
  mkdir -p "$OUTPUT"

  step="making the cloud output/idol.ply"
  say "A statue of $DEMO_POINTS points, 16 times as dense in front as behind: output/idol.ply"
  "$program" generate idol -n "$DEMO_POINTS" -o "$cloud"

  step="feeling the cloud (pointhaptics feel)"
  say "A hand path over the statue, felt tick by tick: output/OUT.csv"
  "$program" feel "$cloud" --unit m --path "$path" -o "$OUTPUT/OUT.csv"

  start_display
  step="drawing the cloud (pointhaptics view)"
  say "The same path in the viewer: output/idol.png and output/idol-force.png"
  on_own_display "$program" view "$cloud" --unit m --path "$path" \
    --screenshot "$OUTPUT/idol.png" --force-chart "$OUTPUT/idol-force.png"
  for file in OUT.csv idol.png idol-force.png; do
    [[ -s "$OUTPUT/$file" ]] || fail "output/$file was not written"
  done

  say "Screenshot: $OUTPUT/idol.png"
  say "Force and proxy radius over time: $OUTPUT/idol-force.png"
  say "Every tick as a table: $OUTPUT/OUT.csv"
  # Without a terminal nobody is there to close the window.
  if [[ -n "${DISPLAY:-}" && -t 0 && -t 1 ]]; then
    say "Opening the viewer; the mouse is your hand; close the window to end the demo"
    "$program" view "$cloud" --unit m --device simulated || say "The viewer could not run on the display $DISPLAY"
  else
    say "No desktop here: where there is one, run build/release/bin/pointhaptics view output/idol.ply"
  fi
  printf 'demo: ok: %s points felt and drawn: output/idol.png, output/idol-force.png, output/OUT.csv\n' "$DEMO_POINTS"
}

run_test() {
  local log="$BUILD/ctest.log" tests seconds skipped
  install_packages "${TEST_PACKAGES[@]}"
  step="unpacking ParaView in build/paraview-root"
  "$ROOT/Testing/ParaView/root.sh" "$ROOT/build/paraview-root" || say "Tests of the ParaView plugin will be skipped"
  build ON
  start_display
  step="running ctest"
  say "Testing"
  if ! on_own_display ctest --test-dir "$BUILD" --output-on-failure --no-tests=error -j2 2>&1 | tee "$log"; then
    tests="$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)$/\1 of \2/p' "$log")"
    fail "${tests:-no} tests failed; the list is above"
  fi
  if [[ -n "${CI:-}" ]]; then
    run_sanitized
  fi
  tests="$(sed -nE 's/^100% tests passed, 0 tests failed out of ([0-9]+)$/\1/p' "$log")"
  seconds="$(sed -nE 's/^Total Test time \(real\) = *([0-9.]+) sec$/\1/p' "$log")"
  skipped="$(grep -cE '^ *[0-9]+/[0-9]+ Test .*\*\*\*Skipped' "$log" || true)"
  printf 'test: ok: %s tests in %s s%s\n' "$tests" "$seconds" "$( ((skipped == 0)) || echo ", $skipped of them skipped")"
}

main() {
  if (($# != 1)); then
    usage >&2
    exit 2
  fi
  case "$1" in
    demo | test) command_name="$1" ;;
    -h | --help)
      usage
      exit 0
      ;;
    *)
      printf 'setup.sh: unknown command %q\n' "$1" >&2
      usage >&2
      exit 2
      ;;
  esac
  trap finish EXIT
  trap 'step="interrupted while $step"; exit 130' INT
  trap 'step="ended while $step"; exit 143' TERM
  cd -- "$ROOT"
  "run_$command_name"
}

main "$@"
