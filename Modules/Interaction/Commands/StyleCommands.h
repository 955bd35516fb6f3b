/// @file
/// The commands of every vtkInteractorStyleHaptic.
#pragma once

class vtkInteractorStyleHaptic;

namespace pointhaptics
{

/// Name of the command that moves the workspace over the model, while the camera goes with it.
constexpr const char* kIndexByHand = "index-by-hand";

/// Adds the commands to the style's own. Each works on a part of the style, where the style has it.
void addStyleCommands(vtkInteractorStyleHaptic& style);

} // namespace pointhaptics
