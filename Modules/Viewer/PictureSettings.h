/// @file
/// Settings of a picture, whatever the cloud is: plain values that options give, keys change and files keep.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace pointhaptics
{

/// Names that PictureSettings::theme may have.
inline const std::vector<std::string>& themeNames()
{
  static const std::vector<std::string> names = { "usual", "high-contrast" };
  return names;
}

/// Points with a value of @c array from low to high are neither shown nor felt.
struct HiddenValues
{
  std::string array; ///< As findColorSource() takes it.
  double low = 0.0;
  double high = 0.0;
  bool operator==(const HiddenValues& other) const
  {
    return array == other.array && low == other.low && high == other.high;
  }
};

/// Settings of a picture; each can be a command-line option, a key and a line of the configuration file.
struct PictureSettings
{
  bool parallel = false;           ///< Parallel projection; else perspective.
  std::string background = "dark"; ///< One of groundNames(): dark, light, white, black.
  std::string stereo = "none";     ///< One of stereoNames(): one picture, or how those of two eyes are shown.
  double pointScale = 1.0;         ///< Factor on the diameter of all points, 0.1 to 10.
  double depthStrength = 1.6;      ///< Strength of the shading by depth, 0 (none) to 10: see
                                   ///< vtkDepthShadingPass.
  double fontScale = 1.0;          ///< Factor on the size of all texts, 0.5 to 4.
  std::string colorMap = "auto";   ///< One of colorMapNames().
  /// Values that get the first and the last colour; empty: nearly all values that occur.
  std::vector<double> colorRange;
  std::vector<HiddenValues> hidden; ///< None in a new cloud.
  /// Coordinates x, y, z in the frame of the file of two points whose distance is shown. One point: the other
  /// is still to be chosen; empty: none.
  std::vector<double> measure;
  /// Width and height of written pictures, pixels; 0: those of the window.
  std::array<int, 2> screenshotSize{};
  /// One of themeNames(). high-contrast: backgrounds are black or white, texts a quarter larger on opaque
  /// plates, marks of touch in colours that people with colour vision deficiencies tell apart, with thick
  /// outlines.
  std::string theme = "usual";
  bool transparent = false; ///< Written pictures have no background: the page behind shows through.

  bool isHighContrast() const { return theme == "high-contrast"; }
};

} // namespace pointhaptics
