#include "vtkHapticFeel.h"

#include "SettingText.h"
#include "VirtualTouch.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Host/GuardedWork.h"
#include "Core/Base/Host/StopRequest.h"
#include "Devices/PathUnits.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkTimeStamp.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

using namespace pointhaptics;

vtkStandardNewMacro(vtkHapticFeel);

static_assert(int(vtkHapticFeel::GradientSteps) == int(ProxyMethod::GradientSteps) &&
    int(vtkHapticFeel::Sphere) == int(ProxyMethod::Sphere),
  "the filter's methods are those of Haptics, in the same order");

namespace
{

/// Part of the progress that resampling takes.
constexpr double kResampled = 0.3;
/// Ticks between two looks at AbortExecute.
constexpr std::int64_t kTicksBetweenReports = 256;

/// The column of numbers @p name of @p table, or null.
vtkDataArray* columnOf(vtkTable* table, const char* name)
{
  auto* column = vtkDataArray::SafeDownCast(table->GetColumnByName(name));
  return column && column->GetNumberOfComponents() == 1 ? column : nullptr;
}

/// False: @p message says what is wrong with the table and the cure.
bool pathOf(vtkTable* table, HipPath& path, std::string& message)
{
  vtkDataArray* columns[4] = { columnOf(table, "t"), nullptr, nullptr, nullptr };
  const bool isFelt = columnOf(table, "hip_x") != nullptr;
  for (int axis = 0; axis < 3; ++axis)
  {
    columns[axis + 1] = columnOf(table, (std::string(isFelt ? "hip_" : "") + "xyz"[axis]).c_str());
  }
  if (std::count(columns, columns + 4, nullptr) > 0)
  {
    message = "path: a column of numbers is missing; give t, x, y and z";
    return false;
  }
  const vtkIdType rows = table->GetNumberOfRows();
  path.points.reserve(std::size_t(rows));
  for (vtkIdType row = 0; row < rows; ++row)
  {
    double v[4];
    for (int i = 0; i < 4; ++i)
    {
      v[i] = columns[i]->GetComponent(row, 0);
    }
    path.points.push_back({ v[0], { v[1], v[2], v[3] } });
  }
  message = path.problem();
  return message.empty();
}

/// The columns of the output, still without rows.
std::vector<vtkSmartPointer<vtkDoubleArray>> addColumns(vtkTable* output)
{
  std::vector<vtkSmartPointer<vtkDoubleArray>> columns;
  for (const char* name : kFeltColumns)
  {
    columns.push_back(vtkSmartPointer<vtkDoubleArray>::New());
    columns.back()->SetName(name);
    output->AddColumn(columns.back());
  }
  return columns;
}

} // namespace

class vtkHapticFeel::Internals
{
public:
  /// False: @p message says why, or is empty where the work was aborted.
  bool MakeScenes(vtkHapticFeel* filter, vtkPointSet* cloud, std::string& message);
  bool Check(const vtkHapticFeel* filter, std::string& message) const;
  /// @p odd: see unlikelyUnits().
  bool Feel(
    vtkHapticFeel* filter, const HipPath& path, std::int64_t ticks, vtkTable* output, std::string& odd);

  vtkNew<vtkVoxelMeanResampler> Resampler; ///< Settings alone, as Bandwidth.
  vtkNew<vtkKernelBandwidthFilter> Bandwidth;
  bool RunsAgain = false;
  bool BeginsUpdate = true;
  vtkTimeStamp RetryTime;

private:
  FeelScenes Scenes;
  /// MTimes of cloud and filters from which the scenes were made, which are never given twice, and the flags.
  std::array<vtkMTimeType, 5> MadeOf{};
};

bool vtkHapticFeel::Internals::MakeScenes(vtkHapticFeel* filter, vtkPointSet* cloud, std::string& message)
{
  // Observers may set these while the resampler runs.
  const decltype(this->MadeOf) madeOf = { cloud->GetMTime(), this->Resampler->GetMTime(),
    this->Bandwidth->GetMTime(), filter->UseCovariance, filter->RefineNearHand };
  if (this->Scenes.whole() && this->MadeOf == madeOf)
  {
    this->Scenes.restart();
    return true;
  }
  this->MadeOf = {};
  FeelSceneSettings settings;
  settings.bandwidth = this->Bandwidth->GetSettings();
  settings.useCovariance = filter->UseCovariance;
  settings.refineNearHand = filter->RefineNearHand;
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->TakeSettings(this->Resampler);
  settings.goesOn = [filter](double part)
  {
    filter->UpdateProgress(kResampled * part);
    return !filter->GetAbortExecute();
  };
  const Status status = this->Scenes.resample(cloud, resampler, settings, message);
  if (status != Status::Ok)
  {
    message = status == Status::Aborted ? "" : message;
    return false;
  }
  message.clear();
  if (!this->Scenes.note().empty())
  {
    vtkWarningWithObjectMacro(filter, << this->Scenes.note());
  }
  filter->NumberOfFeltPoints = resampler->GetOutput()->GetNumberOfPoints();
  this->MadeOf = madeOf;
  return true;
}

bool vtkHapticFeel::Internals::Check(const vtkHapticFeel* filter, std::string& message) const
{
  const ContactParameters& contact = filter->Settings.contact;
  if (const NumberOutOfRange wrong = firstOutOfRange(filter->Settings); wrong.name)
  {
    message = fmt::format("{} {}; give {}{} to {}", wrong.name, wrong.value,
      wrong.range.openMinimum ? "above " : "", wrong.range.minimum, wrong.range.maximum);
  }
  else if (filter->Settings.check() != Status::Ok)
  {
    message = fmt::format(
      "method {}, staticFriction {}, dynamicFriction {}; give a method of vtkHapticFeel and at most as "
      "much dynamic friction as static",
      int(filter->Settings.method), contact.staticFriction, contact.dynamicFriction);
  }
  else if (!(filter->Rate >= 1.0 && filter->Rate <= 1e5))
  {
    message = fmt::format("rate {} Hz; give 1 to 100000", filter->Rate);
  }
  return message.empty();
}

