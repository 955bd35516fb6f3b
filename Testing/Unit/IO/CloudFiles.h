/// @file
/// Shared by the IO tests: files in a temporary folder, readers and writers that print nothing.
#pragma once

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

/// A folder of this test's own, removed at its end.
class CloudFiles : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const ::testing::TestInfo* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("pointhaptics-io-") + info->test_suite_name() + "-" + info->name();
    for (char& c : name)
    {
      c = c == '/' ? '-' : c;
    }
    folder_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& content) const
  {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }
  std::filesystem::path folder_;
};

struct ReadResult
{
  vtkSmartPointer<vtkPolyData> cloud;
  std::string error;
  std::string format;
  unsigned long code = 0;
  int errorEvents = 0;
  std::vector<std::string> notes;
  bool validWithoutPoints = false;

  vtkIdType points() const { return cloud->GetNumberOfPoints(); }
  vtkDataArray* array(const char* name) const { return cloud->GetPointData()->GetArray(name); }
  double value(const char* name, vtkIdType row, int component = 0) const
  {
    return array(name)->GetComponent(row, component);
  }
};

inline void countEvent(vtkObject*, unsigned long, void* count, void*)
{
  ++*static_cast<int*>(count);
}

/// @p reader: with its settings.
inline ReadResult readCloudBy(vtkPointCloudReader* reader, const std::string& path)
{
  ReadResult result;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(&countEvent);
  observer->SetClientData(&result.errorEvents);
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(path.c_str());
  reader->Update();
  reader->RemoveObserver(observer);
  result.cloud = reader->GetOutput();
  result.error = reader->GetErrorMessage();
  result.format = reader->GetFormat();
  result.code = reader->GetErrorCode();
  result.notes = reader->GetNotes();
  result.validWithoutPoints = reader->IsValidWithoutPoints();
  return result;
}

inline ReadResult readCloud(const std::string& path)
{
  vtkNew<vtkPointCloudReader> reader;
  return readCloudBy(reader, path);
}

/// Empty on success, else the message. @p notes gets what the format could not hold.
inline std::string writeCloud(
  vtkDataObject* cloud, const std::string& path, std::vector<std::string>* notes = nullptr)
{
  int events = 0;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(&countEvent);
  observer->SetClientData(&events);
  vtkNew<vtkPointCloudWriter> writer;
  writer->AddObserver(vtkCommand::ErrorEvent, observer);
  writer->SetKeepDoubles(true);
  writer->SetInputData(cloud);
  writer->SetFileName(path.c_str());
  const int written = writer->Write();
  const std::string message = writer->GetErrorMessage();
  EXPECT_EQ(written == 1, message.empty());
  EXPECT_EQ(events > 0, !message.empty());
  if (notes)
  {
    *notes = writer->GetNotes();
  }
  return message;
}

/// Same type, same shape, same bits.
inline void expectSameBits(vtkDataArray* expected, vtkDataArray* actual)
{
  ASSERT_NE(actual, nullptr) << expected->GetName();
  ASSERT_EQ(actual->GetDataType(), expected->GetDataType()) << expected->GetName();
  ASSERT_EQ(actual->GetNumberOfComponents(), expected->GetNumberOfComponents()) << expected->GetName();
  ASSERT_EQ(actual->GetNumberOfTuples(), expected->GetNumberOfTuples()) << expected->GetName();
  const std::size_t size = static_cast<std::size_t>(expected->GetNumberOfValues()) *
    static_cast<std::size_t>(expected->GetDataTypeSize());
  EXPECT_EQ(std::memcmp(expected->GetVoidPointer(0), actual->GetVoidPointer(0), size), 0)
    << expected->GetName();
}

/// Expects the answer to every refused file: a message with the file's name and a cure, an error code, an
/// event and an empty cloud.
inline void expectRefused(const ReadResult& result, const std::string& part)
{
  EXPECT_NE(result.error.find(part), std::string::npos) << result.error;
  EXPECT_NE(result.error.find("; "), std::string::npos) << result.error;
  EXPECT_NE(result.code, 0u);
  EXPECT_GT(result.errorEvents, 0);
  EXPECT_EQ(result.points(), 0);
  EXPECT_NE(result.cloud->GetPoints(), nullptr);
  EXPECT_EQ(result.cloud->GetNumberOfCells(), 0);
}

/// Bytes of @p value in this machine's order.
template <typename T>
void append(std::string& bytes, T value)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

template <typename T>
void appendSwapped(std::string& bytes, T value)
{
  std::string raw;
  append(raw, value);
  bytes.append(raw.rbegin(), raw.rend());
}

template <typename T>
void put(std::string& bytes, std::size_t offset, T value)
{
  std::memcpy(&bytes[offset], &value, sizeof(T));
}

/// A LAS file of two points: version 1.@p minor, record bytes zero but for raw x y z = (100 i, 200 i, -300
/// i).
std::string makeLas(int minor, int format, std::size_t recordLength);

/// Folder of the real clouds, or empty when this checkout has none.
std::string sharedData();
