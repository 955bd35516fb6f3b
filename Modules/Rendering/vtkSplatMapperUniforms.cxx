// The numbers that the shaders of vtkSplatMapper get: sizes, slopes, clipping and light.
#include "vtkSplatMapper.h"

#include "vtkDepthShadingPass.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace
{

constexpr double kPixelsWithoutArray = 3.0;
/// Height of the window that the sizes in pixels are meant for.
constexpr double kUsualHeight = 800.0;
/// Largest diameter of points that a software renderer draws.
constexpr double kMostPixels = 255.0;
constexpr double kMostQuadPixels = 1e5;
/// From the viewer's left and above, in view coordinates.
constexpr double kLightDirection[3] = { -0.45, 0.55, 0.70 };

/// Sets those uniforms that the program has a use for.
class Uniforms
{
public:
  explicit Uniforms(vtkOpenGLHelper& cells)
    : program_(cells.Program)
  {
  }
  void set(const char* name, double value)
  {
    const double values[1] = { value };
    this->set(name, values);
  }
  void set(const char* name, int value)
  {
    if (program_->IsUniformUsed(name))
    {
      program_->SetUniformi(name, value);
    }
  }
  template <int Size>
  void set(const char* name, const double (&values)[Size])
  {
    float numbers[Size];
    std::transform(values, values + Size, numbers, [](double value) { return static_cast<float>(value); });
    if (program_->IsUniformUsed(name))
    {
      if constexpr (Size == 1)
      {
        program_->SetUniformf(name, numbers[0]);
      }
      else if constexpr (Size == 2)
      {
        program_->SetUniform2f(name, numbers);
      }
      else if constexpr (Size == 3)
      {
        program_->SetUniform3f(name, numbers);
      }
      else
      {
        program_->SetUniform4f(name, numbers);
      }
    }
  }

private:
  vtkShaderProgram* program_;
};

} // namespace

/// Diameter of a splat of length 1 at distance 1; at distance w it covers 1/w as many pixels, for both kinds
/// of projection: w is 1 for a parallel one.
double vtkSplatMapper::PixelsPerLength(vtkRenderer* renderer, vtkActor* actor)
{
  vtkMatrix4x4* projection =
    renderer->GetActiveCamera()->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1);
  const double modelScale = std::cbrt(std::abs(actor->GetMatrix()->Determinant()));
  return this->Now.sizeScale * modelScale * 0.5 * renderer->GetSize()[1] * projection->GetElement(1, 1);
}

/// Discs about one point of each cell close what those about all would: their areas grow by that of a disc of
/// this diameter at distance 1.
double vtkSplatMapper::GapPixels(vtkRenderer* renderer, vtkActor* actor)
{
  return pointhaptics::kClosingCells * this->Now.gap * this->PixelsPerLength(renderer, actor) /
    this->Now.sizeScale;
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
  if (this->HasNormals && this->Now.surfaces)
  {
    this->SetSurfaceParameters(cells, renderer, actor);
  }
  const double resolution = vtkDepthShadingPass::ResolutionOf(renderer);
  double pixels = resolution * (this->Now.fixedPixels > 0.0 ? this->Now.fixedPixels : kPixelsWithoutArray);
  const double most = this->DrawsQuads ? kMostQuadPixels : kMostPixels;
  double range[4] = { 1.0, resolution * std::max(this->Now.fixedPixels, this->Now.largestPixels), 0.0, most };
  if (this->HasSizes && this->Now.fixedPixels == 0.0)
  {
    const double lines = resolution * renderer->GetSize()[1];
    pixels = resolution * this->PixelsPerLength(renderer, actor);
    const double scale = this->Now.surfaces ? lines / kUsualHeight : resolution;
    range[0] = std::max(1.0, scale * this->Now.smallestPixels);
    range[1] = scale * this->Now.largestPixels;
    range[2] = scale * this->Now.pointPixels;
    range[3] = this->Now.surfaces ? std::min(most, scale * this->Now.surfacePixels) : most;
  }
  else if (this->HasSizes)
  {
    std::fill(range, range + 4, pixels); // whatever the array says
  }
  Uniforms uniforms(cells);
  const double points[2] = { 0.0, 0.0 };
  uniforms.set("splatFit", this->Fit);
  uniforms.set("splatPixel", this->DrawsQuads ? this->Pixel : points);
  uniforms.set("splatPixels", pixels);
  uniforms.set("splatLongest", this->Now.largestRatio * this->MedianLength);
  uniforms.set("splatRange", range);
  uniforms.set("splatGap", resolution * this->GapPixels(renderer, actor));
}

