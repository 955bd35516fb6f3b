/// @file
/// An array in a layout that VTK's dispatchers do not know; it counts how often it is read.
#pragma once

#include "vtkGenericDataArray.h"
#include "vtkObjectFactory.h"

#include <atomic>
#include <vector>

namespace trial
{

/// Doubles, component by component. Reading is safe from any number of threads.
class CountingArray : public vtkGenericDataArray<CountingArray, double>
{
  using Generic = vtkGenericDataArray<CountingArray, double>;

public:
  vtkTemplateTypeMacro(CountingArray, Generic);
  static CountingArray* New() { VTK_STANDARD_NEW_BODY(CountingArray); }

  double GetValue(vtkIdType i) const
  {
    return this->GetTypedComponent(i / this->NumberOfComponents, int(i % this->NumberOfComponents));
  }
  void SetValue(vtkIdType i, double value)
  {
    this->SetTypedComponent(i / this->NumberOfComponents, int(i % this->NumberOfComponents), value);
  }
  void GetTypedTuple(vtkIdType tuple, double* values) const
  {
    for (int c = 0; c < this->NumberOfComponents; ++c)
    {
      values[c] = this->GetTypedComponent(tuple, c);
    }
  }
  void SetTypedTuple(vtkIdType tuple, const double* values)
  {
    for (int c = 0; c < this->NumberOfComponents; ++c)
    {
      this->SetTypedComponent(tuple, c, values[c]);
    }
  }
  double GetTypedComponent(vtkIdType tuple, int component) const
  {
    this->Reads.fetch_add(1, std::memory_order_relaxed);
    return this->Columns[std::size_t(component)][std::size_t(tuple)];
  }
  void SetTypedComponent(vtkIdType tuple, int component, double value)
  {
    this->Columns[std::size_t(component)][std::size_t(tuple)] = value;
  }
  long reads() const { return this->Reads; }

protected:
  friend Generic;
  CountingArray() = default;
  ~CountingArray() override = default;
  bool AllocateTuples(vtkIdType tuples)
  {
    this->Columns.assign(std::size_t(this->NumberOfComponents), std::vector<double>(std::size_t(tuples)));
    return true;
  }
  bool ReallocateTuples(vtkIdType tuples)
  {
    this->Columns.resize(std::size_t(this->NumberOfComponents));
    for (std::vector<double>& column : this->Columns)
    {
      column.resize(std::size_t(tuples));
    }
    return true;
  }

private:
  std::vector<std::vector<double>> Columns;
  mutable std::atomic<long> Reads{ 0 };

  CountingArray(const CountingArray&) = delete;
  void operator=(const CountingArray&) = delete;
};

} // namespace trial
