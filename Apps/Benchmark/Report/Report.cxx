#include "Benchmark/Report/Report.h"

#include "Benchmark/Report/PageSummary.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace pointhaptics
{
namespace bench
{
namespace
{

constexpr const char* kImages = "Images";

struct PageText
{
  const char* file;
  const char* head;
};

constexpr PageText kPerformance{ "Performance.md",
  "# Performance\n\n"
  "How long PointHaptics takes to resample, to read and write files, to feel and to draw, and how long\n"
  "other libraries and programs take for the same. The summary answers the first questions; each section\n"
  "says how it was measured. `pointhaptics-bench TASK -o Documentation` measures a section again, and\n"
  "writes it and its rows of the summary. Compare ratios rather than times: they change less from machine\n"
  "to machine.\n" };
constexpr PageText kAccuracy{
  "Accuracy.md",
  "# Accuracy\n\n"
  "How far force, friction, bandwidth and density are from exact answers, on shapes, meshes and scans, for\n"
  "every method. The summary answers the first questions; each section says how it was measured.\n"
  "`pointhaptics-bench TASK -o Documentation` measures a section again, and writes it and its rows of the\n"
  "summary. Errors are the same on every machine but for their last digits; the times beside them are not.\n"
};

const PageText& textOf(Page page)
{
  return page == Page::Accuracy ? kAccuracy : kPerformance;
}

std::string beginMark(const std::string& task)
{
  return "<!-- bench " + task + ": begin -->";
}

std::string endMark(const std::string& task)
{
  return "<!-- bench " + task + ": end -->";
}

std::string contentOf(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return stream ? content.str() : std::string();
}

bool writeContent(const std::filesystem::path& file, const std::string& content)
{
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream << content;
  stream.close();
  return bool(stream);
}

bool writeCharts(const Report& report, const std::filesystem::path& folder, std::string& message)
{
  for (const ReportPart& part : report.parts)
  {
    for (const Chart& chart : part.charts)
    {
      const std::string file = (folder / (chart.fileName + ".png")).string();
      if (!writePng(chart, file))
      {
        message = file + ": cannot be written; check that its folder can be written and has space";
        return false;
      }
    }
  }
  return true;
}

} // namespace

std::string toText(const Report& report)
{
  std::string text = fmt::format("{}\n{}\n", report.title, describe(report.machine));
  for (const ReportPart& part : report.parts)
  {
    text += fmt::format("\n== {}\n{}", part.title, toText(part.table));
    for (const std::string& remark : part.remarks)
    {
      text += fmt::format("  - {}\n", remark);
    }
  }
  return text;
}

nlohmann::ordered_json toJson(const Report& report)
{
  nlohmann::ordered_json result = { { "task", report.task }, { "command", report.command },
    { "machine", toJson(report.machine) } };
  for (const ReportPart& part : report.parts)
  {
    result[part.key] = { { "rows", part.rows }, { "remarks", part.remarks } };
  }
  return result;
}

std::string toMarkdown(const Report& report, Page page, const std::string& imageFolder)
{
  std::string parts;
  for (const ReportPart& part : report.parts)
  {
    if (part.page != page)
    {
      continue;
    }
    parts += fmt::format("\n### {}\n\n{}\n\n{}", part.title, part.text, toMarkdown(part.table));
    for (std::size_t i = 0; i < part.remarks.size(); ++i)
    {
      parts += fmt::format("{}- {}\n", i == 0 ? "\n" : "", part.remarks[i]);
    }
    for (const Chart& chart : part.charts)
    {
      parts += imageFolder.empty()
        ? std::string()
        : fmt::format("\n![{}]({}/{}.png)\n", chart.title, imageFolder, chart.fileName);
    }
  }
  const std::string& method = page == Page::Accuracy ? report.accuracyMethod : report.method;
  return parts.empty() ? parts
                       : fmt::format("## {}\n\n    {}\n\n{}\n\nMeasured on: {}\n{}", report.title,
                           report.command, method, describe(report.machine), parts);
}

std::string withSection(
  const std::string& content, Page page, const std::string& task, const std::string& section)
{
  const std::string block = beginMark(task) + "\n\n" + section + "\n" + endMark(task);
  const std::size_t begin = content.find(beginMark(task));
  const std::size_t end = content.find(endMark(task), begin == std::string::npos ? 0 : begin);
  if (begin != std::string::npos && end != std::string::npos)
  {
    return content.substr(0, begin) + block + content.substr(end + endMark(task).size());
  }
  return (content.empty() ? std::string(textOf(page).head) : content) + "\n" + block + "\n";
}

bool writeReport(const Report& report, const std::string& folder, bool withPictures, std::string& message)
{
  const std::filesystem::path root(folder);
  std::error_code error;
  std::filesystem::create_directories(withPictures ? root / kImages : root, error);
  if (error)
  {
    message = fmt::format("{}: the folder cannot be made ({})", folder, error.message());
    return false;
  }
  for (const Page page : { Page::Performance, Page::Accuracy })
  {
    const std::filesystem::path file = root / textOf(page).file;
    const std::string section = toMarkdown(report, page, withPictures ? kImages : "");
    if (section.empty())
    {
      continue;
    }
    const std::string content = withSection(contentOf(file), page, report.task, section);
    if (!writeContent(file, withSummary(content, report.title, summaryOf(report, page))))
    {
      message = file.string() + ": cannot be written; check the folder and the space left";
      return false;
    }
  }
  return !withPictures || writeCharts(report, root / kImages, message);
}

} // namespace bench
} // namespace pointhaptics
