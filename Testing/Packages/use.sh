#!/usr/bin/env bash
# Testing/Packages/use.sh ROOT program | mpi MPIRUN | development COMPILER GENERATOR MAKE | parallel (the same) | python INTERPRETER
# Uses what install.sh installed below ROOT, and nothing of the build. Exit code 0: it works; 1: not; 77: skipped.
set -euo pipefail

readonly ROOT="$1" PART="$2"
shift 2
if [[ ! -x "$ROOT/usr/bin/pointhaptics" ]]; then
  printf 'skipped: no packages in %s\n' "$ROOT"
  exit 77
fi

fail() {
  printf '%s\n' "$1"
  exit 1
}

# Every library of ours that FILE loads lies below the root.
check_libraries() {
  local name arrow path rest
  while read -r name arrow path rest; do
    [[ "$name" != libPointHaptics* || "$(realpath -- "$path")" == "$(realpath -- "$ROOT")"/* ]] ||
      fail "$1 loads $name from ${path/#not/nowhere}"
    [[ "$path" != not ]] || fail "$1 does not find $name"
  done < <(ldd "$1")
}

# None of ours but those made for it links MPI itself. (Debian's libvtkIOXML brings it all the same, for VTK's own filters.)
check_without_mpi() {
  local file
  for file in "$ROOT"/usr/bin/pointhaptics "$ROOT"/usr/lib/libPointHaptics*.so.* \
    "$ROOT"/usr/lib/python3/dist-packages/pointhaptics/*.so; do
    [[ -e "$file" ]] || continue
    if readelf -d "$file" | grep -E 'NEEDED.*(libmpi|libopen-|ParallelMPI|PointHapticsParallel)' &&
      [[ "$file" != *libPointHapticsParallel.so* ]]; then
      fail "$file links MPI"
    fi
  done
}

use_program() {
  local file
  check_without_mpi
  check_libraries "$ROOT/usr/bin/pointhaptics"
  "$ROOT/usr/bin/pointhaptics" generate sphere -n 1000 -o packaged.ply
  "$ROOT/usr/bin/pointhaptics" resample packaged.ply -o packaged.vtp --dims 10
  "$ROOT/usr/bin/pointhaptics" view packaged.ply --write-config packaged.json # by the library that is loaded for it
  check_libraries "$ROOT"/usr/lib/libpointhaptics_view.so.*.*.*
  "$ROOT/usr/bin/pointhaptics" info packaged.vtp | grep -q VoxelPointCount || fail "packaged.vtp has no VoxelPointCount"
  for file in share/man/man1/pointhaptics.1 share/bash-completion/completions/pointhaptics \
    share/applications/pointhaptics.desktop share/doc/pointhaptics/copyright lib/udev/rules.d/70-pointhaptics.rules; do
    [[ -s "$ROOT/usr/$file" ]] || fail "/usr/$file is not installed"
  done
}

use_mpi() {
  local MPIRUN="$1"
  [[ -x "$MPIRUN" ]] || {
    printf 'skipped: no mpirun (package openmpi-bin)\n'
    exit 77
  }
  check_libraries "$ROOT/usr/bin/pointhaptics-mpi"
  [[ -s "$ROOT/usr/share/doc/pointhaptics-mpi/copyright" ]] || fail "the copyright is not installed"
  source "$(dirname -- "${BASH_SOURCE[0]}")/../Mpi/support.sh"
  "$ROOT/usr/bin/pointhaptics" generate sphere -n 1000 -o sphere.ply
  "$ROOT/usr/bin/pointhaptics" resample sphere.ply -o expected.vtp --dims 10
  "$MPIRUN" -n 2 "$ROOT/usr/bin/pointhaptics-mpi" resample sphere.ply -o means.vtp --dims 10
  cmp expected.vtp means.vtp || fail "two ranks write other bytes"
}

# Builds and runs the example Resample as it is installed.
use_development() {
  local compiler="$1" generator="$2" make="$3"
  rm -rf -- packaged-example
  cmake -S "$ROOT/usr/share/doc/PointHaptics/Examples/Resample" -B packaged-example -G "$generator" \
    "-DCMAKE_MAKE_PROGRAM=$make" "-DCMAKE_CXX_COMPILER=$compiler" -DCMAKE_BUILD_TYPE=Release \
    "-DCMAKE_PREFIX_PATH=$ROOT/usr" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
  cmake --build packaged-example
  printf 'x,y,z\n0.1,0.1,0.1\n0.2,0.2,0.2\n9.1,9.1,9.1\n' >packaged-points.csv
  check_libraries packaged-example/Resample
  packaged-example/Resample packaged-points.csv packaged-means.csv
}

# A program of somebody's own on many processes.
use_parallel() {
  local compiler="$1" generator="$2" make="$3"
  rm -rf -- packaged-parallel
  mkdir -p packaged-parallel/source
  cat >packaged-parallel/source/CMakeLists.txt <<'CMAKE'
cmake_minimum_required(VERSION 3.18)
project(Parallel LANGUAGES CXX)
find_package(PointHaptics REQUIRED COMPONENTS Parallel)
add_executable(Parallel main.cxx)
target_link_libraries(Parallel PRIVATE PointHaptics::Parallel)
CMAKE
  cat >packaged-parallel/source/main.cxx <<'CXX'
#include <vtkDistributedVoxelMeanResampler.h>
#include <vtkNew.h>
int main()
{
  vtkNew<vtkDistributedVoxelMeanResampler> resampler;
  return resampler->GetController() != nullptr; // none: MPI was not started
}
CXX
  cmake -S packaged-parallel/source -B packaged-parallel -G "$generator" "-DCMAKE_MAKE_PROGRAM=$make" \
    "-DCMAKE_CXX_COMPILER=$compiler" "-DCMAKE_PREFIX_PATH=$ROOT/usr" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
  cmake --build packaged-parallel
  check_libraries packaged-parallel/Parallel
  packaged-parallel/Parallel
}

use_python() {
  PYTHONPATH="$ROOT/usr/lib/python3/dist-packages" "$1" - "$ROOT" <<'PYTHON'
import os, sys
import numpy as np
import pointhaptics as ph

root = os.path.realpath(sys.argv[1])
assert os.path.realpath(ph.__file__).startswith(root), ph.__file__
loaded = {line.split()[-1] for line in open("/proc/self/maps") if "PointHaptics" in line}
assert loaded and all(os.path.realpath(path).startswith(root) for path in loaded), loaded
print(ph.resample(np.array([[0.0, 0, 0], [1, 1, 1]]), voxel=3).points)
PYTHON
}

"use_$PART" "$@"
