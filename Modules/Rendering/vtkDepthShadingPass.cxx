#include "vtkDepthShadingPass.h"

#include "DepthShadingShaders.h"
#include "DrawPace.h"
#include "PictureState.h"

#include "vtkActor2D.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderUtilities.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtk_glew.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace
{

/// Sizes are pixels of a window of 800 lines; pixelScale makes them those of this one.
constexpr double kUsualHeight = 800.0;

/// From the middle of a pixel, in pixels: no two in a row or column.
constexpr double kSamples[vtkDepthShadingPass::kMostSamples][2] = { { 0.0, 0.0 }, { 0.125, 0.375 },
  { -0.375, 0.125 }, { -0.125, -0.375 }, { 0.375, -0.125 } };

/// The end of a clipping range, outward to a step: four steps double it.
double clippingStep(double distance, bool isNear)
{
  constexpr double kStepsPerDoubling = 4.0;
  constexpr double kOnStep = 1e-6; // a step stays where it is
  const double at = kStepsPerDoubling * std::log2(distance);
  const double step = isNear ? std::floor(at + kOnStep) : std::ceil(at - kOnStep);
  return std::exp2(step / kStepsPerDoubling);
}

/// All of @p frame is drawn, into these; @p depths may be null.
void drawInto(vtkOpenGLFramebufferObject* frame, vtkTextureObject* colors, vtkTextureObject* depths,
  vtkOpenGLState* state)
{
  const int width = int(colors->GetWidth());
  const int height = int(colors->GetHeight());
  frame->Bind();
  frame->AddColorAttachment(0, colors);
  if (depths)
  {
    frame->AddDepthAttachment(depths);
  }
  frame->ActivateDrawBuffer(0);
  frame->StartNonOrtho(width, height);
  state->vtkglViewport(0, 0, width, height);
  state->vtkglDisable(GL_SCISSOR_TEST);
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

/// Text makes its image where it has nothing to draw yet.
void makeTextImages(const vtkRenderState* state)
{
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    if (auto* text = vtkActor2D::SafeDownCast(state->GetPropArray()[i]))
    {
      text->RenderOpaqueGeometry(state->GetRenderer());
    }
  }
}

} // namespace

vtkStandardNewMacro(vtkDepthShadingPass);

vtkDepthShadingPass::vtkDepthShadingPass() = default;
vtkDepthShadingPass::~vtkDepthShadingPass() = default;

vtkDepthShadingPass* vtkDepthShadingPass::GetPassOf(vtkRenderer* renderer)
{
  auto* sequence = vtkSequencePass::SafeDownCast(renderer->GetPass());
  return sequence && sequence->GetPasses()->GetNumberOfItems() > 0
    ? vtkDepthShadingPass::SafeDownCast(sequence->GetPasses()->GetItemAsObject(0))
    : nullptr;
}

double vtkDepthShadingPass::ResolutionOf(vtkRenderer* renderer)
{
  const vtkDepthShadingPass* pass = GetPassOf(renderer);
  return pass ? pass->Resolution : 1.0;
}

void vtkDepthShadingPass::ChooseResolution(const vtkRenderState* state, vtkOpenGLRenderWindow* window)
{
  this->ReadWindowSize(state);
  const double pixels = double(this->Width) * this->Height;
  const bool isReduced = this->IsMoving && !state->GetRenderer()->GetSelector() &&
    pixels > kMostMovingPixels && pointhaptics::DrawPace::of(window).isNeeded();
  this->Resolution = isReduced ? std::sqrt(kMostMovingPixels / pixels) : 1.0;
  this->W = std::max(1, int(this->Resolution * this->Width));
  this->H = std::max(1, int(this->Resolution * this->Height));
}

