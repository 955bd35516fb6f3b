#include "vtkDepthShadingPass.h"

#include "ClippingSteps.h"
#include "DepthShadingShaders.h"
#include "DrawPace.h"
#include "PictureState.h"
#include "vtkSplatMapper.h"

#include "vtkActor.h"
#include "vtkActor2D.h"
#include "vtkCamera.h"
#include "vtkHardwareSelector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderUtilities.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkProperty.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkVolumeCollection.h"
#include "vtk_glew.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace
{

/// Height of the window for which sizes are given, pixels; pixelScale converts them to this one.
constexpr double kUsualHeight = 800.0;

/// Least resolution in motion; below it nothing is told apart.
constexpr double kLeastResolution = 0.3;

/// Format of the depths that are drawn into, as vtkTextureObject numbers it. @p takesCopies: false with a
/// stencil or several samples a pixel, whose bytes are others.
int depthFormatOfTarget(bool& takesCopies)
{
  const auto parameter = [](GLenum name)
  {
    GLint value = 0;
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, name, &value);
    return value;
  };
  GLint bound = 0;
  GLint samples = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glGetIntegerv(GL_SAMPLES, &samples);
  const bool hasDepths = bound != 0 && parameter(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE;
  const int bits = hasDepths ? parameter(GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE) : 0;
  takesCopies = bits >= 24 && samples == 0 && parameter(GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) == 0;
  const bool isFixed32 = bits == 32 && parameter(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) != GL_FLOAT;
  return bits == 24 ? vtkTextureObject::Fixed24
    : isFixed32     ? vtkTextureObject::Fixed32
                    : vtkTextureObject::Float32;
}

/// Volumes copy the depths of a picture to a texture of the window's format and size.
bool hasVolumes(vtkRenderer* renderer)
{
  return renderer->GetVolumes()->GetNumberOfItems() > 0;
}

/// Lets the next drawing overwrite colours and depths.
void overwriteAll(vtkOpenGLState* state)
{
  // Depths are written only where they are tested.
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDisable(GL_BLEND);
}

/// Draws over all of a frame buffer, until it is destroyed.
class DrawingInto
{
public:
  template <class Target>
  DrawingInto(const Target& target, vtkOpenGLState* state)
    : state_(state)
    , depthTest_(state, GL_DEPTH_TEST)
    , blend_(state, GL_BLEND)
    , scissor_(state, GL_SCISSOR_TEST)
  {
    const int width = int(target.Colors->GetWidth());
    const int height = int(target.Colors->GetHeight());
    target.Frame->Bind();
    target.Frame->AddColorAttachment(0, target.Colors);
    target.Frame->AddDepthAttachment(target.Depths);
    target.Frame->ActivateDrawBuffer(0);
    target.Frame->StartNonOrtho(width, height);
    state->vtkglViewport(0, 0, width, height);
    state->vtkglDisable(GL_SCISSOR_TEST);
    overwriteAll(state);
  }
  ~DrawingInto()
  {
    state_->vtkglDepthMask(GL_TRUE);
    state_->vtkglDepthFunc(GL_LEQUAL);
  }
  DrawingInto(const DrawingInto&) = delete;
  DrawingInto& operator=(const DrawingInto&) = delete;

private:
  vtkOpenGLState* state_;
  vtkOpenGLState::ScopedglEnableDisable depthTest_;
  vtkOpenGLState::ScopedglEnableDisable blend_;
  vtkOpenGLState::ScopedglEnableDisable scissor_;
};

/// Lets texts make their images: they do so where they have nothing to draw yet.
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

vtkDepthShadingPass::Stage vtkDepthShadingPass::StageOf(vtkRenderer* renderer)
{
  const vtkDepthShadingPass* pass = GetPassOf(renderer);
  return pass ? pass->DrawnStage : Stage::Picture;
}

vtkTextureObject* vtkDepthShadingPass::TilesOf(vtkRenderer* renderer)
{
  const vtkDepthShadingPass* pass = GetPassOf(renderer);
  return pass ? pass->DrawnTiles : nullptr;
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
  const bool isReduced =
    this->IsMoving && pointhaptics::DrawPace::of(window).isNeeded() && !hasVolumes(state->GetRenderer());
  const double part = std::min(
    { 1.0, kMostMovingPixels / pixels, kMostMovingFragments / std::max(1.0, this->MovingFragments) });
  this->Resolution = isReduced ? std::max(kLeastResolution, std::sqrt(part)) : 1.0;
  this->W = std::max(1, int(this->Resolution * this->Width));
  this->H = std::max(1, int(this->Resolution * this->Height));
}

void vtkDepthShadingPass::PrepareTargets(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  const int format = depthFormatOfTarget(this->WindowTakesCopies);
  const auto prepare = [&](Target& target, int type, int depthFormat, int pixel = 1)
  {
    const auto width = static_cast<unsigned int>((this->W + pixel - 1) / pixel);
    const auto height = static_cast<unsigned int>((this->H + pixel - 1) / pixel);
    if (!target.Frame)
    {
      target.Frame = vtkSmartPointer<vtkOpenGLFramebufferObject>::New();
      target.Frame->SetContext(window);
      for (auto* texture : { &target.Colors, &target.Depths })
      {
        *texture = vtkSmartPointer<vtkTextureObject>::New();
        (*texture)->SetContext(window);
      }
    }
    if (target.Colors->GetWidth() != width || target.Colors->GetHeight() != height)
    {
      target.Colors->Create2D(width, height, 4, type, false);
      depthFormat < 0 ? target.Depths->Create2D(width, height, 2, type, false)
                      : target.Depths->AllocateDepth(width, height, depthFormat);
      this->Kept.clear();
    }
  };
  const int drawnFormat = hasVolumes(renderer) ? format : int(vtkTextureObject::Float32);
  if (format != this->ShownFormat || drawnFormat != this->DrawnFormat)
  {
    this->Drawn = this->Shown = Target();
    this->ShownFormat = format;
    this->DrawnFormat = drawnFormat;
  }
  prepare(this->Drawn, VTK_UNSIGNED_CHAR, drawnFormat);
  prepare(this->Shown, VTK_UNSIGNED_CHAR, format);
  if (this->BlendsSplats)
  {
    prepare(this->Sums, VTK_FLOAT, -1);
    prepare(this->Tiles, VTK_FLOAT, vtkTextureObject::Float32, kTile);
  }
}

/// Renders the right eye with textures of its own: else each eye's picture would replace the other's, and
/// none would be kept.
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
  right->SetBlendsSplats(this->BlendsSplats);
  right->SetIsMoving(this->IsMoving);
  right->SetMovingFragments(this->MovingFragments);
  right->IsRightEye = true;
  const vtkTypeUInt64 before = right->NumberOfPictures;
  right->Render(state);
  this->NumberOfPictures += right->NumberOfPictures - before;
  this->NumberOfRenderedProps = right->GetNumberOfRenderedProps();
}

