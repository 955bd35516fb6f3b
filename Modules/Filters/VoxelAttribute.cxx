#include "VoxelAttribute.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace
{

bool isIntegral(int type)
{
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

class VoxelReducer
{
public:
  VoxelReducer(vtkDataArray* input, vtkDataArray* output, AttributeKind kind, const VoxelMeans& voxels,
    const AffineTransform& transform)
    : input_(input)
    , output_(output)
    , kind_(kind)
    , voxels_(voxels)
    , transform_(transform)
    , tuple_(std::size_t(input->GetNumberOfComponents()))
    , result_(tuple_.size())
  {
  }

  void reduce(std::size_t voxel)
  {
    switch (kind_)
    {
      case AttributeKind::Mean:
        mean(voxel);
        break;
      case AttributeKind::Normal:
        normal(voxel);
        break;
      case AttributeKind::Category:
        category(voxel);
        break;
    }
    output_->SetTuple(vtkIdType(voxel), result_.data());
  }

private:
  /// Sum of the voxel's tuples about its first one, which keeps large offsets (times, ids) from eating the
  /// digits.
  void mean(std::size_t voxel)
  {
    const std::int64_t first = voxels_.begin[voxel];
    const std::int64_t last = voxels_.begin[voxel + 1];
    std::fill(result_.begin(), result_.end(), 0.0);
    base_.resize(tuple_.size());
    input_->GetTuple(vtkIdType(voxels_.members[std::size_t(first)]), base_.data());
    for (std::int64_t m = first + 1; m < last; ++m)
    {
      input_->GetTuple(vtkIdType(voxels_.members[std::size_t(m)]), tuple_.data());
      for (std::size_t c = 0; c < tuple_.size(); ++c)
      {
        result_[c] += tuple_[c] - base_[c];
      }
    }
    const bool integral = isIntegral(input_->GetDataType());
    for (std::size_t c = 0; c < tuple_.size(); ++c)
    {
      result_[c] = base_[c] + result_[c] / double(last - first);
      result_[c] = integral ? std::round(result_[c]) : result_[c];
    }
  }

  void normal(std::size_t voxel)
  {
    mean(voxel);
    const Vec3 turned = transform_.applyToNormal({ result_[0], result_[1], result_[2] });
    const Vec3 unit = normalized(turned, Vec3());
    result_ = { unit.x, unit.y, unit.z };
  }

  void category(std::size_t voxel)
  {
    for (std::size_t c = 0; c < result_.size(); ++c)
    {
      values_.clear();
      for (std::int64_t m = voxels_.begin[voxel]; m < voxels_.begin[voxel + 1]; ++m)
      {
        values_.push_back(input_->GetComponent(vtkIdType(voxels_.members[std::size_t(m)]), int(c)));
      }
      std::sort(values_.begin(), values_.end());
      std::size_t longest = 0;
      for (std::size_t i = 0; i < values_.size();)
      {
        std::size_t end = i + 1;
        while (end < values_.size() && values_[end] == values_[i])
        {
          ++end;
        }
        if (end - i > longest)
        {
          longest = end - i;
          result_[c] = values_[i];
        }
        i = end;
      }
    }
  }

  vtkDataArray* input_;
  vtkDataArray* output_;
  AttributeKind kind_;
  const VoxelMeans& voxels_;
  const AffineTransform& transform_;
  std::vector<double> tuple_;
  std::vector<double> result_;
  std::vector<double> base_;
  std::vector<double> values_;
};

}

vtkSmartPointer<vtkDataArray> voxelAttribute(vtkDataArray* input, AttributeKind kind,
  const VoxelMeans& voxels, const AffineTransform& transform, const Executor& executor)
{
  auto output = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(input->GetDataType()));
  output->SetName(input->GetName());
  output->SetNumberOfComponents(input->GetNumberOfComponents());
  output->CopyComponentNames(input);
  output->SetNumberOfTuples(vtkIdType(voxels.keys.size()));
  forRange(executor, std::int64_t(voxels.keys.size()),
    [&](std::int64_t begin, std::int64_t end)
    {
      VoxelReducer reducer(input, output, kind, voxels, transform);
      for (std::int64_t v = begin; v < end; ++v)
      {
        reducer.reduce(std::size_t(v));
      }
    });
  return output;
}

} // namespace pointhaptics