void vtkDepthShadingPass::PrepareTargets(vtkOpenGLRenderWindow* window)
{
  if (!this->Frame)
  {
    for (auto* frame : { &this->Frame, &this->FilledFrame, &this->SumFrame })
    {
      *frame = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
      (*frame)->SetContext(window);
    }
    for (auto* texture : { &this->Colors, &this->Depths, &this->FilledColors, &this->FilledDepths, &this->Sum,
           &this->FirstDepths })
    {
      *texture = vtkSmartPointer<vtkTextureObject>::New();
      (*texture)->SetContext(window);
    }
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

/// With textures of its own: else each eye's picture would take the place of the other's, and none be kept.
void vtkDepthShadingPass::RenderRightEye(const vtkRenderState* state)
{
  if (!this->RightEye)
  {
    this->RightEye = vtkSmartPointer<vtkDepthShadingPass>::New();
  }
  vtkDepthShadingPass* right = this->RightEye;
  right->SetDelegatePass(this->DelegatePass);
  right->SetNoiseLength(this->NoiseLength);
  right->SetNoisePerDistance(this->NoisePerDistance);
  right->SetStrength(this->Strength);
  right->SetMinimumLightness(this->MinimumLightness);
  right->SetFillsPinholes(this->FillsPinholes);
  right->SetIsMoving(this->IsMoving);
  right->IsRightEye = true;
  right->AddSamples(std::exchange(this->SamplesToAddRight, 0));
  const vtkTypeUInt64 before = right->NumberOfPictures;
  right->Render(state);
  this->NumberOfPictures += right->NumberOfPictures - before;
  this->NumberOfRenderedProps = right->GetNumberOfRenderedProps();
}

void vtkDepthShadingPass::Render(const vtkRenderState* state)
{
  vtkRenderer* renderer = state->GetRenderer();
  vtkRenderWindow* window = renderer->GetRenderWindow();
  const bool isRight = window && window->GetStereoRender() && !renderer->GetActiveCamera()->GetLeftEye();
  if (isRight && !this->IsRightEye)
  {
    this->RenderRightEye(state);
  }
  else
  {
    this->RenderEye(state);
  }
}

void vtkDepthShadingPass::RenderEye(const vtkRenderState* state)
{
  this->NumberOfRenderedProps = 0;
  const int samplesToAdd = std::exchange(this->SamplesToAdd, 0);
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!this->DelegatePass || !window)
  {
    vtkErrorMacro("Nothing can be shaded without a delegate pass and an OpenGL window; give a vtkCameraPass "
                  "to SetDelegatePass() and add the renderer to a window.");
    return;
  }
  this->ChooseResolution(state, window);
  this->PrepareTargets(window);
  setClippingRangeToSteps(renderer->GetActiveCamera());

  std::vector<double> wanted = pointhaptics::pictureState(renderer);
  const std::array<double, 6> numbers = { this->NoiseLength, this->NoisePerDistance, this->Strength,
    this->MinimumLightness, this->FillsPinholes ? 1.0 : 0.0, this->Resolution };
  const bool sameShades = numbers == this->KeptNumbers;
  const bool isNew = wanted != this->Kept || !sameShades || renderer->GetSelector();
  if (isNew)
  {
    this->NumberOfSamples = 1;
    this->DrawSample(state, window);
    if (window->GetAbortRender())
    {
      this->ForgetPicture();
      return;
    }
    this->KeptNumbers = numbers;
    this->Kept = renderer->GetSelector() ? std::vector<double>() : std::move(wanted);
    ++this->NumberOfPictures;
    if (this->Resolution < 1.0)
    {
      this->ShadeKept(renderer, window);
    }
  }
  else
  {
    makeTextImages(state);
  }
  if (!renderer->GetSelector() && this->Resolution == 1.0)
  {
    this->DrawSamples(state, window, samplesToAdd);
  }
  if (window->GetAbortRender())
  {
    return; // nobody sees it
  }
  this->Show(renderer, window);
  if (!isNew && this->NumberOfSamples == 1 && !this->KeptIsShaded)
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

void vtkDepthShadingPass::DrawSample(const vtkRenderState* state, vtkOpenGLRenderWindow* window)
{
  this->KeptIsShaded = false;
  window->GetState()->PushFramebufferBindings();
  this->Frame->Bind();
  this->RenderDelegate(state, this->W, this->H, this->W, this->H, this->Frame, this->Colors, this->Depths);
  this->FillPinholes(state->GetRenderer(), window);
  window->GetState()->PopFramebufferBindings();
}

/// @p count samples more of the picture that was drawn last.
void vtkDepthShadingPass::DrawSamples(const vtkRenderState* state, vtkOpenGLRenderWindow* window, int count)
{
  const int end = std::min(kMostSamples, this->NumberOfSamples + count);
  if (this->NumberOfSamples >= end)
  {
    return;
  }
  vtkCamera* camera = state->GetRenderer()->GetActiveCamera();
  double center[2];
  camera->GetWindowCenter(center);
  if (this->NumberOfSamples == 1)
  {
    this->AddToSum(state->GetRenderer(), window);
    // What is picked by depth is picked where the pixel's middle shows it.
    std::swap(this->FirstDepths, this->FillsPinholes ? this->FilledDepths : this->Depths);
    vtkTextureObject* spare = this->FillsPinholes ? this->FilledDepths : this->Depths;
    if (spare->GetWidth() != unsigned(this->W) || spare->GetHeight() != unsigned(this->H))
    {
      spare->AllocateDepth(unsigned(this->W), unsigned(this->H), vtkTextureObject::Float32);
    }
  }
  while (this->NumberOfSamples < end)
  {
    const double* offset = kSamples[this->NumberOfSamples];
    camera->SetWindowCenter(
      center[0] + 2.0 * offset[0] / this->Width, center[1] + 2.0 * offset[1] / this->Height);
    this->DrawSample(state, window);
    if (window->GetAbortRender())
    {
      break;
    }
    ++this->NumberOfSamples;
    this->AddToSum(state->GetRenderer(), window);
  }
  camera->SetWindowCenter(center[0], center[1]);
  if (window->GetAbortRender() && this->NumberOfSamples == 1)
  {
    this->ForgetPicture(); // what was drawn lies over it
  }
}

/// The next frame draws all anew.
void vtkDepthShadingPass::ForgetPicture()
{
  this->Kept.clear();
  this->NumberOfSamples = 0;
}

/// Shades the picture that was drawn last, at its own resolution.
void vtkDepthShadingPass::ShadeKept(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  {
    vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
    vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
    vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
    // Into the textures that are not shown, which are of no use any more.
    this->FillsPinholes ? drawInto(this->Frame, this->Colors, this->Depths, state)
                        : drawInto(this->FilledFrame, this->FilledColors, this->FilledDepths, state);
    this->DrawPicture(this->ShownColors(), this->ShownDepths(), 1, renderer, window);
  }
  state->PopFramebufferBindings();
  if (!this->FillsPinholes)
  {
    std::swap(this->Colors, this->FilledColors);
  }
  this->KeptIsShaded = true;
}

/// Adds the sample that was drawn last, shaded. The first one begins the sum. Each counts as the bytes it has
/// alone, so that the picture does not depend on which frames its samples were drawn in.
void vtkDepthShadingPass::AddToSum(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  if (this->Sum->GetWidth() != unsigned(this->W) || this->Sum->GetHeight() != unsigned(this->H))
  {
    this->Sum->Create2D(unsigned(this->W), unsigned(this->H), 4, VTK_FLOAT, false);
  }
  if (!this->KeptIsShaded)
  {
    this->ShadeKept(renderer, window);
  }
  if (!this->PrepareQuad(this->CopyQuad, pointhaptics::kCopyShader, window))
  {
    return;
  }
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  {
    vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
    vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
    vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
    vtkOpenGLState::ScopedglBlendFuncSeparate sum(state);
    drawInto(this->SumFrame, this->Sum, nullptr, state);
    state->vtkglDisable(GL_DEPTH_TEST);
    state->SetEnumState(GL_BLEND, this->NumberOfSamples > 1);
    state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
    this->CopyQuad->Program->SetUniformf("samples", 1.0F);
    this->Draw(*this->CopyQuad, this->ShownColors(), this->ShownDepths(), renderer);
  }
  state->PopFramebufferBindings();
}

/// Makes @p quad draw with @p fragment over the whole of the target that is bound; at the largest depth if it
/// @p isBehindAll. False: it cannot be built.
bool vtkDepthShadingPass::PrepareQuad(std::unique_ptr<vtkOpenGLQuadHelper>& quad, const std::string& fragment,
  vtkOpenGLRenderWindow* window, bool isBehindAll)
{
  if (!quad)
  {
    std::string vertex = vtkOpenGLRenderUtilities::GetFullScreenQuadVertexShader();
    if (isBehindAll)
    {
      vtkShaderProgram::Substitute(
        vertex, "gl_Position = ndCoordIn;", "gl_Position = vec4(ndCoordIn.xy, 1.0, 1.0);");
    }
    const std::string source = pointhaptics::kDepthCommon + fragment;
    quad = std::make_unique<vtkOpenGLQuadHelper>(window, vertex.c_str(), source.c_str(), "");
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
  program->SetUniformf("pixelSize", static_cast<float>(height / std::max(1, this->H)));
  program->SetUniformf(
    "pixelScale", static_cast<float>(std::max(0.5 * this->Resolution, this->H / kUsualHeight)));
  program->SetUniform2f("noise", noise);
}

/// From the delegate's picture to that without holes.
void vtkDepthShadingPass::FillPinholes(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  if (!this->FillsPinholes || !this->PrepareQuad(this->FillQuad, pointhaptics::kPinholeShader, window))
  {
    return;
  }
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  drawInto(this->FilledFrame, this->FilledColors, this->FilledDepths, state);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDisable(GL_BLEND);
  this->FillQuad->Program->SetUniformi("neighbors", 8);
  this->Draw(*this->FillQuad, this->Colors, this->Depths, renderer);
  state->vtkglDepthFunc(GL_LEQUAL);
}

/// Of the picture that is shown: filled, or after it was kept as it is.
vtkTextureObject* vtkDepthShadingPass::ShownColors()
{
  return this->FillsPinholes && !this->KeptIsShaded ? this->FilledColors : this->Colors;
}

vtkTextureObject* vtkDepthShadingPass::ShownDepths()
{
  return this->FillsPinholes ? this->FilledDepths : this->Depths;
}

void vtkDepthShadingPass::SetShade(vtkOpenGLQuadHelper& quad)
{
  quad.Program->SetUniformf("strength", static_cast<float>(this->Strength));
  quad.Program->SetUniformf("minimumLightness", static_cast<float>(this->MinimumLightness));
}

void vtkDepthShadingPass::Draw(
  vtkOpenGLQuadHelper& quad, vtkTextureObject* colors, vtkTextureObject* depths, vtkRenderer* renderer)
{
  this->SetUniforms(quad.Program, colors, depths, renderer);
  quad.Render();
  depths->Deactivate();
  colors->Deactivate();
}

/// Into the frame buffer.
void vtkDepthShadingPass::Show(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
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
  const bool isMean = this->NumberOfSamples > 1;
  this->DrawPicture(isMean ? this->Sum.Get() : this->ShownColors(),
    isMean ? this->FirstDepths.Get() : this->ShownDepths(), this->NumberOfSamples, renderer, window);
}

/// All over what is bound. @param colors the sum of @p samples samples, of which one is shaded if it is not.
void vtkDepthShadingPass::DrawPicture(vtkTextureObject* colors, vtkTextureObject* depths, int samples,
  vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  if (!this->PrepareQuad(this->CopyQuad, pointhaptics::kCopyShader, window))
  {
    return;
  }
  vtkOpenGLState* state = window->GetState();
  // Depths are written only where they are tested.
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDisable(GL_BLEND);
  colors->SetMagnificationFilter(
    this->Resolution < 1.0 ? vtkTextureObject::Linear : vtkTextureObject::Nearest);
  this->CopyQuad->Program->SetUniformf("samples", static_cast<float>(samples));
  this->Draw(*this->CopyQuad, colors, depths, renderer);
  if (samples == 1 && !this->KeptIsShaded &&
    this->PrepareQuad(
      this->ShadeQuad, std::string(pointhaptics::kShade) + pointhaptics::kShadeShader, window, true))
  {
    state->vtkglDepthMask(GL_FALSE);
    state->vtkglDepthFunc(GL_GREATER);
    this->SetShade(*this->ShadeQuad);
    this->Draw(*this->ShadeQuad, colors, depths, renderer);
    state->vtkglDepthMask(GL_TRUE);
  }
  state->vtkglDepthFunc(GL_LEQUAL);
}

void vtkDepthShadingPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  if (this->RightEye)
  {
    this->RightEye->ReleaseGraphicsResources(window);
  }
  for (auto* quad : { &this->FillQuad, &this->CopyQuad, &this->ShadeQuad })
  {
    quad->reset();
  }
  if (this->Frame)
  {
    for (auto* frame : { &this->Frame, &this->FilledFrame, &this->SumFrame })
    {
      (*frame)->ReleaseGraphicsResources(window);
      *frame = nullptr;
    }
    for (auto* texture : { &this->Colors, &this->Depths, &this->FilledColors, &this->FilledDepths, &this->Sum,
           &this->FirstDepths })
    {
      (*texture)->ReleaseGraphicsResources(window);
      *texture = nullptr;
    }
  }
  this->Kept.clear();
}

void vtkDepthShadingPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NoiseLength: " << this->NoiseLength << "\n";
  os << indent << "NoisePerDistance: " << this->NoisePerDistance << "\n";
  os << indent << "Strength: " << this->Strength << "\n";
  os << indent << "IsMoving: " << this->IsMoving << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "FillsPinholes: " << this->FillsPinholes << "\n";
  os << indent << "MinimumLightness: " << this->MinimumLightness << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "NumberOfPictures: " << this->NumberOfPictures << "\n";
}
