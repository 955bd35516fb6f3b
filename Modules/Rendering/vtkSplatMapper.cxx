#include "vtkSplatMapper.h"

#include "CloudParts.h"
#include "DrawPace.h"
#include "SplatShaders.h"
#include "vtkDepthShadingPass.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkHardwareSelector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtk_glew.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace
{

constexpr const char* kAttribute = "splatLength";
constexpr const char* kNormalAttribute = "splatNormal";
/// Around the picture, pixels: half of the largest point that a software renderer draws. It draws none whose
/// middle is out of its viewport.
constexpr int kMargin = 128;
/// Sets the divisor of all attributes of the splats: each value serves one vertex, or a quad.
void setAttributeDivisor(vtkOpenGLHelper& points, GLuint divisor)
{
  const auto program = static_cast<GLuint>(points.Program->GetHandle());
  for (const char* name : { "vertexMC", "scalarColor", kAttribute, kNormalAttribute })
  {
    const GLint place = glGetAttribLocation(program, name);
    if (place >= 0)
    {
      glVertexAttribDivisor(static_cast<GLuint>(place), divisor);
    }
  }
}

} // namespace

vtkStandardNewMacro(vtkSplatMapper);

vtkSplatMapper::vtkSplatMapper() = default;
vtkSplatMapper::~vtkSplatMapper() = default;

void vtkSplatMapper::SetPixelRange(double smallest, double largest)
{
  if (smallest > 0.0 && largest >= smallest && std::isfinite(largest))
  {
    this->Now.smallestPixels = smallest;
    this->Now.largestPixels = largest;
  }
}

void vtkSplatMapper::SetFixedPixels(double pixels)
{
  this->Now.fixedPixels = pixels >= 0.0 && std::isfinite(pixels) ? pixels : this->Now.fixedPixels;
}

void vtkSplatMapper::SetLightStrength(double strength)
{
  this->Now.lightStrength = strength >= 0.0 && strength <= 1.0 ? strength : this->Now.lightStrength;
}

void vtkSplatMapper::SetSkyDirection(const double direction[3])
{
  const double length = vtkMath::Norm(direction);
  for (std::size_t axis = 0; axis < 3 && length > 0.0 && std::isfinite(length); ++axis)
  {
    this->Now.sky[axis] = direction[axis] / length;
  }
}

void vtkSplatMapper::GetSkyDirection(double direction[3]) const
{
  std::copy(this->Now.sky.begin(), this->Now.sky.end(), direction);
}

void vtkSplatMapper::SetRanges(std::vector<std::array<vtkIdType, 2>> ranges)
{
  this->Ranges = std::move(ranges);
}

void vtkSplatMapper::CopySizes(const vtkSplatMapper* other, double gap)
{
  this->Now = other->Now;
  this->Now.gap = gap > 0.0 && std::isfinite(gap) ? gap : 0.0;
  this->SetClippingPlanes(other->ClippingPlanes);
}

/// Uploads @p array, or what was uploaded no more where it is null.
void vtkSplatMapper::MapArray(
  vtkDataArray* array, const std::string& name, const char* attribute, bool& isMapped)
{
  if ((array != nullptr) != isMapped)
  {
    isMapped = array != nullptr;
    this->RemoveVertexAttributeMapping(attribute);
    if (array)
    {
      this->MapDataArrayToVertexAttribute(attribute, name.c_str(), vtkDataObject::FIELD_ASSOCIATION_POINTS);
    }
    this->Modified();
  }
}

void vtkSplatMapper::RenderPieceStart(vtkRenderer* renderer, vtkActor* actor)
{
  const auto arrayOf = [this](const std::string& name, int components)
  {
    vtkDataArray* array =
      this->CurrentInput ? this->CurrentInput->GetPointData()->GetArray(name.c_str()) : nullptr;
    return array && array->GetNumberOfComponents() == components ? array : nullptr;
  };
  if (this->Now.sizeArray != this->Drawn.sizeArray)
  {
    this->MapArray(nullptr, "", kAttribute, this->HasSizes);
  }
  if (this->Now.normalArray != this->Drawn.normalArray)
  {
    this->MapArray(nullptr, "", kNormalAttribute, this->HasNormals);
  }
  if (this->Now.surfaces != this->Drawn.surfaces)
  {
    this->Modified();
  }
  this->Drawn = this->Now;
  vtkDataArray* sizes = arrayOf(this->Now.sizeArray, 1);
  this->MapArray(sizes, this->Now.sizeArray, kAttribute, this->HasSizes);
  this->MapArray(this->Now.ambientLight ? arrayOf(this->Now.normalArray, 3) : nullptr, this->Now.normalArray,
    kNormalAttribute, this->HasNormals);
  if (sizes && sizes->GetMTime() != this->MedianTime)
  {
    this->MedianTime = sizes->GetMTime();
    this->MedianLength = pointhaptics::quantileOfPositive(sizes, 5);
  }
  this->Superclass::RenderPieceStart(renderer, actor);
  // Drops the copy of the attributes, which the graphics card or the software renderer holds: 28 bytes a
  // point.
  for (const char* attribute : { "vertexMC", "scalarColor", kAttribute, kNormalAttribute })
  {
    if (vtkOpenGLVertexBufferObject* buffer = this->VBOs->GetVBO(attribute))
    {
      std::vector<float>().swap(buffer->GetPackedVBO());
    }
  }
}

