/// @file
/// Pictures of clouds drawn by vtkSplatMapper, at rest and in motion.
#pragma once

#include <string>

class vtkRenderer;

namespace pointhaptics
{
namespace testing
{

void buildResiduals(const std::string& fault, vtkRenderer* renderer);
void buildAmbientLight(const std::string& fault, vtkRenderer* renderer);
/// A statue as a file of its points is shown at first glance, with the corners of the workspace.
void buildFirstGlance(const std::string& fault, vtkRenderer* renderer);
void buildSmoothGlance(const std::string& fault, vtkRenderer* renderer);
void buildCoarseAmbientLight(const std::string& fault, vtkRenderer* renderer);
void buildSplats(const std::string& fault, vtkRenderer* renderer);
void buildCoarseSplats(const std::string& fault, vtkRenderer* renderer);

} // namespace testing
} // namespace pointhaptics
