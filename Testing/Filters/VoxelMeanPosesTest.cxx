// The poses of sensors in field data go with the points.
#include "VoxelMeanFixtures.h"

#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{

using Pose = std::vector<double>; ///< tx ty tz qw qx qy qz.

const Pose kIdentity = { 0, 0, 0, 1, 0, 0, 0 };
/// Neither in the origin nor along an axis.
const Pose kTurned = { 1, -2, 3, 0.5, -0.5, 0.1, 0.7 };

void addPoses(vtkPolyData* cloud, const char* name, const std::vector<Pose>& poses)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(7);
  for (const Pose& pose : poses)
  {
    array->InsertNextTuple(pose.data());
  }
  cloud->GetFieldData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> cloudWith(const std::vector<Pose>& viewpoint, const std::vector<Pose>& scans)
{
  auto cloud = trial::cloudOf(trial::randomPoints(200, 3));
  addPoses(cloud, "Viewpoint", viewpoint);
  addPoses(cloud, "ScanPoses", scans);
  return cloud;
}

Pose poseIn(vtkPolyData* cloud, const char* name, vtkIdType row = 0)
{
  vtkDataArray* array = cloud->GetFieldData()->GetArray(name);
  Pose pose;
  for (int i = 0; array && i < 7; ++i)
  {
    pose.push_back(array->GetComponent(row, i));
  }
  return pose;
}

/// Takes @p p from the own frame of the sensor at @p pose to the frame of the points; its quaternion may have
/// any length.
pointhaptics::Vec3 seen(const Pose& pose, const pointhaptics::Vec3& p)
{
  const pointhaptics::Vec3 axis(pose[4], pose[5], pose[6]);
  const double norm = std::sqrt(pose[3] * pose[3] + norm2(axis));
  const pointhaptics::Vec3 twice = 2.0 / norm * cross(axis, p);
  return pointhaptics::Vec3(pose[0], pose[1], pose[2]) + p + (pose[3] * twice + cross(axis, twice)) / norm;
}

/// Distances from the moved sensor are those from the sensor times @p scale, in the turned directions.
void expectMoved(const Pose& before, const Pose& after, vtkTransform* transform, double scale)
{
  ASSERT_EQ(after.size(), 7u);
  for (const pointhaptics::Vec3& p : { pointhaptics::Vec3(1, 0, 0), pointhaptics::Vec3(0, 1, 0),
         pointhaptics::Vec3(0, 0, 1), pointhaptics::Vec3() })
  {
    const pointhaptics::Vec3 old = seen(before, p);
    pointhaptics::Vec3 mapped;
    transform->TransformPoint(&old.x, &mapped.x);
    EXPECT_LT(norm(mapped - seen(after, scale * p)), 1e-12 * (1.0 + norm(mapped)));
  }
}

vtkSmartPointer<vtkTransform> turned(double degrees, double x, double y, double z, double scale)
{
  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->Translate(10, 20, -30);
  transform->RotateWXYZ(degrees, x, y, z);
  transform->Scale(scale, scale, scale);
  return transform;
}

}

TEST(VoxelMeanPoses, AreMovedAsThePointsAre)
{
  const auto cloud = cloudWith({ kTurned }, { kIdentity, kTurned });
  for (const auto& transform : { turned(90, 0, 0, 1, 1), turned(37, 1, -2, 0.3, 2.5), turned(180, 1, 0, 0, 1),
         turned(180, 0, 1, 0, 3), turned(179, 0, 0.1, 1, 1e-3), turned(0, 1, 0, 0, 0.3) })
  {
    const double scale = std::cbrt(transform->GetMatrix()->Determinant());
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    resampler->SetTransform(transform);
    resampler->ComputeVoxelIndexOn();
    trial::Ear warnings(resampler, vtkCommand::WarningEvent);
    resampler->Update();
    EXPECT_EQ(warnings.count, 0) << warnings.last;
    vtkPolyData* output = resampler->GetOutput();
    expectMoved(kTurned, poseIn(output, "Viewpoint"), transform, scale);
    expectMoved(kIdentity, poseIn(output, "ScanPoses"), transform, scale);
    expectMoved(kTurned, poseIn(output, "ScanPoses", 1), transform, scale);
    EXPECT_EQ(poseIn(resampler->GetOutput(1), "Viewpoint"), kTurned) << "its points are those of the input";
    EXPECT_EQ(poseIn(cloud, "Viewpoint"), kTurned) << "the input's own";
  }
}

TEST(VoxelMeanPoses, KeepTheirDigitsWhereNothingTurns)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(0, 0, 5);
  transform->Scale(0.1, 0.1, 0.1);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloudWith({ kIdentity }, { kTurned }));
  resampler->SetTransform(transform);
  resampler->Update();
  const Pose pose = poseIn(resampler->GetOutput(), "ScanPoses");
  EXPECT_EQ(Pose(pose.begin() + 3, pose.end()), Pose(kTurned.begin() + 3, kTurned.end()));
  EXPECT_EQ(poseIn(resampler->GetOutput(), "Viewpoint"), kIdentity) << "the usual header says nothing";
}

TEST(VoxelMeanPoses, GoWithAWordWhereNoneIsRight)
{
  for (const auto& scale : { pointhaptics::Vec3(1, 2, 1), pointhaptics::Vec3(-1, 1, 1) })
  {
    vtkNew<vtkTransform> transform;
    transform->Scale(scale.x, scale.y, scale.z);
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloudWith({ kTurned }, { kTurned }));
    resampler->SetTransform(transform);
    trial::Ear warnings(resampler, vtkCommand::WarningEvent);
    resampler->Update();
    EXPECT_EQ(warnings.count, 1);
    EXPECT_NE(warnings.last.find("Viewpoint, ScanPoses left out"), std::string::npos) << warnings.last;
    for (const char* name : { "Viewpoint", "ScanPoses" })
    {
      EXPECT_FALSE(resampler->GetOutput()->GetFieldData()->HasArray(name));
    }
    resampler->SetInputData(cloudWith({ kIdentity }, { kTurned }));
    resampler->SetTransform(nullptr);
    resampler->Update();
    EXPECT_EQ(warnings.count, 1);
    EXPECT_EQ(poseIn(resampler->GetOutput(), "ScanPoses"), kTurned);
  }
}
