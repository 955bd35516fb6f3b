/// @file
/// Recorded interactions, replayed through the real style: what the window shows after them, and the state.
#pragma once

#include <string>

class vtkRenderer;

namespace pointhaptics
{
namespace testing
{

/// A plane with a hill under vtkInteractorStyleHaptic with all its parts, after the events in the file
/// @p events were replayed. @p fault: "other-bindings": drags and keys do something else; "lost-press": the
/// last press of a key or button never came.
void buildInteraction(const std::string& events, const std::string& fault, vtkRenderer* renderer);

/// Model, camera, hand and what is shown after the replay, a name and numbers a line; empty before one.
std::string interactionState();

/// Shows the same in a window and writes what the user does there to @p fileName, until key Q.
void recordInteraction(const std::string& fileName, vtkRenderer* renderer);

} // namespace testing
} // namespace pointhaptics
