/// @file
/// Random clouds, lattices, transforms and attributes, all drawn from a seed, for the resampler's properties.
#pragma once

#include "VoxelMeanFixtures.h"

#include "vtkAlgorithm.h"
#include "vtkFloatArray.h"
#include "vtkLongLongArray.h"
#include "vtkShortArray.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <cstdint>
#include <ostream>

namespace trial
{

/// The arrays that scans carry: colours, normals, labels, times, ids near 2^62, numbers of many
/// magnitudes (their plain sums depend on their order), and a wide one.
inline void addScanAttributes(vtkPolyData* cloud, std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  const auto drawn = [&](double low, double high)
  { return [&engine, low, high](vtkIdType, int) { return uniform(engine, low, high); }; };
  addColumns<vtkFloatArray>(cloud, "Heat", 1, drawn(-5, 40));
  addColumns<vtkDoubleArray>(cloud, "GpsTime", 1, drawn(3e8, 3e8 + 100));
  addColumns<vtkDoubleArray>(cloud, "Weight", 2,
    [&](vtkIdType, int) { return uniform(engine, -1, 1) * std::pow(10.0, uniform(engine, -6, 6)); });
  addColumns<vtkFloatArray>(cloud, "Features", 9, drawn(-1e3, 1e3));
  addColumns<vtkShortArray>(cloud, "Angle", 2, drawn(-90, 90));
  addColumns<vtkLongLongArray>(
    cloud, "Id", 1, [&](vtkIdType, int) { return (std::int64_t(1) << 62) + std::int64_t(engine() % 1000); });
  addColumns<vtkUnsignedCharArray>(cloud, "Classification", 1, drawn(0, 5));
  cloud->GetPointData()->SetScalars(addColumns<vtkUnsignedCharArray>(cloud, "RGB", 3, drawn(0, 256)));
  const auto normals = addColumns<vtkFloatArray>(cloud, "Normals", 3, drawn(-1, 1));
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double n[3];
    normals->GetTuple(i, n);
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    normals->SetTuple3(i, n[0] / length, n[1] / length, n[2] / length);
  }
  cloud->GetPointData()->SetNormals(normals);
}

/// One random run of the resampler.
struct VoxelMeanCase
{
  vtkSmartPointer<vtkPolyData> cloud;
  vtkSmartPointer<vtkTransform> transform; ///< None: the identity.
  double bounds[6] = { 0, 1, 0, 1, 0, 1 };
  int dimensions[3] = { 1, 1, 1 };
  double voxelSize = 0.0;
  bool automatic = false;
  int precision = vtkAlgorithm::DEFAULT_PRECISION;

  void applyTo(vtkVoxelMeanResampler* resampler) const
  {
    resampler->SetInputData(cloud);
    resampler->SetTransform(transform);
    resampler->SetWorkspaceBounds(bounds);
    resampler->SetDimensions(dimensions);
    if (voxelSize > 0.0)
    {
      resampler->SetVoxelSize(voxelSize);
    }
    resampler->SetAutomaticWorkspace(automatic);
    resampler->SetOutputPointsPrecision(precision);
  }
};

inline std::ostream& operator<<(std::ostream& os, const VoxelMeanCase& drawn)
{
  os << drawn.cloud->GetNumberOfPoints() << " points of type " << drawn.cloud->GetPoints()->GetDataType()
     << ", dimensions " << drawn.dimensions[0] << " " << drawn.dimensions[1] << " " << drawn.dimensions[2]
     << ", voxel size " << drawn.voxelSize << (drawn.automatic ? ", automatic" : "") << ", bounds";
  for (const double b : drawn.bounds)
  {
    os << " " << b;
  }
  for (int i = 0; drawn.transform && i < 12; ++i)
  {
    os << (i ? " " : ", transform ") << drawn.transform->GetMatrix()->GetElement(i / 4, i % 4);
  }
  return os;
}

