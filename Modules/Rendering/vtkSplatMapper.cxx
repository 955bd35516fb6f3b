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
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
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
constexpr double kPixelsWithoutArray = 3.0;
/// Of the window that the sizes in pixels are meant for.
constexpr double kUsualHeight = 800.0;
/// From the viewer's left and above, in view coordinates.
constexpr double kLightDirection[3] = { -0.45, 0.55, 0.70 };

} // namespace

vtkStandardNewMacro(vtkSplatMapper);

vtkSplatMapper::vtkSplatMapper()
{
  for (std::size_t side = 0; side < this->ClipBox.size(); ++side)
  {
    this->ClipBox[side] = side % 2 == 0 ? -INFINITY : INFINITY;
  }
}
vtkSplatMapper::~vtkSplatMapper() = default;

void vtkSplatMapper::SetSizeArrayName(const std::string& name)
{
  if (name != this->SizeArrayName)
  {
    this->SizeArrayName = name;
    this->HasSizes = false;
    this->RemoveVertexAttributeMapping(kAttribute);
    this->Modified();
  }
}

// The sizes are uniforms of the shader: Modified() would upload the points again.
void vtkSplatMapper::SetSizeScale(double scale)
{
  this->SizeScale = scale > 0.0 && std::isfinite(scale) ? scale : this->SizeScale;
}

void vtkSplatMapper::SetLargestRatio(double ratio)
{
  this->LargestRatio = ratio > 0.0 ? ratio : this->LargestRatio;
}

void vtkSplatMapper::SetPixelRange(double smallest, double largest)
{
  if (smallest > 0.0 && largest >= smallest && std::isfinite(largest))
  {
    this->SmallestPixels = smallest;
    this->LargestPixels = largest;
  }
}

void vtkSplatMapper::SetFixedPixels(double pixels)
{
  this->FixedPixels = pixels >= 0.0 && std::isfinite(pixels) ? pixels : this->FixedPixels;
}

void vtkSplatMapper::SetAmbientLight(bool on)
{
  if (on != this->AmbientLight)
  {
    this->AmbientLight = on;
    this->Modified();
  }
}

void vtkSplatMapper::SetSurfaces(bool on)
{
  if (on != this->Surfaces)
  {
    this->Surfaces = on;
    this->Modified();
  }
}

void vtkSplatMapper::SetPointPixels(double pixels)
{
  this->PointPixels = pixels > 0.0 && std::isfinite(pixels) ? pixels : this->PointPixels;
}

void vtkSplatMapper::SetLightStrength(double strength)
{
  this->LightStrength = strength >= 0.0 && strength <= 1.0 ? strength : this->LightStrength;
}

void vtkSplatMapper::SetNormalUnit(double unit)
{
  this->NormalUnit = unit > 0.0 && std::isfinite(unit) ? unit : this->NormalUnit;
}

void vtkSplatMapper::SetHidesBackFaces(bool on)
{
  this->HidesBackFaces = on;
}

void vtkSplatMapper::SetNormalArrayName(const std::string& name)
{
  if (name != this->NormalArrayName)
  {
    this->NormalArrayName = name;
    this->HasNormals = false;
    this->RemoveVertexAttributeMapping(kNormalAttribute);
    this->Modified();
  }
}

void vtkSplatMapper::SetSkyDirection(const double direction[3])
{
  const double length = vtkMath::Norm(direction);
  for (std::size_t axis = 0; axis < 3 && length > 0.0 && std::isfinite(length); ++axis)
  {
    this->SkyDirection[axis] = direction[axis] / length;
  }
}

void vtkSplatMapper::GetSkyDirection(double direction[3]) const
{
  std::copy(this->SkyDirection.begin(), this->SkyDirection.end(), direction);
}

void vtkSplatMapper::SetClipBox(const double box[6])
{
  std::copy(box, box + 6, this->ClipBox.begin());
}

void vtkSplatMapper::SetRanges(std::vector<std::array<vtkIdType, 2>> ranges)
{
  this->Ranges = std::move(ranges);
}

