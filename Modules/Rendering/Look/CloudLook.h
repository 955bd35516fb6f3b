/// @file
/// First view of a cloud, decided from the data alone: what kind of cloud it is, from where it is seen, and
/// how its points are drawn. Plain functions, without a window; any thread may call them.
#pragma once

#include "CloudOrientation.h"
#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "Core/Neighbors/LocalShape.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{

enum class CloudKind
{
  Object,  ///< A thing to walk around: statue, part, tree.
  Terrain, ///< Ground seen from above.
  Sweep,   ///< Scanned from the origin of the file, outdoors.
  Indoors, ///< A room, scanned from the origin of the file or not, which is shown without its near walls.
  Frame,   ///< One picture of a depth camera.
};

/// Name of a kind: "object", "terrain", "sweep", "indoors", "frame".
POINTHAPTICSRENDERING_EXPORT const char* cloudKindName(CloudKind kind);
/// Kind of a name. False: @p name is none of them; @p kind is as it was.
POINTHAPTICSRENDERING_EXPORT bool cloudKindFromName(const std::string& name, CloudKind& kind);

/// First view of a cloud; all directions and lengths in the frame of the file.
struct CloudLook
{
  CloudKind kind = CloudKind::Object;
  Vec3 up{ 0.0, 0.0, 1.0 };
  Vec3 front{ 0.0, -1.0, 0.0 }; ///< From the cloud towards the viewer, before it is turned.
  double azimuth = 25.0;        ///< Degrees the viewer stands to the right of the front,
  double elevation = 12.0;      ///< and above.
  double tilt = 0.0;            ///< Ratio of the horizontal variances of a strip; 0: the elevation holds.
  /// Box about the mass of the cloud, without floaters; empty: all points are of it.
  Bounds core;
  double strayShare = 0.03; ///< Part at each end of an axis that is left out where the cloud would be small,
  bool cutsSparse = false;  ///< as rays get ever fewer, and most of what is looked at is near.
  double largestPixels = 16.0;   ///< Largest size of a surface's splats, pixels in a window of 800 lines.
  double noiseLength = 0.0;      ///< Depths that differ by less are one surface,
  double noisePerDistance = 0.0; ///< the same over the distance from the camera.
  bool closesAll = false;        ///< A surface, flat everywhere or not: no splat is kept small on the screen.
  bool hidesBackFaces = false;   ///< Surfaces whose seen side looks away from the viewer are hidden.
  Vec3 sensor;                   ///< Place from which a sweep or a room was seen: surfaces face it.
  bool hasOwnLight = false;      ///< Its colours are those a camera saw: no light is added to them.
  double meanFlatness = 0.0;
  double discRadius = 0.0; ///< Discs of this radius are in the first picture, whole.
};

/// Indices of the drawn points: those that are finite, without rays that did not return, see areNoReturns().
POINTHAPTICSRENDERING_EXPORT std::vector<std::uint32_t> drawnPoints(const PointView& cloud);

/// Decides the kind, the first that fits: a frame, as @p orientation says; a sweep where the spacing grows
/// with the distance from the origin, indoors where it hits most directions above the sensor; terrain where
/// the surfaces face up; indoors where most points lie on the sides of a box and some within; an object. With
/// y up it is an object.
POINTHAPTICSRENDERING_EXPORT CloudKind cloudKind(
  const PointView& cloud, const LocalShape& shape, const CloudOrientation& orientation);

/// Derives the look from the @p kind.
POINTHAPTICSRENDERING_EXPORT CloudLook cloudLook(
  CloudKind kind, const PointView& cloud, const LocalShape& shape, const CloudOrientation& orientation);

/// A camera with its own view angle.
struct CameraFit
{
  Vec3 position;
  Vec3 focalPoint;
  Vec3 up;
  double viewAngle = 30.0; ///< Degrees from bottom to top.
};

/// The camera that sees the points of @p cloud after @p toWorld, all of them finite, from where @p look says,
/// turned to the right by @p turn degrees more. Its core takes 92 % of the width or the height of the window,
/// exactly, or less where discs at its rim need more; a sweep is cut where its thin outskirts would make it
/// much smaller.
/// @param aspect width of the window over its height, above 0.
/// @param parallel for a parallel projection, in which the distance tells the scale: half the height of the
/// picture is the distance from position to focal point times the tangent of half the view angle.
POINTHAPTICSRENDERING_EXPORT CameraFit fitCamera(const PointView& cloud, const CloudLook& look,
  const AffineTransform& toWorld, double aspect, double turn = 0.0, bool parallel = false);

} // namespace pointhaptics