void vtkDepthShadingPass::Render(const vtkRenderState* state)
{
  vtkRenderer* renderer = state->GetRenderer();
  if (vtkHardwareSelector* selector = renderer->GetSelector())
  {
    // Selectors draw ids with their own Render(), which the renderer calls only where it has no pass.
    renderer->GetActiveCamera()->Render(renderer);
    this->NumberOfRenderedProps =
      selector->Render(renderer, state->GetPropArray(), state->GetPropArrayCount());
    return;
  }
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
  vtkRenderer* renderer = state->GetRenderer();
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!this->DelegatePass || !window)
  {
    vtkErrorMacro("Nothing can be shaded without a delegate pass and an OpenGL window; give a vtkCameraPass "
                  "to SetDelegatePass() and add the renderer to a window.");
    return;
  }
  this->ChooseResolution(state, window);
  this->PrepareTargets(renderer, window);
  pointhaptics::setClippingRangeToSteps(renderer->GetActiveCamera());

  std::vector<double> wanted = pointhaptics::pictureState(renderer);
  wanted.insert(wanted.end(),
    { this->NoiseLength, this->NoisePerDistance, this->Strength, this->MinimumLightness, this->Resolution,
      double(this->BlendsSplats) });
  if (wanted != this->Kept)
  {
    this->Kept.clear();
    this->DrawPicture(state, window);
    if (window->GetAbortRender())
    {
      return; // nobody sees it
    }
    this->Shade(renderer, window);
    this->Kept = std::move(wanted);
    this->FromShown->DeepCopy(renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
      renderer->GetTiledAspectRatio(), -1.0, 1.0));
    this->FromShown->Invert();
    ++this->NumberOfPictures;
  }
  else
  {
    makeTextImages(state);
  }
  this->Show(renderer, window);
}

/// Draws the picture of the delegate, before it is shaded.
void vtkDepthShadingPass::DrawPicture(const vtkRenderState* state, vtkOpenGLRenderWindow* window)
{
  window->GetState()->PushFramebufferBindings();
  Target& drawn = this->Drawn;
  drawn.Frame->Bind();
  // The right eye's pass is asked by none: its stage is the left one's, which stands at the renderer.
  vtkDepthShadingPass* asked = GetPassOf(state->GetRenderer());
  asked = asked ? asked : this;
  asked->DrawnStage = this->BlendsSplats ? Stage::Depths : Stage::Picture;
  this->RenderDelegate(state, this->W, this->H, this->W, this->H, drawn.Frame, drawn.Colors, drawn.Depths);
  if (this->BlendsSplats && !window->GetAbortRender())
  {
    this->FindFarthest(state->GetRenderer(), window);
    asked->DrawnStage = Stage::Blending;
    asked->DrawnTiles = this->Tiles.Colors;
    this->SumSplats(state, window);
    this->DivideSums(state->GetRenderer(), window);
  }
  asked->DrawnStage = Stage::Picture;
  asked->DrawnTiles = nullptr;
  window->GetState()->PopFramebufferBindings();
}

