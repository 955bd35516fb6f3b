#include "LoadedCloud.h"

#include "ClippedCloud.h"
#include "CloudAppearance.h"
#include "CloudFiles.h"
#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"
#include "Core/Distributed/FarPoints.h"
#include "IO/Info/LengthUnit.h"
#include "PolyDataAccess.h"
#include "ResampledCloud.h"
#include "SmpExecutor.h"
#include "SurfaceArrays.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <iterator>
#include <set>

namespace pointhaptics
{
namespace
{

using vtksys::SystemTools;

/// Points that are measured before the first picture, which takes no longer than a frame or two.
constexpr vtkIdType kMeasuredAtOnce = 60000;

/// Keeps only the arrays that are looked at: every array costs time at every zoom.
void keepArrays(vtkPolyData* cloud, const ShownRequest& request)
{
  vtkPointData* data = cloud->GetPointData();
  std::set<std::string> kept = { kHeightArrayName };
  for (const std::string& each : request.keptArrays())
  {
    const std::optional<ColorSource> source = findColorSource(cloud, each);
    kept.insert(source ? source->array : each);
  }
  vtkDataArray* scalars = hasColors(cloud) ? data->GetScalars() : nullptr; // a key goes back to them
  for (int i = data->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    if (array != scalars && kept.count(name) == 0)
    {
      data->RemoveArray(i);
    }
  }
}

/// Arrays the pipeline adds to those of the cloud.
constexpr const char* kMadeByPipeline[] = { kClayName, kHeightArrayName, "Density", "ProxyRadius",
  "Bandwidth", "MeanBandwidth", "VoxelPointCount", kResidualArrayName };

bool isMadeByPipeline(const std::string& name)
{
  return std::find(std::begin(kMadeByPipeline), std::end(kMadeByPipeline), name) != std::end(kMadeByPipeline);
}

/// True for an exact name: colours or an array of the cloud, or an array of the pipeline.
bool isExactName(vtkPolyData* cloud, const std::string& name)
{
  return name == "rgb" ? hasColors(cloud)
                       : isMadeByPipeline(name) || findColorSource(cloud, name).has_value();
}

/// All names there are that differ from @p wanted in upper and lower case only; each once.
std::set<std::string> namesInAnyCase(vtkPolyData* cloud, const std::string& wanted)
{
  const std::string key = SystemTools::LowerCase(wanted);
  std::set<std::string> found;
  const auto keepIfSame = [&](const std::string& written, const std::string& name)
  {
    if (SystemTools::LowerCase(written) == key)
    {
      found.insert(name);
    }
  };
  for (const char* made : kMadeByPipeline)
  {
    keepIfSame(made, made);
  }
  if (hasColors(cloud))
  {
    keepIfSame("rgb", "rgb");
  }
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const std::string name = array && array->GetName() ? array->GetName() : "";
    keepIfSame(name, name);
    const int components = name.empty() ? 0 : array->GetNumberOfComponents();
    for (int component = kMagnitude; components > 1 && component < components; ++component)
    {
      const std::string whole = describeColorSource(cloud, { name, component });
      keepIfSame(whole, whole);
      keepIfSame(fmt::format("{}:{}", name, component), whole);
    }
  }
  return found;
}

/// Completes @p name: the exact name, else the only one that differs in upper and lower case. Unchanged where
/// there is none. False: there are several, which @p message lists.
bool completeName(vtkPolyData* cloud, const std::string& option, std::string& name, std::string& message)
{
  const std::set<std::string> found =
    name.empty() || isExactName(cloud, name) ? std::set<std::string>{ name } : namesInAnyCase(cloud, name);
  if (found.size() > 1)
  {
    message = fmt::format("{} {}: means any of {}; give one of them, in upper and lower case as here", option,
      name, fmt::join(found, ", "));
    return false;
  }
  name = found.empty() ? name : *found.begin();
  return true;
}

/// The array that @p name is a component of, in any case. Null: none, or one without components.
vtkDataArray* arrayWithComponents(vtkPolyData* cloud, const std::string& name)
{
  const std::string key = SystemTools::LowerCase(name.substr(0, name.rfind(':')));
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (array && array->GetName() && array->GetNumberOfComponents() > 1 &&
      SystemTools::LowerCase(array->GetName()) == key)
    {
      return array;
    }
  }
  return nullptr;
}