/// Distance of the focal point over that of the nearest place that can be seen, at least 1: the camera moves
/// towards a focal point that may be far behind the surface.
double vtkSplatMapper::NearestIsNearer(vtkRenderer* renderer, vtkActor* actor)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double* bounds = actor->GetBounds();
  const bool isThere = vtkMath::AreBoundsInitialized(bounds);
  double nearest[3] = { 0.0, 0.0, 0.0 };
  for (int axis = 0; axis < 3 && isThere; ++axis)
  {
    nearest[axis] = std::clamp(camera->GetPosition()[axis], bounds[2 * axis], bounds[2 * axis + 1]);
  }
  const double distance = std::sqrt(vtkMath::Distance2BetweenPoints(camera->GetPosition(), nearest));
  return camera->GetParallelProjection() || !isThere
    ? 1.0
    : std::max(1.0, camera->GetDistance() / std::max(distance, camera->GetClippingRange()[0]));
}

/// True if splats are seen from so near that some may be larger than points can be. Quads take four times as
/// long as points to begin with: in motion those at the focal point count.
bool vtkSplatMapper::WantsQuads(vtkRenderer* renderer, vtkActor* actor)
{
  using Stage = vtkDepthShadingPass::Stage;
  constexpr double kLargePixels = 60.0;
  const bool rests = vtkDepthShadingPass::StageOf(renderer) != Stage::Picture;
  const double nearer = rests ? this->NearestIsNearer(renderer, actor) : 1.0;
  return this->Now.surfaces && this->HasNormals && this->HasSizes && this->Now.fixedPixels == 0.0 &&
    this->CurrentInput->GetNumberOfCells() == 0 && glDrawArraysInstancedBaseInstance &&
    nearer * this->GetMedianPixels(renderer, actor, INFINITY) > kLargePixels;
}

double vtkSplatMapper::GetMedianPixels(vtkRenderer* renderer, vtkActor* actor, double largest)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double distance = camera->GetParallelProjection() ? 1.0 : camera->GetDistance();
  const double own = this->PixelsPerLength(renderer, actor) * this->MedianLength / distance;
  return std::hypot(std::min(own, largest), this->GapPixels(renderer, actor) / distance);
}

/// In steps: see DrawPace. Between them the window may give up the frame, but not a selection.
void vtkSplatMapper::DrawRange(vtkRenderer* renderer, vtkIdType begin, vtkIdType end, bool isIndexed)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  const bool selects = renderer->GetSelector() != nullptr;
  auto& pace = pointhaptics::DrawPace::of(window);
  while (begin < end && (selects || !window->GetAbortRender()))
  {
    const auto count = static_cast<GLsizei>(std::min<std::int64_t>(end - begin, pace.room()));
    if (selects)
    {
      // Each call counts its primitives from 0.
      this->LastBoundBO->Program->SetUniformi("PrimitiveIDOffset", static_cast<int>(begin));
    }
    if (isIndexed)
    {
      const auto offset = static_cast<std::uintptr_t>(begin) * sizeof(GLuint);
      glDrawElements(GL_POINTS, count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset));
    }
    else if (this->DrawsQuads)
    {
      glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, count, static_cast<GLuint>(begin));
    }
    else
    {
      glDrawArrays(GL_POINTS, static_cast<GLint>(begin), count);
    }
    pace.add(count);
    begin += count;
    if (!selects)
    {
      window->CheckAbortStatus(); // asks five times a second at most
    }
  }
}

