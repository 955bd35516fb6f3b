/// @file
/// Clouds as VTK data, and ears for what filters say, for the pipeline tests.
#pragma once

#include "Core/Base/Vector3.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <utility>
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

/// Another order of 0 ... n - 1.
inline std::vector<vtkIdType> randomOrder(vtkIdType n, std::uint64_t seed)
{
  std::mt19937_64 engine(seed);
  std::vector<vtkIdType> order(n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    order[i] = i;
    std::swap(order[i], order[engine() % std::uint64_t(i + 1)]);
  }
  return order;
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

/// A cloud of @p n points, in float or double.
inline vtkSmartPointer<vtkPolyData> cloudBy(
  int n, const std::function<pointhaptics::Vec3(int)>& place, int type = VTK_DOUBLE)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->SetNumberOfPoints(n);
  for (int i = 0; i < n; ++i)
  {
    const pointhaptics::Vec3 p = place(i);
    points->SetPoint(i, p.x, p.y, p.z);
  }
  return cloudOf(points);
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

/// Adds an array whose component c of tuple i is @p value(i, c).
template <typename Array, typename Value>
vtkSmartPointer<Array> addColumns(vtkPolyData* cloud, const char* name, int components, Value value)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(cloud->GetNumberOfPoints());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      array->SetTypedComponent(i, c, typename Array::ValueType(value(i, c)));
    }
  }
  cloud->GetPointData()->AddArray(array);
  return array;
}

/// @p cloud, point and attributes alike, in another order.
inline vtkSmartPointer<vtkPolyData> reordered(vtkPolyData* cloud, const std::vector<vtkIdType>& order)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  points->SetNumberOfPoints(vtkIdType(order.size()));
  auto result = cloudOf(points);
  result->GetPointData()->CopyAllocate(cloud->GetPointData(), vtkIdType(order.size()));
  for (vtkIdType i = 0; i < vtkIdType(order.size()); ++i)
  {
    points->SetPoint(i, cloud->GetPoint(order[i]));
    result->GetPointData()->CopyData(cloud->GetPointData(), order[i], i);
  }
  return result;
}

inline vtkSmartPointer<vtkPolyData> copyOf(vtkPolyData* cloud)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(cloud);
  return copy;
}

/// One vertex cell per point, and as many tuples in every array as there are points.
inline void expectValid(vtkPolyData* output)
{
  ASSERT_NE(output, nullptr);
  const vtkIdType n = output->GetNumberOfPoints();
  EXPECT_EQ(output->GetNumberOfVerts(), n);
  EXPECT_EQ(output->GetNumberOfCells(), n);
  for (vtkIdType i = 0; i < n; ++i)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    output->GetVerts()->GetCellAtId(i, size, ids);
    ASSERT_EQ(size, 1);
    ASSERT_EQ(ids[0], i);
  }
  for (int a = 0; a < output->GetPointData()->GetNumberOfArrays(); ++a)
  {
    EXPECT_EQ(output->GetPointData()->GetAbstractArray(a)->GetNumberOfTuples(), n)
      << output->GetPointData()->GetAbstractArray(a)->GetName();
  }
}

/// Same type, shape and bits; both in one block of memory.
inline bool sameBits(vtkDataArray* a, vtkDataArray* b)
{
  if (!a || !b || a->GetDataType() != b->GetDataType() || a->GetNumberOfValues() != b->GetNumberOfValues() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents())
  {
    return false;
  }
  const std::size_t bytes = std::size_t(a->GetNumberOfValues() * a->GetDataTypeSize());
  return bytes == 0 || std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), bytes) == 0;
}

/// Points and point arrays of @p a are those of @p b, bit for bit.
inline void expectSame(vtkPolyData* a, vtkPolyData* b)
{
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  EXPECT_TRUE(sameBits(a->GetPoints()->GetData(), b->GetPoints()->GetData())) << "the points differ";
  ASSERT_EQ(a->GetPointData()->GetNumberOfArrays(), b->GetPointData()->GetNumberOfArrays());
  for (int i = 0; i < a->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = a->GetPointData()->GetArray(i);
    EXPECT_TRUE(sameBits(array, b->GetPointData()->GetArray(array->GetName())))
      << array->GetName() << " differs";
  }
}

} // namespace trial
