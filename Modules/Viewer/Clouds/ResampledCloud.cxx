#include "ResampledCloud.h"

#include "ClippedCloud.h"
#include "CoordinateText.h"
#include "EventLink.h"
#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "SceneFilters.h"
#include "SurfaceArrays.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/Lattice.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMatrix4x4.h>
#include <vtkMatrixToLinearTransform.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Part of the workspace's edge that a fitted cloud takes: the hand needs room to reach it from every side.
constexpr double kFittedPart = 0.9;
constexpr int kUsual = kDefaultLatticeDimension;

/// The lattice that the options ask for.
LatticeSettings latticeOf(const HapticViewerOptions& options, const LoadedCloud& loaded)
{
  LatticeSettings lattice = options.voxels.lattice;
  if (lattice.dimensions[0] == 0)
  {
    const int n = loaded.latticeDimension > 0 ? loaded.latticeDimension : kUsual;
    lattice.dimensions = { n, n, n };
  }
  if (options.fitsWorkspace)
  {
    lattice.workspace = defaultWorkspace();
    lattice.automaticWorkspace = false;
  }
  return lattice;
}

/// Box of the lattice before there is one, as the resampler would choose it. The hand's box stays, so the
/// resampler need not be asked. Empty where the options are no lattice, which the resampler reports.
Bounds workspaceOf(const HapticViewerOptions& options, const LoadedCloud& loaded)
{
  Lattice lattice;
  return makeLattice(latticeOf(options, loaded), loaded.bounds, lattice) == Status::Ok ? lattice.bounds()
                                                                                       : Bounds();
}

/// The numbers as --clip takes them.
std::string clipText(const std::vector<double>& clip)
{
  std::string text;
  for (const double number : clip)
  {
    text += (text.empty() ? "" : ",") + valueText(number);
  }
  return text;
}

bool choosesLattice(const HapticViewerOptions& options)
{
  return options.fitsWorkspace && !options.hasVoxels();
}

void placeWorkspace(const CloudRequest& request, LoadedCloud& loaded)
{
  loaded.workspace = workspaceOf(request.options, loaded);
  loaded.workspace = loaded.workspace.empty() ? defaultWorkspace() : loaded.workspace;
}

/// Runs the filters for one cloud.
class FirstRun
{
public:
  FirstRun(const CloudRequest& request, const LoadProgress& progress, LoadedCloud& loaded)
    : request_(request)
    , progress_(progress)
    , loaded_(loaded)
  {
    vtkNew<vtkMatrix4x4> model;
    setElements(model, loaded.model);
    vtkNew<vtkMatrixToLinearTransform> transform;
    transform->SetInput(model);
    vtkNew<vtkPolyData> cloud; // the object itself belongs to the one that takes it
    loaded.felt = shownPart(loaded.cloud, request.options.clip, loaded.showing.hidden);
    cloud->ShallowCopy(loaded.felt);
    resampler_->SetInputData(cloud);
    resampler_->SetTransform(transform);
    asking_.follow(resampler_, vtkCommand::ProgressEvent);
  }

  bool goesOn() const { return progress_("resampling", resampler_->GetProgress()); }

  vtkSmartPointer<vtkPolyData> resample()
  {
    configureFilters(request_.options, loaded_, resampler_, bandwidth_);
    resampler_->Update();
    ++loaded_.resamplings;
    auto means = vtkSmartPointer<vtkPolyData>::New();
    means->ShallowCopy(resampler_->GetOutput());
    return means;
  }

  /// Resamples with the lattice that suits the cloud.
  vtkSmartPointer<vtkPolyData> resampleAsFits()
  {
    const auto with = [this](int dimension)
    {
      loaded_.latticeDimension = dimension;
      return this->resample();
    };
    LatticeChoice choice = chooseLattice(with, [this] { return this->goesOn(); });
    loaded_.latticeDimension = choice.dimension;
    return std::move(choice.means);
  }

  /// Makes all that depends on the means.
  void finish(vtkPolyData* means)
  {
    const bool residuals =
      loaded_.colorBy == kResidualArrayName && !loaded_.cloud->GetPointData()->HasArray(kResidualArrayName);
    const bool normals = request_.options.ambient;
    configureFilters(request_.options, loaded_, resampler_, bandwidth_); // a finer try may have come after
    if (request_.makesScene || residuals || normals)
    {
      loaded_.scene = makeHapticScene(means, loaded_.sceneStatus, request_.options.voxels.computeCovariance,
        bandwidth_->GetSettings(), &resampler_->GetSettings());
    }
    loaded_.voxels = resampler_->GetSettings();
    if (request_.isFeltOnly)
    {
      loaded_.means = means;
      return;
    }
    bandwidth_->SetInputData(means);
    bandwidth_->Update();
    loaded_.means = vtkSmartPointer<vtkPolyData>::New();
    loaded_.means->ShallowCopy(bandwidth_->GetOutput());
    if (loaded_.scene && (residuals || normals))
    {
      addSurfaceArrays(loaded_.means, *loaded_.scene, residuals, normals);
    }
  }

private:
  const CloudRequest& request_;
  const LoadProgress& progress_;
  LoadedCloud& loaded_;
  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  EventLink asking_{ [this] { resampler_->SetAbortExecute(this->goesOn() ? 0 : 1); } };
};