/// Those of all points, where no cells say otherwise: one cell of all points would be copied.
void vtkSplatMapper::ComputeBounds()
{
  vtkPolyData* input = this->GetInput();
  if (input && input->GetPoints() && input->GetNumberOfCells() == 0)
  {
    input->GetPoints()->GetBounds(this->Bounds);
  }
  else
  {
    this->Superclass::ComputeBounds();
  }
}

/// All by the same call as parts, in pictures and selections: others round otherwise.
void vtkSplatMapper::DrawPoints(
  vtkOpenGLHelper& points, vtkRenderer* renderer, vtkActor* actor, const RangeList& ranges)
{
  const bool hasCells = this->CurrentInput->GetNumberOfCells() > 0;
  const auto count =
    hasCells ? static_cast<vtkIdType>(points.IBO->IndexCount) : this->CurrentInput->GetNumberOfPoints();
  if (count == 0)
  {
    return;
  }
  this->DrawsQuads = !renderer->GetSelector() && this->WantsQuads(renderer, actor);
  const std::size_t indices = points.IBO->IndexCount;
  points.IBO->IndexCount = static_cast<std::size_t>(count); // of 0 the superclass binds no attributes
  this->UpdateShaders(points, renderer, actor);
  points.IBO->IndexCount = indices;
  if (hasCells)
  {
    points.IBO->Bind();
  }
  setAttributeDivisor(points, this->DrawsQuads ? 1 : 0);
  const RangeList all = { { 0, count } };
  for (const auto& [begin, end] : ranges.empty() ? all : ranges)
  {
    this->DrawRange(renderer, begin, std::min(end, count), hasCells);
  }
  setAttributeDivisor(points, 0);
  this->DrawsQuads = false;
  if (hasCells)
  {
    points.IBO->Release();
  }
}

/// Into a viewport that is larger than the picture by half a splat, so that those at the border are drawn
/// whose middles lie beyond.
void vtkSplatMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  using Stage = vtkDepthShadingPass::Stage;
  const Stage stage = vtkDepthShadingPass::StageOf(renderer);
  const bool blends = this->Now.surfaces && this->HasNormals;
  if (stage == Stage::Blending && !blends)
  {
    return; // it is in the picture already
  }
  vtkOpenGLState* state = vtkOpenGLRenderer::SafeDownCast(renderer)->GetState();
  int place[4]; // and size
  state->vtkglGetIntegerv(GL_VIEWPORT, place);
  for (int axis = 0; axis < 2; ++axis)
  {
    this->Pixel[axis] = 2.0 / (place[2 + axis] + 2 * kMargin);
    this->Fit[axis] = 0.5 * place[2 + axis] * this->Pixel[axis];
  }
  state->vtkglViewport(
    place[0] - kMargin, place[1] - kMargin, place[2] + 2 * kMargin, place[3] + 2 * kMargin);
  const bool hidesColors = stage == Stage::Depths && blends;
  if (hidesColors)
  {
    glDrawBuffer(GL_NONE); // a software renderer works less than with masked colours
  }
  this->DrawSplats(renderer, actor);
  if (hidesColors)
  {
    glDrawBuffer(GL_COLOR_ATTACHMENT0);
  }
  state->vtkglViewport(place[0], place[1], place[2], place[3]);
}

/// The points, and what vtkMapper::SetSelection marks among them.
void vtkSplatMapper::DrawSplats(vtkRenderer* renderer, vtkActor* actor)
{
  vtkHardwareSelector* selector = renderer->GetSelector();
  const bool hasCells = this->CurrentInput->GetNumberOfCells() > 0;
  vtkOpenGLState* state = vtkOpenGLRenderer::SafeDownCast(renderer)->GetState();
  const vtkOpenGLState::ScopedglDepthMask mask(state);
  const vtkOpenGLState::ScopedglDepthFunc function(state);
  if (selector)
  {
    // A splat is selected by the pixels it is seen in: here, too, near ones hide others. The passes of a
    // selection keep the depths of the pass before.
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglDepthFunc(GL_LEQUAL);
  }
  glEnable(GL_PROGRAM_POINT_SIZE);
  // The markers of a chart leave it the other way up, and discs would tilt the wrong way.
  glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_UPPER_LEFT);
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  const int pass = selector ? selector->GetCurrentPass() : vtkHardwareSelector::MIN_KNOWN_PASS - 1;
  const bool asksForCells =
    pass == vtkHardwareSelector::CELL_ID_LOW24 || pass == vtkHardwareSelector::CELL_ID_HIGH24;
  if (hasCells || !asksForCells)
  {
    this->DrawPoints(this->Primitives[PrimitivePoints], renderer, actor, this->Ranges);
  }
  if (hasCells && !selector)
  {
    this->DrawingSelection = true; // vtkMapper::SetSelection
    this->DrawPoints(this->SelectionPrimitives[PrimitivePoints], renderer, actor, {});
    this->DrawingSelection = false;
  }
  glDisable(GL_PROGRAM_POINT_SIZE);
}

void vtkSplatMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  // In front of the superclass, which takes the marks away.
  std::string vertex = shaders[vtkShader::Vertex]->GetSource();
  const bool tilts = this->Now.surfaces && this->HasNormals;
  const std::string declared = (this->HasSizes ? std::string("in float ") + kAttribute + ";\n" : "") +
    (this->HasNormals ? pointhaptics::kLightFunctions : "") +
    (tilts ? pointhaptics::kSurfaceDeclarations : "");
  vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Dec",
    "//VTK::PositionVC::Dec\n" + declared +
      "uniform float splatPixels;\nuniform float splatLongest;\nuniform vec4 splatRange;\n"
      "uniform float splatGap;\n"
      "uniform vec2 splatFit;\nuniform vec3 splatLow;\nuniform vec3 splatHigh;\n");
  // A flat surface is drawn at its size; the rest stays small on the screen.
  const std::string size = std::string("splatPixels") +
    (this->HasSizes ? std::string(" * min(splatLongest, ") + kAttribute + ") / gl_Position.w" : "");
  const std::string bounded = tilts
    ? "mix(min(splatSize, mix(splatRange.z, splatRange.y, splatFlat * splatFlat)), "
      "min(splatSize, splatRange.w), splatCloses)"
    : "min(splatSize, splatRange.y)";
  vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Impl",
    std::string("//VTK::PositionVC::Impl\n") + (this->HasNormals ? pointhaptics::kLightStatements : "") +
      (tilts ? "  float splatTilts = clamp(2.0 * splatFlat - 0.6, 0.0, 1.0);\n"
               "  float splatCloses = max(splatTilts, splatAll);\n"
             : "") +
      "  float splatSize = " + size + ";\n  gl_PointSize = " + bounded +
      ";\n"
      "  gl_PointSize = splatGap > 0.0 ? length(vec2(gl_PointSize, splatGap / gl_Position.w)) : "
      "gl_PointSize;\n"
      "  gl_PointSize = clamp(gl_PointSize, splatRange.x, max(splatRange.x, splatRange.w));\n" +
      (tilts ? std::string(pointhaptics::kSurfaceStatements) + pointhaptics::kTileStatements : "") +
      pointhaptics::kFitStatements + (tilts ? pointhaptics::kQuadStatements : "") +
      pointhaptics::kClipStatements + (this->HasSizes ? pointhaptics::kHideStatements : ""));
  shaders[vtkShader::Vertex]->SetSource(vertex);
  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  // Depth peeling may return after the depths: what is outside of the disc is discarded before.
  vtkShaderProgram::Substitute(fragment, "//VTK::Depth::Impl",
    tilts ? pointhaptics::kSurfaceFragment
          : "  vec2 splatPlace = 2.0 * gl_PointCoord - vec2(1.0);\n"
            "  if (dot(splatPlace, splatPlace) > 1.0) { discard; }\n"
            "//VTK::Depth::Impl\n");
  if (this->HasNormals)
  {
    vtkShaderProgram::Substitute(fragment, "//VTK::PositionVC::Dec",
      std::string("//VTK::PositionVC::Dec\nin float splatLight;\n") +
        (tilts ? pointhaptics::kSurfaceFragmentDeclarations : ""));
    vtkShaderProgram::Substitute(fragment, "//VTK::Light::Impl",
      std::string("//VTK::Light::Impl\n  gl_FragData[0].rgb *= splatLight;\n") +
        (tilts ? pointhaptics::kBlendStatements : pointhaptics::kOpaqueStatements));
  }
  else
  {
    vtkShaderProgram::Substitute(
      fragment, "//VTK::Light::Impl", std::string("//VTK::Light::Impl\n") + pointhaptics::kOpaqueStatements);
  }
  shaders[vtkShader::Fragment]->SetSource(fragment);
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
}

void vtkSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SizeArray: " << this->Now.sizeArray << "\n";
  os << indent << "SizeScale: " << this->Now.sizeScale << "\n";
  os << indent << "FixedPixels: " << this->Now.fixedPixels << "\n";
  os << indent << "Surfaces: " << this->Now.surfaces << "\n";
}
