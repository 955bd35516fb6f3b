/// @file
/// Strict comparison of two pictures: pixel by pixel, no shift, no averaging.
#pragma once

#include <string>

class vtkImageData;

namespace pointhaptics
{
namespace testing
{

struct ImageDifference
{
  bool sameSize = false;
  long long visible = 0; ///< Pixels with a channel that differs by more than kVisibleStep.
  long long any = 0;     ///< Pixels that differ at all.
  int largest = 0;       ///< Largest difference of a channel, 0 to 255.
};

/// Rounding of colours in other renderers stays below it; the least fault we want to see is far above.
constexpr int kVisibleStep = 20;

/// Both of 3 unsigned char components. @p picture receives the differences, five times as strong, on black.
ImageDifference compareImages(vtkImageData* test, vtkImageData* baseline, vtkImageData* picture);

/// The picture in a PNG file, without an alpha channel. False: there is none, or it is no PNG.
bool readPng(const std::string& fileName, vtkImageData* image);
bool writePng(const std::string& fileName, vtkImageData* image);

} // namespace testing
} // namespace pointhaptics