bool vtkHapticFeel::Internals::Feel(
  vtkHapticFeel* filter, const HipPath& path, std::int64_t ticks, vtkTable* output, std::string& odd)
{
  const auto columns = addColumns(output);
  for (const auto& column : columns)
  {
    column->Allocate(ticks);
  }
  std::int64_t tick = 0;
  bool isTouched = false;
  feelPath(filter->Settings, this->Scenes, path, filter->Rate, ticks,
    [&](double time, const VirtualTouch& touch)
    {
      isTouched = isTouched || touch.sample().state.contact;
      const auto row = feltRow(time, touch.sample());
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        columns[i]->InsertNextValue(row[i]);
      }
      if (++tick % kTicksBetweenReports == 0)
      {
        filter->UpdateProgress(kResampled + (1.0 - kResampled) * double(tick) / double(ticks));
        runSignalHandlers();
      }
      return !filter->AbortExecute;
    });
  odd = unlikelyUnits(path, this->Scenes.whole()->bounds(), {}, isTouched);
  return !filter->AbortExecute;
}

vtkHapticFeel::vtkHapticFeel()
  : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
}

vtkHapticFeel::~vtkHapticFeel() = default;

void vtkHapticFeel::SetSettings(const HapticParameters& settings)
{
  if (!equalSettings(this->Settings, settings))
  {
    this->Settings = settings;
    this->Modified();
  }
}

vtkVoxelMeanResampler* vtkHapticFeel::GetResampler()
{
  return this->Impl->Resampler;
}

vtkKernelBandwidthFilter* vtkHapticFeel::GetBandwidthFilter()
{
  return this->Impl->Bandwidth;
}

vtkMTimeType vtkHapticFeel::GetMTime()
{
  if (this->Impl->RunsAgain)
  {
    // The pipeline would take what an error or an abort left for valid: request another one.
    this->Impl->RetryTime.Modified();
  }
  return std::max(this->SettingsTime(), this->Impl->RetryTime.GetMTime());
}

/// Once for each update, whatever the number of blocks.
int vtkHapticFeel::ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputs,
  vtkInformationVector* outputs, int port, vtkMTimeType* time)
{
  this->Impl->BeginsUpdate = true;
  return this->Superclass::ComputePipelineMTime(request, inputs, outputs, port, time);
}

vtkMTimeType vtkHapticFeel::SettingsTime()
{
  return std::max(
    { this->Superclass::GetMTime(), this->Impl->Resampler->GetMTime(), this->Impl->Bandwidth->GetMTime() });
}

int vtkHapticFeel::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPointSet" : "vtkTable");
  return 1;
}

int vtkHapticFeel::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const vtkSmartPointer<vtkPointSet> cloud = vtkPointSet::GetData(inputVector[0]);
  const vtkSmartPointer<vtkTable> table = vtkTable::GetData(inputVector[1]);
  const vtkSmartPointer<vtkTable> output = vtkTable::GetData(outputVector);
  if (std::exchange(this->Impl->BeginsUpdate, false)) // else this is another block of the same one
  {
    this->Impl->RunsAgain = false;
    this->ErrorCode = vtkErrorCode::NoError; // without Modified(): nothing was set
  }
  if (vtkDataObject* block = vtkDataObject::GetData(inputVector[0]); block && !cloud)
  {
    vtkWarningMacro(<< "A block without points is left empty: " << block->GetClassName() << ".");
    addColumns(output);
    return 1;
  }
  const vtkMTimeType begin = this->SettingsTime();
  const bool hasPoints = cloud && table && cloud->GetNumberOfPoints() > 0;
  HipPath path;
  std::int64_t ticks = 0;
  std::string message = cloud && table
    ? ""
    : "an input was taken away as the update began; leave both until EndEvent, or set others";
  std::string odd;
  bool isFelt = false;
  HostStop stop(this->AbortExecute);
  const Status status = guardedWork(
    [&]
    {
      isFelt = hasPoints && pathOf(table, path, message) && this->Impl->Check(this, message) &&
        countTicks(path, "path", this->Rate, kMostTicks, ticks, message) &&
        this->Impl->MakeScenes(this, cloud, message) && this->Impl->Feel(this, path, ticks, output, odd);
    },
    stop.request());
  message = status == Status::Ok ? message : pointhaptics::message(status);
  if (!isFelt)
  {
    output->Initialize();
    addColumns(output);
    if (!message.empty())
    {
      this->ErrorCode =
        status == Status::Ok ? static_cast<unsigned long>(vtkErrorCode::UserError) : kOutOfMemoryCode;
      vtkErrorMacro(<< message);
    }
  }
  else if (!odd.empty())
  {
    vtkWarningMacro(<< odd);
  }
  this->Impl->RunsAgain = this->Impl->RunsAgain || this->SettingsTime() > begin ||
    (!isFelt && hasPoints && (this->RepeatsErrors || message.empty()));
  return 1;
}

void vtkHapticFeel::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  keyed::printSettings(os, indent, this->Settings);
  os << indent << "Rate: " << this->Rate << "\n";
  os << indent << "UseCovariance: " << this->UseCovariance << "\n";
  os << indent << "RefineNearHand: " << this->RefineNearHand << "\n";
  os << indent << "RepeatsErrors: " << this->RepeatsErrors << "\n";
  os << indent << "NumberOfFeltPoints: " << this->NumberOfFeltPoints << "\n";
}
