// The unit of the file's coordinates, in the words of the window.
#include "ScaleNote.h"
#include "ViewWindow.h"

#include <vtkTransform.h>

namespace pointhaptics
{

/// Text of the present scale, and of the unit that could be taken.
std::string ViewWindow::scaleText()
{
  const LengthUnit& unit = scene_.unit();
  const LengthUnit& likely = scene_.likelyUnit();
  const std::string scale = describeScale(style_->GetModelTransform()->GetMatrix(), unit.name, unit.metres);
  const std::string key = style_->GetCommands().label("take-unit");
  const bool isOffered = !likely.name.empty() && likely.name != unit.name && !key.empty();
  return scale + (isOffered ? "    " + key + ": the file is in " + likely.name : std::string()) +
    (scene_.isUpGuessed() ? "    up is a guess: " + style_->GetCommands().label("turn-up") + " turns it"
                          : std::string());
}

/// Shows the scale and the last message.
void ViewWindow::showNote()
{
  const std::string scale = this->scaleText();
  style_->GetStatus().setNote(news_.empty() ? scale : scale + "\n" + news_);
}

/// Takes the unit that the file seems to have, or gives it back.
void ViewWindow::toggleUnit()
{
  const LengthUnit likely = scene_.likelyUnit();
  if (likely.name.empty())
  {
    this->say("the file is taken to be in " + scene_.unit().name + ", and nothing speaks for another unit");
    return;
  }
  const bool isTaken = scene_.unit().name == likely.name;
  if (!isTaken)
  {
    firstUnit_ = scene_.unit();
  }
  scene_.setUnit(isTaken ? firstUnit_ : likely);
  this->say("the file is taken to be in " + scene_.unit().name);
}

} // namespace pointhaptics
