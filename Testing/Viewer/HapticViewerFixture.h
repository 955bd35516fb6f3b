/// @file
/// A cloud, a folder and an observer for tests of HapticViewer.
#pragma once

#include "HapticViewer.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

namespace pointhaptics
{

constexpr int kPoints = 20000;

/// Evenly on a sphere of radius 1 about the origin.
inline vtkSmartPointer<vtkPolyData> makeSphere()
{
  const double golden = 2.399963229728653;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < kPoints; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / kPoints;
    const double ring = std::sqrt(1.0 - z * z);
    points->InsertNextPoint(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

class HapticViewerTest : public ::testing::Test
{
protected:
  HapticViewerTest()
    : folder_(std::filesystem::temp_directory_path() / ("HapticViewerTest-" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(folder_);
    options_.width = 160;
    options_.height = 120;
    observer_.message = [this](HapticViewerObserver::Kind kind, const std::string& text)
    { (kind == HapticViewerObserver::Kind::Warning ? warnings_ : notes_).push_back(text); };
  }
  ~HapticViewerTest() override
  {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Draws @p cloud to the file @p name.
  void save(vtkPolyData* cloud, const std::string& name)
  {
    HapticViewer viewer(options_, observer_);
    ASSERT_TRUE(viewer.open(cloud)) << viewer.message();
    ASSERT_TRUE(viewer.renderToFile(this->path(name))) << viewer.message();
  }

  std::string writeCloud(const std::string& name, int rows) const
  {
    std::ofstream file(this->path(name));
    file << "x,y,z\n";
    for (int i = 0; i < rows; ++i)
    {
      file << 0.01 * (i % 250) << ',' << 0.01 * (i / 250) << ",0\n";
    }
    return this->path(name);
  }

  std::filesystem::path folder_;
  HapticViewerOptions options_;
  HapticViewerObserver observer_;
  std::vector<std::string> warnings_;
  std::vector<std::string> notes_;
};

} // namespace pointhaptics
