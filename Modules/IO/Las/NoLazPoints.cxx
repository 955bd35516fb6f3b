#include "IO/Las/LazPoints.h"

#include "IO/Las/LasHeader.h"
#include "ReadTask.h"

namespace pointhaptics::io
{

struct LazPoints::Unpacker
{
};

LazPoints::LazPoints(const ReadTask&, const LasHeader& header)
{
  throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
    "the points are " + std::string(header.packing == "COPC" ? "COPC (LAZ)" : "LAZ") +
      "-compressed, which is not read here",
    "unpack it first: laszip -i in.laz -o out.las, las2las -i in.laz -o out.las, or pdal translate in.laz "
    "out.las; or build this program with LASzip");
}

LazPoints::~LazPoints() = default;

const char* LazPoints::next(vtkIdType)
{
  return nullptr;
}

} // namespace pointhaptics::io
