/// @file
/// Points on the faces of a mesh instead of its vertices.
#pragma once

#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <string>

class vtkPolyData;

namespace pointhaptics::io
{

/// As many samples as the shape of the mesh asks for; see sampleFaces().
constexpr vtkIdType kAutomaticSamples = -1;

/// Replaces the points of @p cloud by @p samples points on its polygons, evenly by area: the
/// surface is cut along Hilbert's curve into as many compact parts of equal area, and each has a point near
/// its middle. The same mesh gives the same points, bit for bit. The cells stay and mean nothing any
/// more.
///
/// kAutomaticSamples: the spacing is at most a quarter of the median edge, with 200,000 to 2 million samples.
///
/// Arrays are interpolated within a triangle. Integers but colours and intensities are labels and have the
/// value of the nearest corner, and so do texts. Normals get unit length; where the vertices have none, the
/// samples have those of the faces.
///
/// Faces that name vertices which are not there are left out. @p count: faces of the file, of which the
/// polygons are those that could be read. @p progress is told what part is done, 0..1, and may throw.
///
/// @return whether the points are samples; @p told gets what they are, in words. They stay as they are where
/// no face is right or has an area, and with kAutomaticSamples where the vertices outnumber the samples.
bool sampleFaces(vtkPolyData* cloud, vtkIdType samples, std::uint64_t count,
  const std::function<void(double)>& progress, std::string& told);

/// "6,442 faces".
std::string facesText(std::uint64_t count);

} // namespace pointhaptics::io
