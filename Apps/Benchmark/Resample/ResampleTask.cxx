/// How long does mean resampling take beside PCL, and with everything else that the filter can be asked for?
#include "Benchmark/Harness/Race.h"
#include "Benchmark/Harness/RivalModule.h"
#include "Benchmark/Resample/Expected.h"
#include "Benchmark/Tasks.h"
#include "Options/OptionParsing.h"

#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/PointView.h"
#include "Core/Resample/Representative.h"
#include "Shapes/Shapes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::resample
{
namespace
{

using namespace app;

constexpr double kMostPoints = 1e8;
constexpr double kMostVoxels = 2097152;
/// Seconds after which a contestant sits out the rounds left.
constexpr double kLongest = 40.0;

/// Radius of the sphere that the points lie on: the paper's larger one. 543,652 points on it fill about
/// 204,000 voxels of 300^3 in a cube of 10 cm.
constexpr double kSphereRadius = 0.04;
/// Edge of the workspace: the paper's.
constexpr double kWorkspaceEdge = 0.1;
constexpr char kColors[] = "RGB";
constexpr char kNormals[] = "Normals";
constexpr char kIntensity[] = "Intensity";
constexpr char kLabels[] = "Labels";
constexpr std::int64_t kPiece = 1000000;
constexpr double kUnscaledRadius = 0.025; // of Shape::Sphere

void fillRandomly(float* xyz, std::int64_t count)
{
  std::vector<Vec3> piece;
  for (std::int64_t begin = 0; begin < count; begin += kPiece)
  {
    const std::int64_t size = std::min(kPiece, count - begin);
    (void)generateShape(Shape::Sphere, size, std::uint64_t(1 + begin / kPiece), 0.0, piece);
    for (const Vec3& p : piece)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        *xyz++ = float(p[axis] * (kSphereRadius / kUnscaledRadius));
      }
    }
  }
}

/// @p count float points on the sphere, without cells and arrays: the same on every machine.
vtkSmartPointer<vtkPolyData> sphereCloud(std::int64_t count)
{
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  fillRandomly(coordinates->GetPointer(0), count);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

/// A view of the float points.
PointView viewOf(vtkPolyData* cloud)
{
  auto* coordinates = vtkFloatArray::SafeDownCast(cloud->GetPoints()->GetData());
  return { coordinates->GetPointer(0), cloud->GetNumberOfPoints() };
}

/// Adds colours (3 unsigned char), normals (3 float), intensity (float), and labels (unsigned char), of which
/// a voxel has one to three.
void addAttributes(vtkPolyData* cloud)
{
  const PointView points = viewOf(cloud);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(kColors);
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(points.size());
  vtkNew<vtkFloatArray> normals;
  normals->SetName(kNormals);
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(points.size());
  vtkNew<vtkFloatArray> intensity;
  intensity->SetName(kIntensity);
  intensity->SetNumberOfTuples(points.size());
  vtkNew<vtkUnsignedCharArray> labels;
  labels->SetName(kLabels);
  labels->SetNumberOfTuples(points.size());
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 normal = points[i] * (1.0 / kSphereRadius);
    for (int axis = 0; axis < 3; ++axis)
    {
      normals->SetComponent(i, axis, normal[axis]);
      colors->SetComponent(i, axis, std::floor(127.5 * (1.0 + normal[axis])));
    }
    intensity->SetValue(i, float(std::abs(normal.z)));
    labels->SetValue(i, static_cast<unsigned char>(normal.z > 0.0 ? i % 3 : 3));
  }
  cloud->GetPointData()->AddArray(colors);
  cloud->GetPointData()->SetNormals(normals);
  cloud->GetPointData()->AddArray(intensity);
  cloud->GetPointData()->AddArray(labels);
}

/// The cube about the origin with @p dimension voxels on an axis.
ResampleTask taskOn(vtkPolyData* cloud, std::int64_t dimension)
{
  ResampleTask task;
  task.cloud = cloud;
  const double half = 0.5 * kWorkspaceEdge;
  task.workspace.include({ -half, -half, -half });
  task.workspace.include({ half, half, half });
  task.dimension = dimension;
  task.leaf = kWorkspaceEdge / double(dimension);
  return task;
}

const std::vector<RivalFile>& rivalFiles()
{
  static const std::vector<RivalFile> files{
#ifdef POINTHAPTICS_RIVAL_RESAMPLE_PCL
    { "pcl", POINTHAPTICS_RIVAL_RESAMPLE_PCL }
#endif
  };
  return files;
}

