#!/usr/bin/env bash
# FailingJob.sh CASE: a rank that fails ends the job with a message and an exit code, and does not let the others wait.
source "$(dirname -- "${BASH_SOURCE[0]}")/support.sh"

"$PROGRAM" generate idol -n 20000 -o idol.ply >said

# expect_end CODE TEXT COMMAND...: within 60 s.
expect_end() {
  local code="$1" text="$2" ended=0 begin=$SECONDS
  shift 2
  timeout --kill-after=5 60 "$@" >output 2>&1 || ended=$?
  ((SECONDS - begin < 60)) || fault "$*: the job hangs: $(cat output)"
  if [[ "$code" == any ]]; then
    ((ended != 0)) || fault "$*: exit code 0: $(cat output)"
  else
    ((ended == code)) || fault "$*: exit code $ended, not $code: $(cat output)"
  fi
  grep -qF -- "$text" output || fault "$*: no \"$text\" in: $(cat output)"
  [[ ! -e out.ply ]] || fault "$*: a failed job left out.ply behind"
}

# rank_script NAME: what the ranks of a job run, $rank being the rank. A job of two programs, divided by a colon, makes
# Open MPI 5.0's own launcher crash now and then.
rank_script() {
  {
    printf '#!/bin/sh\nrank="${OMPI_COMM_WORLD_RANK:-$PMI_RANK}"\n'
    cat
  } >"$1"
  chmod +x "$1"
}

export MPI_PROGRAM
case "$1" in
  MissingFile)
    rank_script last_misses <<<'exec "$MPI_PROGRAM" resample "$([ "$rank" = 2 ] && echo absent.ply || echo idol.ply)" -o out.ply'
    expect_end 1 "pointhaptics-mpi resample: rank 2 of 3: absent.ply: " "$MPIRUN" -n 3 ./last_misses
    # Missing for all: one message, as from the plain program.
    expect_end 1 "pointhaptics-mpi bandwidth: absent.ply: " "$MPIRUN" -n 3 "$MPI_PROGRAM" bandwidth absent.ply -o out.ply
    (($(grep -c "absent.ply" output) == 1)) || fault "more than one message: $(cat output)"
    ;;
  KilledRank)
    # The second rank is killed while both work, or while they start: each of them waits for the other many times.
    rank_script last_dies <<<'[ "$rank" = 0 ] || (sleep 0.7; kill -9 $$) &
exec "$MPI_PROGRAM" bandwidth large.ply -o out.ply --neighbors 500'
    "$PROGRAM" generate idol -n 300000 -o large.ply >said
    expect_end any "signal 9" "$MPIRUN" -n 2 ./last_dies
    ;;
  BadInput)
    printf 'x,y,z\nnan,0,0\nnan,1,1\n' >invalid.csv
    expect_end 1 "invalid" "$MPIRUN" -n 2 "$MPI_PROGRAM" resample invalid.csv -o out.ply
    expect_end 1 "2 points with a coordinate that is NaN" "$MPIRUN" -n 2 "$MPI_PROGRAM" bandwidth invalid.csv -o out.ply
    expect_end 2 "unknown extension" "$MPIRUN" -n 2 "$MPI_PROGRAM" resample idol.ply -o out.xls
    expect_end 1 "no/folder" "$MPIRUN" -n 2 "$MPI_PROGRAM" resample idol.ply -o out.ply --voxel-index no/folder/i.csv
    expect_end 2 "original-ids: " "$MPIRUN" -n 2 "$MPI_PROGRAM" resample idol.ply -o out.ply --original-ids
    expect_end 2 "a name of its own" "$MPIRUN" -n 2 "$MPI_PROGRAM" resample idol.ply -o i.csv --voxel-index i.csv
    expect_end 1 "no/folder" "$MPIRUN" -n 2 "$MPI_PROGRAM" resample idol.ply -o no/folder/out.pvtp
    awk 'BEGIN { print "x,y,z"; for (i = 0; i < 200; ++i) print "1,2,3"; print "4,5,x" }' >letters.csv
    expect_end 1 "letters.csv: text (comma separated): line 202, column 3: 'x'" \
      "$MPIRUN" -n 2 "$MPI_PROGRAM" resample letters.csv -o out.ply
    expect_end 2 "standard input" "$MPIRUN" -n 2 "$MPI_PROGRAM" resample - -o out.ply
    mkfifo pipe.ply
    expect_end 2 "pipes have no parts" "$MPIRUN" -n 2 "$MPI_PROGRAM" resample pipe.ply -o out.ply
    expect_end 2 "pointhaptics-mpi resample: " "$MPIRUN" -n 2 "$MPI_PROGRAM" resample idol.ply -o out.ply --dims 0
    (($(grep -c "^pointhaptics-mpi" output) == 1)) || fault "more than one message: $(cat output)"
    expect_end 1 "no point lies in the workspace" \
      "$MPIRUN" -n 2 "$MPI_PROGRAM" resample idol.ply -o out.ply --workspace 90,91,90,91,90,91
    (($(grep -c "^pointhaptics-mpi" output) == 1)) || fault "more than one message: $(cat output)"
    # One JSON object a run, not one a rank.
    for words in "resample absent.ply -o out.ply" "bandwidth idol.ply -o out.xls" "resampel idol.ply -o out.ply"; do
      # shellcheck disable=SC2086 # several words
      ! "$MPIRUN" -n 3 "$MPI_PROGRAM" $words --json >json 2>output || fault "$words: no error"
      (($(wc -l <json) == 1)) && grep -q '^{"error":"[^"].*"exit_code":[12]}$' json || fault "$words: $(cat json)"
    done
    grep -q "no command 'resampel'; did you mean resample?" output || fault "$(cat output)"
    ! grep -q "manual" output || fault "a hidden command is listed: $(cat output)"
    expect_end 2 "pointhaptics-mpi: no command '--traffi'; commands are resample, bandwidth" \
      "$MPIRUN" -n 2 "$MPI_PROGRAM" --traffi
    # shellcheck disable=SC2016 # for the script
    rank_script last_is_wrong <<<'exec "$MPI_PROGRAM" resample idol.ply -o out.ply --dims $((1 - rank))'
    expect_end 2 "rank 1 of 2: --dims 0" "$MPIRUN" -n 2 ./last_is_wrong
    ;;
  *) fault "unknown case $1" ;;
esac