/// "Velocity (:x, :y, :z, :magnitude)": what can be said of @p array.
std::string withComponents(vtkPolyData* cloud, vtkDataArray* array)
{
  std::string text;
  for (int i = 0; array->GetNumberOfComponents() > 1 && i <= array->GetNumberOfComponents(); ++i)
  {
    const int component = i < array->GetNumberOfComponents() ? i : kMagnitude;
    const std::string whole = describeColorSource(cloud, { array->GetName(), component });
    text += (i > 0 ? ", " : "") + whole.substr(std::string(array->GetName()).size());
  }
  return array->GetName() + (text.empty() ? text : " (" + text + ")");
}

/// " Intensity, Velocity (:x, :y, :z, :magnitude)," for messages.
std::string arraysOf(vtkPolyData* cloud)
{
  std::string text;
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* each = data->GetArray(i); each && each->GetName())
    {
      text += fmt::format(" {},", withComponents(cloud, each));
    }
  }
  return text;
}

/// False: @p message names the arrays and components there are.
bool canColorBy(vtkPolyData* cloud, const std::string& option, const std::string& name, std::string& message)
{
  if (name.empty() || isExactName(cloud, name))
  {
    return true;
  }
  if (vtkDataArray* array = arrayWithComponents(cloud, name))
  {
    message = fmt::format(
      "{} {}: the array has no such component; give one of {}", option, name, withComponents(cloud, array));
    return false;
  }
  message = fmt::format("{} {}: the cloud has no such array; it has", option, name) + arraysOf(cloud);
  message += hasColors(cloud) ? " rgb," : "";
  for (const char* made : kMadeByPipeline)
  {
    message += fmt::format(" {},", colorWord(made));
  }
  message.pop_back();
  return false;
}

bool hidesByHeight(const std::vector<HiddenValues>& hidden)
{
  return std::any_of(
    hidden.begin(), hidden.end(), [](const HiddenValues& each) { return each.array == kHeightArrayName; });
}

/// Request for a cloud of which no coarse level was shown before.
ShownRequest showingOf(const CloudRequest& request, vtkPolyData* cloud, const std::string& format)
{
  ShownRequest showing;
  showing.orientation = request.options.up == "auto" ? guessCloudOrientation(cloud, format)
                                                     : orientationForUpAxis(request.options.up);
  CloudKind kind = CloudKind::Object;
  if (!request.isOnlyRead && cloudKindFromName(request.options.kind, kind))
  {
    showing.kind = kind;
  }
  return showing;
}

/// All points but far ones, which would take float digits from the others. Far ones in the clipping box stay.
vtkSmartPointer<vtkPolyData> drawnPoints(const CloudRequest& request, const LoadedCloud& loaded)
{
  if (loaded.near.empty())
  {
    return loaded.cloud;
  }
  Bounds box = loaded.near;
  if (const std::optional<Bounds> clip = clipBox(request.options.clip, loaded.cloud))
  {
    box.include(clip->minimum);
    box.include(clip->maximum);
  }
  return clippedCloud(loaded.cloud, box);
}

/// True if the means come after the picture, or are not needed.
bool isResampledLater(const CloudRequest& request, const LoadedCloud& loaded)
{
  const HapticViewerOptions& options = request.options;
  const bool showsMeans =
    options.felt || (isOfMeans(loaded.colorBy) && !findColorSource(loaded.cloud, loaded.colorBy));
  return !request.isOnlyRead && request.resamplesLater && !showsMeans && options.fitsWorkspace &&
    options.clip.empty() && options.picture.hidden.empty() && !options.followsFile() &&
    options.record.empty();
}

