#!/usr/bin/env bash
# RunInVm.sh PROGRAM FOLDER: starts a virtual machine whose only program is PROGRAM, and passes on what it says.
# The kernel: POINTHAPTICS_VM_KERNEL, a folder with boot/vmlinuz-* and lib/modules; else FOLDER/kernel, where
# FetchKernel.sh puts one; else the newest one installed here. FOLDER is for files of this script.
# Exit code 0: tests passed, 1: failed, 77: something is missing here, and which.
set -euo pipefail

readonly PROGRAM="$1"
readonly FOLDER="$2"
readonly SECONDS_AT_MOST=55
# Those that the others need come first; what a kernel has built in has no file.
readonly MODULES=(usb-common usbcore usbip-core vhci-hcd usbserial ftdi_sio hid hid-generic uhid)

skip() {
  printf 'skipped: %s\n' "$1" >&2
  exit 77
}

# Prints the folder and the version of a kernel, or nothing.
find_kernel() {
  local root image version
  for root in ${POINTHAPTICS_VM_KERNEL:+"$POINTHAPTICS_VM_KERNEL"} "$FOLDER/kernel" ""; do
    while read -r image; do
      version="${image##*/vmlinuz-}"
      if [[ -r "$image" && -d "$root/lib/modules/$version/kernel" ]]; then
        printf '%s %s\n' "${root:-/}" "$version"
        return
      fi
    done < <(ls -1 "$root"/boot/vmlinuz-* 2>/dev/null | sort -rV)
  done
}

copy_module() {
  local from="$1" to="$2"
  case "$from" in
    *.xz) xz -dc "$from" >"$to" ;;
    *.zst) zstd -dcq "$from" >"$to" ;;
    *.gz) gzip -dc "$from" >"$to" ;;
    *) cp "$from" "$to" ;;
  esac
}

make_initramfs() {
  local root="$1" modules="$2" number=10 name file
  mkdir -p "$root/modules" "$root/dev"
  for name in "${MODULES[@]}"; do
    file="$(find "$modules/kernel" -name "$name.ko*" -print -quit)"
    if [[ -n "$file" ]]; then
      copy_module "$file" "$root/modules/$number-$name.ko"
      number=$((number + 1))
    elif ! grep -q "/$name.ko" "$modules/modules.builtin"; then
      skip "this kernel has no module $name ($modules); Debian's package linux-image-amd64 has it"
    fi
  done
  cp "$PROGRAM" "$root/init"
  while read -r file; do
    install -D "$file" "$root$file"
  done < <(ldd "$PROGRAM" | grep -o '/[^ ]*')
  (cd "$root" && find . | cpio -o -H newc -R 0:0 --quiet)
}

[[ "$(uname -m)" == x86_64 ]] || skip "the virtual machine is an x86_64 one, and this is not"
command -v qemu-system-x86_64 >/dev/null || skip "qemu-system-x86_64 is missing (package qemu-system-x86)"
command -v cpio >/dev/null || skip "cpio is missing (package cpio)"
read -r kernel version < <(find_kernel) || true
[[ -n "${version:-}" ]] || skip "there is no kernel to start; run $(dirname -- "$0")/FetchKernel.sh $FOLDER/kernel"

mkdir -p "$FOLDER"
work="$(mktemp -d "$FOLDER/run-XXXXXX")"
trap 'rm -rf -- "$work"' EXIT
make_initramfs "$work/root" "${kernel%/}/lib/modules/$version" >"$work/initramfs"

# Software emulation: it needs no permission, and virtual machines inside virtual ones are not to be relied on.
printf 'vm: Linux %s\n' "$version"
timeout --kill-after=3 "$SECONDS_AT_MOST" qemu-system-x86_64 -accel tcg,thread=multi -cpu max -smp 2 -m 512 \
  -nodefaults -no-user-config -display none -serial stdio -no-reboot \
  -kernel "${kernel%/}/boot/vmlinuz-$version" -initrd "$work/initramfs" \
  -append "console=ttyS0 loglevel=2 panic=-1 mitigations=off" </dev/null 2>&1 | tr -d '\r' | tee "$work/log" ||
  printf 'vm: the machine was ended after %d s or did not start\n' "$SECONDS_AT_MOST"
grep -q '^vm: tests ended with 0$' "$work/log"
