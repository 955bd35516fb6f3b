#include "Benchmark/Resample/Rivals/Ours.h"

#include "Benchmark/Resample/Clouds.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace pointhaptics
{
namespace bench
{
namespace resample
{

void setTask(vtkVoxelMeanResampler* filter, const ResampleTask& task, bool automaticWorkspace)
{
  if (automaticWorkspace)
  {
    filter->SetAutomaticWorkspace(true);
    filter->SetVoxelSize(task.leaf);
    return;
  }
  const Bounds& box = task.workspace;
  filter->SetWorkspaceBounds(
    box.minimum.x, box.maximum.x, box.minimum.y, box.maximum.y, box.minimum.z, box.maximum.z);
  const int n = int(task.dimension);
  filter->SetDimensions(n, n, n);
}

ResampleAnswer answerOf(vtkPolyData* output)
{
  ResampleAnswer answer;
  vtkFieldData* field = output->GetFieldData();
  vtkDataArray* origin = field->GetArray("LatticeOrigin");
  vtkDataArray* spacing = field->GetArray("LatticeSpacing");
  vtkDataArray* dimensions = field->GetArray("LatticeDimensions");
  vtkDataArray* counts = output->GetPointData()->GetArray("VoxelPointCount");
  if (!origin || !spacing || !dimensions || !counts)
  {
    answer.fault = "no result";
    return answer;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    answer.lattice.origin[axis] = origin->GetComponent(0, axis);
    answer.lattice.spacing[axis] = spacing->GetComponent(0, axis);
    answer.lattice.dimensions[std::size_t(axis)] = std::int64_t(dimensions->GetComponent(0, axis));
  }
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    double p[3];
    output->GetPoint(i, p);
    answer.xyz.insert(answer.xyz.end(), p, p + 3);
    answer.counts.push_back(std::int64_t(counts->GetComponent(i, 0)));
  }
  return answer;
}

namespace
{

bool processorHas(InstructionSet set)
{
#if defined(__x86_64__) || defined(__i386__)
  if (set == InstructionSet::Avx512)
  {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  }
  return set != InstructionSet::Avx2 || __builtin_cpu_supports("avx2");
#else
  return set == InstructionSet::Automatic || set == InstructionSet::Baseline;
#endif
}

class Ours : public Rival
{
public:
  explicit Ours(OursSettings settings)
    : settings_(std::move(settings))
  {
  }
  std::string name() const override { return settings_.name; }
  ComparedWith comparedWith() const override
  {
    return settings_.representative == Representative::Mean ? ComparedWith::ExactMeans
                                                            : ComparedWith::TheirVoxels;
  }
  std::string refusal(const ResampleTask&) const override
  {
    return processorHas(settings_.instructionSet) ? "" : "the processor does not have them";
  }
  void load(const ResampleTask& task) override
  {
    input_->SetPoints(task.cloud->GetPoints());
    for (const std::string& name : settings_.arrays)
    {
      input_->GetPointData()->AddArray(task.cloud->GetPointData()->GetAbstractArray(name.c_str()));
    }
    if (input_->GetPointData()->HasArray(kNormals))
    {
      input_->GetPointData()->SetActiveNormals(kNormals);
    }
    filter_->AddCategoricalArray(kLabels);
    filter_->SetRepresentative(int(settings_.representative));
    filter_->SetComputeVoxelIndex(settings_.voxelIndex);
    filter_->SetInputData(input_);
    filter_->SetComputeCovariance(settings_.covariance);
    filter_->SetInstructionSet(int(settings_.instructionSet));
    setTask(filter_, task, settings_.automaticWorkspace);
  }
  void before() override { input_->Modified(); }
  void run() override { filter_->Update(); }
  ResampleAnswer answer() const override { return answerOf(filter_->GetOutput()); }
  std::int64_t resultBytes() const override
  {
    std::int64_t bytes = 0;
    for (int port = 0; port < filter_->GetNumberOfOutputPorts(); ++port)
    {
      bytes += std::int64_t(1024 * filter_->GetOutputDataObject(port)->GetActualMemorySize());
    }
    return bytes;
  }

private:
  OursSettings settings_;
  vtkNew<vtkPolyData> input_;
  vtkNew<vtkVoxelMeanResampler> filter_;
};

} // namespace

const char* instructionSetName(InstructionSet set)
{
  switch (set)
  {
    case InstructionSet::Baseline:
      return "baseline";
    case InstructionSet::Avx2:
      return "AVX2";
    case InstructionSet::Avx512:
      return "AVX-512";
    case InstructionSet::Automatic:
      break;
  }
  return "automatic";
}

std::unique_ptr<Rival> makeOurs(const OursSettings& settings)
{
  return std::make_unique<Ours>(settings);
}

} // namespace resample
} // namespace bench
} // namespace pointhaptics
