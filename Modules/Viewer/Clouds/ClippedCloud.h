/// @file
/// The part of a cloud in a box.
#pragma once

#include "Core/Base/PointView.h"
#include "PictureSettings.h"

#include "PointHapticsViewerModule.h" // For export macro

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkIdList;
class vtkPolyData;

namespace pointhaptics
{

/// HapticViewerOptions::clip, in the coordinates of the file, as a box in those of @p cloud (see
/// inLocalMetres()); nothing: there is none.
POINTHAPTICSVIEWER_EXPORT std::optional<Bounds> clipBox(const std::vector<double>& clip, vtkPolyData* cloud);
/// HapticViewerOptions::clip of a box in the coordinates of @p cloud.
std::vector<double> clipNumbers(const Bounds& box, vtkPolyData* cloud);

/// True if one box is about as long as the other and their middles are near.
bool areAlike(const Bounds& one, const Bounds& other);

/// The points of @p cloud that @p isKept, with all arrays, in their order; @p cloud itself where all are.
vtkSmartPointer<vtkPolyData> partOfCloud(
  vtkPolyData* cloud, const std::function<bool(vtkIdType, const Vec3&)>& isKept);

/// The points @p ids of @p cloud with all arrays.
vtkSmartPointer<vtkPolyData> pointsOfCloud(vtkPolyData* cloud, vtkIdList* ids);

/// True for points, by their index, that none of @p hidden names; those whose array @p cloud lacks hide none.
std::function<bool(vtkIdType)> notHidden(vtkPolyData* cloud, const std::vector<HiddenValues>& hidden);

/// The points of @p cloud that are shown and felt: in the box of @p clip, and not @p hidden.
POINTHAPTICSVIEWER_EXPORT vtkSmartPointer<vtkPolyData> shownPart(
  vtkPolyData* cloud, const std::vector<double>& clip, const std::vector<HiddenValues>& hidden);

/// Reads a list with commas of "ARRAY=VALUE" and "ARRAY=LOW:HIGH", either of which may be missing, and back.
/// @p wrong: the first word that is none of these.
POINTHAPTICSVIEWER_EXPORT std::vector<HiddenValues> hiddenIn(const std::string& list, std::string& wrong);
POINTHAPTICSVIEWER_EXPORT std::string textOf(const HiddenValues& hidden);

/// The points of @p cloud in @p box, the faces included, with all arrays, in their order; @p cloud itself
/// where all are. Points that are not finite lie in no box. Cost: about 10 ns a point.
POINTHAPTICSVIEWER_EXPORT vtkSmartPointer<vtkPolyData> clippedCloud(
  vtkPolyData* cloud, const std::optional<Bounds>& box);

} // namespace pointhaptics
