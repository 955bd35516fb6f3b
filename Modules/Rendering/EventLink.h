/// @file
/// A function that is called at events of a VTK object.
#pragma once

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <initializer_list>
#include <type_traits>
#include <utility>

namespace pointhaptics
{

/// Both may end first, the link or the object. One thread.
class EventLink
{
public:
  /// @p called takes nothing, or the event and its call data.
  template <typename Called>
  explicit EventLink(Called called)
    : called_(
        [called = std::move(called)](unsigned long event, void* data)
        {
          if constexpr (std::is_invocable_v<const Called&, unsigned long, void*>)
          {
            called(event, data);
          }
          else
          {
            static_cast<void>(event);
            static_cast<void>(data);
            called();
          }
        })
  {
    command_->SetClientData(this);
    command_->SetCallback([](vtkObject*, unsigned long event, void* self, void* data)
      { static_cast<EventLink*>(self)->called_(event, data); });
  }
  ~EventLink() { this->follow(nullptr); }
  EventLink(const EventLink&) = delete;
  EventLink& operator=(const EventLink&) = delete;

  ///@{
  /// Follows @p object in the place of the former one; null: none.
  void follow(vtkObject* object, unsigned long event = vtkCommand::StartEvent, float priority = 0.0F)
  {
    this->follow(object, { event }, priority);
  }
  void follow(vtkObject* object, std::initializer_list<unsigned long> events, float priority = 0.0F)
  {
    if (object_)
    {
      object_->RemoveObserver(command_);
    }
    object_ = object;
    for (auto event = events.begin(); object && event != events.end(); ++event)
    {
      object->AddObserver(*event, command_, priority);
    }
  }
  ///@}
  /// While an event is handled: no observer of a lower priority sees it.
  void keepEvent() { command_->SetAbortFlag(1); }

private:
  std::function<void(unsigned long, void*)> called_;
  vtkNew<vtkCallbackCommand> command_;
  vtkWeakPointer<vtkObject> object_;
};

} // namespace pointhaptics