struct Options
{
  std::vector<double> points;
  std::vector<double> dimensions;
  int instructions = 0;
};

/// Settings of the filter.
struct Mode
{
  std::string name = "ours";
  bool automaticWorkspace = false;
  bool covariance = false;
  std::vector<std::string> arrays; ///< Arrays of the cloud that are reduced; the others are not passed in.
  Representative representative = Representative::Mean;
  bool voxelIndex = false;
};

class Ours : public Rival
{
public:
  Ours(Mode mode, int instructions)
    : mode_(std::move(mode))
  {
    filter_->SetInstructionSet(instructions);
  }
  std::string name() const override { return mode_.name; }
  ComparedWith comparedWith() const override
  {
    return mode_.representative == Representative::Mean ? ComparedWith::ExactMeans
                                                        : ComparedWith::TheirVoxels;
  }
  void load(const ResampleTask& task) override
  {
    input_->SetPoints(task.cloud->GetPoints());
    for (const std::string& name : mode_.arrays)
    {
      input_->GetPointData()->AddArray(task.cloud->GetPointData()->GetAbstractArray(name.c_str()));
    }
    filter_->AddCategoricalArray(kLabels);
    filter_->SetRepresentative(int(mode_.representative));
    filter_->SetComputeVoxelIndex(mode_.voxelIndex);
    filter_->SetComputeCovariance(mode_.covariance);
    filter_->SetInputData(input_);
    if (mode_.automaticWorkspace)
    {
      filter_->SetAutomaticWorkspace(true);
      filter_->SetVoxelSize(task.leaf);
      return;
    }
    const Bounds& box = task.workspace;
    filter_->SetWorkspaceBounds(
      box.minimum.x, box.maximum.x, box.minimum.y, box.maximum.y, box.minimum.z, box.maximum.z);
    const int n = int(task.dimension);
    filter_->SetDimensions(n, n, n);
  }
  void before() override { input_->Modified(); }
  void run() override { filter_->Update(); }
  ResampleAnswer answer() const override
  {
    ResampleAnswer answer;
    vtkPolyData* output = filter_->GetOutput();
    const std::optional<Lattice> lattice = latticeOf(output);
    vtkDataArray* counts = output->GetPointData()->GetArray("VoxelPointCount");
    if (!lattice || !counts)
    {
      answer.fault = "no result";
      return answer;
    }
    answer.lattice = *lattice;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      const double* p = output->GetPoint(i);
      answer.xyz.insert(answer.xyz.end(), p, p + 3);
      answer.counts.push_back(std::int64_t(counts->GetComponent(i, 0)));
    }
    return answer;
  }

private:
  Mode mode_;
  vtkNew<vtkPolyData> input_;
  vtkNew<vtkVoxelMeanResampler> filter_;
};

using Rivals = std::vector<std::unique_ptr<Rival>>;

/// Loads, checks and times all of @p rivals on one task; a row each, with that of the first one beside it.
void raceOn(Run& run, const char* study, const ResampleTask& task, const Rivals& rivals, int threads)
{
  const std::int64_t points = task.cloud->GetNumberOfPoints();
  run.say(fmt::format("{} points, {} voxels on an axis, {} threads", points, task.dimension, threads));
  std::vector<Contestant> contestants;
  std::vector<Verdict> verdicts(rivals.size());
  for (const std::unique_ptr<Rival>& owned : rivals)
  {
    Rival& rival = *owned;
    if (const std::string why = rival.refusal(task); !why.empty())
    {
      run.remark(
        study, fmt::format("Left out ({} voxels on an axis): {}: {}", task.dimension, rival.name(), why));
      continue;
    }
    rival.load(task);
    Verdict& verdict = verdicts[contestants.size()];
    const auto check = [&run, &rival, &task, &verdict]
    {
      const ResampleAnswer answer = rival.answer();
      verdict = judge(answer, expectedMeans(viewOf(task.cloud), answer.lattice), rival.comparedWith());
      if (!verdict.right && rival.comparedWith() != ComparedWith::Means)
      {
        run.fault("an answer of vtkVoxelMeanResampler is wrong; look for rows that are not right");
      }
      return true; // a wrong one is timed too, and said to be wrong
    };
    contestants.push_back({ rival.name(), [&rival] { rival.run(); }, [&rival] { rival.before(); }, check });
  }
  RaceSettings settings;
  settings.rounds = run.repetitions;
  settings.warmUps = run.quick ? 1 : 2;
  settings.inARow = 2;
  settings.longestSeconds = kLongest;
  std::vector<Lap> laps;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(threads), [&] { laps = race(contestants, settings); });
  for (std::size_t i = 0; i < laps.size(); ++i)
  {
    Json row{ { "points", points }, { "dimension", task.dimension }, { "threads", threads } };
    row.update(timesOf(laps, i));
    row.update({ { "ns_per_point", 1e9 * quartiles(laps[i].seconds).median / double(points) },
      { "voxels", verdicts[i].voxels }, { "expected_voxels", verdicts[i].expectedVoxels },
      { "wrong_voxels", verdicts[i].wrongVoxels }, { "worst_error_voxels", verdicts[i].worstError },
      { "right", verdicts[i].right }, { "answer", verdicts[i].text } });
    run.add(study, std::move(row));
  }
}

