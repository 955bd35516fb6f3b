#include "CloudColors.h"

#include "AsprsClasses.h"
#include "CloudAppearance.h"
#include "SmpExecutor.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

namespace pointhaptics
{
namespace
{

using vtksys::SystemTools;
constexpr vtkIdType kSample = 20000;
constexpr double kRgbRange = 16.0;
constexpr double kPlainRange = 20.0;
constexpr double kRgbLight = 0.35;
constexpr std::size_t kFewestClasses = 3;
constexpr double kClayFlatness = 0.63;
constexpr double kCoherent = 0.5;
/// Largest ratio of the range of heights to their noise at which a plate is drawn as clay. With a smaller one
/// the noise of a scanned table top is coloured.
constexpr double kNoisyRange = 8.0;
/// Largest ratio of the range of heights to the spacing at which a plate is drawn as clay in any case.
/// Without it the rounding of coordinates is coloured.
constexpr double kLeastRange = 1e-3;

double at(const std::vector<double>& sorted, double part)
{
  return sorted.empty() ? 0.0 : sorted[std::size_t(part * double(sorted.size() - 1))];
}

/// Finite values of @p value(i) over a sample of @p count, ascending.
template <typename Value>
std::vector<double> sortedSample(vtkIdType count, Value&& value)
{
  std::vector<double> values;
  for (vtkIdType i = 0; i < count; i += 1 + count / kSample)
  {
    const double each = value(i);
    if (std::isfinite(each))
    {
      values.push_back(each);
    }
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// Fraction of the sample below @p value, half of the equal ones included.
double rankOf(const std::vector<double>& sorted, double value)
{
  const auto range = std::equal_range(sorted.begin(), sorted.end(), value);
  return 0.5 * double((range.first - sorted.begin()) + (range.second - sorted.begin())) /
    double(sorted.size());
}

/// True if the colours tell anything; @p lightStrength receives how much of the light they leave visible.
bool rgbIsUseful(vtkDataArray* rgb, double& lightStrength)
{
  const auto luma = [rgb](vtkIdType i)
  {
    return 0.299 * rgb->GetComponent(i, 0) + 0.587 * rgb->GetComponent(i, 1) +
      0.114 * rgb->GetComponent(i, 2);
  };
  bool differs = false;
  for (int channel = 0; channel < 3; ++channel)
  {
    const std::vector<double> values =
      sortedSample(rgb->GetNumberOfTuples(), [&](vtkIdType i) { return rgb->GetComponent(i, channel); });
    differs = differs || at(values, 0.98) - at(values, 0.02) > kRgbRange;
  }
  const std::vector<double> lumas = sortedSample(rgb->GetNumberOfTuples(), luma);
  lightStrength = at(lumas, 0.75) - at(lumas, 0.25) < kPlainRange ? 1.0 : kRgbLight;
  return differs;
}

bool hasUsefulClasses(vtkDataArray* classes)
{
  std::set<int> found;
  for (vtkIdType i = 0; i < classes->GetNumberOfTuples() && found.size() < kFewestClasses; ++i)
  {
    const int each = int(classes->GetComponent(i, 0));
    if (each != 0 && each != 1 && each != 12)
    {
      found.insert(each);
    }
  }
  return found.size() >= kFewestClasses;
}

Vec3 positionOf(vtkPolyData* cloud, vtkIdType i)
{
  Vec3 p;
  cloud->GetPoint(i, &p.x);
  return p;
}

/// Position of a point on the map of colours of ColorRule::Height and Depth.
double levelOf(vtkPolyData* cloud, vtkIdType i, ColorRule rule, const CloudLook& look)
{
  const Vec3 p = positionOf(cloud, i);
  return rule == ColorRule::Depth ? -std::log(p.z) : dot(p, look.up);
}

void measureRanges(vtkPolyData* cloud, const CloudLook& look, CloudColors& colors)
{
  const vtkIdType count = cloud->GetNumberOfPoints();
  if (colors.rule == ColorRule::Height || colors.rule == ColorRule::Depth)
  {
    const std::vector<double> levels =
      sortedSample(count, [&](vtkIdType i) { return levelOf(cloud, i, colors.rule, look); });
    colors.low = at(levels, 0.01);
    colors.high = at(levels, 0.99);
  }
  if (!colors.intensity.empty())
  {
    vtkDataArray* intensity = cloud->GetPointData()->GetArray(colors.intensity.c_str());
    colors.ranks = sortedSample(count, [intensity](vtkIdType i) { return intensity->GetComponent(i, 0); });
  }
}

} // namespace

vtkDataArray* findArrayAnyCase(vtkPolyData* cloud, const std::string& name)
{
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const std::string own = array && array->GetName() ? SystemTools::LowerCase(array->GetName()) : "";
    if ((own == name || own == "scalar_" + name) && array->GetNumberOfComponents() == 1)
    {
      return array;
    }
  }
  return nullptr;
}

double spatialCoherence(vtkDataArray* values, const NeighborQuery& query, const LocalShape& shape)
{
  constexpr int kNeighbors = 9; // the point itself among them
  constexpr std::int64_t kProbes = 5000;
  const std::vector<double> sorted =
    sortedSample(values->GetNumberOfTuples(), [values](vtkIdType i) { return values->GetComponent(i, 0); });
  if (sorted.empty() || sorted.front() == sorted.back())
  {
    return 0.0;
  }
  double n = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  double residuals = 0.0;
  for (std::int64_t slot = 0; slot < query.size(); slot += 1 + query.size() / kProbes)
  {
    const std::int64_t index = query.index(slot);
    if (shape.points[std::size_t(index)].flatness < 0.5F)
    {
      continue;
    }
    Neighbor neighbors[kNeighbors];
    const int count = query.nearest(query.point(slot), kNeighbors, neighbors);
    double sumOfRanks = 0.0;
    for (int i = 1; i < count; ++i)
    {
      sumOfRanks += rankOf(sorted, values->GetComponent(neighbors[i].index, 0));
    }
    if (count > 1)
    {
      const double rank = rankOf(sorted, values->GetComponent(index, 0));
      const double residual = rank - sumOfRanks / (count - 1);
      n += 1.0;
      sum += rank;
      squares += rank * rank;
      residuals += residual * residual;
    }
  }
  const double variance = n > 0.0 ? squares / n - sum * sum / (n * n) : 0.0;
  return variance > 0.0 ? 1.0 - residuals / n / variance : 0.0;
}

CloudColors chooseColors(
  vtkPolyData* cloud, const NeighborQuery& query, const LocalShape& shape, const CloudLook& look)
{
  CloudColors colors;
  const bool isFrame = look.kind == CloudKind::Frame;
  double lightStrength = 1.0;
  if (hasColors(cloud) && rgbIsUseful(cloud->GetPointData()->GetScalars(), lightStrength))
  {
    colors.rule = ColorRule::Rgb;
    colors.lightStrength = look.hasOwnLight ? 0.0 : lightStrength;
    return colors;
  }
  vtkDataArray* intensity = findArrayAnyCase(cloud, "intensity");
  if (intensity && spatialCoherence(intensity, query, shape) > kCoherent)
  {
    colors.intensity = intensity->GetName();
  }
  vtkDataArray* classes = findArrayAnyCase(cloud, "classification");
  if (classes && hasUsefulClasses(classes))
  {
    colors.rule = ColorRule::Classes;
    colors.array = classes->GetName();
  }
  else if (look.kind == CloudKind::Object && shape.meanFlatness > kClayFlatness && colors.intensity.empty())
  {
    colors.rule = ColorRule::Clay;
  }
  else
  {
    colors.rule = isFrame ? ColorRule::Depth : ColorRule::Height;
  }
  measureRanges(cloud, look, colors);
  if (colors.rule == ColorRule::Height && look.kind == CloudKind::Terrain &&
    colors.high - colors.low <= std::max(kNoisyRange * shape.noise, kLeastRange) * shape.medianSpacing)
  {
    colors.rule = ColorRule::Clay; // heights of a flat plate are one colour, or noise
  }
  return colors;
}

vtkSmartPointer<vtkUnsignedCharArray> makeColors(
  vtkPolyData* cloud, const CloudColors& colors, const CloudLook& look)
{
  if (colors.rule == ColorRule::Rgb || (colors.rule == ColorRule::Clay && colors.intensity.empty()))
  {
    return nullptr;
  }
  const vtkIdType count = cloud->GetNumberOfPoints();
  vtkPointData* data = cloud->GetPointData();
  vtkDataArray* classes = colors.rule == ColorRule::Classes ? data->GetArray(colors.array.c_str()) : nullptr;
  vtkDataArray* intensity = colors.ranks.empty() ? nullptr : data->GetArray(colors.intensity.c_str());
  const double width = std::max(1e-300, colors.high - colors.low);
  auto result = vtkSmartPointer<vtkUnsignedCharArray>::New();
  result->SetNumberOfComponents(3);
  result->SetNumberOfTuples(count);
  const auto colorOne = [&](vtkIdType i)
  {
    Vec3 color{ kClayColor[0], kClayColor[1], kClayColor[2] };
    if (classes)
    {
      const double* entry = asprsClass(int(classes->GetComponent(i, 0))).color;
      color = { entry[0], entry[1], entry[2] };
    }
    else if (colors.rule != ColorRule::Clay)
    {
      color = groundColor((levelOf(cloud, i, colors.rule, look) - colors.low) / width);
    }
    color *= intensity ? 0.75 + 0.40 * rankOf(colors.ranks, intensity->GetComponent(i, 0)) : 1.0;
    for (int channel = 0; channel < 3; ++channel)
    {
      result->SetValue(3 * i + channel,
        static_cast<unsigned char>(std::lround(255.0 * std::clamp(color[channel], 0.0, 1.0))));
    }
  };
  forRange(SmpExecutor(), count,
    [&colorOne](std::int64_t begin, std::int64_t end)
    {
      for (; begin < end; ++begin)
      {
        colorOne(begin);
      }
    });
  return result;
}

} // namespace pointhaptics
