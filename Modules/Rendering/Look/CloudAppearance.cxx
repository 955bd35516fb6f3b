#include "CloudAppearance.h"

#include "AsprsClasses.h"
#include "CloudParts.h"
#include "SmpExecutor.h"

#include "vtkActor.h"
#include "vtkCameraPass.h"
#include "vtkDataArray.h"
#include "vtkDepthShadingPass.h"
#include "vtkLightsPass.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOverlayPass.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSequencePass.h"
#include "vtkSmartPointer.h"
#include "vtkTranslucentPass.h"
#include "vtkVolumetricPass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace
{

/// A lower end of a range of colours below this part of the upper one counts as 0: the least value of an
/// error is an accident.
constexpr double kAsGoodAsZero = 3e-3;
/// A range stays while it moves by less than this part of its width.
constexpr double kSameRange = 0.1;
constexpr int kNumberOfClasses = 256;

double valueOf(vtkDataArray* array, vtkIdType tuple, int component)
{
  if (component != kMagnitude)
  {
    return array->GetComponent(tuple, component);
  }
  double sum = 0.0;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    sum += array->GetComponent(tuple, i) * array->GetComponent(tuple, i);
  }
  return std::sqrt(sum);
}

/// Finite values in ascending order; above 20,000 a sample by a multiplicative hash, as every k-th value
/// would meet the rows of a scanner in step.
std::vector<double> finiteSample(vtkDataArray* array, int component)
{
  constexpr std::uint64_t kSamples = 10000;
  std::vector<double> values;
  const std::uint64_t count = std::uint64_t(array->GetNumberOfTuples());
  const bool isAll = count < 2 * kSamples;
  for (std::uint64_t i = 0; i < (isAll ? count : kSamples); ++i)
  {
    const std::uint64_t place = isAll ? i : (i * 0x9e3779b97f4a7c15u >> 11) % count;
    const double value = valueOf(array, vtkIdType(place), component);
    if (std::isfinite(value))
    {
      values.push_back(value);
    }
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// Name of a component: its own, x to z of three, or its number.
std::string componentName(vtkDataArray* array, int component)
{
  if (component == kMagnitude)
  {
    return "magnitude";
  }
  const char* own = array->GetComponentName(component);
  if (own && *own)
  {
    return own;
  }
  return array->GetNumberOfComponents() == 3 ? std::string(1, "xyz"[component]) : std::to_string(component);
}

/// Colour of a class or file. Those of files are as different as those of eight classes.
const double* labelColor(const std::string& array, int number)
{
  constexpr int kFileColors[] = { 6, 9, 3, 14, 2, 10, 17, 5 };
  return asprsClass(array == kFileArrayName ? kFileColors[number % 8] : number).color;
}

/// Makes a table with a colour for each number of a class or file, 0 to 255. The caller owns the result.
vtkLookupTable* newClassColorMap(const std::string& array)
{
  vtkLookupTable* colors = vtkLookupTable::New();
  colors->SetNumberOfTableValues(kNumberOfClasses);
  colors->SetTableRange(-0.5, kNumberOfClasses - 0.5);
  for (int i = 0; i < kNumberOfClasses; ++i)
  {
    const double* color = labelColor(array, i);
    colors->SetTableValue(i, color[0], color[1], color[2], 1.0);
  }
  colors->SetNanColor(0.5, 0.5, 0.5, 1.0);
  return colors;
}

/// Range of the finite values between the 1st and the 99th percentile.
void robustRange(vtkDataArray* array, int component, double range[2])
{
  const std::vector<double> values = finiteSample(array, component);
  range[0] = 0.0;
  range[1] = 1.0;
  if (!values.empty())
  {
    range[0] = values[values.size() / 100];
    range[1] = values[values.size() - 1 - values.size() / 100];
    range[0] = range[0] > 0.0 && range[0] < kAsGoodAsZero * range[1] ? 0.0 : range[0];
  }
  if (!(range[1] > range[0]))
  {
    range[1] = range[0] + widthOfOneValue(range[0]);
  }
}

void colorByArray(vtkPolyDataMapper* mapper, vtkDataArray* array, int component)
{
  const bool areClasses = array->GetNumberOfComponents() == 1 && holdsLabels(array->GetName());
  vtkLookupTable* colors = areClasses ? newClassColorMap(array->GetName()) : newCloudColorMap();
  if (!areClasses)
  {
    double range[2];
    robustRange(array, component, range);
    colors->SetTableRange(range);
  }
  if (component == kMagnitude)
  {
    colors->SetVectorModeToMagnitude();
  }
  else
  {
    colors->SetVectorModeToComponent();
    colors->SetVectorComponent(component);
  }
  mapper->SetLookupTable(colors);
  colors->Delete();
  mapper->UseLookupTableScalarRangeOn();
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(array->GetName());
  mapper->SetColorModeToMapScalars();
  mapper->ScalarVisibilityOn();
}

} // namespace

void addHeightArray(vtkPolyData* cloud, const Vec3& up)
{
  const auto heights =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(cloud->GetPoints()->GetDataType()));
  heights->SetName(kHeightArrayName);
  heights->SetNumberOfTuples(cloud->GetNumberOfPoints());
  std::vector<Vec3> copy;
  const PointView points = cloud->GetNumberOfPoints() > 0 ? viewOf(cloud, copy) : PointView();
  forRange(SmpExecutor(), points.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (; begin < end; ++begin)
      {
        const Vec3 p = points[begin];
        heights->SetComponent(begin, 0, isFinite(p) ? dot(p, up) : NAN);
      }
    });
  cloud->GetPointData()->AddArray(heights);
}

