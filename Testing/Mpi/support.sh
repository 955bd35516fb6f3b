# Sourced by the tests under mpirun: makes a temporary folder and defines run_ranks.
set -euo pipefail

if [[ -z "${MPIRUN:-}" || ! -x "$MPIRUN" ]]; then
  echo "skipped: no mpirun (package openmpi-bin)"
  exit 0
fi
# Containers run tests as root, on fewer cores than ranks; Open MPI 4, then 5.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export PRTE_ALLOW_RUN_AS_ROOT=1 PRTE_ALLOW_RUN_AS_ROOT_CONFIRM=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
# Ranks that wait give their core to the others; no copies through another process's memory, which containers forbid.
# One machine needs no network, and Open MPI 5 warns where there is none.
export OMPI_MCA_btl=^tcp
export OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
export OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_plm_rsh_agent=

folder="$(mktemp -d)"
trap 'rm -rf -- "$folder"' EXIT
cd -- "$folder"

fault() {
  printf 'FAULT: %s\n' "$*"
  exit 1
}

# Reports where a failed command stood, with the last lines of all programs.
explain() {
  local code="$1"
  trap - ERR
  printf 'FAULT: line %s: %s: exit code %s\n' "$2" "$3" "$code"
  tail -n 20 said said-by-ranks warned warned-by-ranks 2>/dev/null || true
  exit "$code"
}
set -o errtrace
trap 'explain "$?" "$LINENO" "$BASH_COMMAND"' ERR

# run_ranks N WORDS...: pointhaptics-mpi on N ranks.
run_ranks() {
  local ranks="$1"
  shift
  timeout 120 "$MPIRUN" -n "$ranks" "$MPI_PROGRAM" "$@"
}

# same_bytes EXTENSION COMMAND IN WORDS...: OUT of 1, 3 and 8 ranks ($RANKS) is that of the plain program, and so is
# what is said.
same_bytes() {
  local extension="$1" command="$2" input="$3" ranks
  shift 3
  "$PROGRAM" "$command" "$input" -o "out.$extension" "$@" >said 2>warned
  mv "out.$extension" "expected.$extension"
  for ranks in ${RANKS:-1 3 8}; do
    run_ranks "$ranks" "$command" "$input" -o "out.$extension" "$@" >said-by-ranks 2>warned-by-ranks ||
      fault "$command $input $* on $ranks ranks: exit code $?: $(cat warned-by-ranks)"
    cmp "expected.$extension" "out.$extension" || fault "$command $input $* on $ranks ranks: other bytes"
    [[ "$(sed 's/^pointhaptics-mpi /pointhaptics /' warned-by-ranks)" == "$(cat warned)" ]] ||
      fault "$command $input $* on $ranks ranks warns of: $(cat warned-by-ranks)"
    cmp said said-by-ranks || fault "$command $input $* on $ranks ranks says $(cat said-by-ranks)"
    rm "out.$extension"
  done
  printf 'the same: %s %s %s: %s\n' "$command" "$input" "$*" "$(cat said)"
}
