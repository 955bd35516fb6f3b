#include "vtkDepthShadingPass.h"

#include "PictureState.h"

#include "vtkActor2D.h"
#include "vtkCamera.h"
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

namespace
{

/// Neighbours two to three pixels away: nearer ones mostly belong to the same splat.
constexpr const char* kFragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D colors;
uniform sampler2D depths;
uniform vec2 clipping;
uniform int isParallel;
uniform float depthScale;
uniform float depthTolerance;
uniform float minimumLightness;
uniform int isShaded;
// A line far in front of a surface, which few neighbours see, must not draw a black band on it.
const float mostBehind = 1.5;

float distanceAt(float depth)
{
  return isParallel != 0 ? mix(clipping.x, clipping.y, depth)
                         : clipping.x * clipping.y / (clipping.y - depth * (clipping.y - clipping.x));
}

float behind(ivec2 place, ivec2 last, float here)
{
  float depth = texelFetch(depths, clamp(place, ivec2(0), last), 0).r;
  return depth < 1.0 ? clamp(here - distanceAt(depth) - depthTolerance, 0.0, mostBehind * depthScale) : 0.0;
}

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
    float sum = behind(place + ivec2(3, 0), last, here) + behind(place + ivec2(-3, 0), last, here) +
      behind(place + ivec2(0, 3), last, here) + behind(place + ivec2(0, -3), last, here) +
      behind(place + ivec2(2, 2), last, here) + behind(place + ivec2(-2, 2), last, here) +
      behind(place + ivec2(2, -2), last, here) + behind(place + ivec2(-2, -2), last, here);
    color.rgb *= max(minimumLightness, exp(-0.125 * sum / depthScale));
  }
  gl_FragData[0] = color;
}
)";

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
    this->Kept.clear();
  }
  const auto width = static_cast<unsigned int>(this->W);
  const auto height = static_cast<unsigned int>(this->H);
  if (this->Colors->GetWidth() != width || this->Colors->GetHeight() != height)
  {
    this->Colors->Create2D(width, height, 4, VTK_UNSIGNED_CHAR, false);
    this->Depths->AllocateDepth(width, height, vtkTextureObject::Float32);
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

  std::vector<double> wanted = pointhaptics::pictureState(renderer);
  const bool sameShades = !this->KeptIsShaded ||
    (this->KeptDepthScale == this->DepthScale && this->KeptDepthTolerance == this->DepthTolerance &&
      this->KeptMinimumLightness == this->MinimumLightness);
  if (wanted != this->Kept || !sameShades || renderer->GetSelector())
  {
    window->GetState()->PushFramebufferBindings();
    this->Frame->Bind();
    this->RenderDelegate(
      state, this->Width, this->Height, this->W, this->H, this->Frame, this->Colors, this->Depths);
    window->GetState()->PopFramebufferBindings();
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
    this->KeptDepthScale = this->DepthScale;
    this->KeptDepthTolerance = this->DepthTolerance;
    this->KeptMinimumLightness = this->MinimumLightness;
  }
}

void vtkDepthShadingPass::Shade(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  if (!this->Quad)
  {
    this->Quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, kFragmentShader, "");
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(this->Quad->Program);
  }
  vtkShaderProgram* program = this->Quad->Program;
  if (!program || !program->GetCompiled())
  {
    vtkErrorMacro(
      "The shader could not be built, so nothing is drawn; update the graphics driver to one with "
      "OpenGL 3.2.");
    return;
  }
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

  vtkCamera* camera = renderer->GetActiveCamera();
  const double* range = camera->GetClippingRange();
  const float clipping[2] = { static_cast<float>(range[0]), static_cast<float>(range[1]) };
  this->Colors->Activate();
  this->Depths->Activate();
  program->SetUniformi("colors", this->Colors->GetTextureUnit());
  program->SetUniformi("depths", this->Depths->GetTextureUnit());
  program->SetUniform2f("clipping", clipping);
  program->SetUniformi("isParallel", camera->GetParallelProjection() ? 1 : 0);
  program->SetUniformi("isShaded", this->KeptIsShaded ? 1 : 0);
  program->SetUniformf("depthScale", static_cast<float>(this->DepthScale));
  program->SetUniformf("depthTolerance", static_cast<float>(this->DepthTolerance));
  program->SetUniformf("minimumLightness", static_cast<float>(this->MinimumLightness));
  this->Quad->Render();
  this->Depths->Deactivate();
  this->Colors->Deactivate();
  state->vtkglDepthFunc(GL_LEQUAL);
}

void vtkDepthShadingPass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Quad.reset();
  if (this->Frame)
  {
    this->Frame->ReleaseGraphicsResources(window);
    this->Colors->ReleaseGraphicsResources(window);
    this->Depths->ReleaseGraphicsResources(window);
    this->Frame = nullptr;
    this->Colors = nullptr;
    this->Depths = nullptr;
  }
  this->Kept.clear();
}

void vtkDepthShadingPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DepthScale: " << this->DepthScale << "\n";
  os << indent << "DepthTolerance: " << this->DepthTolerance << "\n";
  os << indent << "MinimumLightness: " << this->MinimumLightness << "\n";
  os << indent << "NumberOfPictures: " << this->NumberOfPictures << "\n";
}
