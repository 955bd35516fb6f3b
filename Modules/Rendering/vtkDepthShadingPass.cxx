#include "vtkDepthShadingPass.h"

#include "PictureState.h"

#include "vtkActor2D.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtk_glew.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

/// Sizes are pixels of a window of 800 lines; pixelScale makes them those of this one.
constexpr double kUsualHeight = 800.0;

constexpr const char* kCommon = R"(//VTK::System::Dec
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

/// A pixel that lies behind nearly all around it is a hole between splats.
constexpr const char* kFillShader = R"(
const int enough = 6;
void main()
{
  ivec2 last = textureSize(depths, 0) - ivec2(1);
  ivec2 place = ivec2(texCoord * vec2(last + ivec2(1)));
  float depth = texelFetch(depths, place, 0).r;
  float here = depth < 1.0 ? distanceAt(depth) : 3.4e38;
  int side = int(1.5 * pixelScale + 0.5);
  int corner = int(1.06 * pixelScale + 0.5);
  ivec2 steps[8] = ivec2[8](ivec2(side, 0), ivec2(-side, 0), ivec2(0, side), ivec2(0, -side),
    ivec2(corner, corner), ivec2(-corner, corner), ivec2(corner, -corner), ivec2(-corner, -corner));
  int before = 0;
  float farthest = -1.0;
  ivec2 source = place;
  for (int i = 0; i < 8; ++i)
  {
    float other = depthAt(place + steps[i], last);
    if (other < depth)
    {
      float there = distanceAt(other);
      float pixel = pixelAt(there);
      if (here - there > max(3.0 * pixelScale * pixel, noise.x + noise.y * there))
      {
        ++before;
        if (other > farthest)
        {
          farthest = other;
          source = place + steps[i];
        }
      }
    }
    if (before + 7 - i < enough)
    {
      break;
    }
  }
  bool fills = before >= enough;
  gl_FragDepth = fills ? farthest : depth;
  gl_FragData[0] = texelFetch(colors, fills ? clamp(source, ivec2(0), last) : place, 0);
}
)";

/// Depths along a line over a plane are even: only what bends towards the viewer on both sides is dark.
constexpr const char* kShadeShader = R"(
uniform float strength;
uniform float minimumLightness;
uniform int isShaded;

void main()
{
  ivec2 last = textureSize(depths, 0) - ivec2(1);
  ivec2 place = ivec2(texCoord * vec2(last + ivec2(1)));
  float depth = texelFetch(depths, place, 0).r;
  vec4 color = texelFetch(colors, place, 0);
  gl_FragDepth = depth;
  if (depth < 1.0 && isShaded == 0)
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
    color.rgb *= max(minimumLightness, exp(-strength * sum));
  }
  gl_FragData[0] = color;
}
)";

/// The end of a clipping range, outward to a step: four steps double it.
double clippingStep(double distance, bool isNear)
{
  constexpr double kStepsPerDoubling = 4.0;
  constexpr double kOnStep = 1e-6; // a step stays where it is
  const double at = kStepsPerDoubling * std::log2(distance);
  const double step = isNear ? std::floor(at + kOnStep) : std::ceil(at - kOnStep);
  return std::exp2(step / kStepsPerDoubling);
}

/// Shades depend on depths, and their last bits on the clipping range, which follows all that is in the scene
/// and is reset before most frames: in steps, an equal view has an equal picture.
void setClippingRangeToSteps(vtkCamera* camera)
{
  const double* range = camera->GetClippingRange();
  if (range[0] > 0.0 && std::isfinite(range[1]))
  {
    camera->SetClippingRange(clippingStep(range[0], true), clippingStep(range[1], false));
  }
}

} // namespace

vtkStandardNewMacro(vtkDepthShadingPass);

vtkDepthShadingPass::vtkDepthShadingPass() = default;
vtkDepthShadingPass::~vtkDepthShadingPass() = default;

