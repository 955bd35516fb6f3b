#include "Benchmark/Report.h"

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

constexpr const char* kPage = "Performance.md";
constexpr const char* kImages = "Images";
constexpr const char* kPageHead =
  "# Performance\n\nWritten by `pointhaptics bench`; run the command of a section to repeat it. Compare the "
  "ratios, which\ntravel between machines better than the times do.\n";

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
  std::string text = fmt::format("{}\n{}\n", report.title, sentence(report.machine));
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

std::string toMarkdown(const Report& report, const std::string& imageFolder)
{
  std::string text = fmt::format("## {}\n\n    {}\n\n{}\n\nMeasured on: {}\n", report.title, report.command,
    report.method, sentence(report.machine));
  for (const ReportPart& part : report.parts)
  {
    text += fmt::format("\n### {}\n\n{}\n\n{}", part.title, part.text, toMarkdown(part.table));
    for (std::size_t i = 0; i < part.remarks.size(); ++i)
    {
      text += fmt::format("{}- {}\n", i == 0 ? "\n" : "", part.remarks[i]);
    }
    for (const Chart& chart : part.charts)
    {
      text += imageFolder.empty()
        ? std::string()
        : fmt::format("\n![{}]({}/{}.png)\n", chart.title, imageFolder, chart.fileName);
    }
  }
  return text;
}

std::string withSection(const std::string& page, const std::string& task, const std::string& section)
{
  const std::string block = beginMark(task) + "\n\n" + section + "\n" + endMark(task);
  const std::size_t begin = page.find(beginMark(task));
  const std::size_t end = page.find(endMark(task), begin == std::string::npos ? 0 : begin);
  if (begin != std::string::npos && end != std::string::npos)
  {
    return page.substr(0, begin) + block + page.substr(end + endMark(task).size());
  }
  return (page.empty() ? std::string(kPageHead) : page) + "\n" + block + "\n";
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
  const std::string section = toMarkdown(report, withPictures ? kImages : "");
  const std::string page = withSection(contentOf(root / kPage), report.task, section);
  if (!writeContent(root / kPage, page))
  {
    message = (root / kPage).string() + ": cannot be written; check the folder and the space left";
    return false;
  }
  return !withPictures || writeCharts(report, root / kImages, message);
}

} // namespace bench
} // namespace pointhaptics
