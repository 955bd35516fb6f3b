// Files of vtkPointCloudWriter as .pcd fit PCL's point types, which find fields by name and type, and leave
// out the others with no more than a warning.
#include "vtkPointCloudWriter.h"

#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <unistd.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

#include <filesystem>
#include <string>
#include <vector>

namespace
{

class PcdFiles : public ::testing::Test
{
protected:
  void SetUp() override
  {
    pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
    std::filesystem::create_directories(folder_);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->InsertNextPoint(684766.39, 5017773.08, 100.25);
    points->InsertNextPoint(1.5, -2.5, 3.5);
    cloud_->SetPoints(points);
    add<vtkUnsignedCharArray>("RGB", 3, { 10, 20, 30, 40, 50, 60 });
    add<vtkDoubleArray>("Normals", 3, { 0, 0, 1, 0, 0.6, 0.8 });
    add<vtkUnsignedShortArray>("Intensity", 1, { 65535, 7 });
    add<vtkIntArray>("Label", 1, { 3, 70000 });
    add<vtkDoubleArray>("GpsTime", 1, { 1e9 + 0.25, 2 });
    cloud_->GetPointData()->SetActiveScalars("RGB");
    cloud_->GetPointData()->SetActiveNormals("Normals");
    vtkNew<vtkPointCloudWriter> writer;
    writer->SetInputData(cloud_);
    writer->SetFileName(file_.c_str());
    ASSERT_EQ(writer->Write(), 1) << writer->GetErrorMessage();
    notes_ = writer->GetNotes();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  template <typename Array>
  void add(const char* name, int components, const std::vector<double>& values)
  {
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(2);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      array->SetComponent(vtkIdType(i) / components, int(i) % components, values[i]);
    }
    cloud_->GetPointData()->AddArray(array);
  }
  template <typename Point>
  pcl::PointCloud<Point> load() const
  {
    pcl::PointCloud<Point> cloud;
    EXPECT_EQ(pcl::io::loadPCDFile(file_, cloud), 0);
    EXPECT_EQ(cloud.size(), 2U);
    for (std::size_t i = 0; i < cloud.size(); ++i)
    {
      double p[3];
      cloud_->GetPoint(vtkIdType(i), p);
      EXPECT_EQ(cloud[i].x, float(p[0]));
      EXPECT_EQ(cloud[i].y, float(p[1]));
      EXPECT_EQ(cloud[i].z, float(p[2]));
    }
    return cloud;
  }

  const std::filesystem::path folder_ =
    std::filesystem::temp_directory_path() / ("pointhaptics-pcl-files-" + std::to_string(getpid()));
  const std::string file_ = (folder_ / "a.pcd").string();
  vtkNew<vtkPolyData> cloud_;
  std::vector<std::string> notes_;
};

TEST_F(PcdFiles, AreReadIntoThePointTypesOfPcl)
{
  this->load<pcl::PointXYZ>();
  const auto intensities = this->load<pcl::PointXYZI>();
  EXPECT_EQ(intensities[0].intensity, 65535.0f);
  const auto colors = this->load<pcl::PointXYZRGB>();
  EXPECT_EQ(colors[1].r, 40);
  EXPECT_EQ(colors[1].g, 50);
  EXPECT_EQ(colors[1].b, 60);
  const auto normals = this->load<pcl::PointNormal>();
  EXPECT_EQ(normals[1].normal_y, 0.6f);
  EXPECT_EQ(normals[1].normal_z, 0.8f);
  const auto labels = this->load<pcl::PointXYZL>();
  EXPECT_EQ(labels[1].label, 70000U);
}

TEST_F(PcdFiles, HaveColorsAndNormalsOfArraysInLowerCase)
{
  vtkPointData* data = cloud_->GetPointData();
  data->GetArray("RGB")->SetName("rgb");
  data->GetArray("Normals")->SetName("normals");
  data->SetActiveScalars(nullptr);
  data->SetActiveNormals(nullptr);
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetInputData(cloud_);
  writer->SetFileName(file_.c_str());
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_EQ(this->load<pcl::PointXYZRGB>()[1].g, 50);
  EXPECT_EQ(this->load<pcl::PointNormal>()[1].normal_z, 0.8f);
}

TEST_F(PcdFiles, SayHowMuchCoordinatesAreRounded)
{
  EXPECT_TRUE(notes_.empty()) << "0.08 in 5,000 km";
  cloud_->GetPoints()->SetPoint(1, 684767.39, 5017773.08, 1.0);
  cloud_->GetPoints()->Modified();
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetInputData(cloud_);
  writer->SetFileName(file_.c_str());
  ASSERT_EQ(writer->Write(), 1);
  ASSERT_EQ(writer->GetNotes().size(), 1U);
  EXPECT_EQ(writer->GetNotes()[0].find("coordinates are rounded to floats, by at most 0.08"), 0U);
}

} // namespace