void vtkDepthShadingPass::FindFarthest(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  if (this->PrepareQuad(this->TileQuad, pointhaptics::kTileShader, window))
  {
    const DrawingInto into(this->Tiles, window->GetState());
    this->Draw(*this->TileQuad, this->Drawn, renderer);
  }
}

void vtkDepthShadingPass::SumSplats(const vtkRenderState* state, vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* gl = window->GetState();
  vtkOpenGLState::ScopedglEnableDisable depthTest(gl, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(gl, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable scissor(gl, GL_SCISSOR_TEST);
  vtkOpenGLState::ScopedglBlendFuncSeparate function(gl);
  vtkOpenGLFramebufferObject* frame = this->Sums.Frame;
  frame->Bind();
  frame->AddColorAttachment(0, this->Sums.Colors);
  frame->AddColorAttachment(1, this->Sums.Depths);
  frame->AddDepthAttachment(this->Drawn.Depths);
  frame->ActivateDrawBuffers(2);
  gl->vtkglViewport(0, 0, this->W, this->H);
  gl->vtkglDisable(GL_SCISSOR_TEST);
  gl->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const float zero[4] = { 0.0F, 0.0F, 0.0F, 0.0F };
  glClearBufferfv(GL_COLOR, 0, zero);
  glClearBufferfv(GL_COLOR, 1, zero);
  gl->vtkglEnable(GL_DEPTH_TEST);
  gl->vtkglDepthFunc(GL_LEQUAL);
  gl->vtkglDepthMask(GL_FALSE);
  gl->vtkglEnable(GL_BLEND);
  gl->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
  gl->vtkglBlendEquationSeparate(GL_FUNC_ADD, GL_MAX);
  this->Tiles.Colors->Activate();
  for (int i = 0; i < state->GetPropArrayCount() && !window->GetAbortRender(); ++i)
  {
    auto* actor = vtkActor::SafeDownCast(state->GetPropArray()[i]);
    auto* splats = actor ? vtkSplatMapper::SafeDownCast(actor->GetMapper()) : nullptr;
    if (splats && actor->GetVisibility())
    {
      actor->GetProperty()->Render(actor, state->GetRenderer());
      splats->Render(state->GetRenderer(), actor);
    }
  }
  this->Tiles.Colors->Deactivate();
  gl->vtkglBlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
  gl->vtkglDepthMask(GL_TRUE);
}

/// Over what was drawn without the splats.
void vtkDepthShadingPass::DivideSums(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  if (!this->PrepareQuad(this->DivideQuad, pointhaptics::kDivideShader, window))
  {
    return;
  }
  vtkOpenGLState* state = window->GetState();
  const DrawingInto into(this->Drawn, state);
  vtkOpenGLState::ScopedglBlendFuncSeparate function(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE);
  this->Draw(*this->DivideQuad, this->Sums, renderer);
}

/// Draws the picture with its shading into the window.
void vtkDepthShadingPass::Shade(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  if (this->PrepareQuad(this->CopyQuad, pointhaptics::kCopyShader, window))
  {
    const DrawingInto into(this->Shown, state);
    this->Draw(*this->CopyQuad, this->Drawn, renderer);
    if (this->PrepareQuad(
          this->ShadeQuad, std::string(pointhaptics::kShade) + pointhaptics::kShadeShader, window, true))
    {
      state->vtkglDepthMask(GL_FALSE);
      state->vtkglDepthFunc(GL_GREATER);
      vtkShaderProgram* program = this->ShadeQuad->Program;
      program->SetUniformf("strength", static_cast<float>(this->Strength));
      program->SetUniformf("minimumLightness", static_cast<float>(this->MinimumLightness));
      this->Draw(*this->ShadeQuad, this->Drawn, renderer);
    }
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

void vtkDepthShadingPass::SetUniforms(vtkShaderProgram* program, const Target& source, vtkRenderer* renderer)
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
  source.Colors->Activate();
  source.Depths->Activate();
  program->SetUniformi("colors", source.Colors->GetTextureUnit());
  program->SetUniformi("depths", source.Depths->GetTextureUnit());
  program->SetUniform2f("clipping", clipping);
  program->SetUniformi("isParallel", isParallel ? 1 : 0);
  program->SetUniformf("pixelSize", static_cast<float>(height / std::max(1, this->H)));
  program->SetUniformf(
    "pixelScale", static_cast<float>(std::max(0.5 * this->Resolution, this->H / kUsualHeight)));
  program->SetUniform2f("noise", noise);
}

void vtkDepthShadingPass::Draw(vtkOpenGLQuadHelper& quad, const Target& source, vtkRenderer* renderer)
{
  this->SetUniforms(quad.Program, source, renderer);
  quad.Render();
  source.Depths->Deactivate();
  source.Colors->Deactivate();
}

/// Into the frame buffer: a copy of bytes where both have the same.
void vtkDepthShadingPass::Show(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  vtkOpenGLState* state = window->GetState();
  int width = 0;
  int height = 0;
  int x = 0;
  int y = 0;
  renderer->GetTiledSizeAndOrigin(&width, &height, &x, &y);
  state->vtkglViewport(x, y, width, height);
  state->vtkglScissor(x, y, width, height);
  if (this->Resolution == 1.0 && this->WindowTakesCopies)
  {
    state->PushReadFramebufferBinding();
    this->Shown.Frame->Bind(GL_READ_FRAMEBUFFER);
    this->Shown.Frame->ActivateReadBuffer(0);
    state->vtkglDepthMask(GL_TRUE);
    glBlitFramebuffer(0, 0, this->W, this->H, x, y, x + width, y + height,
      GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    state->PopReadFramebufferBinding();
    return;
  }
  if (!this->PrepareQuad(this->CopyQuad, pointhaptics::kCopyShader, window))
  {
    return;
  }
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  overwriteAll(state);
  this->Shown.Colors->SetMagnificationFilter(
    this->Resolution < 1.0 ? vtkTextureObject::Linear : vtkTextureObject::Nearest);
  this->Draw(*this->CopyQuad, this->Shown, renderer);
  state->vtkglDepthFunc(GL_LEQUAL);
}

bool vtkDepthShadingPass::FindShown(vtkRenderer* renderer, double x, double y, double reach, double place[3])
{
  const vtkDepthShadingPass* pass = GetPassOf(renderer);
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!pass || pass->Kept.empty() || !window || window->GetStereoRender())
  {
    return false;
  }
  const double at[2] = { pass->Resolution * (x + 0.5 - renderer->GetOrigin()[0]),
    pass->Resolution * (y + 0.5 - renderer->GetOrigin()[1]) };
  const int size[2] = { pass->W, pass->H };
  int low[2];
  int high[2];
  for (int axis = 0; axis < 2; ++axis)
  {
    low[axis] = std::max(0, int(std::floor(at[axis] - pass->Resolution * reach)));
    high[axis] = std::min(size[axis] - 1, int(std::floor(at[axis] + pass->Resolution * reach)));
  }
  if (low[0] > high[0] || low[1] > high[1])
  {
    return false;
  }
  const int width = high[0] - low[0] + 1;
  std::vector<float> depths(std::size_t(width) * std::size_t(high[1] - low[1] + 1), 1.0F);
  window->MakeCurrent();
  window->GetState()->PushReadFramebufferBinding();
  pass->Shown.Frame->Bind(GL_READ_FRAMEBUFFER);
  glReadPixels(low[0], low[1], width, high[1] - low[1] + 1, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
  window->GetState()->PopReadFramebufferBinding();
  double nearest = INFINITY;
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    const double column = low[0] + int(i) % width + 0.5;
    const double row = low[1] + int(i) / width + 0.5;
    const double away = std::hypot(column - at[0], row - at[1]);
    if (depths[i] < 1.0F && away < nearest && away <= std::max(1.0, pass->Resolution * reach))
    {
      nearest = away;
      const double in[4] = { 2.0 * column / size[0] - 1.0, 2.0 * row / size[1] - 1.0,
        2.0 * double(depths[i]) - 1.0, 1.0 };
      double out[4];
      pass->FromShown->MultiplyPoint(in, out);
      std::transform(out, out + 3, place, [&out](double each) { return each / out[3]; });
    }
  }
  return nearest < INFINITY;
}

void vtkDepthShadingPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  if (this->RightEye)
  {
    this->RightEye->ReleaseGraphicsResources(window);
  }
  for (auto* quad : { &this->TileQuad, &this->DivideQuad, &this->CopyQuad, &this->ShadeQuad })
  {
    quad->reset();
  }
  for (Target* target : { &this->Drawn, &this->Sums, &this->Tiles, &this->Shown })
  {
    if (target->Frame)
    {
      target->Frame->ReleaseGraphicsResources(window);
      target->Colors->ReleaseGraphicsResources(window);
      target->Depths->ReleaseGraphicsResources(window);
      *target = Target();
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
  os << indent << "MovingFragments: " << this->MovingFragments << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "BlendsSplats: " << this->BlendsSplats << "\n";
  os << indent << "MinimumLightness: " << this->MinimumLightness << "\n";
  os << indent << "NumberOfPictures: " << this->NumberOfPictures << "\n";
}
