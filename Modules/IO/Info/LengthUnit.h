/// @file
/// The unit of a cloud's coordinates, and what tells it.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsIOModule.h" // For export macro

#include "vtkSmartPointer.h"

#include <string>

class vtkPolyData;

namespace pointhaptics
{

/// A unit of length as files call it.
struct NamedUnit
{
  const char* name; ///< As --unit takes it.
  double metres;
  int code;         ///< EPSG's; 0: none.
  const char* word; ///< As LAS says it.
  const char* others;
};
inline constexpr NamedUnit kLengthUnits[] = {
  { "m", 1.0, 9001, "metre", "metres meter meters" },
  { "cm", 1e-2, 1033, "centimetre", "centimetres centimeter centimeters" },
  { "mm", 1e-3, 1025, "millimetre", "millimetres millimeter millimeters" },
  { "um", 1e-6, 0, "micrometre", "micrometres micrometer micrometers \xc2\xb5m \xce\xbcm" },
  { "nm", 1e-9, 0, "nanometre", "nanometres nanometer nanometers" },
  { "dm", 1e-1, 0, "decimetre", "decimetres decimeter decimeters" },
  { "km", 1e3, 9036, "kilometre", "kilometres kilometer kilometers" },
  { "in", 0.0254, 0, "inch", "inches" },
  { "ft", 0.3048, 9002, "foot", "feet" },
  { "us-ft", 1200.0 / 3937.0, 9003, "US survey foot", "ftus usft sft" },
  { "mil", 2.54e-5, 0, "mil", "mils thou" },
  { "yd", 0.9144, 9096, "yard", "yards yds" },
};

/// The unit that a file calls @p name, in upper or lower case, also in more words: "International Feet",
/// "Foot_US". Null: none is known.
POINTHAPTICSIO_EXPORT const NamedUnit* findLengthUnit(const std::string& name);

enum class UnitEvidence
{
  File,  ///< The file says it.
  Shape, ///< Coordinates and arrays leave little doubt.
  None,  ///< Nothing tells; metres are taken.
};

struct LengthUnit
{
  std::string name = "m"; ///< As --unit takes it, or deg of longitude and latitude.
  double metres = 1.0;    ///< Length of one unit; 1 for degrees, which have no length.
  UnitEvidence evidence = UnitEvidence::None;
};

/// Unit of the coordinates of @p cloud, whose finite points lie within @p bounds. The field array LengthUnit,
/// which the readers of LAS and of text make, is believed. Map coordinates, and arrays that only LiDAR has,
/// mean metres. A compact cloud of 100 to 10,000 units without intensities, not about its scanner, is a thing
/// in millimetres: statues of 1600 units are, a street of 160 m is not. Cost: none a point.
POINTHAPTICSIO_EXPORT LengthUnit lengthUnitOf(vtkPolyData* cloud, const Bounds& bounds);

/// True where no unit is said and x and y are like longitude and latitude: in their range, far from the
/// origin, and of an extent that is small beside that of z, of which places near each other have the same.
POINTHAPTICSIO_EXPORT bool looksLikeDegrees(vtkPolyData* cloud);

/// Says with @p file that @p cloud, which comes from it, has another unit than @p chosen; empty: it does not.
POINTHAPTICSIO_EXPORT std::string contradictedUnit(
  const std::string& file, vtkPolyData* cloud, const std::string& chosen);

/// lengthUnitOf()'s name of a unit that a file calls @p name, "m" of "Metres"; empty: it knows none.
std::string lengthUnitCalled(const std::string& name);

/// @p cloud with its coordinates, and no arrays, times @p factor, as doubles in @p unit; empty: none is said.
/// Steps and coordinate system of the file are left out.
POINTHAPTICSIO_EXPORT vtkSmartPointer<vtkPolyData> scaledCloud(
  vtkPolyData* cloud, double factor, const std::string& unit = {});

/// @p cloud, or where its x and y are degrees of longitude and latitude (with @p isGuessed also where
/// looksLikeDegrees()) a copy of it in metres to the east and north of their medians, on a sphere of the WGS
/// 84 ellipsoid's mean radius; z becomes metres where kHeightUnit says another unit, else it stays. What says
/// where the degrees are on the Earth is not in the copy's field data. Points at 0, 0, 0, which are no
/// returns, stay.
POINTHAPTICSIO_EXPORT vtkSmartPointer<vtkPolyData> inLocalMetres(vtkPolyData* cloud, bool isGuessed = false);
/// Field data of a cloud whose heights are in another unit than x and y, or with degrees in no metres:
/// theirs.
inline constexpr const char* kHeightUnit = "HeightUnit";
/// Field data of such a copy: longitude and latitude of the origin, metres of a degree of each, and of a
/// unit of height.
inline constexpr const char* kLocalFrame = "LocalFrame";
/// Place of @p place, in the coordinates of the file, in what inLocalMetres() made of it, and back. Clouds
/// that are as in their file change nothing.
POINTHAPTICSIO_EXPORT Vec3 toLocalFrame(vtkPolyData* cloud, const Vec3& place);
POINTHAPTICSIO_EXPORT Vec3 fromLocalFrame(vtkPolyData* cloud, const Vec3& place);

} // namespace pointhaptics
