#include "FieldPoses.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr const char* kViewpoint = "Viewpoint";
constexpr const char* kPoses[] = { kViewpoint, "ScanPoses" };
constexpr std::size_t kPoseSize = 7;
using Quaternion = std::array<double, 4>; ///< w x y z

/// Pose by pose, those that a transform moves; none where the array has another shape.
std::vector<double> movedPosesIn(vtkFieldData* field, const char* name)
{
  std::vector<double> values;
  vtkDataArray* array = field->GetArray(name);
  const int components = array ? array->GetNumberOfComponents() : 0;
  // PCL's conversions have one value a tuple.
  if (components == int(kPoseSize) || (components == 1 && array->GetNumberOfValues() == kPoseSize))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      values.push_back(array->GetComponent(i / components, int(i % components)));
    }
  }
  const std::vector<double> identity = { 0, 0, 0, 1, 0, 0, 0 };
  if (name == kViewpoint && values == identity)
  {
    values.clear();
  }
  return values;
}

/// Quaternion of the rotation whose matrix is T over @p scale.
Quaternion rotationOf(const AffineTransform& transform, double scale)
{
  double rotation[3][3];
  for (int i = 0; i < 9; ++i)
  {
    rotation[i / 3][i % 3] = transform.m[i / 3][i % 3] / scale;
  }
  Quaternion result;
  vtkMath::Matrix3x3ToQuaternion(rotation, result.data());
  return result;
}

/// @p scale receives what @p transform does to lengths. False: there is no rotation in it.
bool turns(const AffineTransform& transform, double& scale)
{
  return transform.isSimilarity(scale) && transform.determinant() > 0.0;
}

} // namespace

void movePoses(const AffineTransform& transform, vtkFieldData* field)
{
  double scale = 1.0;
  if (transform.isIdentity())
  {
    return;
  }
  const bool isTurned = turns(transform, scale);
  for (const char* name : kPoses)
  {
    std::vector<double> poses = movedPosesIn(field, name);
    if (poses.empty())
    {
      continue;
    }
    if (!isTurned)
    {
      field->RemoveArray(name);
      continue;
    }
    const Quaternion rotation = rotationOf(transform, scale);
    for (std::size_t i = 0; i < poses.size(); i += kPoseSize)
    {
      const Vec3 position = transform.apply({ poses[i], poses[i + 1], poses[i + 2] });
      Quaternion turned;
      vtkMath::MultiplyQuaternion(rotation.data(), &poses[i + 3], turned.data());
      std::copy(&position.x, &position.x + 3, &poses[i]);
      std::copy(turned.begin(), turned.end(), &poses[i + 3]);
    }
    vtkNew<vtkDoubleArray> moved;
    moved->SetName(name);
    moved->SetNumberOfComponents(field->GetArray(name)->GetNumberOfComponents());
    moved->SetNumberOfValues(vtkIdType(poses.size()));
    std::copy(poses.begin(), poses.end(), moved->GetPointer(0));
    field->AddArray(moved);
  }
}

std::string lostPoses(const AffineTransform& transform, vtkFieldData* field)
{
  double scale = 1.0;
  if (transform.isIdentity() || turns(transform, scale))
  {
    return {};
  }
  std::string names;
  for (const char* name : kPoses)
  {
    if (!movedPosesIn(field, name).empty())
    {
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
  }
  return names.empty() ? names
                       : "Field data " + names +
      " left out: the transform mirrors or does not keep angles, so no pose says where the sensor was; use "
      "rotations, translations and one scale for all axes to keep it.";
}

} // namespace pointhaptics
