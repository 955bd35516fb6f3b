#!/usr/bin/env bash
# Testing/ParaView/run.sh ROOT PLUGIN COMMAND...: runs a program of the private root (root.sh) with the plugin.
# Exit code 77, which ctest takes for skipped, where there is no root.
set -euo pipefail

readonly ROOT="$1" PLUGIN="$2"
shift 2
if [[ ! -e "$ROOT/complete" ]]; then
  printf 'skipped: no ParaView in %s; Testing/ParaView/root.sh %s downloads it\n' "$ROOT" "$ROOT"
  exit 77
fi
libraries="$(dirname -- "$(find "$ROOT/usr/lib" -maxdepth 2 -name 'libvtkRemotingCore-pv*.so' -print -quit)")"
# The window needs Qt's plugins, and on Debian 13 what libproxy keeps in a folder of its own.
export LD_LIBRARY_PATH="$libraries:$libraries/libproxy${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
export QT_PLUGIN_PATH="$(find "$ROOT/usr/lib" -maxdepth 4 -path '*/plugins/platforms' -printf '%h' -quit)${QT_PLUGIN_PATH:+:$QT_PLUGIN_PATH}"
export PYTHONPATH="$ROOT/usr/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}"
export PATH="$ROOT/usr/bin:$PATH"
export POINTHAPTICS_PLUGIN="$PLUGIN"
# Several ranks on few cores, in a container too.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export PRTE_ALLOW_RUN_AS_ROOT=1 PRTE_ALLOW_RUN_AS_ROOT_CONFIRM=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
# Ranks that wait give their core to the one that works, and to the client.
export OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_hwloc_base_binding_policy=none
exec "$@"
