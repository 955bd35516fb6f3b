/// @file
/// Pictures of what lies over the cloud: words, sliders, chart. VTK draws words with its own fonts.
#pragma once

#include <string>

class vtkRenderer;

namespace pointhaptics
{
namespace testing
{

/// Each fills @p renderer, which is in a window already, with @p fault in it ("": none): a help that lacks a
/// line ("missing-line"), a panel with another number ("wrong-number"), a slider at another value
/// ("wrong-value"), a chart with another peak ("wrong-force"). What they need lives until the program ends.
void buildHelpOverlay(const std::string& fault, vtkRenderer* renderer);
void buildStatusOverlay(const std::string& fault, vtkRenderer* renderer);
void buildSliders(const std::string& fault, vtkRenderer* renderer);
void buildChart(const std::string& fault, vtkRenderer* renderer);

void buildIdealChart(const std::string& fault, vtkRenderer* renderer);   ///< "wrong-ideal"
void buildHelpFits(const std::string& fault, vtkRenderer* renderer);     ///< "large-font"
void buildErrorOverlay(const std::string& fault, vtkRenderer* renderer); ///< "no-message"
void buildMarks(const std::string& fault, vtkRenderer* renderer);
void buildProgress(const std::string& fault, vtkRenderer* renderer); ///< "wrong-part"

} // namespace testing
} // namespace pointhaptics
