#include "PCL/Conversions.h"

#include <gtest/gtest.h>
#include <pcl/console/print.h>
#include <pcl/point_types.h>
#include <vtkDoubleArray.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace
{

using pointhaptics::toPointCloud;
using pointhaptics::toPointCloud2;
using pointhaptics::toPolyData;
using Cloud = ::pcl::PCLPointCloud2;
using Field = ::pcl::PCLPointField;

void addField(Cloud& cloud, const std::string& name, std::uint8_t type, unsigned count, unsigned bytes)
{
  Field field;
  field.name = name;
  field.datatype = type;
  field.count = count;
  field.offset = cloud.point_step;
  cloud.fields.push_back(field);
  cloud.point_step += count * bytes;
}

/// Two rows of five points with a field of every type, random bits in all of them, padding within records and
/// rows.
Cloud everyType(bool doubles)
{
  Cloud cloud;
  const std::uint8_t real = doubles ? Field::FLOAT64 : Field::FLOAT32;
  const unsigned size = doubles ? 8 : 4;
  addField(cloud, "x", real, 1, size);
  addField(cloud, "y", real, 1, size);
  addField(cloud, "z", real, 1, size);
  addField(cloud, "_", Field::UINT8, 4, 1);
  addField(cloud, "rgb", Field::FLOAT32, 1, 4);
  addField(cloud, "normal_x", Field::FLOAT32, 1, 4);
  addField(cloud, "normal_y", Field::FLOAT32, 1, 4);
  addField(cloud, "normal_z", Field::FLOAT32, 1, 4);
  addField(cloud, "i8", Field::INT8, 1, 1);
  addField(cloud, "u8", Field::UINT8, 3, 1);
  addField(cloud, "i16", Field::INT16, 1, 2);
  addField(cloud, "u16", Field::UINT16, 2, 2);
  addField(cloud, "i32", Field::INT32, 1, 4);
  addField(cloud, "u32", Field::UINT32, 1, 4);
  addField(cloud, "i64", Field::INT64, 1, 8);
  addField(cloud, "u64", Field::UINT64, 2, 8);
  addField(cloud, "f32", Field::FLOAT32, 5, 4);
  addField(cloud, "f64", Field::FLOAT64, 1, 8);
  addField(cloud, "flag", Field::BOOL, 1, 1);
  cloud.width = 5;
  cloud.height = 2;
  cloud.row_step = cloud.width * cloud.point_step + 6;
  cloud.data.resize(std::size_t(cloud.row_step) * cloud.height);
  std::mt19937 random(3);
  for (std::uint8_t& byte : cloud.data)
  {
    byte = std::uint8_t(random());
  }
  const float nan = NAN;
  const double doubleNan = NAN;
  doubles ? std::memcpy(cloud.data.data(), &doubleNan, 8) : std::memcpy(cloud.data.data(), &nan, 4);
  cloud.header.frame_id = "lidar front";
  cloud.header.stamp = 18446744073709551615ull;
  cloud.header.seq = 4294967295u;
  return cloud;
}

/// The bytes of a field, point by point.
std::vector<std::uint8_t> bytesOf(const Cloud& cloud, const std::string& name)
{
  std::vector<std::uint8_t> bytes;
  const unsigned sizes[] = { 0, 1, 1, 2, 2, 4, 4, 4, 8, 8, 8, 1 };
  for (const Field& field : cloud.fields)
  {
    for (unsigned i = 0; field.name == name && i < cloud.width * cloud.height; ++i)
    {
      const unsigned row = i / cloud.width;
      const std::uint8_t* p =
        cloud.data.data() + row * cloud.row_step + (i % cloud.width) * cloud.point_step + field.offset;
      const unsigned size = field.datatype == Field::INT64 || field.datatype == Field::UINT64 ? 8
        : field.datatype == Field::BOOL                                                       ? 1
                                        : sizes[field.datatype];
      bytes.insert(bytes.end(), p, p + size * field.count);
    }
  }
  return bytes;
}

TEST(PclConversions, GiveBackEveryBitOfEveryType)
{
  for (const bool doubles : { false, true })
  {
    const Cloud cloud = everyType(doubles);
    const auto points = toPolyData(cloud);
    ASSERT_EQ(points->GetNumberOfPoints(), 10);
    ASSERT_EQ(points->GetNumberOfVerts(), 10);
    EXPECT_EQ(points->GetPoints()->GetDataType(), doubles ? VTK_DOUBLE : VTK_FLOAT);
    Cloud again;
    ASSERT_TRUE(toPointCloud2(points, again));
    EXPECT_EQ(again.width, cloud.width);
    EXPECT_EQ(again.height, cloud.height);
    EXPECT_EQ(again.header.frame_id, cloud.header.frame_id);
    EXPECT_EQ(again.header.stamp, cloud.header.stamp);
    EXPECT_EQ(again.header.seq, cloud.header.seq);
    EXPECT_FALSE(again.is_dense);
    ASSERT_EQ(again.fields.size(), cloud.fields.size() - 1); // but for the padding
    for (const Field& field : cloud.fields)
    {
      if (field.name != "_")
      {
        const auto same = std::find_if(
          again.fields.begin(), again.fields.end(), [&](const Field& f) { return f.name == field.name; });
        ASSERT_NE(same, again.fields.end()) << field.name;
        EXPECT_EQ(same->datatype, field.datatype) << field.name;
        EXPECT_EQ(same->count, field.count) << field.name;
        EXPECT_EQ(bytesOf(again, field.name), bytesOf(cloud, field.name)) << field.name;
      }
    }
  }
}

TEST(PclConversions, NameArraysAsTheReaderDoes)
{
  Cloud cloud = everyType(false);
  auto points = toPolyData(cloud);
  vtkPointData* data = points->GetPointData();
  ASSERT_TRUE(data->GetScalars());
  EXPECT_STREQ(data->GetScalars()->GetName(), "RGBA");
  ASSERT_TRUE(data->GetNormals());
  EXPECT_STREQ(data->GetNormals()->GetName(), "Normals");
  EXPECT_EQ(data->GetArray("u64")->GetNumberOfComponents(), 2);
  // Red is the third byte of a packed colour.
  const auto rgb = std::find_if(
    cloud.fields.begin(), cloud.fields.end(), [](const Field& field) { return field.name == "rgb"; });
  EXPECT_EQ(data->GetScalars()->GetComponent(0, 0), cloud.data[rgb->offset + 2]);
  EXPECT_EQ(data->GetScalars()->GetComponent(0, 2), cloud.data[rgb->offset]);
  for (unsigned row = 0; row < 2; ++row)
  {
    for (unsigned i = 0; i < 5; ++i)
    {
      cloud.data[row * cloud.row_step + i * cloud.point_step + rgb->offset + 3] = 0;
    }
  }
  points = toPolyData(cloud);
  ASSERT_TRUE(points->GetPointData()->GetArray("RGB"));
  Cloud again;
  ASSERT_TRUE(toPointCloud2(points, again));
  EXPECT_EQ(bytesOf(again, "rgb"), bytesOf(cloud, "rgb"));
}

TEST(PclConversions, GiveBackCloudsOfVtk)
{
  vtkNew<vtkPolyData> points;
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  vtkNew<vtkLongLongArray> times;
  times->SetName("Time");
  times->SetNumberOfComponents(2);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  vtkNew<vtkStringArray> words;
  words->SetName("Word");
  for (int i = 0; i < 7; ++i)
  {
    places->InsertNextPoint(1e6 + 1.0 / (i + 1), i, -i);
    times->InsertNextTuple2(0, 0);
    times->SetTypedComponent(i, 0, 9223372036854775807ll - i);
    times->SetTypedComponent(i, 1, -i);
    colors->InsertNextTuple3(i, 100 + i, 200 + i);
    normals->InsertNextTuple3(0.1 * i, 0.2, 0.3);
    words->InsertNextValue("a");
  }
  points->SetPoints(places);
  points->GetPointData()->AddArray(times);
  points->GetPointData()->SetScalars(colors);
  points->GetPointData()->SetNormals(normals);
  points->GetPointData()->AddArray(words);
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  Cloud cloud;
  ASSERT_TRUE(toPointCloud2(points, cloud));
  EXPECT_TRUE(cloud.is_dense);
  const auto again = toPolyData(cloud);
  vtkPointData* data = again->GetPointData();
  EXPECT_EQ(data->GetNumberOfArrays(), 3);
  for (int i = 0; i < 7; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(again->GetPoint(i)[axis], points->GetPoint(i)[axis]);
      EXPECT_EQ(data->GetArray("RGB")->GetComponent(i, axis), colors->GetComponent(i, axis));
      EXPECT_EQ(data->GetNormals()->GetComponent(i, axis), normals->GetComponent(i, axis));
    }
    EXPECT_EQ(vtkLongLongArray::SafeDownCast(data->GetArray("Time"))->GetTypedComponent(i, 0),
      times->GetTypedComponent(i, 0));
  }
}

