/// @file
/// The fragment shaders of vtkDepthShadingPass, which alone includes this.
#pragma once

namespace pointhaptics
{

/// Comes before each of the others.
constexpr const char* kDepthCommon = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D colors;
uniform sampler2D depths;
uniform vec2 clipping;
uniform int isParallel;
uniform float pixelSize; // at distance 1
uniform float pixelScale;
uniform vec2 noise; // in the scene, and over the distance

float distanceAt(float depth)
{
  return isParallel != 0 ? mix(clipping.x, clipping.y, depth)
                         : clipping.x * clipping.y / (clipping.y - depth * (clipping.y - clipping.x));
}
float pixelAt(float here)
{
  return isParallel != 0 ? pixelSize : pixelSize * here;
}
float depthAt(ivec2 place, ivec2 last)
{
  return texelFetch(depths, clamp(place, ivec2(0), last), 0).r;
}
)";

/// A pixel that lies behind nearly all around it is a hole between splats. The number of neighbours is a
/// uniform so that the loop stays one: a software renderer leaves a loop where all its pixels have, but works
/// on both branches of a condition.
constexpr const char* kPinholeShader = R"(
const int enough = 6;
uniform int neighbors; // 8
void main()
{
  ivec2 last = textureSize(depths, 0) - ivec2(1);
  ivec2 place = ivec2(texCoord * vec2(last + ivec2(1)));
  float depth = texelFetch(depths, place, 0).r;
  float here = depth < 1.0 ? distanceAt(depth) : 3.4e38;
  int side = int(1.5 * pixelScale + 0.5);
  int corner = int(1.06 * pixelScale + 0.5);
  int before = 0;
  float farthest = -1.0;
  ivec2 source = place;
  for (int i = 0; i < neighbors; ++i)
  {
    int way = 1 - 2 * (i & 1);
    ivec2 along = (i & 2) == 0 ? ivec2(1, 0) : ivec2(0, 1);
    ivec2 other = place + (i < 4 ? side * way * along : corner * ivec2(way, 1 - (i & 2)));
    float depthThere = depthAt(other, last);
    float there = distanceAt(depthThere);
    float gap = max(3.0 * pixelScale * pixelAt(there), noise.x + noise.y * there);
    if (depthThere < depth && here - there > gap)
    {
      ++before;
      source = depthThere > farthest ? other : source;
      farthest = max(farthest, depthThere);
    }
    if (before + neighbors - 1 - i < enough)
    {
      break;
    }
  }
  bool fills = before >= enough;
  gl_FragDepth = fills ? farthest : depth;
  gl_FragData[0] = texelFetch(colors, fills ? clamp(source, ivec2(0), last) : place, 0);
}
)";

/// Colours and depths as they are, or spread over more pixels.
constexpr const char* kCopyShader = R"(
uniform float samples; // that the colours are the sum of

void main()
{
  ivec2 place = ivec2(texCoord * vec2(textureSize(depths, 0)));
  gl_FragDepth = texelFetch(depths, place, 0).r;
  gl_FragData[0] = texture(colors, texCoord) / samples;
}
)";

/// Depths along a line over a plane are even: only what bends towards the viewer on both sides is dark.
constexpr const char* kShade = R"(
uniform float strength;
uniform float minimumLightness;

float shadeAt(ivec2 place, ivec2 last, float depth)
{
  float here = distanceAt(depth);
  float slope = isParallel != 0 ? clipping.y - clipping.x
                                : here * here * (clipping.y - clipping.x) / (clipping.x * clipping.y);
  float pixel = pixelAt(here) * pixelScale;
  float rough = (noise.x + noise.y * here) / pixel;
  float radii[3] = float[3](2.0, 5.0, 12.0);
  float weights[3] = float[3](0.075, 0.0875, 0.0875);
  float sum = 0.0;
  for (int ring = 0; ring < 3; ++ring)
  {
    float radius = radii[ring];
    float perRadius = slope / (pixel * radius);
    float least = 0.15 + rough / radius;
    int side = int(radius * pixelScale + 0.5);
    int corner = int(0.7071 * radius * pixelScale + 0.5);
    ivec2 steps[4] = ivec2[4](ivec2(side, 0), ivec2(0, side), ivec2(corner, corner), ivec2(-corner, corner));
    float part = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      float one = depthAt(place + steps[i], last);
      float other = depthAt(place - steps[i], last);
      if (one < 1.0 && other < 1.0)
      {
        float bend = clamp((depth - one) * perRadius, -3.0, 3.0) + clamp((depth - other) * perRadius, -3.0, 3.0);
        part += clamp(0.5 * bend - least, 0.0, 1.0);
      }
    }
    sum += weights[ring] * part;
  }
  return max(minimumLightness, exp(-strength * sum));
}
)";

/// Of the pixels that something is drawn in, over what kCopyShader left: their depths are tested before, so
/// that a software renderer works on no others.
constexpr const char* kShadeShader = R"(
void main()
{
  ivec2 last = textureSize(depths, 0) - ivec2(1);
  ivec2 place = ivec2(texCoord * vec2(last + ivec2(1)));
  vec4 color = texelFetch(colors, place, 0);
  color.rgb *= shadeAt(place, last, texelFetch(depths, place, 0).r);
  gl_FragData[0] = color;
}
)";

} // namespace pointhaptics