void vtkDepthShadingPass::PrepareTargets(vtkOpenGLRenderWindow* window)
{
  if (!this->Frame)
  {
    this->Frame = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->Frame->SetContext(window);
    this->Colors = vtkSmartPointer<vtkTextureObject>::New();
    this->Colors->SetContext(window);
    this->Depths = vtkSmartPointer<vtkTextureObject>::New();
    this->Depths->SetContext(window);
    this->FilledFrame = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
    this->FilledFrame->SetContext(window);
    this->FilledColors = vtkSmartPointer<vtkTextureObject>::New();
    this->FilledColors->SetContext(window);
    this->FilledDepths = vtkSmartPointer<vtkTextureObject>::New();
    this->FilledDepths->SetContext(window);
    this->Kept.clear();
  }
  const auto width = static_cast<unsigned int>(this->W);
  const auto height = static_cast<unsigned int>(this->H);
  if (this->Colors->GetWidth() != width || this->Colors->GetHeight() != height)
  {
    this->Colors->Create2D(width, height, 4, VTK_UNSIGNED_CHAR, false);
    this->Depths->AllocateDepth(width, height, vtkTextureObject::Float32);
    this->FilledColors->Create2D(width, height, 4, VTK_UNSIGNED_CHAR, false);
    this->FilledDepths->AllocateDepth(width, height, vtkTextureObject::Float32);
    this->Kept.clear();
  }
}

void vtkDepthShadingPass::Render(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!this->DelegatePass || !window)
  {
    vtkErrorMacro("Nothing can be shaded without a delegate pass and an OpenGL window; give a vtkCameraPass "
                  "to SetDelegatePass() and add the renderer to a window.");
    return;
  }
  this->ReadWindowSize(state);
  this->W = this->Width;
  this->H = this->Height;
  this->PrepareTargets(window);
  setClippingRangeToSteps(renderer->GetActiveCamera());

  std::vector<double> wanted = pointhaptics::pictureState(renderer);
  const std::array<double, 5> numbers = { this->NoiseLength, this->NoisePerDistance, this->Strength,
    this->MinimumLightness, this->FillsPinholes ? 1.0 : 0.0 };
  const bool sameShades = numbers == this->KeptNumbers;
  if (wanted != this->Kept || !sameShades || renderer->GetSelector())
  {
    window->GetState()->PushFramebufferBindings();
    this->Frame->Bind();
    this->RenderDelegate(
      state, this->Width, this->Height, this->W, this->H, this->Frame, this->Colors, this->Depths);
    this->FillPinholes(renderer, window);
    window->GetState()->PopFramebufferBindings();
    this->KeptNumbers = numbers;
    this->Kept = renderer->GetSelector() ? std::vector<double>() : std::move(wanted);
    this->KeptIsShaded = false;
    ++this->NumberOfPictures;
    this->Shade(renderer, window);
    return;
  }
  // Text makes its image where it has nothing to draw yet.
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    if (auto* text = vtkActor2D::SafeDownCast(state->GetPropArray()[i]))
    {
      text->RenderOpaqueGeometry(renderer);
    }
  }
  this->Shade(renderer, window);
  if (!this->KeptIsShaded)
  {
    // The first of a row of equal pictures: from now on it need not be shaded either.
    int width = 0;
    int height = 0;
    int x = 0;
    int y = 0;
    renderer->GetTiledSizeAndOrigin(&width, &height, &x, &y);
    this->Colors->CopyFromFrameBuffer(x, y, 0, 0, width, height);
    this->KeptIsShaded = true;
  }
}

/// Makes @p quad draw with @p fragment over the whole of the target that is bound. False: it cannot be built.
bool vtkDepthShadingPass::PrepareQuad(
  std::unique_ptr<vtkOpenGLQuadHelper>& quad, const char* fragment, vtkOpenGLRenderWindow* window)
{
  if (!quad)
  {
    const std::string source = std::string(kCommon) + fragment;
    quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, source.c_str(), "");
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(quad->Program);
  }
  if (!quad->Program || !quad->Program->GetCompiled())
  {
    vtkErrorMacro(
      "The shader could not be built, so nothing is drawn; update the graphics driver to one with "
      "OpenGL 3.2.");
    return false;
  }
  return true;
}

