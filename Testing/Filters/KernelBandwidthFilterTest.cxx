#include "FilterFixtures.h"

#include "Core/Bandwidth/Density.h"
#include "Core/Bandwidth/LocalBandwidth.h"
#include "Core/Reference/ReferenceBandwidth.h"

#include "vtkCommand.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVoxelMeanResampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

vtkDataArray* arrayOf(vtkKernelBandwidthFilter* filter, const char* name)
{
  return filter->GetOutput()->GetPointData()->GetArray(name);
}

/// The error of a filter set to fail: said, with these words of the cure, and a valid empty output.
void expectError(vtkKernelBandwidthFilter* filter, const std::string& cure)
{
  trial::Ear errors(filter, vtkCommand::ErrorEvent);
  filter->Update();
  EXPECT_GE(errors.count, 1);
  EXPECT_NE(errors.last.find(cure), std::string::npos) << "no '" << cure << "' in: " << errors.last;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

/// The bandwidth at a point by the definition.
double expectedBandwidth(vtkPolyData* cloud, vtkIdType at, int neighbors)
{
  std::vector<pointhaptics::Vec3> points;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    const double* p = cloud->GetPoint(i);
    points.emplace_back(p[0], p[1], p[2]);
  }
  const pointhaptics::PointView view(points.data(), std::int64_t(points.size()));
  std::vector<std::int64_t> indices;
  for (const auto& n :
    pointhaptics::reference::nearest(view, points[std::size_t(at)], std::size_t(neighbors) + 1))
  {
    indices.push_back(n.index);
  }
  return double(pointhaptics::reference::surfaceSpread(view, indices) *
    pointhaptics::reference::bandwidthFactor(
      pointhaptics::BandwidthRule::NormalReference, (long double)(indices.size()), 1));
}

} // namespace

TEST(KernelBandwidthFilter, HasTheDocumentedDefaults)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  EXPECT_EQ(filter->GetNeighborhood(), vtkKernelBandwidthFilter::KNearest);
  EXPECT_EQ(filter->GetNumberOfNeighbors(), 16);
  EXPECT_EQ(filter->GetRule(), vtkKernelBandwidthFilter::NormalReference);
  EXPECT_EQ(filter->GetRadiusScale(), 4.0);
  EXPECT_EQ(filter->GetMinimumRadius(), 0.0);
  EXPECT_EQ(filter->GetMaximumRadius(), 0.0);
  EXPECT_TRUE(filter->GetComputeBandwidth());
  EXPECT_TRUE(filter->GetComputeProxyRadius());
  EXPECT_FALSE(filter->GetComputeDensity());
  EXPECT_EQ(filter->GetDensityKernel(), vtkKernelBandwidthFilter::Gaussian);
}

TEST(KernelBandwidthFilter, AgreesWithTheDefinition)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    const auto cloud = trial::cloudOf(trial::randomPoints(1000, 1, type));
    vtkNew<vtkKernelBandwidthFilter> filter;
    filter->SetInputData(cloud);
    filter->SetNumberOfNeighbors(10);
    filter->SetMinimumRadius(1e-9);
    filter->ComputeDensityOff();
    filter->Update();
    ASSERT_NE(arrayOf(filter, "Bandwidth"), nullptr);
    ASSERT_NE(arrayOf(filter, "ProxyRadius"), nullptr);
    EXPECT_EQ(arrayOf(filter, "Density"), nullptr);
    EXPECT_EQ(arrayOf(filter, "Bandwidth")->GetDataType(), VTK_DOUBLE);
    for (vtkIdType i = 0; i < 1000; i += 37)
    {
      const double b = arrayOf(filter, "Bandwidth")->GetTuple1(i);
      EXPECT_NEAR(b / expectedBandwidth(cloud, i, 10), 1.0, 1e-9);
      EXPECT_NEAR(arrayOf(filter, "ProxyRadius")->GetTuple1(i), 4 * b, 1e-12);
    }
  }
}

TEST(KernelBandwidthFilter, PassesItsInputThrough)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(200, 2));
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("RGB");
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(200);
  colours->Fill(7);
  cloud->GetPointData()->SetScalars(colours);
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(cloud);
  filter->ComputeDensityOn();
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  EXPECT_EQ(output->GetNumberOfPoints(), 200);
  ASSERT_NE(output->GetPointData()->GetScalars(), nullptr);
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "RGB") << "the active scalars stay active";
  for (const char* name : { "RGB", "Bandwidth", "ProxyRadius", "Density" })
  {
    ASSERT_NE(arrayOf(filter, name), nullptr) << name;
    EXPECT_EQ(arrayOf(filter, name)->GetNumberOfTuples(), 200);
  }
  EXPECT_EQ(cloud->GetPointData()->GetNumberOfArrays(), 1) << "the input is left alone";
  filter->ComputeBandwidthOff();
  filter->ComputeProxyRadiusOff();
  filter->ComputeDensityOff();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 1);
}

