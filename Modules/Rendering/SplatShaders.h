/// @file
/// What vtkSplatMapper, which alone includes this, puts into VTK's shaders.
#pragma once

namespace pointhaptics
{

/// The light on a side of a splat is that of the sky, which is darker below, and the part of the lamp's that
/// wraps around the shape. Near the outline, where noise turns normals away, both sides count. The length of
/// a normal is how much of the light is seen.
inline constexpr const char* kLightFunctions = R"(
in vec3 splatNormal;
uniform vec3 splatSky;
uniform vec3 splatLamp;
uniform vec4 splatEye;
uniform vec3 splatUnscale;
uniform float splatUnit;
uniform float splatStrength;
uniform int splatHides;
out float splatLight;
float lightOn(vec3 normal)
{
  float sky = 0.5 + 0.5 * dot(normal, splatSky);
  float lamp = 0.5 + 0.5 * dot(normal, splatLamp);
  return 0.16 + 0.20 * sky + 0.66 * lamp * lamp;
}
)";
inline constexpr const char* kLightStatements = R"(
  float splatFlat = length(splatNormal) * splatUnit;
  vec3 splatAxis = splatFlat > 1e-3 ? normalize(splatNormal) : vec3(0.0);
  vec3 splatSight = normalize((splatEye.xyz - splatEye.w * vertexMC.xyz) * splatUnscale);
  float splatFacing = smoothstep(-0.2, 0.2, dot(splatAxis, splatSight));
  float splatShade = mix(lightOn(-splatAxis), lightOn(splatAxis), splatFacing);
  splatLight = 1.0 + min(1.0, splatFlat) * splatStrength * (splatShade - 0.85);
  if (splatHides != 0 && splatFlat > 0.02 && dot(splatAxis, splatSight) < 0.0)
  {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }
)";

/// Slope of the disc seen from the eye: how far towards the viewer it goes for a step on the screen. The
/// lengths are of the view: splatDepth.x is half a pixel at distance 1, splatTerms those of the projection.
inline constexpr const char* kSurfaceDeclarations = R"(
uniform mat3 splatTurn;
uniform vec4 splatTerms;
uniform float splatHalfPixel;
uniform int splatIsParallel;
out vec2 splatSlope;
out vec2 splatReach;
)";
inline constexpr const char* kSurfaceStatements = R"(
  vec3 splatRay = splatIsParallel != 0 ? vec3(0.0, 0.0, -1.0)
    : vec3(gl_Position.xy / gl_Position.w / splatTerms.xy, -1.0);
  vec3 splatTilted = splatTurn * splatAxis;
  float splatAcross = dot(splatTilted, splatRay);
  splatSlope = abs(splatAcross) > 1e-4 ? splatTilted.xy / splatAcross : vec2(0.0);
  float splatSteep = length(splatSlope);
  splatSlope *= min(1.0, 1.5 / max(splatSteep, 1e-6)) * clamp(2.0 * splatFlat - 0.6, 0.0, 1.0);
  splatReach = vec2(gl_Position.w, gl_PointSize * splatHalfPixel * gl_Position.w);
)";
inline constexpr const char* kSurfaceFragment = R"(
  vec2 splatPlace = vec2(2.0 * gl_PointCoord.x - 1.0, 1.0 - 2.0 * gl_PointCoord.y);
  float splatRise = dot(splatSlope, splatPlace);
  if (dot(splatPlace, splatPlace) + splatNarrow * splatRise * splatRise > 1.0) { discard; }
  float splatNear = splatReach.y * splatRise;
  gl_FragDepth = clamp(splatIsParallel != 0
    ? gl_FragCoord.z + 0.5 * splatTerms.z * splatNear
    : 0.5 + 0.5 * (-splatTerms.z + splatTerms.w / max(1e-6 * splatReach.x, splatReach.x - splatNear)), 0.0, 1.0);
)";

/// What is outside of the box goes behind the far plane.
inline constexpr const char* kClipStatements = R"(
  if (any(lessThan(vertexMC.xyz, splatLow)) || any(greaterThan(vertexMC.xyz, splatHigh)))
  {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }
)";

} // namespace pointhaptics
