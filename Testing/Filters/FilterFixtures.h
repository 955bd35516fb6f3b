/// @file
/// Clouds as VTK data, and ears for what filters say, for the pipeline tests.
#pragma once

#include "vtkCallbackCommand.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace trial
{

/// Counts an object's events and keeps the text of the last one; the text is not printed.
class Ear
{
public:
  Ear(vtkObject* object, unsigned long event)
    : object_(object)
  {
    callback_->SetClientData(this);
    callback_->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      {
        Ear* ear = static_cast<Ear*>(self);
        ++ear->count;
        ear->last = text ? static_cast<const char*>(text) : "";
      });
    tag_ = object->AddObserver(event, callback_);
  }
  ~Ear() { object_->RemoveObserver(tag_); }
  Ear(const Ear&) = delete;
  Ear& operator=(const Ear&) = delete;

  int count = 0;
  std::string last;

private:
  vtkSmartPointer<vtkObject> object_;
  vtkNew<vtkCallbackCommand> callback_;
  unsigned long tag_ = 0;
};

inline double uniform(std::mt19937_64& engine, double low = 0.0, double high = 1.0)
{
  return low + (high - low) * (double(engine() >> 11) * 0x1p-53);
}

inline vtkSmartPointer<vtkPoints> randomPoints(int n, std::uint64_t seed, int type = VTK_DOUBLE)
{
  std::mt19937_64 engine(seed);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(type);
  points->SetNumberOfPoints(n);
  for (int i = 0; i < n; ++i)
  {
    const double x = uniform(engine);
    const double y = uniform(engine);
    points->SetPoint(i, x, y, uniform(engine));
  }
  return points;
}

inline vtkSmartPointer<vtkPolyData> cloudOf(vtkPoints* points)
{
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

inline vtkSmartPointer<vtkPolyData> cloudAt(const std::vector<std::vector<double>>& places)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const std::vector<double>& p : places)
  {
    points->InsertNextPoint(p[0], p[1], p[2]);
  }
  return cloudOf(points);
}

inline void addArray(vtkPolyData* cloud, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double v : values)
  {
    array->InsertNextValue(v);
  }
  cloud->GetPointData()->AddArray(array);
}

} // namespace trial
