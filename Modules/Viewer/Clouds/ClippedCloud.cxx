#include "ClippedCloud.h"

#include "CloudAppearance.h"
#include "Core/Base/Boxes.h"
#include "IO/Info/LengthUnit.h"

#include <fmt/format.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <sstream>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr std::size_t kNumbers = 6;

std::optional<HiddenValues> hiddenValuesOf(const std::string& text)
{
  const std::size_t equals = text.rfind('=');
  const std::string values = equals == std::string::npos ? std::string() : text.substr(equals + 1);
  const std::size_t colon = values.find(':');
  const auto numberOf = [](const std::string& word, double missing)
  {
    char* end = nullptr;
    const double number = word.empty() ? missing : std::strtod(word.c_str(), &end);
    return end && *end ? NAN : number;
  };
  HiddenValues hidden{ text.substr(0, equals), numberOf(values.substr(0, colon), -INFINITY), 0.0 };
  hidden.high = colon == std::string::npos ? hidden.low : numberOf(values.substr(colon + 1), INFINITY);
  const bool isWhole = !hidden.array.empty() && values.find_first_not_of(':') != std::string::npos;
  return isWhole && hidden.low <= hidden.high ? std::optional(hidden) : std::nullopt;
}

} // namespace

std::optional<Bounds> clipBox(const std::vector<double>& clip, vtkPolyData* cloud)
{
  if (clip.size() != kNumbers)
  {
    return std::nullopt;
  }
  return Bounds{ toLocalFrame(cloud, { clip[0], clip[2], clip[4] }),
    toLocalFrame(cloud, { clip[1], clip[3], clip[5] }) };
}

std::vector<double> clipNumbers(const Bounds& box, vtkPolyData* cloud)
{
  const Vec3 low = fromLocalFrame(cloud, box.minimum);
  const Vec3 high = fromLocalFrame(cloud, box.maximum);
  return { low.x, high.x, low.y, high.y, low.z, high.z };
}

bool areAlike(const Bounds& one, const Bounds& other)
{
  const double ratio = norm(one.extent()) / norm(other.extent());
  return contains(other, one.center()) && ratio > 0.5 && ratio < 2.0;
}

vtkSmartPointer<vtkPolyData> clippedCloud(vtkPolyData* cloud, const std::optional<Bounds>& box)
{
  return box ? partOfCloud(cloud, [&box](vtkIdType, const Vec3& place) { return contains(*box, place); })
             : vtkSmartPointer<vtkPolyData>(cloud);
}

std::function<bool(vtkIdType)> notHidden(vtkPolyData* cloud, const std::vector<HiddenValues>& hidden)
{
  std::vector<std::pair<ColorSource, HiddenValues>> found;
  for (const HiddenValues& each : hidden)
  {
    if (const std::optional<ColorSource> source = findColorSource(cloud, each.array))
    {
      found.emplace_back(*source, each);
    }
  }
  return [cloud, found](vtkIdType i)
  {
    return std::none_of(found.begin(), found.end(),
      [cloud, i](const auto& each)
      {
        const double value = colorValue(cloud, each.first, i);
        return value >= each.second.low && value <= each.second.high;
      });
  };
}

vtkSmartPointer<vtkPolyData> shownPart(
  vtkPolyData* cloud, const std::vector<double>& clip, const std::vector<HiddenValues>& hidden)
{
  const auto isShown = notHidden(cloud, hidden);
  const vtkSmartPointer<vtkPolyData> shown = hidden.empty()
    ? vtkSmartPointer<vtkPolyData>(cloud)
    : partOfCloud(cloud, [&](vtkIdType i, const Vec3&) { return isShown(i); });
  return clippedCloud(shown, clipBox(clip, cloud));
}

std::vector<HiddenValues> hiddenIn(const std::string& list, std::string& wrong)
{
  std::vector<HiddenValues> all;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');)
  {
    const std::optional<HiddenValues> hidden = hiddenValuesOf(word);
    hidden ? all.push_back(*hidden) : void(wrong = wrong.empty() ? word : wrong);
  }
  return all;
}

std::string textOf(const HiddenValues& hidden)
{
  const auto word = [](double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; };
  return hidden.array + "=" + word(hidden.low) + (hidden.low == hidden.high ? "" : ":" + word(hidden.high));
}

vtkSmartPointer<vtkPolyData> partOfCloud(
  vtkPolyData* cloud, const std::function<bool(vtkIdType, const Vec3&)>& isKept)
{
  const vtkIdType count = cloud->GetNumberOfPoints();
  vtkNew<vtkIdList> kept;
  for (vtkIdType i = 0; i < count; ++i)
  {
    Vec3 place;
    cloud->GetPoint(i, &place.x);
    if (isKept(i, place))
    {
      kept->InsertNextId(i);
    }
  }
  return kept->GetNumberOfIds() == count ? vtkSmartPointer<vtkPolyData>(cloud) : pointsOfCloud(cloud, kept);
}

vtkSmartPointer<vtkPolyData> pointsOfCloud(vtkPolyData* cloud, vtkIdList* ids)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  cloud->GetPoints()->GetPoints(ids, points);
  vtkNew<vtkIdList> places;
  places->SetNumberOfIds(ids->GetNumberOfIds());
  std::iota(places->GetPointer(0), places->GetPointer(0) + ids->GetNumberOfIds(), vtkIdType(0));
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  result->GetPointData()->CopyAllOn();
  result->GetPointData()->CopyAllocate(cloud->GetPointData(), ids->GetNumberOfIds());
  result->GetPointData()->CopyData(cloud->GetPointData(), ids, places);
  return result;
}

} // namespace pointhaptics
