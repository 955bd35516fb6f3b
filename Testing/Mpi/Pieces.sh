#!/usr/bin/env bash
# Pieces.sh PYTHON: a rank reads no more than its part of a file, and writes its part of a .pvtp, whose pieces together are the
# program's output. PYTHON, with VTK's modules, reads it as anybody would; without it that is not looked at.
source "$(dirname -- "${BASH_SOURCE[0]}")/support.sh"

# same_pieces IN COMMAND WORDS...: on three ranks.
same_pieces() {
  local input="$1" command="$2"
  shift 2
  "$PROGRAM" "$command" "$input" -o expected.vtp "$@" >said
  run_ranks 3 "$command" "$input" -o out.pvtp "$@" >said-by-ranks || fault "exit code $?"
  cmp <(sed 's/[^ ]*$//' said) <(sed 's/[^ ]*$//' said-by-ranks) || fault "ranks say $(cat said-by-ranks)"
  [[ -s out_0.vtp && -s out_2.vtp ]] || fault "no pieces: $(ls)"
  if [[ -x "$python" ]] && "$python" -c "import vtkmodules.vtkIOXML" 2>/dev/null; then
    "$python" - <<'PYTHON'
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPPolyDataReader

clouds = []
for reader, name in ((vtkXMLPolyDataReader(), "expected.vtp"), (vtkXMLPPolyDataReader(), "out.pvtp")):
    reader.SetFileName(name)
    reader.Update()
    clouds.append(reader.GetOutput())
expected, found = clouds
assert found.GetNumberOfPoints() == expected.GetNumberOfPoints() > 100, found
assert found.GetNumberOfVerts() == expected.GetNumberOfVerts()
data, other = expected.GetPointData(), found.GetPointData()
assert data.GetNumberOfArrays() == other.GetNumberOfArrays(), other
pairs = [(expected.GetPoints().GetData(), found.GetPoints().GetData())]
pairs += [(data.GetArray(i), other.GetArray(data.GetArrayName(i))) for i in range(data.GetNumberOfArrays())]
for left, right in pairs:
    assert left.GetDataType() == right.GetDataType(), left.GetName()
    assert vtk_to_numpy(left).tobytes() == vtk_to_numpy(right).tobytes(), left.GetName()
for role in range(4):
    left, right = data.GetAbstractAttribute(role), other.GetAbstractAttribute(role)
    assert (left and left.GetName()) == (right and right.GetName()), role
PYTHON
  fi
  # The program reads it, too, and ranks read it in parts.
  "$PROGRAM" convert out.pvtp -o together.vtp >converted
  "$PROGRAM" convert expected.vtp -o alone.vtp >converted
  cmp together.vtp alone.vtp || fault "out.pvtp is not read as out.vtp"
  "$PROGRAM" info out.pvtp | grep -q "PVTP" || fault "info says: $("$PROGRAM" info out.pvtp)"
  RANKS="1 2 5" same_bytes vtp resample out.pvtp --dims 20
  mv out_1.vtp away.vtp
  ! "$PROGRAM" info out.pvtp >failed 2>&1 || fault "a missing piece is no fault"
  grep -q "out.pvtp: .*piece 2 of 3, 'out_1.vtp': there is no such file.*; " failed || fault "a missing piece: $(cat failed)"
  rm out.pvtp out_?.vtp
}

readonly python="${1:-}"
"$PROGRAM" generate idol -n 400000 -o idol.ply >said
same_pieces idol.ply resample --dims 60 --covariance
same_pieces idol.ply resample --voxel 0.001
"$PROGRAM" resample idol.ply -o means.ply --dims 60 >said
same_pieces means.ply bandwidth --density none
# Ranks without points have no piece.
printf 'x,y,z\n0,0,0\n' >one.csv
run_ranks 3 resample one.csv -o one.pvtp >said
(($(ls one_?.vtp | wc -l) == 1 && $(grep -c "<Piece " one.pvtp) == 1)) || fault "not one piece: $(ls)"

# Four ranks: a quarter and the start of the file, which is a megabyte.
run_ranks 4 resample idol.ply -o out.vtp --dims 60 --traffic >said 2>traffic
read_most="$(sed -n 's/ bytes read by a rank at most$//p' traffic)"
size="$(stat -c %s idol.ply)"
((read_most > size / 5 && read_most < size / 4 + 1200000)) || fault "a rank read $read_most of $size bytes: $(cat traffic)"

# Outputs of a job appear together: where one cannot be written, none does.
! run_ranks 2 resample idol.ply -o all.vtp --dims 20 --voxel-index /dev/full >said 2>warned || fault "a full disk is no fault"
grep -q "No space left" warned && [[ ! -e all.vtp && -z "$(find . -name '*.part')" ]] || fault "$(cat warned): $(ls -A)"
mkdir -p two.pvtp
! run_ranks 2 resample idol.ply -o two.pvtp --dims 20 >said 2>warned || fault "a folder is no fault"
[[ ! -e two_0.vtp && ! -e two_1.vtp ]] || fault "pieces without their list: $(ls)"
# A piece is no input.
run_ranks 2 resample idol.ply -o in.pvtp --dims 20 >said
! run_ranks 2 resample in_0.vtp -o in.pvtp >said 2>warned || fault "the input is written over"
grep -q "in_0.vtp: this is the input in_0.vtp" warned || fault "$(cat warned)"