/// True while the cloud lies in the workspace where @p placement puts it, at least half as long as it could
/// be.
bool fitsStill(const CloudRequest& request, const LoadedCloud& loaded, const AffineTransform& placement)
{
  const AffineTransform fit = placement * request.options.transform.inverse();
  const Bounds box = boxOfCorners(loaded.bounds, [&](const Vec3& p) { return fit.apply(p); });
  const Vec3 extent = box.extent();
  return contains(defaultWorkspace(), box.minimum) && contains(defaultWorkspace(), box.maximum) &&
    2.0 * std::max({ extent.x, extent.y, extent.z }) > kFittedPart * kDefaultWorkspaceEdge;
}

} // namespace

void placeCloud(const CloudRequest& request, LoadedCloud& loaded)
{
  loaded.placement = request.options.transform;
  if (request.options.fitsWorkspace)
  {
    const Vec3 extent = loaded.bounds.extent();
    const double longest = std::max({ extent.x, extent.y, extent.z });
    const double factor = longest > 0.0 ? kFittedPart * kDefaultWorkspaceEdge / longest : 1.0;
    loaded.placement = AffineTransform::scaling({ factor, factor, factor }) *
      AffineTransform::translation(-loaded.bounds.center()) * loaded.placement;
  }
  const bool isKept =
    request.placement && (!request.options.fitsWorkspace || fitsStill(request, loaded, *request.placement));
  loaded.placement = isKept ? *request.placement : loaded.placement;
  loaded.model = isKept && request.model ? *request.model : loaded.placement;
}

void configureFilters(const HapticViewerOptions& options, const LoadedCloud& loaded,
  vtkVoxelMeanResampler* resampler, vtkKernelBandwidthFilter* bandwidth)
{
  VoxelMeanSettings voxels = options.voxels;
  voxels.lattice = latticeOf(options, loaded);
  voxels.outputPointsPrecision = PointsPrecision::Double; // as feel does: the same forces
  if (const Bounds box = workspaceOf(options, loaded); !box.empty())
  {
    voxels.lattice.workspace = box;
    voxels.lattice.automaticWorkspace = false;
  }
  resampler->SetSettings(voxels);
  // The picture needs the sizes of its splats and the array that colours it; the scene computes the few radii
  // that it needs.
  BandwidthSettings settings = options.bandwidth;
  settings.computeBandwidth = false;
  settings.computeMeanBandwidth = true;
  settings.computeDensity = loaded.colorBy == "Density";
  settings.computeProxyRadius = loaded.colorBy == "ProxyRadius";
  bandwidth->SetSettings(settings);
}

void resampleLater(const CloudRequest& request, LoadedCloud& loaded)
{
  loaded.isResampled = false;
  loaded.findsLattice = choosesLattice(request.options);
  loaded.felt = loaded.cloud;
  loaded.means = vtkSmartPointer<vtkPolyData>::New();
  placeWorkspace(request, loaded);
}

bool resampleCloud(
  const CloudRequest& request, const LoadProgress& progress, LoadedCloud& loaded, std::string& message)
{
  const auto begin = std::chrono::steady_clock::now();
  FirstRun run(request, progress, loaded);
  if (loaded.felt->GetNumberOfPoints() == 0)
  {
    if (shownPart(loaded.cloud, request.options.clip, {})->GetNumberOfPoints() > 0)
    {
      message = fmt::format(
        "{}: all points are hidden by {}; hide fewer values", loaded.title, request.options.names.hidden);
      return false;
    }
    const Bounds all = extentOf(loaded.cloud).all;
    message = fmt::format("{}: no point lies in the box of {} {}; the cloud has {}", loaded.title,
      request.options.names.clip, clipText(request.options.clip), clipText(clipNumbers(all, loaded.cloud)));
    return false;
  }
  const bool chooses = choosesLattice(request.options);
  const vtkSmartPointer<vtkPolyData> means = chooses ? run.resampleAsFits() : run.resample();
  if (!run.goesOn())
  {
    message = loaded.title + ": resampling was stopped on request; start it again";
    return false;
  }
  run.finish(means);
  placeWorkspace(request, loaded);
  loaded.resampleSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return true;
}

} // namespace pointhaptics
