#!/usr/bin/env bash
# FetchKernel.sh FOLDER: puts Debian's newest kernel with its modules into FOLDER (300 MB), without installing it.
set -euo pipefail
mkdir -p "$1"
cd -- "$1"
package="$(apt-cache depends linux-image-amd64 | sed -nE 's/^ *Depends: (linux-image-[^ ]*)$/\1/p' | head -n 1)"
if [[ -z "$package" ]]; then
  echo "FetchKernel.sh: no package linux-image-amd64 is known here; run apt-get update, or name a folder with" \
    "boot/vmlinuz-* and lib/modules in POINTHAPTICS_VM_KERNEL" >&2
  exit 1
fi
apt-get download "$package"
dpkg-deb -x "$package"_*.deb .
rm -f -- "$package"_*.deb