void vtkSplatMapper::CopySizes(const vtkSplatMapper* other, double factor)
{
  this->SetSizeArrayName(other->SizeArrayName);
  this->SetSizeScale(factor * other->SizeScale);
  this->SetLargestRatio(other->LargestRatio);
  const double wider = other->Surfaces ? factor : 1.0;
  this->SetPixelRange(other->SmallestPixels, wider * other->LargestPixels);
  this->SetPointPixels(wider * other->PointPixels);
  this->SetFixedPixels(factor * other->FixedPixels);
  this->SetAmbientLight(other->AmbientLight);
  this->SetNormalArrayName(other->NormalArrayName);
  this->SkyDirection = other->SkyDirection;
  this->SetSurfaces(other->Surfaces);
  this->SetForeshortens(other->Foreshortens);
  this->SetLightStrength(other->LightStrength);
  this->SetNormalUnit(other->NormalUnit);
  this->SetHidesBackFaces(other->HidesBackFaces);
  this->ClipBox = other->ClipBox;
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
  vtkDataArray* sizes = arrayOf(this->SizeArrayName, 1);
  this->MapArray(sizes, this->SizeArrayName, kAttribute, this->HasSizes);
  this->MapArray(this->AmbientLight ? arrayOf(this->NormalArrayName, 3) : nullptr, this->NormalArrayName,
    kNormalAttribute, this->HasNormals);
  if (sizes && sizes->GetMTime() != this->MedianTime)
  {
    this->MedianTime = sizes->GetMTime();
    this->MedianLength = pointhaptics::quantileOfPositive(sizes, 5);
  }
  this->Superclass::RenderPieceStart(renderer, actor);
  // What is in the graphics card's memory, or the software renderer's, is kept here by nobody: 28 bytes a
  // point.
  for (const char* attribute : { "vertexMC", "scalarColor", kAttribute, kNormalAttribute })
  {
    if (vtkOpenGLVertexBufferObject* buffer = this->VBOs->GetVBO(attribute))
    {
      std::vector<float>().swap(buffer->GetPackedVBO());
    }
  }
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
  const std::size_t indices = points.IBO->IndexCount;
  points.IBO->IndexCount = static_cast<std::size_t>(count); // of 0 the superclass binds no attributes
  this->UpdateShaders(points, renderer, actor);
  points.IBO->IndexCount = indices;
  if (hasCells)
  {
    points.IBO->Bind();
  }
  const RangeList all = { { 0, count } };
  for (const auto& [begin, end] : ranges.empty() ? all : ranges)
  {
    this->DrawRange(renderer, begin, std::min(end, count), hasCells);
  }
  if (hasCells)
  {
    points.IBO->Release();
  }
}

void vtkSplatMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
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
  const bool tilts = this->Surfaces && this->HasNormals;
  const std::string declared = (this->HasSizes ? std::string("in float ") + kAttribute + ";\n" : "") +
    (this->HasNormals ? pointhaptics::kLightFunctions : "") +
    (tilts ? pointhaptics::kSurfaceDeclarations : "");
  vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Dec",
    "//VTK::PositionVC::Dec\n" + declared +
      "uniform float splatPixels;\nuniform float splatLongest;\nuniform vec3 splatRange;\n"
      "uniform vec3 splatLow;\nuniform vec3 splatHigh;\n");
  const std::string largest =
    tilts ? "mix(splatRange.z, splatRange.y, splatFlat * splatFlat)" : "splatRange.y";
  vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Impl",
    std::string("//VTK::PositionVC::Impl\n") + (this->HasNormals ? pointhaptics::kLightStatements : "") +
      "  gl_PointSize = clamp(splatPixels" +
      (this->HasSizes ? std::string(" * min(splatLongest, ") + kAttribute + ") / gl_Position.w" : "") +
      ", splatRange.x, max(splatRange.x, " + largest + "));\n" +
      (tilts ? pointhaptics::kSurfaceStatements : "") + pointhaptics::kClipStatements);
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
        (tilts ? "in vec2 splatSlope;\nin vec2 splatReach;\nuniform vec4 splatTerms;\n"
                 "uniform int splatIsParallel;\nuniform float splatNarrow;\n"
               : ""));
    vtkShaderProgram::Substitute(
      fragment, "//VTK::Light::Impl", "//VTK::Light::Impl\n  gl_FragData[0].rgb *= splatLight;\n");
  }
  shaders[vtkShader::Fragment]->SetSource(fragment);
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
}

