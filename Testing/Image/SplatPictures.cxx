#include "SplatPictures.h"

#include "CloudAppearance.h"
#include "CloudDetail.h"
#include "CloudOrientation.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkSplatMapper.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Shapes.h"
#include "Core/Vector3.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <memory>
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
  bandwidth->Update();
  vtkNew<vtkSplatMapper> mapper;
  mapper->SetInputData(bandwidth->GetOutput());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  applyCloudAppearance(bandwidth->GetOutput(), mapper, actor, kHeightArrayName);
  mapper->SetFixedPixels(equalSizes ? 3.0 : 0.0);
  renderer->AddActor(actor);
  applyBackground(renderer);
  applyDepthShading(renderer, 0.003);
  // From below and behind, where it is sparse.
  placeCamera(renderer->GetActiveCamera(), CloudOrientation(), {}, 0.1, 200.0, 12.0);
  renderer->GetActiveCamera()->Zoom(1.6);
  return actor;
}

} // namespace

void buildSplats(const std::string& fault, vtkRenderer* renderer)
{
  showStatue(renderer, 12000, fault == "equal-sizes");
}

void buildCoarseSplats(const std::string& fault, vtkRenderer* renderer)
{
  const vtkSmartPointer<vtkActor> actor = showStatue(renderer, 100000, fault == "equal-sizes");
  static std::unique_ptr<CloudDetail> detail; // until the program ends
  detail = std::make_unique<CloudDetail>(renderer, actor);
  detail->setEnabled(fault != "all-points");
  detail->beginFrame(0.0);
}

} // namespace testing
} // namespace pointhaptics