/// None, diagonal, mirrored, turned, sheared or general; well conditioned.
inline vtkSmartPointer<vtkTransform> drawTransform(std::mt19937_64& engine)
{
  const std::uint64_t kind = engine() % 7;
  if (kind == 0)
  {
    return nullptr;
  }
  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->Translate(uniform(engine, -0.2, 0.2), uniform(engine, -0.2, 0.2), uniform(engine, -0.2, 0.2));
  if (kind == 2 || kind == 6)
  {
    transform->Scale(uniform(engine, 0.3, 3), uniform(engine, 0.3, 3), uniform(engine, 0.3, 3));
  }
  if (kind == 3 || kind == 6)
  {
    transform->Scale(engine() % 2 ? -1 : 1, engine() % 2 ? -1 : 1, -1);
  }
  if (kind == 4 || kind == 6)
  {
    transform->RotateWXYZ(uniform(engine, -180, 180), uniform(engine, 0.1, 1), uniform(engine, -1, 1), 0.3);
  }
  if (kind == 5 || kind == 6)
  {
    const double shear[16] = { 1, uniform(engine, -1, 1), uniform(engine, -1, 1), 0, 0, 1,
      uniform(engine, -1, 1), 0, 0, 0, 1, 0, 0, 0, 0, 1 };
    transform->Concatenate(shear);
  }
  return transform;
}

/// Up to @p most points in and about the unit cube: spread, in clusters, on a line or a plane, repeated, with
/// some that are not finite.
inline vtkSmartPointer<vtkPolyData> drawCloud(std::mt19937_64& engine, vtkIdType most)
{
  const int n = int(engine() % std::uint64_t(most + 1));
  const std::uint64_t kind = engine() % 6;
  const double spread = std::pow(10.0, uniform(engine, -5, 0));
  const double low = uniform(engine, -0.3, 0.1);
  const double high = uniform(engine, 0.8, 1.3);
  const double invalid = engine() % 3 ? 0.0 : 0.05;
  pointhaptics::Vec3 last{ 0.5, 0.5, 0.5 };
  return cloudBy(
    n,
    [&](int)
    {
      pointhaptics::Vec3 p{ uniform(engine, low, high), uniform(engine, low, high),
        uniform(engine, low, high) };
      if (kind == 1 && engine() % 50 != 0) // clusters
      {
        p = last + spread * (p - pointhaptics::Vec3(0.5, 0.5, 0.5));
      }
      if (kind == 2 && engine() % 4 != 0) // repeated
      {
        p = last;
      }
      if (kind == 3) // on a line
      {
        p = { p.x, 0.47 * p.x + 0.1, 0.9 - p.x };
      }
      if (kind == 4) // on a plane
      {
        p.z = 0.3 * p.x + 0.2 * p.y;
      }
      last = p;
      if (uniform(engine) < invalid)
      {
        const double values[3] = { NAN, INFINITY, -INFINITY };
        p[int(engine() % 3)] = values[engine() % 3];
      }
      return p;
    },
    engine() % 2 ? VTK_FLOAT : VTK_DOUBLE);
}

/// A case with at most @p most points.
inline VoxelMeanCase drawCase(std::uint64_t seed, vtkIdType most)
{
  std::mt19937_64 engine(seed * 0x9E3779B97F4A7C15u + 1);
  VoxelMeanCase drawn;
  drawn.cloud = drawCloud(engine, most);
  drawn.transform = drawTransform(engine);
  const int sizes[] = { 1, 2, 3, 7, 8, 16, 33, 64, 100, 300, 1000, 4096, 100000, 1 << 21 };
  const bool cubic = engine() % 2 == 0;
  const std::uint64_t choices = engine() % 3 ? 9 : 14;
  const int size = sizes[engine() % choices];
  for (int axis = 0; axis < 3; ++axis)
  {
    drawn.dimensions[axis] = cubic ? size : sizes[engine() % choices];
    drawn.bounds[2 * axis] = uniform(engine, -0.5, 0.3);
    drawn.bounds[2 * axis + 1] = drawn.bounds[2 * axis] + uniform(engine, 0.2, 1.5);
  }
  if (engine() % 4 == 0)
  {
    drawn.voxelSize = std::pow(10.0, uniform(engine, -4, 0.5));
  }
  // An automatic workspace of different dimensions can put the cloud's ends on faces, up to rounding: which
  // voxel they are in is then anybody's guess.
  drawn.automatic = engine() % 3 == 0 && (cubic || drawn.voxelSize > 0.0);
  drawn.precision = int(engine() % 3);
  return drawn;
}

} // namespace trial