TEST(KernelBandwidthFilter, DensityDoesNotNeedTheOtherArrays)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(trial::cloudOf(trial::randomPoints(300, 4)));
  filter->ComputeDensityOn();
  filter->Update();
  const double expected = arrayOf(filter, "Density")->GetTuple1(17);
  filter->ComputeBandwidthOff();
  filter->ComputeProxyRadiusOff();
  filter->Update();
  ASSERT_NE(arrayOf(filter, "Density"), nullptr);
  EXPECT_EQ(arrayOf(filter, "Density")->GetTuple1(17), expected);
}

TEST(KernelBandwidthFilter, GivesWhatCoreGivesForItsProperties)
{
  const auto points = trial::randomPoints(2000, 5);
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(trial::cloudOf(points));
  filter->SetMinimumRadius(0.15);
  filter->SetMaximumRadius(0.2);
  filter->SetDensityKernelToEpanechnikov();
  filter->ComputeDensityOn();
  filter->Update();
  const pointhaptics::PointView view(static_cast<const double*>(points->GetData()->GetVoidPointer(0)), 2000);
  pointhaptics::NeighborQuery query;
  query.build(view);
  std::vector<double> bandwidths;
  std::vector<double> radii;
  std::vector<double> densities;
  ASSERT_EQ(pointhaptics::localBandwidths(view, {}, query, filter->GetSettings(), bandwidths, radii),
    pointhaptics::Status::Ok);
  pointhaptics::surfaceDensities(
    view, {}, query, bandwidths, densities, {}, pointhaptics::DensityKernel::Epanechnikov);
  for (vtkIdType i = 0; i < 2000; ++i)
  {
    EXPECT_EQ(arrayOf(filter, "ProxyRadius")->GetTuple1(i), radii[std::size_t(i)]);
    EXPECT_EQ(arrayOf(filter, "Density")->GetTuple1(i), densities[std::size_t(i)]);
  }
}

TEST(KernelBandwidthFilter, DegenerateCloudsGetUsableRadii)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->ComputeDensityOn();
  for (const std::vector<std::vector<double>>& places :
    { std::vector<std::vector<double>>{ { 1, 2, 3 } }, std::vector<std::vector<double>>(50, { 1, 2, 3 }),
      std::vector<std::vector<double>>{ { 0, 0, 0 }, { 1, 0, 0 } } })
  {
    filter->SetInputData(trial::cloudAt(places));
    filter->Update();
    for (vtkIdType i = 0; i < vtkIdType(places.size()); ++i)
    {
      for (const char* name : { "Bandwidth", "ProxyRadius", "Density" })
      {
        EXPECT_GT(arrayOf(filter, name)->GetTuple1(i), 0.0) << name;
        EXPECT_TRUE(std::isfinite(arrayOf(filter, name)->GetTuple1(i))) << name;
      }
    }
  }
}

TEST(KernelBandwidthFilter, EmptyInputIsNoError)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(empty);
  trial::Ear errors(filter, vtkCommand::ErrorEvent);
  filter->Update();
  EXPECT_EQ(errors.count, 0) << errors.last;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(KernelBandwidthFilter, ErrorsNameTheCureAndGiveAValidEmptyOutput)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(trial::cloudOf(trial::randomPoints(100, 7)));
  filter->Update();
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPoints(), 100);
  filter->SetNumberOfNeighbors(0);
  expectError(filter, "needs at least 1 neighbour");
  filter->SetNumberOfNeighbors(16);
  filter->SetNeighborhoodToFixedRadius();
  filter->SetRadius(0.0);
  expectError(filter, "a radius above 0");
  filter->SetRadius(std::numeric_limits<double>::quiet_NaN());
  expectError(filter, "a radius above 0");
  filter->SetNeighborhoodToKNearest();
  filter->SetMinimumRadius(2);
  filter->SetMaximumRadius(1);
  expectError(filter, "r1 not above r2");
  filter->SetMaximumRadius(0);
  filter->SetRadiusScale(-1);
  expectError(filter, "give a value within");
  filter->SetRadiusScale(4);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 100) << "it recovers";
}

