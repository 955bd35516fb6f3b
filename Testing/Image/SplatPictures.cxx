#include "SplatPictures.h"

#include "CloudAppearance.h"
#include "CloudOrientation.h"
#include "CloudParts.h"
#include "HapticSceneBuilder.h"
#include "LevelOfDetail.h"
#include "Pictures.h"
#include "PolyDataAccess.h"
#include "ShownCloud.h"
#include "SurfaceArrays.h"
#include "vtkDepthShadingPass.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkSplatMapper.h"
#include "vtkVoxelMeanResampler.h"
#include "vtkWorkspaceBrackets.h"

#include "Core/Base/Vector3.h"
#include "Shapes/Shapes.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace testing
{
namespace
{

/// The statue, sparse behind the foot, as the viewer draws it.
vtkSmartPointer<vtkActor> showStatue(vtkRenderer* renderer, std::int64_t count, bool equalSizes)
{
  std::vector<Vec3> positions;
  vtkNew<vtkPoints> points;
  if (generateShape(Shape::Idol, count, 3, 0.0, positions) == Status::Ok)
  {
    for (const Vec3& p : positions)
    {
      points->InsertNextPoint(p.x, p.y, p.z);
    }
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  addHeightArray(cloud, { 0, 0, 1 });
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  bandwidth->SetInputConnection(resampler->GetOutputPort());
  bandwidth->ComputeMeanBandwidthOn();
  bandwidth->Update();
  vtkNew<vtkSplatMapper> mapper;
  mapper->Settings().sizeArray = "MeanBandwidth";
  mapper->SetInputData(bandwidth->GetOutput());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  applyCloudAppearance(bandwidth->GetOutput(), mapper, actor, kHeightArrayName);
  mapper->Settings().fixedPixels = equalSizes ? 3.0 : 0.0;
  renderer->AddActor(actor);
  applyBackground(renderer);
  applyDepthShading(
    renderer, 1.1 * quantileOfPositive(bandwidth->GetOutput()->GetPointData()->GetArray("MeanBandwidth"), 5));
  // From below and behind, where it is sparse.
  placeCamera(renderer->GetActiveCamera(), CloudOrientation(), 0.1, 200.0, 12.0);
  renderer->GetActiveCamera()->Zoom(1.6);
  return actor;
}

/// Adds the arrays of the felt surface to the means behind @p actor.
void addSurface(vtkActor* actor, bool residuals, bool normals)
{
  auto* means = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputDataObject(0, 0));
  Status status = Status::Empty;
  if (const auto scene = makeHapticScene(means, status))
  {
    addSurfaceArrays(means, *scene, residuals, normals);
  }
}

/// The statue in one colour under the sky.
vtkSmartPointer<vtkActor> showLitStatue(vtkRenderer* renderer, std::int64_t count, const std::string& fault)
{
  const vtkSmartPointer<vtkActor> actor = showStatue(renderer, count, false);
  auto* mapper = vtkSplatMapper::SafeDownCast(actor->GetMapper());
  addSurface(actor, false, true);
  auto* means = vtkPolyData::SafeDownCast(mapper->GetInput());
  vtkDataArray* normals = means->GetPointData()->GetArray(kSurfaceNormalArrayName);
  // Which side a normal is on must not be seen.
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    double normal[3];
    normals->GetTuple(i, normal);
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    if (fault == "wrong-normals" && i % 3 == 0)
    {
      normal[0] = normal[1] = 0.0; // all the same
    }
    normals->SetTuple3(i, side * normal[0], side * normal[1], side * normal[2]);
  }
  mapper->ScalarVisibilityOff();
  actor->GetProperty()->SetColor(0.60, 0.68, 0.80);
  mapper->Settings().ambientLight = fault != "no-light";
  const double sky[3] = { 0.0, 0.0, fault == "sky-below" ? -1.0 : 1.0 };
  mapper->Settings().sky = { sky[0], sky[1], sky[2] };
  placeCamera(renderer->GetActiveCamera(), CloudOrientation(), 0.1, 28.0, 12.0);
  renderer->GetActiveCamera()->Zoom(1.6);
  return actor;
}

} // namespace

