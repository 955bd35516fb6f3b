/// @file
/// Drawing of a cloud: its own colours where it has them, else height by a perceptually uniform map.
#pragma once

#include "ColorMaps.h"

#include "Core/Base/PointView.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <vtkType.h>

#include <optional>
#include <string>
#include <vector>

class vtkActor;
class vtkDataArray;
class vtkLookupTable;
class vtkMapper;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;
class vtkScalarBarActor;

namespace pointhaptics
{

/// Name of the array addHeightArray() makes.
constexpr const char* kHeightArrayName = "Height";

/// Adds the array "Height", of the type of the coordinates: the coordinate along @p up, NaN for points that
/// are not finite. Taken before the cloud is transformed, so the colours turn with the model.
POINTHAPTICSRENDERING_EXPORT void addHeightArray(vtkPolyData* cloud, const Vec3& up);

/// True where the active scalars are colours: unsigned char with 3 or 4 components.
POINTHAPTICSRENDERING_EXPORT bool hasColors(vtkPolyData* cloud);

/// The array component by which the points are coloured.
struct ColorSource
{
  std::string array;
  int component = 0; ///< From 0; kMagnitude: the length of the vector.
};
constexpr int kMagnitude = -1;

/// The array and the component that @p colorBy names: "ARRAY", "ARRAY:0" and so on, "ARRAY:magnitude", and by
/// the names of the components, where the array has them; "ARRAY:x" to "ARRAY:z" of one with three. A name
/// alone means the magnitude of an array with several components. None: @p cloud has no such point array or
/// component.
POINTHAPTICSRENDERING_EXPORT std::optional<ColorSource> findColorSource(
  vtkPolyData* cloud, const std::string& colorBy);

/// The value of @p source at a point.
POINTHAPTICSRENDERING_EXPORT double colorValue(
  vtkPolyData* cloud, const ColorSource& source, vtkIdType point);

/// Text for a scalar bar: "ARRAY", or with its component as the user would write it where there are several.
POINTHAPTICSRENDERING_EXPORT std::string describeColorSource(vtkPolyData* cloud, const ColorSource& source);

/// The values of @p source between which the colours run: those of the finite points, without the 1 % at each
/// end, from 0 where the lower one is hardly more, and never of no width; 0 to 1 where no value is finite. Of
/// at most about 10,000 points.
POINTHAPTICSRENDERING_EXPORT void colorRange(vtkPolyData* cloud, const ColorSource& source, double range[2]);

/// Sets the range of @p colors to the colorRange() of @p source, unless both ends are within a tenth of its
/// width of that already: colours that creep while the model moves would tell nothing. @return whether it was
/// set.
POINTHAPTICSRENDERING_EXPORT bool followColorRange(
  vtkPolyData* cloud, const ColorSource& source, vtkLookupTable* colors);

/// Array with the number of the file, from 0, that a point of several is from.
constexpr const char* kFileArrayName = "File";
/// True for arrays whose numbers are names: ASPRS classes and files.
POINTHAPTICSRENDERING_EXPORT bool holdsLabels(const std::string& array);

/// The numbers that occur in the array @p labels, with their names and colours: for a scalar bar, which shows
/// them as a list. Files have the names in @p files, in their order. The caller owns the result (Delete()).
POINTHAPTICSRENDERING_EXPORT vtkLookupTable* newClassLegend(
  vtkDataArray* labels, const std::vector<std::string>& files = {});

/// Makes @p mapper and @p actor draw the points of the mapper's input as squares of @p pointSize pixels.
/// @param colorBy what findColorSource() takes; "rgb" for the active colours; empty: colours if there, else
/// "Height", else one colour. An array is coloured over its colorRange(), grey where it is NaN; classes
/// (holdsAsprsClasses()) have the colours of asprsClass(). False: there
/// is no such array, and the appearance is that of the empty name.
POINTHAPTICSRENDERING_EXPORT bool applyCloudAppearance(vtkPolyData* cloud, vtkPolyDataMapper* mapper,
  vtkActor* actor, const std::string& colorBy = {}, double pointSize = 3.0);

/// Width of the range of colours of an array that holds only @p value: such a range has one label.
POINTHAPTICSRENDERING_EXPORT double widthOfOneValue(double value);

/// "LOW to HIGH", with the decimals of the labels of a bar of colours over that range.
POINTHAPTICSRENDERING_EXPORT std::string rangeText(double low, double high);

/// Sets dark text on the light background, at the right edge: see placeScalarBar().
POINTHAPTICSRENDERING_EXPORT void setUpScalarBar(vtkScalarBarActor* bar);

/// Makes room for the title and the numbers of @p bar at the right edge of @p renderer, in pixels: to be
/// called before a render whose size or title may be another one.
POINTHAPTICSRENDERING_EXPORT void placeScalarBar(vtkScalarBarActor* bar, vtkRenderer* renderer);

///@{
/// As above, for a layout: the pixels that @p bar needs with a font of @p font points, each of @p
/// pixelsPerPoint, and the box it is put in: left, bottom, right, top, pixels of @p renderer.
POINTHAPTICSRENDERING_EXPORT void measureScalarBar(
  vtkScalarBarActor* bar, double font, double pixelsPerPoint, double size[2]);
POINTHAPTICSRENDERING_EXPORT void placeScalarBar(
  vtkScalarBarActor* bar, vtkRenderer* renderer, double font, double pixelsPerPoint, const double box[4]);
///@}

/// Sets a light background, white below to a pale blue-grey above, on which black lines and all colours of
/// the map can be read.
POINTHAPTICSRENDERING_EXPORT void applyBackground(vtkRenderer* renderer);

/// Sets the map of a @p mapper that colours by one: newColorMap() of @p name over @p range, two values of the
/// array; the former range if that is empty. Colours of classes stay.
POINTHAPTICSRENDERING_EXPORT void applyColorMap(
  vtkMapper* mapper, const std::string& name = "auto", const std::vector<double>& range = {});

/// Names for applyGround(): dark, on which a cloud's own colours stand out; light, that of applyBackground();
/// white; black.
POINTHAPTICSRENDERING_EXPORT const std::vector<std::string>& groundNames();
/// Sets the background of that name; dark where there is none.
POINTHAPTICSRENDERING_EXPORT void applyGround(vtkRenderer* renderer, const std::string& name = "dark");
/// True if text on that background must be dark.
POINTHAPTICSRENDERING_EXPORT bool isLightGround(const std::string& name);

/// Shows the cloud in one plain colour on white, as in a printed figure. applyCloudAppearance() and
/// applyBackground() undo it.
POINTHAPTICSRENDERING_EXPORT void applyFigureAppearance(
  vtkPolyDataMapper* mapper, vtkActor* actor, vtkRenderer* renderer);

/// Darkens what lies behind its surroundings (eye-dome lighting, vtkDepthShadingPass): points without normals
/// show their shape.
/// May be called again with other numbers.
/// @param noise what lies less than this behind its neighbours, in the units of the scene, is not darkened.
/// @param noisePerDistance the same over the distance from the camera.
POINTHAPTICSRENDERING_EXPORT void applyDepthShading(
  vtkRenderer* renderer, double noise = 0.0, double noisePerDistance = 0.0);
/// Strength of the shading that applyDepthShading() made: see vtkDepthShadingPass; nothing where there is
/// none.
POINTHAPTICSRENDERING_EXPORT void setDepthStrength(vtkRenderer* renderer, double strength);

} // namespace pointhaptics
