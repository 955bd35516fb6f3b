#!/usr/bin/env bash
# Testing/ParaView/root.sh FOLDER: unpacks the distribution's ParaView, with what plugins are built with, below FOLDER.
#
# Nothing is installed and nothing removed: Debian's python3-paraview and python3-vtk9 cannot be installed together, and
# the other tests need the latter. FOLDER/usr/bin/pvpython runs with PYTHONPATH=FOLDER/usr/lib/python3/dist-packages; the
# libraries below all of this are those that the packages of setup.sh bring. 83 MB are downloaded once, 670 MB kept.
# Exit code 0: FOLDER is complete; 1: the packages cannot be had, and the last line says why.
set -euo pipefail

readonly PACKAGES=(paraview paraview-dev python3-paraview)

fail() {
  printf 'No ParaView to test with: %s\n' "$1"
  exit 1
}

main() {
  (($# == 1)) || fail "usage: Testing/ParaView/root.sh FOLDER"
  local folder libraries package part
  folder="$(realpath -m -- "$1")" # apt-get runs in a folder below
  part="$folder.part"
  if [[ -e "$folder/complete" ]]; then
    printf 'ParaView is in %s\n' "$folder"
    return
  fi
  command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || fail "this is no Debian or Ubuntu"
  # Debian 13's needs libraries that the packages of setup.sh do not bring.
  mapfile -t libraries < <(apt-get --no-install-recommends --simulate install paraview 2>/dev/null |
    sed -n 's/^Inst \(lib[^ ]*\).*/\1/p')
  rm -rf -- "$part"
  mkdir -p -- "$part/packages"
  # As root, apt's own user could not write into a folder of ours: then apt says so and downloads as root.
  (cd -- "$part/packages" && apt-get download "${PACKAGES[@]}" "${libraries[@]}" >"$part/log" 2>&1) ||
    fail "apt-get download ${PACKAGES[*]}: $(grep -m1 '^E:' "$part/log" || echo "see $part/log")"
  for package in "$part"/packages/*.deb; do
    dpkg-deb --extract "$package" "$part"
  done
  rm -rf -- "$part/packages" "$part/log"
  # Debian 13 renames the modules of Python, but not what CMake is told of them.
  find "$part" -name '*.cpython-*.so' | while read -r module; do
    ln -s -- "${module##*/}" "${module%%.cpython-*}.so"
  done
  touch -- "$part/complete"
  rm -rf -- "$folder"
  mv -- "$part" "$folder"
  printf 'ParaView is in %s\n' "$folder"
}

main "$@"