TEST(PclConversions, KeepThePoseOfTheSensor)
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud(3, 2);
  cloud.sensor_origin_ = { 1.5f, 2.5f, -3.5f, 0.0f };
  cloud.sensor_orientation_ = Eigen::Quaternionf(0.5f, -0.5f, 0.5f, 0.5f);
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    cloud[i].x = i == 2 ? NAN : float(i);
    cloud[i].rgba = 0x11223344u + std::uint32_t(i);
    cloud[i].normal_y = 1.0f;
    cloud[i].curvature = 0.25f * float(i);
  }
  pcl::PointCloud<pcl::PointXYZRGBNormal> again;
  ASSERT_TRUE(toPointCloud(toPolyData(cloud), again));
  EXPECT_EQ(again.width, 3u);
  EXPECT_EQ(again.height, 2u);
  EXPECT_EQ(again.sensor_origin_, cloud.sensor_origin_);
  EXPECT_EQ(again.sensor_orientation_.coeffs(), cloud.sensor_orientation_.coeffs());
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    EXPECT_TRUE(again[i].x == cloud[i].x || i == 2);
    EXPECT_EQ(again[i].rgba, cloud[i].rgba);
    EXPECT_EQ(again[i].normal_y, cloud[i].normal_y);
    EXPECT_EQ(again[i].curvature, cloud[i].curvature);
  }
  EXPECT_TRUE(std::isnan(again[2].x));
}

