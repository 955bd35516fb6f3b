/// @file
/// Code that vtkSplatMapper, which alone includes this, puts into VTK's shaders.
#pragma once

namespace pointhaptics
{

/// Light on a side of a splat: the sky, which is darker below, and the lamp, which wraps around the shape.
/// Near the outline, where noise turns normals away, both sides count. The length of a normal is the part of
/// the light that is seen.
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

/// Slope of the disc seen from the eye: how far towards the viewer it goes for a step on the screen. Splats
/// that are blended pass in front of the nearest of their surface, and a pixel beyond their rims. The lengths
/// are of the view: splatHalfPixel is half a pixel at distance 1, splatTerms those of the projection.
inline constexpr const char* kSurfaceDeclarations = R"(
uniform mat3 splatTurn;
uniform vec4 splatTerms;
uniform float splatHalfPixel;
uniform float splatAll;
uniform vec2 splatPixel; // of quads; 0: points are drawn
out vec3 splatCorner;
uniform int splatIsParallel;
uniform int splatStage; // vtkDepthShadingPass::Stage
uniform sampler2D splatTiles; // vtkDepthShadingPass::TilesOf
uniform vec2 splatTileCount; // of the picture
out vec2 splatSlope;
out vec4 splatReach;
)";
inline constexpr const char* kSurfaceStatements = R"(
  vec3 splatRay = splatIsParallel != 0 ? vec3(0.0, 0.0, -1.0)
    : vec3(gl_Position.xy / gl_Position.w / splatTerms.xy, -1.0);
  vec3 splatTilted = splatTurn * splatAxis;
  float splatAcross = dot(splatTilted, splatRay);
  // A disc seen edge-on is steep, it does not face the viewer.
  splatSlope = splatTilted.xy / (splatAcross < 0.0 ? min(splatAcross, -1e-4) : max(splatAcross, 1e-4));
  float splatSteep = length(splatSlope);
  splatSlope *= min(1.0, 3.0 / max(splatSteep, 1e-6)) * splatTilts;
  // The rims of blended splats are a pixel wide: about those of points, beyond those of surfaces.
  gl_PointSize = splatStage != 0 ? max(1.0, gl_PointSize - 1.0 + splatCloses) : gl_PointSize;
  float splatRadius = gl_PointSize * splatHalfPixel * gl_Position.w;
  splatReach = vec4(gl_Position.w, splatRadius, 1.0, 0.0);
  if (splatStage == 2)
  {
    splatReach.zw = vec2(1.0 + 2.0 / gl_PointSize, splatRadius * mix(0.05, 0.8, splatCloses));
    gl_PointSize += 2.0;
  }
  splatCorner = vec3(2 * (gl_VertexID & 1) - 1, (gl_VertexID & 2) - 1, splatPixel.x > 0.0 ? 1.0 : 0.0);
)";
/// Moves blended splats that are behind all pixels they could be seen in behind the far plane: the fragments
/// of half of the points of an object need not be shaded.
inline constexpr const char* kTileStatements = R"(
  if (splatStage == 2)
  {
    float splatNearest = splatReach.y * splatReach.z * length(splatSlope) + splatReach.w;
    float splatFront = splatIsParallel != 0
      ? 0.5 + 0.5 * (gl_Position.z / gl_Position.w + splatTerms.z * splatNearest)
      : 0.5 + 0.5 * (-splatTerms.z + splatTerms.w / max(1e-6 * splatReach.x, splatReach.x - splatNearest));
    vec2 splatMiddle = (0.5 + 0.5 * gl_Position.xy / gl_Position.w) * splatTileCount;
    ivec2 splatLast = textureSize(splatTiles, 0) - ivec2(1);
    vec2 splatHalf = vec2(gl_PointSize / 16.0);
    ivec2 splatFrom = clamp(ivec2(floor(splatMiddle - splatHalf)), ivec2(0), splatLast);
    ivec2 splatTo = clamp(ivec2(floor(splatMiddle + splatHalf)), ivec2(0), splatLast);
    bool splatIsSmall = all(lessThan(splatTo - splatFrom, ivec2(6)));
    float splatFarthest = splatIsSmall ? 0.0 : 1.0;
    for (int y = splatFrom.y; splatIsSmall && y <= splatTo.y; ++y)
    {
      for (int x = splatFrom.x; x <= splatTo.x; ++x)
      {
        splatFarthest = max(splatFarthest, texelFetch(splatTiles, ivec2(x, y), 0).r);
      }
    }
    if (splatFront > splatFarthest + 2e-6)
    {
      gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    }
  }
)";
inline constexpr const char* kQuadStatements = R"(
  gl_Position.xy += 0.5 * splatCorner.xy * gl_PointSize * splatPixel * gl_Position.w;
)";
inline constexpr const char* kSurfaceFragmentDeclarations = R"(
in vec2 splatSlope;
in vec3 splatCorner; // of a quad, and whether it is one
in vec4 splatReach; // distance, radius, place at the rim of the point, how far it comes forward
uniform vec4 splatTerms;
uniform int splatIsParallel;
uniform float splatNarrow;
uniform int splatStage;
float splatDepth(float near)
{
  return clamp(splatIsParallel != 0
    ? gl_FragCoord.z + 0.5 * splatTerms.z * near
    : 0.5 + 0.5 * (-splatTerms.z + splatTerms.w / max(1e-6 * splatReach.x, splatReach.x - near)), 0.0, 1.0);
}
)";
inline constexpr const char* kSurfaceFragment = R"(
  vec2 splatPlace = splatReach.z * (splatCorner.z > 0.0 ? splatCorner.xy
    : vec2(2.0 * gl_PointCoord.x - 1.0, 1.0 - 2.0 * gl_PointCoord.y));
  float splatRise = dot(splatSlope, splatPlace);
  float splatSquare = dot(splatPlace, splatPlace) + splatNarrow * splatRise * splatRise;
  float splatCover = splatStage == 2 ? clamp(1.0 + (1.0 - splatSquare) / fwidth(splatSquare), 0.0, 1.0)
    : step(splatSquare, 1.0);
  if (splatCover <= 0.0) { discard; }
  float splatInner = max(0.0, 1.0 - splatSquare);
  float splatWeight = splatCover * (0.01 + splatInner * splatInner);
  float splatNear = splatReach.y * splatRise;
  gl_FragDepth = splatDepth(splatNear + splatReach.w);
  gl_FragData[1] = vec4(splatWeight, splatWeight * splatDepth(splatNear), 0.0, 0.0);
)";
/// Sets the opacity after the light. The alpha of a colour does not tell if a point is there; the opacity of
/// the actor counts.
inline constexpr const char* kOpaqueStatements = R"(
  gl_FragData[0].a = opacityUniform;
)";
inline constexpr const char* kBlendStatements = R"(
  gl_FragData[0] = splatStage == 2 ? vec4(splatWeight * gl_FragData[0].rgb, splatCover)
    : vec4(gl_FragData[0].rgb, opacityUniform);
)";

/// Moves the picture to the middle of its viewport.
inline constexpr const char* kFitStatements = R"(
  gl_Position.xy *= splatFit;
)";

/// Moves vertices outside of the box behind the far plane, and those of a negative length.
inline constexpr const char* kHideStatements = R"(
  if (splatLength < 0.0)
  {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }
)";
inline constexpr const char* kClipStatements = R"(
  if (any(lessThan(vertexMC.xyz, splatLow)) || any(greaterThan(vertexMC.xyz, splatHigh)))
  {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }
)";

} // namespace pointhaptics