TEST(KernelBandwidthFilter, RunsAgainWhenSomethingChangedAndOnlyThen)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(trial::cloudOf(trial::randomPoints(100, 8)));
  filter->Update();
  trial::Ear runs(filter, vtkCommand::StartEvent);
  filter->Update();
  EXPECT_EQ(runs.count, 0);
  filter->SetNumberOfNeighbors(8);
  filter->Update();
  EXPECT_EQ(runs.count, 1);
  filter->SetNumberOfNeighbors(8);
  filter->SetRadiusScale(4.0);
  filter->Update();
  EXPECT_EQ(runs.count, 1);
  filter->SetRule(vtkKernelBandwidthFilter::SilvermanRobust);
  filter->Update();
  EXPECT_EQ(runs.count, 2);
}

TEST(KernelBandwidthFilter, GivesTheSameBitsWithEveryBackEndAndThreadCount)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(20000, 9));
  vtkNew<vtkPolyData> expected;
  for (const char* backend : { "Sequential", "STDThread", "TBB" })
  {
    if (!vtkSMPTools::SetBackend(backend))
    {
      continue;
    }
    for (const int threads : { 1, 2, 8 })
    {
      vtkSMPTools::Initialize(threads);
      vtkNew<vtkKernelBandwidthFilter> filter;
      filter->SetInputData(cloud);
      filter->ComputeDensityOn();
      filter->Update();
      if (expected->GetNumberOfPoints() == 0)
      {
        expected->DeepCopy(filter->GetOutput());
      }
      for (const char* name : { "Bandwidth", "ProxyRadius", "Density" })
      {
        for (vtkIdType i = 0; i < 20000; ++i)
        {
          ASSERT_EQ(
            arrayOf(filter, name)->GetTuple1(i), expected->GetPointData()->GetArray(name)->GetTuple1(i))
            << name << ' ' << backend << ' ' << threads;
        }
      }
    }
  }
  vtkSMPTools::Initialize(0);
}

TEST(KernelBandwidthFilter, OffersEveryRuleForBothNeighborhoods)
{
  const auto cloud = trial::cloudOf(trial::randomPoints(2000, 11));
  std::vector<double> seen;
  for (int neighborhood = vtkKernelBandwidthFilter::KNearest;
       neighborhood <= vtkKernelBandwidthFilter::FixedRadius; ++neighborhood)
  {
    for (int rule = vtkKernelBandwidthFilter::NormalReference;
         rule <= vtkKernelBandwidthFilter::SheatherJones; ++rule)
    {
      vtkNew<vtkKernelBandwidthFilter> filter;
      filter->SetInputData(cloud);
      filter->SetNeighborhood(neighborhood);
      filter->SetRadius(0.3);
      filter->SetRule(rule);
      filter->ComputeDensityOff();
      filter->Update();
      ASSERT_EQ(filter->GetRule(), rule);
      const double b = arrayOf(filter, "Bandwidth")->GetTuple1(500);
      EXPECT_GT(b, 0.0);
      EXPECT_TRUE(std::isfinite(b));
      // Scott's and Silverman's multivariate rules are the same on a surface.
      if (rule != vtkKernelBandwidthFilter::SilvermanMultivariate)
      {
        EXPECT_EQ(std::count(seen.begin(), seen.end(), b), 0) << neighborhood << ' ' << rule;
      }
      seen.push_back(b);
    }
  }
}

namespace
{

/// Notes the progress of a filter and ends its work at some point.
struct ProgressNotes
{
  std::vector<double> seen;
  double abortAt = 2.0;

  static void note(vtkObject* caller, unsigned long, void* self, void*)
  {
    auto* filter = static_cast<vtkAlgorithm*>(caller);
    auto* notes = static_cast<ProgressNotes*>(self);
    notes->seen.push_back(filter->GetProgress());
    filter->SetAbortExecute(filter->GetProgress() >= notes->abortAt);
  }
};

}

TEST(KernelBandwidthFilter, ReportsProgressAndHonoursAnAbort)
{
  vtkNew<vtkKernelBandwidthFilter> filter;
  filter->SetInputData(trial::cloudOf(trial::randomPoints(40000, 14)));
  ProgressNotes notes;
  vtkNew<vtkCallbackCommand> callback;
  callback->SetClientData(&notes);
  callback->SetCallback(ProgressNotes::note);
  filter->AddObserver(vtkCommand::ProgressEvent, callback);
  filter->Update();
  EXPECT_GT(notes.seen.size(), 8u);
  EXPECT_TRUE(std::is_sorted(notes.seen.begin(), notes.seen.end()));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 40000);
  for (const double abortAt : { 0.05, 0.2, 0.6 })
  {
    notes.seen.clear();
    notes.abortAt = abortAt;
    filter->Modified();
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << abortAt;
    EXPECT_LT(notes.seen.empty() ? 0.0 : notes.seen.back(), 1.0 + 1e-9);
  }
  notes.abortAt = 2.0;
  filter->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 40000) << "it recovers";
}

