#include "vtkCloudAlgorithm.h"

#include "Core/Base/Host/GuardedWork.h"
#include "Core/Base/Host/StopRequest.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstddef>

namespace
{

constexpr const char* kTakenAway =
  "the input was taken away as the update began; leave it until EndEvent, or set another one";

/// Empty, but with points.
void makeEmpty(vtkPolyData* output)
{
  output->Initialize();
  output->SetPoints(vtkNew<vtkPoints>());
}

std::string nameOf(vtkCompositeDataIterator* block)
{
  const char* name = block->HasCurrentMetaData() != 0
    ? block->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME())
    : nullptr;
  return (name ? std::string("\"") + name + "\"" : std::to_string(block->GetCurrentFlatIndex())) + " (" +
    block->GetCurrentDataObject()->GetClassName() + ")";
}

} // namespace

/// The clouds of an input, and what becomes of each: one, or those of a composite.
struct vtkCloudAlgorithm::Parts
{
  Clouds clouds;
  std::vector<Outputs> outputs; ///< Outputs of each cloud, for each port.
  std::string others;           ///< Names of blocks without points.

  Parts(vtkDataObject* input, const std::vector<vtkSmartPointer<vtkDataObject>>& results)
  {
    auto* composite = vtkCompositeDataSet::SafeDownCast(input);
    if (!composite)
    {
      auto* cloud = vtkPointSet::SafeDownCast(input);
      Outputs& own = this->Add(cloud ? cloud : vtkSmartPointer<vtkPolyData>::New().Get());
      for (vtkDataObject* result : results)
      {
        own.emplace_back(vtkPolyData::SafeDownCast(result));
      }
      return;
    }
    const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
    {
      if (auto* cloud = vtkPointSet::SafeDownCast(block->GetCurrentDataObject()))
      {
        Outputs& own = this->Add(cloud);
        for (vtkDataObject* result : results)
        {
          own.push_back(vtkSmartPointer<vtkPolyData>::New());
          vtkCompositeDataSet::SafeDownCast(result)->SetDataSet(block, own.back());
        }
      }
      else
      {
        this->others += (this->others.empty() ? "" : ", ") + nameOf(block);
      }
    }
  }

  void Empty() const
  {
    for (const Outputs& ofCloud : this->outputs)
    {
      std::for_each(ofCloud.begin(), ofCloud.end(), &makeEmpty);
    }
  }

private:
  Outputs& Add(vtkPointSet* cloud)
  {
    this->clouds.emplace_back(cloud);
    return this->outputs.emplace_back();
  }
};

vtkMTimeType vtkCloudAlgorithm::GetMTime()
{
  if (this->RunsAgain)
  {
    // The pipeline would take the last output for valid: request another one.
    this->RetryTime.Modified();
  }
  return std::max(this->Superclass::GetMTime(), this->RetryTime.GetMTime());
}

vtkTypeBool vtkCloudAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT())
    ? this->RequestDataObject(request, inputs, outputs)
    : this->Superclass::ProcessRequest(request, inputs, outputs);
}

void vtkCloudAlgorithm::Fail(const std::string& problem)
{
  this->ErrorCode = vtkErrorCode::UserError; // without Modified(): nothing was set
  this->ErrorMessage = problem;
  vtkErrorMacro(<< problem);
}

void vtkCloudAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RepeatsErrors: " << this->RepeatsErrors << "\n";
}

void vtkCloudAlgorithm::Warn(const std::string& text)
{
  if (!text.empty() && std::find(this->Warnings.begin(), this->Warnings.end(), text) == this->Warnings.end())
  {
    this->Warnings.push_back(text);
  }
}

int vtkCloudAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

/// As that of the input, so the executive has no say.
int vtkCloudAlgorithm::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

int vtkCloudAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkSmartPointer<vtkDataObject> sample = vtkSmartPointer<vtkPolyData>::New();
  if (vtkDataObjectTree::SafeDownCast(input))
  {
    sample.TakeReference(input->NewInstance());
  }
  else if (vtkCompositeDataSet::SafeDownCast(input))
  {
    sample = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  }
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    vtkDataObject* output = vtkDataObject::GetData(info);
    if (!output || output->GetDataObjectType() != sample->GetDataObjectType())
    {
      info->Set(vtkDataObject::DATA_OBJECT(), vtkSmartPointer<vtkDataObject>::Take(sample->NewInstance()));
    }
  }
  return 1;
}

int vtkCloudAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Observers may take away what the pipeline holds.
  const vtkSmartPointer<vtkDataObject> input = vtkDataObject::GetData(inputs[0]);
  auto* tree = vtkDataObjectTree::SafeDownCast(input);
  std::vector<vtkSmartPointer<vtkDataObject>> results;
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    results.emplace_back(vtkDataObject::GetData(outputs, port));
    results.back()->Initialize();
    if (tree)
    {
      vtkDataObjectTree::SafeDownCast(results.back())->CopyStructure(tree);
      results.back()->GetFieldData()->PassData(input->GetFieldData());
    }
  }
  this->RunsAgain = false;
  this->SetProgressShiftScale(0.0, 1.0);
  this->ErrorMessage.clear();
  this->ErrorCode = vtkErrorCode::NoError;
  const vtkMTimeType begin = this->GetMTime();
  const Parts parts(input, tree || !vtkCompositeDataSet::SafeDownCast(input) ? results : decltype(results)());
  this->Warnings.clear();
  this->Warn(parts.others.empty() ? "" : "Blocks without points are left empty: " + parts.others + ".");
  parts.Empty();
  std::string problem = this->ProblemOf(input);
  problem = input || !problem.empty() ? problem : kTakenAway;
  if (!problem.empty())
  {
    this->Fail(problem);
  }
  bool succeeded = problem.empty();
  pointhaptics::HostStop stop(this->AbortExecute);
  const pointhaptics::Status end =
    pointhaptics::guardedWork([&] { succeeded = succeeded && this->RunParts(parts); }, stop.request());
  if (end != pointhaptics::Status::Ok)
  {
    succeeded = false;
    this->Fail(std::string(message(end)) + ".");
    this->ErrorCode = pointhaptics::kOutOfMemoryCode;
  }
  this->SetProgressShiftScale(0.0, 1.0);
  succeeded = !pointhaptics::shallStop(this, 0) && succeeded;
  if (!succeeded)
  {
    parts.Empty();
  }
  this->EndRun(succeeded);
  if (succeeded)
  {
    for (const std::string& text : std::vector<std::string>(this->Warnings))
    {
      vtkWarningMacro(<< text);
    }
    this->UpdateProgress(1.0);
  }
  // Observers of the warnings and of the end of progress may set something, too.
  this->RunsAgain =
    this->GetMTime() > begin || (!succeeded && (this->SaysAgain() || this->ErrorMessage.empty()));
  return 1;
}

bool vtkCloudAlgorithm::RunParts(const Parts& parts)
{
  bool succeeded = this->BeginRun(parts.clouds);
  const auto count = double(parts.clouds.size());
  for (std::size_t i = 0; succeeded && i < parts.clouds.size(); ++i)
  {
    this->SetProgressShiftScale(double(i) / count, 1.0 / count);
    succeeded = !pointhaptics::shallStop(this, 0) && this->RunCloud(parts.clouds[i], parts.outputs[i]);
  }
  return succeeded;
}
