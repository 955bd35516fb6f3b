#include "ModelTransform.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr std::size_t kLongestHistory = 100;

} // namespace

ModelTransform::ModelTransform()
  : transform_(vtkSmartPointer<vtkTransform>::New())
  , initial_(vtkSmartPointer<vtkMatrix4x4>::New())
{
  transform_->PostMultiply();
}

ModelTransform::~ModelTransform() = default;

double ModelTransform::edge() const
{
  const Vec3 extent = this->workspace().extent();
  return std::max({ extent.x, extent.y, extent.z });
}

void ModelTransform::setMatrix(vtkMatrix4x4* matrix)
{
  this->adoptMatrix(matrix);
  this->report();
}

void ModelTransform::adoptMatrix(vtkMatrix4x4* matrix)
{
  initial_->DeepCopy(matrix);
  transform_->SetMatrix(initial_);
  history_.clear();
  isRemembered_ = false;
}

void ModelTransform::rotate(double degrees, const Vec3& axis)
{
  if (!std::isfinite(degrees) || !isFinite(axis) || !(norm(axis) > 0.0))
  {
    return;
  }
  this->remember();
  const Vec3 c = this->center();
  transform_->Translate(-c.x, -c.y, -c.z);
  transform_->RotateWXYZ(degrees, axis.x, axis.y, axis.z);
  transform_->Translate(c.x, c.y, c.z);
  this->report();
}

void ModelTransform::translate(const Vec3& offset)
{
  if (isFinite(offset))
  {
    this->remember();
    transform_->Translate(offset.x, offset.y, offset.z);
    this->report();
  }
}

void ModelTransform::scale(double factor)
{
  if (!std::isfinite(factor) || !(factor > 0.0))
  {
    return;
  }
  this->remember();
  const Vec3 c = this->center();
  transform_->Translate(-c.x, -c.y, -c.z);
  transform_->Scale(factor, factor, factor);
  transform_->Translate(c.x, c.y, c.z);
  this->report();
}

void ModelTransform::reset()
{
  this->remember();
  transform_->SetMatrix(initial_);
  this->report();
}

bool ModelTransform::undo()
{
  while (!history_.empty())
  {
    const Elements elements = history_.back();
    history_.pop_back();
    // A reset of a model that had not moved is no change.
    if (!std::equal(elements.begin(), elements.end(), transform_->GetMatrix()->GetData()))
    {
      transform_->SetMatrix(elements.data());
      this->report();
      return true;
    }
  }
  return false;
}

void ModelTransform::beginGesture()
{
  isRemembered_ = isRemembered_ && gestures_ > 0;
  ++gestures_;
}

void ModelTransform::remember()
{
  if (gestures_ > 0 && isRemembered_)
  {
    return;
  }
  isRemembered_ = true;
  Elements elements;
  std::copy_n(transform_->GetMatrix()->GetData(), elements.size(), elements.begin());
  history_.push_back(elements);
  if (history_.size() > kLongestHistory)
  {
    history_.pop_front();
  }
}

void ModelTransform::report()
{
  // Many small steps must not lengthen vtkTransform's list of matrices for ever.
  vtkNew<vtkMatrix4x4> matrix;
  matrix->DeepCopy(transform_->GetMatrix());
  transform_->SetMatrix(matrix);
  if (changed_)
  {
    changed_();
  }
}

} // namespace pointhaptics
