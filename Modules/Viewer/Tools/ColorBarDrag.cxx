#include "ColorBarDrag.h"

#include "PictureControls.h"
#include "ViewScene.h"

#include <utility>

namespace pointhaptics
{
namespace
{

constexpr float kBarBeforeTheStyle = 1.0f;

} // namespace

ColorBarDrag::ColorBarDrag(const ToolContext& context, PictureControls& controls)
  : context_(context)
  , controls_(controls)
  , button_(context.interactor, kBarBeforeTheStyle,
      [this](const LeftButton::Event& event) { return this->takes(event); })
{
}

bool ColorBarDrag::takes(const LeftButton::Event& event)
{
  if (event.kind == LeftButton::Kind::Press)
  {
    const auto place = event.isPlain ? context_.scene.placeOnColorBar(event.x, event.y) : std::nullopt;
    drags_ = place.has_value();
    if (const auto label = event.isPlain ? context_.scene.labelOnColorBar(event.x, event.y) : std::nullopt)
    {
      controls_.toggleLabel(*label);
      button_.render();
      return true;
    }
    if (drags_)
    {
      from_ = place->along;
      pixels_ = place->pixels;
      fromY_ = event.y;
      range_ = context_.scene.shownColorRange();
    }
    return drags_;
  }
  if (event.kind == LeftButton::Kind::Release)
  {
    return std::exchange(drags_, false);
  }
  if (drags_)
  {
    controls_.dragColorRange(range_, from_, from_ + (event.y - fromY_) / pixels_);
  }
  return drags_;
}

} // namespace pointhaptics