void vtkSplatMapper::SetMapperShaderParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cells, renderer, actor);
  // VTK sets it only where a factor comes with it.
  float factor = 0.0F;
  float offset = 0.0F;
  this->GetCoincidentParameters(renderer, actor, factor, offset);
  if (cells.Program->IsUniformUsed("cOffset"))
  {
    cells.Program->SetUniformf("cOffset", offset);
  }
  this->SetClipParameters(cells);
  if (this->HasNormals)
  {
    this->SetLightParameters(cells, renderer, actor);
  }
  if (this->HasNormals && this->Surfaces)
  {
    this->SetSurfaceParameters(cells, renderer, actor);
  }
  const double resolution = vtkDepthShadingPass::ResolutionOf(renderer);
  double pixels = resolution * (this->FixedPixels > 0.0 ? this->FixedPixels : kPixelsWithoutArray);
  double range[3] = { 1.0, resolution * std::max(this->FixedPixels, this->LargestPixels), 0.0 };
  if (this->HasSizes && this->FixedPixels == 0.0)
  {
    // A length at distance w covers as many pixels, for both kinds of projection: w is 1 for a parallel one.
    vtkMatrix4x4* projection =
      renderer->GetActiveCamera()->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1);
    const double modelScale = std::cbrt(std::abs(actor->GetMatrix()->Determinant()));
    const double lines = resolution * renderer->GetSize()[1];
    pixels = this->SizeScale * modelScale * 0.5 * lines * projection->GetElement(1, 1);
    const double scale = this->Surfaces ? lines / kUsualHeight : resolution;
    range[0] = std::max(1.0, scale * this->SmallestPixels);
    range[1] = scale * this->LargestPixels;
    range[2] = scale * this->PointPixels;
  }
  else if (this->HasSizes)
  {
    range[0] = range[1] = range[2] = pixels; // whatever the array says
  }
  const float limits[3] = { static_cast<float>(range[0]), static_cast<float>(range[1]),
    static_cast<float>(range[2]) };
  if (cells.Program->IsUniformUsed("splatPixels"))
  {
    cells.Program->SetUniformf("splatPixels", static_cast<float>(pixels));
  }
  if (cells.Program->IsUniformUsed("splatLongest"))
  {
    cells.Program->SetUniformf("splatLongest", static_cast<float>(this->LargestRatio * this->MedianLength));
  }
  if (cells.Program->IsUniformUsed("splatRange"))
  {
    cells.Program->SetUniform3f("splatRange", limits);
  }
}

/// In the frame of the uploaded points, which are shifted and scaled where they are far from the origin.
void vtkSplatMapper::SetClipParameters(vtkOpenGLHelper& cells)
{
  constexpr double kLargest = 3e38; // of single precision
  vtkOpenGLVertexBufferObject* points = this->VBOs->GetVBO("vertexMC");
  const bool isShifted = points && points->GetCoordShiftAndScaleEnabled();
  float ends[2][3];
  for (std::size_t side = 0; side < this->ClipBox.size(); ++side)
  {
    const std::size_t axis = side / 2;
    const double shift = isShifted ? points->GetShift()[axis] : 0.0;
    const double scale = isShifted ? points->GetScale()[axis] : 1.0;
    ends[side % 2][axis] =
      static_cast<float>(std::clamp((this->ClipBox[side] - shift) * scale, -kLargest, kLargest));
  }
  cells.Program->SetUniform3f("splatLow", ends[0]);
  cells.Program->SetUniform3f("splatHigh", ends[1]);
}

/// The slopes of the discs come from normals in the frame of the view: it knows no large coordinates.
void vtkSplatMapper::SetSurfaceParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> toView;
  vtkMatrix4x4::Multiply4x4(camera->GetViewTransformMatrix(), actor->GetMatrix(), toView);
  double linear[3][3];
  double inverse[3][3];
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      linear[row][column] = toView->GetElement(row, column);
    }
  }
  vtkMath::Invert3x3(linear, inverse); // its transpose takes normals
  double longest = 0.0;
  for (const auto& row : inverse)
  {
    longest = std::max(longest, vtkMath::Norm(row));
  }
  float turn[3][3]; // column by column, as OpenGL has it
  for (std::size_t column = 0; column < 3; ++column)
  {
    for (std::size_t row = 0; row < 3; ++row)
    {
      turn[column][row] = static_cast<float>(longest > 0.0 ? inverse[column][row] / longest : 0.0);
    }
  }
  vtkMatrix4x4* projection = camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1);
  const float terms[4] = { static_cast<float>(projection->GetElement(0, 0)),
    static_cast<float>(projection->GetElement(1, 1)), static_cast<float>(projection->GetElement(2, 2)),
    static_cast<float>(projection->GetElement(2, 3)) };
  const double lines = vtkDepthShadingPass::ResolutionOf(renderer) * renderer->GetSize()[1];
  const double halfPixel = 1.0 / (projection->GetElement(1, 1) * lines);
  cells.Program->SetUniformMatrix3x3("splatTurn", &turn[0][0]);
  cells.Program->SetUniform4f("splatTerms", terms);
  cells.Program->SetUniformf("splatHalfPixel", static_cast<float>(halfPixel));
  cells.Program->SetUniformf("splatNarrow", this->Foreshortens ? 1.0F : 0.0F);
  cells.Program->SetUniformi("splatIsParallel", camera->GetParallelProjection() ? 1 : 0);
}