/// In the frame of the uploaded points, which are shifted and scaled where they are far from the origin.
void vtkSplatMapper::SetClipParameters(vtkOpenGLHelper& cells)
{
  constexpr double kLargest = 3e38; // of single precision
  vtkOpenGLVertexBufferObject* points = this->VBOs->GetVBO("vertexMC");
  const bool isShifted = points && points->GetCoordShiftAndScaleEnabled();
  double ends[2][3];
  for (std::size_t side = 0; side < this->Now.clipBox.size(); ++side)
  {
    const std::size_t axis = side / 2;
    const double shift = isShifted ? points->GetShift()[axis] : 0.0;
    const double scale = isShifted ? points->GetScale()[axis] : 1.0;
    ends[side % 2][axis] = std::clamp((this->Now.clipBox[side] - shift) * scale, -kLargest, kLargest);
  }
  Uniforms uniforms(cells);
  uniforms.set("splatLow", ends[0]);
  uniforms.set("splatHigh", ends[1]);
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
  const double terms[4] = { projection->GetElement(0, 0), projection->GetElement(1, 1),
    projection->GetElement(2, 2), projection->GetElement(2, 3) };
  const double lines = vtkDepthShadingPass::ResolutionOf(renderer) * renderer->GetSize()[1];
  if (cells.Program->IsUniformUsed("splatTurn"))
  {
    cells.Program->SetUniformMatrix3x3("splatTurn", &turn[0][0]);
  }
  Uniforms uniforms(cells);
  uniforms.set("splatTerms", terms);
  uniforms.set("splatHalfPixel", 1.0 / (projection->GetElement(1, 1) * lines));
  uniforms.set("splatNarrow", this->Now.foreshortens ? 1.0 : 0.0);
  uniforms.set("splatAll", this->Now.closesAll ? 1.0 : 0.0);
  uniforms.set("splatIsParallel", camera->GetParallelProjection() ? 1 : 0);
  uniforms.set("splatStage", static_cast<int>(vtkDepthShadingPass::StageOf(renderer)));
  constexpr int kUnusedUnit =
    15; // of a sampler that nothing reads: unit 0 may have a texture of another kind
  vtkTextureObject* tiles = vtkDepthShadingPass::TilesOf(renderer);
  const double tile = vtkDepthShadingPass::kTile;
  const double tileCount[2] = { renderer->GetSize()[0] / tile, renderer->GetSize()[1] / tile };
  uniforms.set("splatTiles", tiles ? tiles->GetTextureUnit() : kUnusedUnit);
  uniforms.set("splatTileCount", tileCount);
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
  taken(toModel, this->Now.sky.data(), 0.0, sky);
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
  const double place[4] = { eye[0], eye[1], eye[2], isParallel ? 0.0 : 1.0 };
  Uniforms uniforms(cells);
  uniforms.set("splatUnit", 1.0 / this->Now.normalUnit);
  uniforms.set("splatStrength", this->Now.lightStrength);
  uniforms.set("splatHides", this->Now.hidesBackFaces ? 1 : 0);
  uniforms.set("splatLamp", lamp);
  uniforms.set("splatSky", sky);
  uniforms.set("splatUnscale", unscale);
  uniforms.set("splatEye", place);
}
