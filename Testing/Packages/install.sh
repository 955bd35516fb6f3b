#!/usr/bin/env bash
# Testing/Packages/install.sh BUILD FOLDER: makes Debian packages of the build and has dpkg install them into FOLDER/root.
#
# dpkg takes the private root for a machine on which the same packages are installed as on this one: a dependency that is wrong
# or missing here is an error. FOLDER is emptied. Exit code 0: installed; 1: not, the last lines say why; 77: skipped.
set -euo pipefail

readonly BUILD="$1" FOLDER="$2"
readonly STATUS=/var/lib/dpkg/status
# dpkg asks for ldconfig, which lies where only root looks.
export PATH="$PATH:/usr/sbin:/sbin"

skip() {
  printf 'skipped: %s\n' "$1"
  exit 77
}

for tool in dpkg dpkg-deb dpkg-shlibdeps file cpack; do
  command -v "$tool" >/dev/null || skip "$tool is missing (packages dpkg-dev and file)"
done
[[ -r "$STATUS" ]] || skip "this is no Debian or Ubuntu"
as_root=()
if ((EUID != 0)); then
  command -v fakeroot >/dev/null || skip "fakeroot is missing, and this user is not root"
  as_root=(fakeroot)
fi

rm -rf -- "$FOLDER"
mkdir -p -- "$FOLDER"/root/var/lib/dpkg/{info,updates,triggers}
cp -- "$STATUS" "$FOLDER/root/var/lib/dpkg/status"
cpack --config "$BUILD/CPackConfig.cmake" -B "$FOLDER/packages" >"$FOLDER/cpack.log" 2>&1 || {
  tail -20 "$FOLDER/cpack.log"
  exit 1
}
for package in "$FOLDER"/packages/*.deb; do
  depends="$(dpkg-deb --field "$package" Depends)"
  printf '%s\n%s\n' "${package##*/}" "$depends"
  # Whoever has one machine installs no MPI for it: what needs that are packages apart.
  if [[ "$depends" == *mpi* && "${package##*/}" != *-mpi* ]]; then
    printf 'FAULT: %s depends on MPI\n' "${package##*/}"
    exit 1
  fi
done
# Files of the machine's own packages are not listed in the root: dpkg warns of each.
run_dpkg() {
  "${as_root[@]}" dpkg --root="$FOLDER/root" --no-triggers "$@" >"$FOLDER/dpkg.log" 2>&1 || {
    grep -v 'files list file' "$FOLDER/dpkg.log"
    exit 1
  }
}
run_dpkg --unpack "$FOLDER"/packages/*.deb
# They have the loader's cache made anew, which the root has none of, nor a shell to run them.
rm -f -- "$FOLDER"/root/var/lib/dpkg/info/*.postinst
names=()
for package in "$FOLDER"/packages/*.deb; do
  names+=("$(dpkg-deb --field "$package" Package)")
done
run_dpkg --configure "${names[@]}"
