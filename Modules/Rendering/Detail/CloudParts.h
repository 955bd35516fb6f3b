/// @file
/// Parts of a cloud as LevelOfDetail draws them.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include "vtkSmartPointer.h"

#include <cstddef>
#include <vector>

class vtkDataArray;
class vtkIdList;
class vtkMapper;
class vtkPolyData;
class vtkSplatMapper;

namespace pointhaptics
{

/// View of the points of @p cloud where they lie; @p copy is filled where the coordinates are neither float
/// nor double.
PointView viewOf(vtkPolyData* cloud, std::vector<Vec3>& copy);

/// Quantile of the values above 0 among at most about 10,000: @p tenths tenths are below it; 0 where there is
/// none. @param tenths 0 to 9.
POINTHAPTICSRENDERING_EXPORT double quantileOfPositive(vtkDataArray* array, std::size_t tenths);

/// True if @p cloud has no cells, or vertices at all of its points, first to last.
bool drawsInOrder(vtkPolyData* cloud);

/// Lets @p to colour as @p from does, as vtkPolyDataMapper::ShallowCopy() would, without its warnings of
/// deprecated shaders.
void colorAlike(vtkMapper* from, vtkMapper* to);

/// The points @p ids of @p cloud with the arrays that @p mapper draws them with: colours, sizes and normals;
/// without cells where the cloud has none.
vtkSmartPointer<vtkPolyData> pickPoints(vtkPolyData* cloud, vtkSplatMapper* mapper, vtkIdList* ids);

} // namespace pointhaptics
