#include "FieldPoses.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <cmath>
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

/// Pose by pose; none where the array has another shape.
std::vector<double> posesIn(vtkFieldData* field, const char* name)
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
  return values;
}

/// The poses of @p name that a transform moves.
std::vector<double> movedPosesIn(vtkFieldData* field, const char* name)
{
  std::vector<double> values = posesIn(field, name);
  const std::vector<double> identity = { 0, 0, 0, 1, 0, 0, 0 };
  if (name == kViewpoint && values == identity)
  {
    values.clear();
  }
  return values;
}

/// Quaternion of the rotation whose matrix is T over @p scale: Shepperd's method, by its largest part.
Quaternion rotationOf(const AffineTransform& transform, double scale)
{
  const auto& m = transform.m;
  const double trace = m[0][0] + m[1][1] + m[2][2];
  Quaternion result;
  if (trace >= std::max({ m[0][0], m[1][1], m[2][2] }))
  {
    result = { scale + trace, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1] };
  }
  else
  {
    const std::size_t i = m[0][0] >= m[1][1] ? (m[0][0] >= m[2][2] ? 0 : 2) : (m[1][1] >= m[2][2] ? 1 : 2);
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result[0] = m[k][j] - m[j][k];
    result[1 + i] = scale + m[i][i] - m[j][j] - m[k][k];
    result[1 + j] = m[j][i] + m[i][j];
    result[1 + k] = m[k][i] + m[i][k];
  }
  const double length =
    std::sqrt(result[0] * result[0] + result[1] * result[1] + result[2] * result[2] + result[3] * result[3]);
  for (double& part : result)
  {
    part /= length;
  }
  return result;
}

/// The rotation @p a after @p b.
Quaternion product(const Quaternion& a, const double* b)
{
  return { a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0] };
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
      const Quaternion turned = product(rotation, &poses[i + 3]);
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