/// Adds the array of heights where means or points are coloured or hidden by it.
void addHeights(const CloudRequest& request, bool isLater, vtkPolyData* drawn, LoadedCloud& loaded)
{
  const bool isNeeded = !isLater || request.makesScene || loaded.colorBy == kHeightArrayName;
  if (isNeeded &&
    (!hasColors(loaded.cloud) || !request.options.colorBy.empty() || hidesByHeight(loaded.showing.hidden)))
  {
    addHeightArray(loaded.cloud, loaded.orientation.up);
    if (drawn != loaded.cloud)
    {
      addHeightArray(drawn, loaded.orientation.up);
    }
  }
}

/// Fills in LoadedCloud::shown from the points that are @p drawn, or begins to measure what it needs. False:
/// @p progress said no.
bool show(const CloudRequest& request, vtkPolyData* drawn, const LoadProgress& progress, LoadedCloud& loaded)
{
  if (request.measuresLater && drawn->GetNumberOfPoints() > kMeasuredAtOnce)
  {
    const auto all = vtkSmartPointer<vtkPolyData>::New();
    all->ShallowCopy(drawn);
    loaded.measurement = std::make_shared<ShownMeasurement>();
    loaded.measurement->start(all, loaded.showing);
    loaded.shown = makePlainCloud(drawn, loaded.showing);
  }
  else
  {
    loaded.shown =
      makeShownCloud(drawn, loaded.showing, [&progress](double part) { return progress("measuring", part); });
  }
  return loaded.shown != nullptr;
}

} // namespace

bool completeHidden(
  vtkPolyData* cloud, const std::string& option, std::vector<HiddenValues>& hidden, std::string& message)
{
  for (HiddenValues& each : hidden)
  {
    if (!completeName(cloud, option, each.array, message))
    {
      return false;
    }
    if (each.array != kHeightArrayName && !findColorSource(cloud, each.array))
    {
      const std::string made = cloud->GetPointData()->HasArray(kHeightArrayName) ? "" : " height,";
      message = fmt::format("{} {}: the cloud has no such array to hide by; it has{}", option, each.array,
        arraysOf(cloud) + made);
      message.pop_back();
      return false;
    }
  }
  return true;
}

std::string CloudRequest::name() const
{
  return points ? title : titleOf(files);
}

std::string shortNote(const std::vector<std::string>& notes)
{
  return notes.size() < 2 ? (notes.empty() ? std::string() : notes.front())
                          : fmt::format("{} (and {} more)", notes.front(), notes.size() - 1);
}

bool isOfMeans(const std::string& name)
{
  return isMadeByPipeline(name) && name != kClayName && name != kHeightArrayName && name != "Density";
}

std::string colorWord(const std::string& name)
{
  return isMadeByPipeline(name) ? SystemTools::LowerCase(name) : name;
}

void findBounds(const CloudRequest& request, LoadedCloud& loaded)
{
  const HapticViewerOptions& options = request.options;
  const bool isFitted = !request.isOnlyRead && options.fitsWorkspace;
  const CloudExtent extent = extentOf(loaded.cloud, options.transform, SmpExecutor());
  loaded.bounds = isFitted ? extent.returned : extent.all;
  loaded.invalid = extent.invalid;
  loaded.noReturns = extent.noReturns;
  const bool isClipped = !options.clip.empty();
  if (request.isOnlyRead || !(isFitted || (options.voxels.lattice.automaticWorkspace && !isClipped)))
  {
    return;
  }
  const PointAccess points(loaded.cloud->GetPoints());
  FarPoints far = findFarPoints(points.view(),
    options.transform.isIdentity() ? extent.all
                                   : extentOf(loaded.cloud, AffineTransform(), SmpExecutor()).all);
  if (far.count == 0)
  {
    return;
  }
  const auto moved = [&](const Vec3& p) { return options.transform.apply(p); };
  loaded.near = far.others;
  loaded.bounds = boxOfCorners(far.others, moved);
  far.all = boxOfCorners(far.all, moved);
  if (!isClipped)
  {
    loaded.notes.push_back(loaded.title + ": " + far.note());
  }
}