std::optional<ColorSource> findColorSource(vtkPolyData* cloud, const std::string& colorBy)
{
  vtkPointData* data = cloud->GetPointData();
  if (vtkDataArray* array = data->GetArray(colorBy.c_str()))
  {
    return ColorSource{ colorBy, array->GetNumberOfComponents() > 1 ? kMagnitude : 0 };
  }
  const std::size_t colon = colorBy.rfind(':');
  const std::string name = colorBy.substr(0, colon);
  vtkDataArray* array = colon == std::string::npos ? nullptr : data->GetArray(name.c_str());
  const std::string word = array ? colorBy.substr(colon + 1) : "";
  for (int i = kMagnitude; array && i < array->GetNumberOfComponents(); ++i)
  {
    if (word == componentName(array, i) || (i != kMagnitude && word == std::to_string(i)))
    {
      return ColorSource{ name, i };
    }
  }
  return std::nullopt;
}

std::string describeColorSource(vtkPolyData* cloud, const ColorSource& source)
{
  vtkDataArray* array = cloud->GetPointData()->GetArray(source.array.c_str());
  return array && array->GetNumberOfComponents() > 1
    ? source.array + ":" + componentName(array, source.component)
    : source.array;
}

void colorRange(vtkPolyData* cloud, const ColorSource& source, double range[2])
{
  robustRange(cloud->GetPointData()->GetArray(source.array.c_str()), source.component, range);
}

bool followColorRange(vtkPolyData* cloud, const ColorSource& source, vtkLookupTable* colors)
{
  double range[2];
  colorRange(cloud, source, range);
  const double* shown = colors->GetTableRange();
  const double slack = kSameRange * (shown[1] - shown[0]);
  const bool isOther = std::abs(range[0] - shown[0]) > slack || std::abs(range[1] - shown[1]) > slack;
  if (isOther)
  {
    colors->SetTableRange(range);
  }
  return isOther;
}

double colorValue(vtkPolyData* cloud, const ColorSource& source, vtkIdType point)
{
  return valueOf(cloud->GetPointData()->GetArray(source.array.c_str()), point, source.component);
}

bool holdsLabels(const std::string& array)
{
  return array == kFileArrayName || holdsAsprsClasses(array);
}

vtkLookupTable* newClassLegend(vtkDataArray* labels, const std::vector<std::string>& files)
{
  const std::string array = labels->GetName() ? labels->GetName() : "";
  std::array<bool, kNumberOfClasses> found{};
  for (vtkIdType i = 0; i < labels->GetNumberOfTuples(); ++i)
  {
    const double number = std::round(labels->GetComponent(i, 0));
    if (number >= 0.0 && number < kNumberOfClasses)
    {
      found[std::size_t(number)] = true;
    }
  }
  vtkLookupTable* legend = vtkLookupTable::New();
  legend->IndexedLookupOn();
  legend->SetNumberOfTableValues(std::max<vtkIdType>(1, std::count(found.begin(), found.end(), true)));
  vtkIdType row = 0;
  for (int number = 0; number < kNumberOfClasses; ++number)
  {
    if (found[std::size_t(number)])
    {
      const bool isFile = std::size_t(number) < files.size();
      const double* color = labelColor(array, number);
      legend->SetAnnotation(
        number, isFile ? files[std::size_t(number)] : std::to_string(number) + " " + asprsClass(number).name);
      legend->SetTableValue(row++, color[0], color[1], color[2], 1.0);
    }
  }
  return legend;
}

bool hasColors(vtkPolyData* cloud)
{
  vtkDataArray* scalars = cloud ? cloud->GetPointData()->GetScalars() : nullptr;
  return scalars && scalars->GetDataType() == VTK_UNSIGNED_CHAR &&
    (scalars->GetNumberOfComponents() == 3 || scalars->GetNumberOfComponents() == 4);
}