/// A sphere, noisier towards its top, and five points beside it on no surface.
void buildResiduals(const std::string& fault, vtkRenderer* renderer)
{
  vtkNew<vtkPoints> points;
  constexpr int kCount = 30000;
  for (int i = 0; i < kCount; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / kCount;
    const double angle = 2.39996322972865332 * i;
    const double across = std::sqrt(1.0 - z * z);
    const double radius = 0.03 + 2e-4 * std::max(0.0, z) * (i * 7919 % 1000 / 1000.0 - 0.5);
    points->InsertNextPoint(radius * across * std::cos(angle), radius * across * std::sin(angle), radius * z);
  }
  for (int i = -2; i <= 2; ++i)
  {
    points->InsertNextPoint(0.015 * i, -0.04, 0.03);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetVoxelSize(0.0004);
  resampler->ComputeCovarianceOn();
  resampler->Update();
  vtkNew<vtkSplatMapper> mapper;
  mapper->SetInputData(resampler->GetOutput());
  mapper->Settings().fixedPixels = 5.0;
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  addSurface(actor, true, false);
  vtkDataArray* residuals = resampler->GetOutput()->GetPointData()->GetArray(kResidualArrayName);
  for (vtkIdType i = 0; i < residuals->GetNumberOfTuples(); ++i)
  {
    const double value = residuals->GetComponent(i, 0);
    const double wrong = std::isnan(value) && fault == "not-a-number-as-zero" ? 0.0 : value;
    residuals->SetComponent(i, 0, fault == "larger" ? 1.3 * wrong : wrong);
  }
  applyCloudAppearance(resampler->GetOutput(), mapper, actor, kResidualArrayName);
  vtkLookupTable::SafeDownCast(mapper->GetLookupTable())->SetTableRange(0.0, 5e-5);
  renderer->AddActor(actor);
  applyBackground(renderer);
  placeCamera(renderer->GetActiveCamera(), CloudOrientation(), 0.1, 28.0, 18.0);
  renderer->GetActiveCamera()->Zoom(1.7);
}

void buildAmbientLight(const std::string& fault, vtkRenderer* renderer)
{
  showLitStatue(renderer, 12000, fault);
}

void buildFirstGlance(const std::string& fault, vtkRenderer* renderer)
{
  std::vector<Vec3> positions;
  if (generateShape(Shape::Idol, 20000, 3, 0.0, positions) != Status::Ok)
  {
    return;
  }
  vtkNew<vtkPoints> points;
  for (const Vec3& p : positions)
  {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  // Strays, and rays that did not return.
  points->InsertNextPoint(1.0, 0.0, 0.0);
  points->InsertNextPoint(0.0, 0.0, 0.0);
  points->InsertNextPoint(0.0, 0.0, 0.0);
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  const std::shared_ptr<ShownCloud> shown =
    makeShownCloud(cloud, ShownRequest(), [](double) { return true; });
  vtkNew<vtkSplatMapper> mapper;
  drawShown(*shown, mapper);
  mapper->ScalarVisibilityOff();
  mapper->Settings().surfaces = fault != "no-tilt";
  mapper->Settings().lightStrength = fault == "no-light" ? 0.0 : 1.0;
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(kClayColor[0], kClayColor[1], kClayColor[2]);
  renderer->AddActor(actor);
  vtkNew<vtkWorkspaceBrackets> brackets;
  const double box[6] = { -0.05, 0.05, -0.05, 0.05, -0.05, 0.05 };
  brackets->SetBox(box);
  brackets->SetVisibility(fault != "no-brackets");
  renderer->AddActor(brackets);
  applyGround(renderer);
  applyDepthShading(renderer, fault == "no-depth" ? 1.0 : shown->look.noiseLength);
  const CameraFit fit =
    fitCamera(PointAccess(shown->points->GetPoints()).view(), shown->look, AffineTransform(), 4.0 / 3.0);
  renderer->GetActiveCamera()->SetPosition(&fit.position.x);
  renderer->GetActiveCamera()->SetFocalPoint(&fit.focalPoint.x);
  renderer->GetActiveCamera()->SetViewUp(&fit.up.x);
  renderer->GetActiveCamera()->SetViewAngle(fit.viewAngle);
}

void buildSmoothGlance(const std::string& fault, vtkRenderer* renderer)
{
  buildFirstGlance("", renderer);
  vtkDepthShadingPass::GetPassOf(renderer)->SetBlendsSplats(fault != "not-blended");
}

void buildCoarseAmbientLight(const std::string& fault, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkActor> actor = showLitStatue(renderer, 40000, fault);
  static std::unique_ptr<LevelOfDetail> detail; // until the program ends
  detail = std::make_unique<LevelOfDetail>(renderer, actor);
  detail->setEnabled(true);
  detail->beginFrame(0.0);
}

void buildSplats(const std::string& fault, vtkRenderer* renderer)
{
  showStatue(renderer, 12000, fault == "equal-sizes");
}

void buildCoarseSplats(const std::string& fault, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkActor> actor = showStatue(renderer, 100000, fault == "equal-sizes");
  static std::unique_ptr<LevelOfDetail> detail; // until the program ends
  detail = std::make_unique<LevelOfDetail>(renderer, actor);
  detail->setEnabled(fault != "all-points");
  detail->beginFrame(0.0);
}

} // namespace testing
} // namespace pointhaptics