void studyPoints(Run& run, const Options& options)
{
  for (const double count : run.chosen(options.points, { 1e4, 1e5, 543652, 1e6, 5e6 }, { 2000, 20000 }))
  {
    const auto cloud = sphereCloud(std::int64_t(count));
    for (const double dimension : run.chosen(options.dimensions, { 300 }, { 75 }))
    {
      for (const int threads : run.threads)
      {
        Rivals rivals;
        rivals.push_back(std::make_unique<Ours>(Mode(), options.instructions));
        for (const std::string& word : run.rivals)
        {
          rivals.push_back(makeRival<Rival>(rivalFiles(), word));
        }
        raceOn(run, "points", taskOn(cloud, std::int64_t(dimension)), rivals, threads);
      }
    }
  }
}

std::vector<Mode> allModes()
{
  const std::vector<std::string> three{ kColors, kNormals, kIntensity };
  std::vector<Mode> modes;
  const auto add = [&modes](const std::string& name) -> Mode&
  {
    modes.emplace_back().name = name;
    return modes.back();
  };
  add("points alone");
  add("automatic workspace").automaticWorkspace = true;
  add("with covariance").covariance = true;
  add("with three arrays").arrays = three;
  Mode& both = add("with both");
  both.covariance = true;
  both.arrays = three;
  add("with a label").arrays = { kLabels };
  add("with the voxel of each point").voxelIndex = true;
  const std::pair<const char*, Representative> others[] = { { "nearest to the mean",
                                                              Representative::NearestToMean },
    { "nearest to the centre", Representative::NearestToCenter }, { "median", Representative::Median } };
  for (const auto& [name, representative] : others)
  {
    add(name).representative = representative;
    Mode& withArrays = add(std::string(name) + ", three arrays");
    withArrays.representative = representative;
    withArrays.arrays = three;
  }
  return modes;
}

void studyModes(Run& run, const Options& options)
{
  for (const double count : run.chosen(options.points, { 543652, 5e6 }, { 20000 }))
  {
    const auto cloud = sphereCloud(std::int64_t(count));
    addAttributes(cloud);
    for (const double dimension : run.chosen(options.dimensions, { 300 }, { 75 }))
    {
      Rivals rivals;
      for (const Mode& mode : allModes())
      {
        rivals.push_back(std::make_unique<Ours>(mode, options.instructions));
      }
      raceOn(run, "modes", taskOn(cloud, std::int64_t(dimension)), rivals, run.threads.back());
    }
  }
}

TaskRun addOptions(CLI::App& command)
{
  auto options = std::make_shared<Options>();
  addWholeNumbers(command, "--points", options->points, kMostPoints,
    "Numbers of points; default 1e4,1e5,543652,1e6,5e6, for modes 543652,5e6");
  addWholeNumbers(command, "--dims", options->dimensions, kMostVoxels, "Voxels on an axis; default 300");
  addInstructions(command, options->instructions);
  return [options](Run& run)
  {
    if (run.wants("points"))
    {
      studyPoints(run, *options);
    }
    if (run.wants("modes"))
    {
      studyModes(run, *options);
    }
  };
}

} // namespace
} // namespace pointhaptics::bench::resample

namespace pointhaptics::bench
{

Task resampleTask()
{
  return { "resample", "Time mean resampling: ours beside PCL's, and each mode; answers checked first", 15, 3,
    true, { "points", "modes" }, wordsOf(resample::rivalFiles()), resample::addOptions };
}

} // namespace pointhaptics::bench
