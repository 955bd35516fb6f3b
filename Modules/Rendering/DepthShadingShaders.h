/// @file
/// The fragment shaders of vtkDepthShadingPass, which alone includes this.
#pragma once

namespace pointhaptics
{

/// Declarations in front of each of the other shaders.
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

/// Depth of the farthest pixel of each tile.
constexpr const char* kTileShader = R"(
void main()
{
  ivec2 size = textureSize(depths, 0);
  ivec2 first = 8 * ivec2(texCoord * vec2((size + ivec2(7)) / 8));
  float farthest = 0.0;
  for (int i = 0; i < 64; ++i)
  {
    farthest = max(farthest, depthAt(first + ivec2(i % 8, i / 8), size - ivec2(1)));
  }
  gl_FragData[0] = vec4(farthest);
}
)";

/// Divides weighted sums by their weights. The colours' alpha is 1 where a splat is in the middle of the
/// pixel; where a splat only comes near, it makes the rim smooth on what lies behind, without a depth.
constexpr const char* kDivideShader = R"(
void main()
{
  ivec2 place = ivec2(texCoord * vec2(textureSize(depths, 0)));
  vec4 sum = texelFetch(colors, place, 0);
  vec2 weight = texelFetch(depths, place, 0).rg; // and depths times them
  if (weight.r <= 0.0) { discard; }
  gl_FragDepth = sum.a < 1.0 ? 1.0 : clamp(weight.g / weight.r, 0.0, 1.0);
  gl_FragData[0] = vec4(sum.rgb / weight.r, sum.a);
}
)";

/// Copies colours and depths as they are, or spreads them over more pixels.
constexpr const char* kCopyShader = R"(
void main()
{
  ivec2 place = ivec2(texCoord * vec2(textureSize(depths, 0)));
  gl_FragDepth = texelFetch(depths, place, 0).r;
  gl_FragData[0] = texture(colors, texCoord);
}
)";

/// Shades a pixel. Depths along a line over a plane are even: only places that bend towards the viewer on
/// both sides are dark.
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

/// Shades the pixels that something is drawn in, over the result of kCopyShader. Their depths are tested
/// before, so that a software renderer works on no others.
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