bool applyCloudAppearance(vtkPolyData* cloud, vtkPolyDataMapper* mapper, vtkActor* actor,
  const std::string& colorBy, double pointSize)
{
  actor->GetProperty()->SetPointSize(static_cast<float>(pointSize));
  actor->GetProperty()->SetColor(0.20, 0.33, 0.55);
  actor->GetProperty()->LightingOff();
  const bool wantsColors = colorBy.empty() || colorBy == "rgb";
  const std::optional<ColorSource> source = wantsColors ? std::nullopt : findColorSource(cloud, colorBy);
  if (source)
  {
    colorByArray(mapper, cloud->GetPointData()->GetArray(source->array.c_str()), source->component);
    return true;
  }
  if (wantsColors && hasColors(cloud))
  {
    mapper->SetScalarModeToUsePointData();
    mapper->SetColorModeToDirectScalars();
    mapper->ScalarVisibilityOn();
    return true;
  }
  vtkDataArray* height = cloud->GetPointData()->GetArray(kHeightArrayName);
  if (height)
  {
    colorByArray(mapper, height, 0);
  }
  else
  {
    mapper->ScalarVisibilityOff();
  }
  return colorBy.empty();
}

void applyBackground(vtkRenderer* renderer)
{
  renderer->GradientBackgroundOn();
  renderer->SetBackground(0.97, 0.97, 0.96);
  renderer->SetBackground2(0.80, 0.84, 0.89);
}

void applyColorMap(vtkMapper* mapper, const std::string& name, const std::vector<double>& range)
{
  auto* table = vtkLookupTable::SafeDownCast(mapper->GetLookupTable());
  const bool areClasses = mapper->GetArrayName() && holdsLabels(mapper->GetArrayName());
  if (!mapper->GetScalarVisibility() || mapper->GetColorMode() != VTK_COLOR_MODE_MAP_SCALARS || !table ||
    areClasses)
  {
    return;
  }
  const auto map = vtkSmartPointer<vtkLookupTable>::Take(newColorMap(name));
  table->SetTable(map->GetTable());
  if (range.size() == 2)
  {
    table->SetTableRange(range[0], range[1]);
  }
}

const std::vector<std::string>& groundNames()
{
  static const std::vector<std::string> names = { "dark", "light", "white", "black" };
  return names;
}

void applyGround(vtkRenderer* renderer, const std::string& name)
{
  if (name == "light")
  {
    applyBackground(renderer);
    return;
  }
  renderer->GradientBackgroundOff();
  if (name == "white" || name == "black")
  {
    const double grey = name == "white" ? 1.0 : 0.0;
    renderer->SetBackground(grey, grey, grey);
    return;
  }
  renderer->SetBackground(0.125, 0.135, 0.155);
}

bool isLightGround(const std::string& name)
{
  return name == "light" || name == "white";
}

void applyFigureAppearance(vtkPolyDataMapper* mapper, vtkActor* actor, vtkRenderer* renderer)
{
  mapper->ScalarVisibilityOff();
  actor->GetProperty()->SetColor(0.60, 0.68, 0.80);
  renderer->GradientBackgroundOff();
  renderer->SetBackground(1.0, 1.0, 1.0);
}

namespace
{

/// Draws nothing into the ids of a selector, which draws the overlays itself.
class OverlaysOfPicture : public vtkOverlayPass
{
public:
  static OverlaysOfPicture* New();
  void Render(const vtkRenderState* state) override
  {
    if (!state->GetRenderer()->GetSelector())
    {
      this->vtkOverlayPass::Render(state);
    }
  }
};
vtkStandardNewMacro(OverlaysOfPicture);

} // namespace

void applyDepthShading(vtkRenderer* renderer, double noise, double noisePerDistance)
{
  if (vtkDepthShadingPass* present = vtkDepthShadingPass::GetPassOf(renderer))
  {
    present->SetNoiseLength(noise);
    present->SetNoisePerDistance(noisePerDistance);
    return;
  }
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkTranslucentPass> translucent;
  vtkNew<vtkVolumetricPass> volumes;
  vtkNew<vtkRenderPassCollection> worldPasses;
  worldPasses->AddItem(lights);
  worldPasses->AddItem(opaque);
  worldPasses->AddItem(translucent);
  worldPasses->AddItem(volumes);
  vtkNew<vtkSequencePass> world;
  world->SetPasses(worldPasses);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(world);
  vtkNew<vtkDepthShadingPass> shading;
  shading->SetDelegatePass(camera);
  shading->SetNoiseLength(noise);
  shading->SetNoisePerDistance(noisePerDistance);
  // Text is drawn after the shading, as it has no depth.
  vtkNew<OverlaysOfPicture> overlay;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(shading);
  passes->AddItem(overlay);
  vtkNew<vtkSequencePass> all;
  all->SetPasses(passes);
  renderer->SetPass(all);
}

void setDepthStrength(vtkRenderer* renderer, double strength)
{
  if (vtkDepthShadingPass* shading = vtkDepthShadingPass::GetPassOf(renderer))
  {
    shading->SetStrength(strength);
  }
}

} // namespace pointhaptics
