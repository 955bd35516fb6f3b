/// @file
/// The clouds of the resampling benchmark: the same on every machine.
#pragma once

#include "Benchmark/Resample/Rivals/Rival.h"

#include <vtkSmartPointer.h>

#include <cstdint>

namespace pointhaptics
{
namespace bench
{
namespace resample
{

enum class PointOrder
{
  Random,
  Scan, ///< Row by row over the surface, as a scanner sees it; the rows are planes of constant x.
};
const char* orderName(PointOrder order);

/// Radius of the sphere that the points lie on: the paper's larger one. 543,652 points on it fill about
/// 204,000 voxels of 300^3 in a cube of 10 cm.
constexpr double kSphereRadius = 0.04;
/// Edge of the workspace: the paper's.
constexpr double kWorkspaceEdge = 0.1;

/// @p count float points on the sphere, without cells and arrays. 24 bytes a point while it runs.
vtkSmartPointer<vtkPolyData> sphereCloud(std::int64_t count, PointOrder order);
constexpr char kColors[] = "RGB";
constexpr char kNormals[] = "Normals";
constexpr char kIntensity[] = "Intensity";
constexpr char kLabels[] = "Labels";
/// Adds colours (3 unsigned char), normals (3 float), intensity (float), and labels (unsigned char), of which
/// a voxel has one to three.
void addAttributes(vtkPolyData* cloud);
/// A view of the float points.
PointView viewOf(vtkPolyData* cloud);

/// The cube about the origin with @p dimension voxels on an axis.
ResampleTask taskOn(vtkPolyData* cloud, std::int64_t dimension);

} // namespace resample
} // namespace bench
} // namespace pointhaptics