void noteNoReturns(const CloudRequest& request, LoadedCloud& loaded)
{
  const std::optional<Bounds> clip = clipBox(request.options.clip, loaded.cloud);
  const bool isFar = !loaded.near.empty() && !contains(loaded.near, Vec3()); // that was said
  if (loaded.noReturns == 0 || request.options.felt || isFar || (clip && !contains(*clip, Vec3())))
  {
    return;
  }
  const bool areFelt = contains(loaded.workspace, loaded.placement.apply(Vec3()));
  const std::string what = !areFelt ? "are outside the workspace: neither shown nor felt"
    : request.isFeltOnly
    ? "are felt"
    : fmt::format("are felt but not drawn; {} draws what is felt", request.options.names.felt);
  loaded.notes.push_back(fmt::format("{}: {} {}", loaded.title, noReturnsText(loaded.noReturns), what));
}

/// Adds @p notes of the readers, and that the chosen unit contradicts the file's.
void addNotes(const CloudRequest& request, std::vector<std::string> notes, LoadedCloud& loaded)
{
  const bool isChosen = !request.isOnlyRead && request.options.unitIsChosen;
  const std::string odd =
    isChosen ? contradictedUnit(loaded.title, loaded.cloud, request.options.unit) : std::string();
  loaded.notes = std::move(notes);
  loaded.notes.insert(loaded.notes.end(), odd.empty() ? 0 : 1, odd);
}

bool loadCloud(
  const CloudRequest& request, const LoadProgress& progress, LoadedCloud& loaded, std::string& message)
{
  const HapticViewerOptions& options = request.options;
  LoadedCloud result;
  Findings findings;
  result.title = request.name();
  result.cloud = inLocalMetres(
    readFiles(
      request, [&progress](double part) { return progress("reading", part); }, findings, message),
    !options.unitIsChosen);
  if (!result.cloud)
  {
    return false;
  }
  progress("preparing", 0.0);
  result.isCoarse = findings.isCoarse;
  addNotes(request, std::move(findings.notes), result);
  findBounds(request, result);
  if (result.bounds.empty())
  {
    message = fmt::format("{}: no point is finite (all are NaN or infinite); nothing to show", result.title);
    return false;
  }
  progress("preparing", 0.2);
  result.colorBy = options.colorBy;
  std::vector<HiddenValues> hidden = options.picture.hidden;
  if (!completeName(result.cloud, options.names.colorBy, result.colorBy, message) ||
    !canColorBy(result.cloud, options.names.colorBy, result.colorBy, message) ||
    !completeHidden(result.cloud, options.names.hidden, hidden, message))
  {
    return false;
  }
  const vtkSmartPointer<vtkPolyData> drawn = drawnPoints(request, result);
  result.showing = request.before ? *request.before : showingOf(request, drawn, findings.format);
  result.showing.keptArray = result.colorBy;
  result.showing.hidden = std::move(hidden);
  result.showing.ignoresIntensity = findings.hasSamples;
  result.orientation = result.showing.orientation;
  const bool isLater = isResampledLater(request, result);
  addHeights(request, isLater, drawn, result);
  progress("preparing", 0.6);
  if (!request.isOnlyRead && !show(request, drawn, progress, result))
  {
    message = result.title + ": reading was stopped on request; start it again";
    return false;
  }
  keepArrays(result.cloud, result.showing);
  if (!request.isOnlyRead)
  {
    placeCloud(request, result);
    if (isLater)
    {
      resampleLater(request, result);
    }
    else if (!resampleCloud(request, progress, result, message))
    {
      return false;
    }
    noteNoReturns(request, result);
  }
  loaded = std::move(result);
  return true;
}

} // namespace pointhaptics
