#include "vtkSplatMapper.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtk_glew.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace
{

constexpr const char* kAttribute = "splatLength";
constexpr double kPixelsWithoutArray = 3.0;

/// Of the values above 0 among at most about 10,000; 0 where there is none.
double medianOf(vtkDataArray* array)
{
  std::vector<double> values;
  const vtkIdType step = 1 + array->GetNumberOfTuples() / 10000;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); i += step)
  {
    const double value = array->GetComponent(i, 0);
    if (value > 0.0 && std::isfinite(value))
    {
      values.push_back(value);
    }
  }
  if (values.empty())
  {
    return 0.0;
  }
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace

vtkStandardNewMacro(vtkSplatMapper);

vtkSplatMapper::vtkSplatMapper() = default;
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

void vtkSplatMapper::CopySizes(const vtkSplatMapper* other, double factor)
{
  this->SetSizeArrayName(other->SizeArrayName);
  this->SetSizeScale(factor * other->SizeScale);
  this->SetLargestRatio(other->LargestRatio);
  this->SetPixelRange(other->SmallestPixels, other->LargestPixels);
  this->SetFixedPixels(factor * other->FixedPixels);
}

void vtkSplatMapper::RenderPieceStart(vtkRenderer* renderer, vtkActor* actor)
{
  vtkDataArray* sizes =
    this->CurrentInput ? this->CurrentInput->GetPointData()->GetArray(this->SizeArrayName.c_str()) : nullptr;
  const bool hasSizes = sizes && sizes->GetNumberOfComponents() == 1;
  if (hasSizes != this->HasSizes)
  {
    this->HasSizes = hasSizes;
    this->RemoveVertexAttributeMapping(kAttribute);
    if (hasSizes)
    {
      this->MapDataArrayToVertexAttribute(
        kAttribute, this->SizeArrayName.c_str(), vtkDataObject::FIELD_ASSOCIATION_POINTS);
    }
    this->Modified();
  }
  if (hasSizes && sizes->GetMTime() != this->MedianTime)
  {
    this->MedianTime = sizes->GetMTime();
    this->MedianLength = medianOf(sizes);
  }
  this->Superclass::RenderPieceStart(renderer, actor);
}

void vtkSplatMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  glEnable(GL_PROGRAM_POINT_SIZE);
  this->Superclass::RenderPieceDraw(renderer, actor);
  glDisable(GL_PROGRAM_POINT_SIZE);
}

void vtkSplatMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  // In front of the superclass, which takes the marks away.
  std::string vertex = shaders[vtkShader::Vertex]->GetSource();
  const std::string declared = this->HasSizes ? std::string("in float ") + kAttribute + ";\n" : std::string();
  vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Dec",
    "//VTK::PositionVC::Dec\n" + declared +
      "uniform float splatPixels;\nuniform float splatLongest;\nuniform vec2 splatRange;\n");
  vtkShaderProgram::Substitute(vertex, "//VTK::PositionVC::Impl",
    std::string("//VTK::PositionVC::Impl\n  gl_PointSize = clamp(splatPixels") +
      (this->HasSizes ? std::string(" * min(splatLongest, ") + kAttribute + ") / gl_Position.w" : "") +
      ", splatRange.x, splatRange.y);\n");
  shaders[vtkShader::Vertex]->SetSource(vertex);
  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  vtkShaderProgram::Substitute(fragment, "//VTK::Clip::Impl",
    "  vec2 splatPlace = 2.0 * gl_PointCoord - vec2(1.0);\n"
    "  if (dot(splatPlace, splatPlace) > 1.0) { discard; }\n"
    "//VTK::Clip::Impl\n");
  shaders[vtkShader::Fragment]->SetSource(fragment);
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
}

void vtkSplatMapper::SetMapperShaderParameters(vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cells, renderer, actor);
  double pixels = this->FixedPixels > 0.0 ? this->FixedPixels : kPixelsWithoutArray;
  double range[2] = { 1.0, std::max(this->FixedPixels, this->LargestPixels) };
  if (this->HasSizes && this->FixedPixels == 0.0)
  {
    // A length at distance w covers as many pixels, for both kinds of projection: w is 1 for a parallel one.
    vtkMatrix4x4* projection =
      renderer->GetActiveCamera()->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1);
    const double modelScale = std::cbrt(std::abs(actor->GetMatrix()->Determinant()));
    pixels = this->SizeScale * modelScale * 0.5 * renderer->GetSize()[1] * projection->GetElement(1, 1);
    range[0] = this->SmallestPixels;
    range[1] = this->LargestPixels;
  }
  else if (this->HasSizes)
  {
    range[0] = range[1] = pixels; // whatever the array says
  }
  const float limits[2] = { static_cast<float>(range[0]), static_cast<float>(range[1]) };
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
    cells.Program->SetUniform2f("splatRange", limits);
  }
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
}