TEST(PclConversions, GiveAnEmptyCloudForBadInput)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  Cloud cloud = everyType(false);
  EXPECT_FALSE(toPointCloud2(nullptr, cloud));
  EXPECT_EQ(cloud.width, 0u);
  vtkNew<vtkPolyData> nothing;
  EXPECT_FALSE(toPointCloud2(nothing, cloud));
  const auto pointsFor = [](auto&& spoil)
  {
    Cloud bad = everyType(false);
    spoil(bad);
    return toPolyData(bad)->GetNumberOfPoints();
  };
  EXPECT_EQ(pointsFor([](Cloud&) {}), 10);
  EXPECT_EQ(pointsFor([](Cloud& bad) { bad.height = 0; }), 0);
  EXPECT_EQ(pointsFor([](Cloud& bad) { bad.height = 4000000000u; }), 0);
  EXPECT_EQ(pointsFor([](Cloud& bad) { bad.row_step = 1; }), 0);
  EXPECT_EQ(pointsFor([](Cloud& bad) { bad.point_step = 0; }), 0);
  EXPECT_EQ(pointsFor([](Cloud& bad) { bad.is_bigendian = !bad.is_bigendian; }), 0);
  EXPECT_EQ(pointsFor([](Cloud& bad) { bad.fields[5].offset = 4000000000u; }), 0);
  EXPECT_EQ(pointsFor([](Cloud& bad) { bad.fields[1].name = "w"; }), 0);
}

}
