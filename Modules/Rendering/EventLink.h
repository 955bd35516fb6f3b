/// @file
/// A function that is called at an event of a VTK object.
#pragma once

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <utility>

namespace pointhaptics
{

/// Both may end first, the link or the object. GUI thread only.
class EventLink
{
public:
  explicit EventLink(std::function<void()> called)
    : called_(std::move(called))
  {
    command_->SetClientData(this);
    command_->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*) { static_cast<EventLink*>(self)->called_(); });
  }
  ~EventLink() { this->follow(nullptr); }
  EventLink(const EventLink&) = delete;
  EventLink& operator=(const EventLink&) = delete;

  /// Follows @p object in the place of the former one; null: none.
  void follow(vtkObject* object, unsigned long event = vtkCommand::StartEvent, float priority = 0.0F)
  {
    if (object_)
    {
      object_->RemoveObserver(command_);
    }
    object_ = object;
    if (object)
    {
      object->AddObserver(event, command_, priority);
    }
  }

private:
  std::function<void()> called_;
  vtkNew<vtkCallbackCommand> command_;
  vtkWeakPointer<vtkObject> object_;
};

} // namespace pointhaptics
