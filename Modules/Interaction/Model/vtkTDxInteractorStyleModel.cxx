#include "vtkTDxInteractorStyleModel.h"

#include "CapMotion.h"
#include "ModelTransform.h"
#include "ScreenView.h"
#include "SteadyTime.h"

#include "vtkObjectFactory.h"
#include "vtkTDxInteractorStyleSettings.h"
#include "vtkTDxMotionEventInfo.h"

#include <algorithm>

using pointhaptics::Vec3;

namespace
{

constexpr int kScaleButton = 1;
constexpr int kResetButton = 2;
/// Value of an axis at the end of the puck's way.
constexpr double kFullDeflection = 350.0;
/// Seconds that the first event after a pause counts for: drivers report about 60 times a second.
constexpr double kFirstStep = 1.0 / 60.0;
constexpr double kPause = 0.2;

/// Limits each axis to -1 to 1.
Vec3 limited(const Vec3& v)
{
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result[axis] = std::clamp(v[axis] / kFullDeflection, -1.0, 1.0);
  }
  return isFinite(v) ? result : Vec3();
}

} // namespace

vtkStandardNewMacro(vtkTDxInteractorStyleModel);

vtkTDxInteractorStyleModel::vtkTDxInteractorStyleModel() = default;

vtkTDxInteractorStyleModel::~vtkTDxInteractorStyleModel() = default;

void vtkTDxInteractorStyleModel::SetModel(
  pointhaptics::ModelTransform* model, const pointhaptics::ScreenView* screen)
{
  this->Cap = model && screen ? std::make_unique<pointhaptics::CapMotion>(*model, *screen) : nullptr;
}

void vtkTDxInteractorStyleModel::OnMotionEvent(vtkTDxMotionEventInfo* motionInfo)
{
  if (!this->Cap || !motionInfo || !this->Settings)
  {
    return;
  }
  this->CheckForRest();
  const double time = pointhaptics::steadySeconds();
  const double seconds = time - this->LastTime > kPause ? kFirstStep : time - this->LastTime;
  this->LastTime = time;
  vtkTDxInteractorStyleSettings* settings = this->Settings;
  const Vec3 shift{ motionInfo->X * settings->GetTranslationXSensitivity(),
    motionInfo->Y * settings->GetTranslationYSensitivity(),
    motionInfo->Z * settings->GetTranslationZSensitivity() };
  const Vec3 axis{ settings->GetUseRotationX() ? motionInfo->AxisX : 0.0,
    settings->GetUseRotationY() ? motionInfo->AxisY : 0.0,
    settings->GetUseRotationZ() ? motionInfo->AxisZ : 0.0 };
  this->Cap->move(limited(shift), limited(motionInfo->Angle * settings->GetAngleSensitivity() * axis),
    this->Scales, seconds);
}

void vtkTDxInteractorStyleModel::OnButtonPressedEvent(int button)
{
  this->Scales = this->Scales || button == kScaleButton;
  if (this->Cap && button == kResetButton)
  {
    this->Cap->reset();
  }
}

void vtkTDxInteractorStyleModel::OnButtonReleasedEvent(int button)
{
  this->Scales = this->Scales && button != kScaleButton;
}

void vtkTDxInteractorStyleModel::CheckForRest()
{
  if (this->Cap && pointhaptics::steadySeconds() - this->LastTime > kPause)
  {
    this->Cap->rest();
  }
}

void vtkTDxInteractorStyleModel::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HasModel: " << (this->Cap != nullptr) << "\n";
}