void vtkDepthShadingPass::SetUniforms(
  vtkShaderProgram* program, vtkTextureObject* colors, vtkTextureObject* depths, vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double* range = camera->GetClippingRange();
  const float clipping[2] = { static_cast<float>(range[0]), static_cast<float>(range[1]) };
  const float noise[2] = { static_cast<float>(this->NoiseLength),
    static_cast<float>(this->NoisePerDistance) };
  const bool isParallel = camera->GetParallelProjection() != 0;
  const double height = isParallel
    ? 2.0 * camera->GetParallelScale()
    : 2.0 * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
  colors->Activate();
  depths->Activate();
  program->SetUniformi("colors", colors->GetTextureUnit());
  program->SetUniformi("depths", depths->GetTextureUnit());
  program->SetUniform2f("clipping", clipping);
  program->SetUniformi("isParallel", isParallel ? 1 : 0);
  program->SetUniformf("pixelSize", static_cast<float>(height / std::max(1, this->Height)));
  program->SetUniformf("pixelScale", static_cast<float>(std::max(0.5, this->Height / kUsualHeight)));
  program->SetUniform2f("noise", noise);
}

/// From the delegate's picture to that without holes.
void vtkDepthShadingPass::FillPinholes(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  if (!this->FillsPinholes || !this->PrepareQuad(this->FillQuad, kFillShader, window))
  {
    return;
  }
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  this->FilledFrame->Bind();
  this->FilledFrame->AddColorAttachment(0, this->FilledColors);
  this->FilledFrame->AddDepthAttachment(this->FilledDepths);
  this->FilledFrame->ActivateDrawBuffer(0);
  this->FilledFrame->StartNonOrtho(this->Width, this->Height);
  state->vtkglViewport(0, 0, this->Width, this->Height);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_SCISSOR_TEST);
  this->SetUniforms(this->FillQuad->Program, this->Colors, this->Depths, renderer);
  this->FillQuad->Render();
  this->Depths->Deactivate();
  this->Colors->Deactivate();
  state->vtkglDepthFunc(GL_LEQUAL);
}

void vtkDepthShadingPass::Shade(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  if (!this->PrepareQuad(this->Quad, kShadeShader, window))
  {
    return;
  }
  vtkShaderProgram* program = this->Quad->Program;
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  int width = 0;
  int height = 0;
  int x = 0;
  int y = 0;
  renderer->GetTiledSizeAndOrigin(&width, &height, &x, &y);
  state->vtkglViewport(x, y, width, height);
  state->vtkglScissor(x, y, width, height);
  // Depths are written only where they are tested.
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDisable(GL_BLEND);

  vtkTextureObject* colors = this->FillsPinholes && !this->KeptIsShaded ? this->FilledColors : this->Colors;
  vtkTextureObject* depths = this->FillsPinholes ? this->FilledDepths : this->Depths;
  this->SetUniforms(program, colors, depths, renderer);
  program->SetUniformi("isShaded", this->KeptIsShaded ? 1 : 0);
  program->SetUniformf("strength", static_cast<float>(this->Strength));
  program->SetUniformf("minimumLightness", static_cast<float>(this->MinimumLightness));
  this->Quad->Render();
  depths->Deactivate();
  colors->Deactivate();
  state->vtkglDepthFunc(GL_LEQUAL);
}

void vtkDepthShadingPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Quad.reset();
  this->FillQuad.reset();
  if (this->Frame)
  {
    this->Frame->ReleaseGraphicsResources(window);
    this->Colors->ReleaseGraphicsResources(window);
    this->Depths->ReleaseGraphicsResources(window);
    this->FilledFrame->ReleaseGraphicsResources(window);
    this->FilledColors->ReleaseGraphicsResources(window);
    this->FilledDepths->ReleaseGraphicsResources(window);
    this->FilledFrame = nullptr;
    this->FilledColors = nullptr;
    this->FilledDepths = nullptr;
    this->Frame = nullptr;
    this->Colors = nullptr;
    this->Depths = nullptr;
  }
  this->Kept.clear();
}

void vtkDepthShadingPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NoiseLength: " << this->NoiseLength << "\n";
  os << indent << "NoisePerDistance: " << this->NoisePerDistance << "\n";
  os << indent << "Strength: " << this->Strength << "\n";
  os << indent << "FillsPinholes: " << this->FillsPinholes << "\n";
  os << indent << "MinimumLightness: " << this->MinimumLightness << "\n";
  os << indent << "NumberOfPictures: " << this->NumberOfPictures << "\n";
}
