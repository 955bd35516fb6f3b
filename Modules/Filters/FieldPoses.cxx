#include "FieldPoses.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <string>

namespace pointhaptics
{
namespace
{

constexpr const char* kViewpoint = "Viewpoint";
constexpr int kPoseSize = 7;
using Quaternion = std::array<double, 4>; ///< w x y z

/// A copy of the poses that a transform moves, one value after the other; none where the array has another
/// shape.
vtkSmartPointer<vtkDoubleArray> posesIn(vtkFieldData* field, const char* name)
{
  vtkDataArray* array = field->GetArray(name);
  const int components = array ? array->GetNumberOfComponents() : 0;
  // PCL's conversions have one value a tuple.
  if (components != kPoseSize && !(components == 1 && array->GetNumberOfValues() == kPoseSize))
  {
    return nullptr;
  }
  auto poses = vtkSmartPointer<vtkDoubleArray>::New();
  poses->SetName(name);
  poses->SetNumberOfComponents(components);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    poses->InsertNextValue(array->GetComponent(i / components, int(i % components)));
  }
  constexpr double kIdentity[kPoseSize] = { 0, 0, 0, 1, 0, 0, 0 };
  const bool saysNothing = name == kViewpoint && poses->GetNumberOfValues() == kPoseSize &&
    std::equal(kIdentity, kIdentity + kPoseSize, poses->GetPointer(0));
  return saysNothing ? nullptr : poses;
}

/// Moves a pose by a similarity that does not mirror.
void movePose(const AffineTransform& transform, double scale, double* pose)
{
  double rotation[3][3];
  for (int i = 0; i < 9; ++i)
  {
    rotation[i / 3][i % 3] = transform.m[i / 3][i % 3] / scale;
  }
  Quaternion turn;
  Quaternion turned;
  vtkMath::Matrix3x3ToQuaternion(rotation, turn.data());
  vtkMath::MultiplyQuaternion(turn.data(), pose + 3, turned.data());
  const Vec3 position = transform.apply({ pose[0], pose[1], pose[2] });
  std::copy(&position.x, &position.x + 3, pose);
  std::copy(turned.begin(), turned.end(), pose + 3);
}

} // namespace

std::string movePoses(const AffineTransform& transform, vtkFieldData* field)
{
  std::string lost;
  double scale = 1.0;
  const bool isTurned = transform.isSimilarity(scale) && transform.determinant() > 0.0;
  for (const char* name : { kViewpoint, "ScanPoses" })
  {
    const auto poses = transform.isIdentity() ? nullptr : posesIn(field, name);
    if (poses && isTurned)
    {
      for (vtkIdType i = 0; i < poses->GetNumberOfValues(); i += kPoseSize)
      {
        movePose(transform, scale, poses->GetPointer(i));
      }
      field->AddArray(poses);
    }
    else if (poses)
    {
      lost += (lost.empty() ? "" : ", ") + std::string(name);
      field->RemoveArray(name);
    }
  }
  return lost.empty() ? lost
                      : "Field data " + lost +
      " left out: the transform mirrors or does not keep angles, so no pose says where the sensor was; use "
      "rotations, translations and one scale for all axes to keep it.";
}

} // namespace pointhaptics