namespace
{

/// A square with sixteen times the density where x < 0.
vtkSmartPointer<vtkPolyData> densityStep(int dense)
{
  std::mt19937_64 engine(10);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < dense + dense / 16; ++i)
  {
    const double x = i < dense ? trial::uniform(engine, -1, 0) : trial::uniform(engine, 0, 1);
    points->InsertNextPoint(0.02 * x, 0.02 * trial::uniform(engine), 0.0);
  }
  return trial::cloudOf(points);
}

double sideRatio(vtkKernelBandwidthFilter* filter, const char* name)
{
  double sum[2] = { 0, 0 };
  double count[2] = { 0, 0 };
  for (vtkIdType i = 0; i < filter->GetOutput()->GetNumberOfPoints(); ++i)
  {
    const int side = filter->GetOutput()->GetPoint(i)[0] > 0;
    sum[side] += arrayOf(filter, name)->GetTuple1(i);
    count[side] += 1;
  }
  return sum[1] / count[1] / (sum[0] / count[0]);
}

}

TEST(Pipeline, RadiiOfAResampledCloudAreThoseOfThePoints)
{
  const auto cloud = densityStep(64000);
  vtkNew<vtkKernelBandwidthFilter> raw;
  raw->SetInputData(cloud);
  raw->ComputeDensityOn();
  raw->Update();
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  vtkNew<vtkKernelBandwidthFilter> filter;
  EXPECT_TRUE(filter->GetUsePointCounts());
  filter->SetInputConnection(resampler->GetOutputPort());
  filter->ComputeDensityOn();
  filter->Update();
  for (const char* name : { "ProxyRadius", "Bandwidth" })
  {
    EXPECT_NEAR(sideRatio(filter, name) / sideRatio(raw, name), 1.0, 0.1) << name;
    EXPECT_GT(sideRatio(filter, name), 3.5) << name;
  }
  // Voxels at the step see both sides, and so do their averages.
  EXPECT_NEAR(sideRatio(raw, "Density"), 1.0 / 16.0, 0.02);
  EXPECT_NEAR(sideRatio(filter, "Density"), 1.0 / 16.0, 0.02);
  EXPECT_TRUE(filter->GetSettings().usePointCounts);
  EXPECT_EQ(arrayOf(filter, "MeanBandwidth"), nullptr);
  vtkNew<vtkKernelBandwidthFilter> forSplats;
  forSplats->SetInputConnection(resampler->GetOutputPort());
  forSplats->ComputeMeanBandwidthOn();
  forSplats->ComputeBandwidthOff();
  forSplats->ComputeProxyRadiusOff();
  forSplats->ComputeDensityOff();
  forSplats->Update();
  filter->UsePointCountsOff();
  filter->Update();
  EXPECT_FALSE(filter->GetSettings().usePointCounts);
  EXPECT_LT(sideRatio(filter, "ProxyRadius"), 2.5);
  EXPECT_GT(sideRatio(filter, "Density"), 0.2);
  vtkNew<vtkPolyData> means;
  means->DeepCopy(resampler->GetOutput());
  means->GetPointData()->RemoveArray("VoxelPointCount");
  vtkNew<vtkKernelBandwidthFilter> ofMeans;
  ofMeans->SetInputData(means);
  ofMeans->ComputeDensityOn();
  ofMeans->Update();
  for (vtkIdType i = 0; i < means->GetNumberOfPoints(); ++i)
  {
    ASSERT_EQ(arrayOf(forSplats, "MeanBandwidth")->GetTuple1(i), arrayOf(ofMeans, "Bandwidth")->GetTuple1(i));
  }
  for (const char* name : { "ProxyRadius", "Bandwidth", "Density" })
  {
    for (vtkIdType i = 0; i < means->GetNumberOfPoints(); ++i)
    {
      ASSERT_EQ(arrayOf(filter, name)->GetTuple1(i), arrayOf(ofMeans, name)->GetTuple1(i)) << name;
    }
  }
}