namespace
{

/// A point (@p w 1) or a direction (@p w 0) in the frame that @p matrix leads to; @p result may be @p vector.
void taken(vtkMatrix4x4* matrix, const double* vector, double w, double* result)
{
  const double in[4] = { vector[0], vector[1], vector[2], w };
  double out[4];
  matrix->MultiplyPoint(in, out);
  std::copy(out, out + 3, result);
}

} // namespace

/// All in the frame of the uploaded points.
void vtkSplatMapper::SetLightParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkNew<vtkMatrix4x4> toModel;
  vtkMatrix4x4::Invert(actor->GetMatrix(), toModel);
  vtkNew<vtkMatrix4x4> fromView;
  vtkMatrix4x4::Invert(camera->GetViewTransformMatrix(), fromView);
  double lamp[3];
  taken(fromView, kLightDirection, 0.0, lamp);
  taken(toModel, lamp, 0.0, lamp);
  vtkMath::Normalize(lamp);
  double sky[3];
  taken(toModel, this->SkyDirection.data(), 0.0, sky);
  vtkMath::Normalize(sky);
  const bool isParallel = camera->GetParallelProjection() != 0;
  double eye[3];
  double towardsViewer[3];
  camera->GetDirectionOfProjection(towardsViewer);
  std::transform(towardsViewer, towardsViewer + 3, towardsViewer, [](double c) { return -c; });
  taken(toModel, isParallel ? towardsViewer : camera->GetPosition(), isParallel ? 0.0 : 1.0, eye);
  // Points far from the origin are uploaded shifted and scaled.
  double unscale[3] = { 1.0, 1.0, 1.0 };
  vtkOpenGLVertexBufferObject* points = this->VBOs->GetVBO("vertexMC");
  for (std::size_t axis = 0; points && points->GetCoordShiftAndScaleEnabled() && axis < 3; ++axis)
  {
    const double scale = points->GetScale()[axis];
    unscale[axis] = 1.0 / scale;
    eye[axis] = scale * (eye[axis] - (isParallel ? 0.0 : points->GetShift()[axis]));
  }
  const auto set = [&cells](const char* name, const double* vector)
  {
    const float values[3] = { static_cast<float>(vector[0]), static_cast<float>(vector[1]),
      static_cast<float>(vector[2]) };
    cells.Program->SetUniform3f(name, values);
  };
  const auto setNumber = [&cells](const char* name, double value)
  { cells.Program->SetUniformf(name, static_cast<float>(value)); };
  setNumber("splatUnit", 1.0 / this->NormalUnit);
  setNumber("splatStrength", this->LightStrength);
  cells.Program->SetUniformi("splatHides", this->HidesBackFaces ? 1 : 0);
  set("splatLamp", lamp);
  set("splatSky", sky);
  set("splatUnscale", unscale);
  const float place[4] = { static_cast<float>(eye[0]), static_cast<float>(eye[1]), static_cast<float>(eye[2]),
    isParallel ? 0.0F : 1.0F };
  cells.Program->SetUniform4f("splatEye", place);
}

void vtkSplatMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SizeArrayName: " << this->SizeArrayName << "\n";
  os << indent << "SizeScale: " << this->SizeScale << "\n";
  os << indent << "LargestRatio: " << this->LargestRatio << "\n";
  os << indent << "SmallestPixels: " << this->SmallestPixels << "\n";
  os << indent << "LargestPixels: " << this->LargestPixels << "\n";
  os << indent << "FixedPixels: " << this->FixedPixels << "\n";
  os << indent << "AmbientLight: " << this->AmbientLight << "\n";
  os << indent << "Surfaces: " << this->Surfaces << "\n";
  os << indent << "Foreshortens: " << this->Foreshortens << "\n";
  os << indent << "PointPixels: " << this->PointPixels << "\n";
  os << indent << "LightStrength: " << this->LightStrength << "\n";
  os << indent << "NormalUnit: " << this->NormalUnit << "\n";
  os << indent << "HidesBackFaces: " << this->HidesBackFaces << "\n";
  os << indent << "NormalArrayName: " << this->NormalArrayName << "\n";
  os << indent << "ClipBox: " << this->ClipBox[0] << ", " << this->ClipBox[1] << ", " << this->ClipBox[2]
     << ", " << this->ClipBox[3] << ", " << this->ClipBox[4] << ", " << this->ClipBox[5] << "\n";
  os << indent << "SkyDirection: " << this->SkyDirection[0] << ", " << this->SkyDirection[1] << ", "
     << this->SkyDirection[2] << "\n";
}
