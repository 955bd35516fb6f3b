#include "Benchmark/Report/PageSummary.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace pointhaptics
{
namespace bench
{
namespace
{

constexpr const char* kStepColumn = "step us: p50 / p99 / p99.9 / max";

/// Quotes the table of one part. An empty answer leaves the row out.
struct Rule
{
  Page page;
  const char* task;
  const char* part;
  SummaryRow (*row)(const TableRows& rows);
};

/// The @p index-th of figures with slashes between: "1.81 / 4.31 / 6.09".
std::string figure(const std::string& cell, std::size_t index)
{
  std::size_t begin = 0;
  for (std::size_t i = 0; i < index && begin != std::string::npos; ++i)
  {
    begin = cell.find(" / ", begin);
    begin = begin == std::string::npos ? begin : begin + 3;
  }
  return begin == std::string::npos ? std::string() : cell.substr(begin, cell.find(" / ", begin) - begin);
}

/// @p text with a cell for each "{}", or nothing where a cell is empty: a run with other settings lacks it.
std::string filled(const char* text, const std::vector<std::string>& cells)
{
  std::string result;
  std::size_t next = 0;
  for (const char* c = text; *c != '\0'; ++c)
  {
    if (c[0] != '{')
    {
      result += *c;
      continue;
    }
    if (next == cells.size() || cells[next].empty())
    {
      return std::string();
    }
    result += cells[next++];
    ++c;
  }
  return result;
}

SummaryRow resampling(const TableRows& rows)
{
  const TableRows largest = rows.where("points", rows.last("points")).where("order", "random");
  const TableRows ours = largest.where("threads", largest.last("threads")).where("contestant", "ours");
  return { filled("Mean resampling of {} points, {} threads", { ours.last("points"), ours.last("threads") }),
    filled("{} ms; PCL takes {} times as long", { ours.last("median ms"), ours.last("PCL / it") }) };
}

SummaryRow zooming(const TableRows& rows)
{
  const TableRows view = rows.where("% inside", "1.00");
  return { "Resampling a view that 1 % of the points are in",
    filled(
      "{} ms, {} % of the time for all points", { view.last("moved ms"), view.last("% of full update") }) };
}

SummaryRow proxyTime(const TableRows& rows)
{
  return { filled("Update of the proxy in contact with {} points", { rows.last("points") }),
    filled(
      "p50 {} us, p99 {} us, max {} us", { rows.last("p50 us"), rows.last("p99"), rows.last("max us") }) };
}

SummaryRow reading(const TableRows& rows)
{
  const TableRows ply = rows.where("file", "PLY binary");
  const TableRows vtp = rows.where("file", "VTP").where("contestant", "vtkXMLPolyDataReader");
  return { filled("Reading a binary PLY file of {} MB", { ply.last("MB") }),
    filled("{} ms; PCL takes {} times as long, VTK {}. VTK reads its own VTP in {} of our time",
      { ply.where("contestant", "ours").last("median ms"),
        ply.where("contestant", "pcl::io::loadPLYFile").last("x ours"),
        ply.where("contestant", "vtkPLYReader").last("x ours"), vtp.last("x ours") }) };
}

SummaryRow bandwidthTime(const TableRows& rows)
{
  const TableRows threads = rows.where("cloud", "sphere").where("threads", rows.last("threads"));
  const TableRows ours = threads.where("contestant", "ours");
  return { filled("Bandwidths of {} points, {} threads", { ours.last("points"), ours.last("threads") }),
    filled("{} ms; loops over other libraries' searches take {} times as long",
      { ours.last("median ms"), rangeText(threads.whereNot("contestant", "ours").range("x ours")) }) };
}

SummaryRow firstTouch(const TableRows& rows)
{
  const std::string near = rows.where("radii", "in a window, near the hand first").last("median ms");
  const std::string needed = rows.where("radii", "those the scene needs").last("median ms"); // of older pages
  return { "From the statue's points in memory to the first contact",
    filled("{} ms", { near.empty() ? needed : near }) };
}

SummaryRow servo(const TableRows& rows)
{
  const TableRows idle = rows.where("hand", "simulated hand").where("machine", "idle").where("Hz", "1000");
  const std::string step = idle.last(kStepColumn);
  return { "Servo loop at 1 kHz on an idle machine",
    filled(
      "step time p50 {} us, p99 {} us, max {} us; {} deadline misses in {} ticks, {} in a loop that does "
      "nothing",
      { figure(step, 0), figure(step, 1), figure(step, 3), idle.last("deadline misses"), idle.last("ticks"),
        idle.last("misses of an empty loop") }) };
}

SummaryRow turning(const TableRows& rows)
{
  const TableRows detail = rows.where("level of detail", "yes");
  return { filled(
             "Turning the camera about {} points, no graphics card", { detail.last("points in the file") }),
    filled("{} frames a second; {} without level of detail",
      { detail.last("fps"), rows.where("level of detail", "no").last("fps") }) };
}

SummaryRow keyToHand(const TableRows& rows)
{
  const std::string points = rows.last("points in the file");
  const TableRows largest = rows.where("points in the file", points);
  return { filled("From a key that moves {} points to the new scene at the hand", { points }),
    filled("p50 {} ms, largest {} ms",
      { rangeText(largest.range("at the hand p50 ms")), largest.range("largest ms").second }) };
}

SummaryRow firstPicture(const TableRows& rows)
{
  const TableRows ours = rows.where("program", "pointhaptics view");
  const TableRows f3d = rows.where("program", "f3d");
  return { filled("From the program's start to the picture of {} points", { ours.last("points") }),
    filled("{} s, {} MB; f3d takes {} times as long and {} MB",
      { ours.last("median s"), ours.last("peak MB"), f3d.last("x ours"), f3d.last("peak MB") }) };
}

SummaryRow forceOnShapes(const TableRows& rows)
{
  const TableRows dense = rows.where("points", rows.last("points"));
  return { filled("Force on exact shapes of {} points", { dense.last("points") }),
    filled("RMS error {} % without noise, {} % with 100 um of noise",
      { rangeText(dense.where("noise", "clean").range("RMS %")),
        rangeText(dense.where("noise", "100 um").range("RMS %")) }) };
}

SummaryRow forceByMethod(const TableRows& rows)
{
  const TableRows torus = rows.where("points", rows.last("points")).where("noise", "clean");
  return { "The default method beside the paper's, on a torus",
    filled("RMS error {} %; the paper's {} %, with its printed gains {} %",
      { torus.where("method", "surface-fit (default)").last("RMS %"),
        torus.where("method", "gradient-steps, tuned").last("RMS %"),
        torus.where("method", "gradient-steps, paper").last("RMS %") }) };
}

SummaryRow forceOnScans(const TableRows& rows)
{
  const TableRows straight = rows.where("hand", "straight");
  const TableRows following = rows.where("hand", "following");
  return { "Strokes over real scans in which the force falls by more than 0.2 N in a tick",
    filled("{} of {} straight ones, {} of {} that follow the surface",
      { straight.sum("drops"), straight.sum("strokes"), following.sum("drops"), following.sum("strokes") }) };
}

SummaryRow friction(const TableRows& rows)
{
  return { "Ratio of friction to normal force",
    filled("RMS error at most {} %; the paper's method {} %",
      { rows.where("method", "surface-fit").range("RMS error %").second,
        rangeText(rows.where("method", "gradient-steps, tuned").range("RMS error %")) }) };
}

SummaryRow bandwidthScatter(const TableRows& rows)
{
  const TableRows nearest = rows.where("neighbourhood", "k nearest").where("k", "16");
  return { "Bandwidth from 16 neighbours, against that of an even disc",
    filled(
      "bias {} %, scatter {} % RMS", { nearest.last("bandwidth bias %"), nearest.last("bandwidth RMS %") }) };
}

SummaryRow density(const TableRows& rows)
{
  return { "Density, against the sum over all points",
    filled("relative error at most {}",
      { rows.where("cut off at (bandwidths)", "6, the filter's").last("largest relative error") }) };
}

SummaryRow touchOnMeshes(const TableRows& rows)
{
  const TableRows samples = rows.where("cloud", "samples");
  return { "Force beside a god object on the mesh itself, scans and machined parts",
    filled("median error {} %; without the fit {} %",
      { rangeText(samples.where("method", "surface-fit").range("median %")),
        rangeText(samples.where("method", "sphere").range("median %")) }) };
}

SummaryRow touchOverEdges(const TableRows& rows)
{
  const TableRows ours = rows.where("method", "surface-fit");
  const TableRows papers = rows.where("method", "gradient-steps-tuned");
  return { "Slides over edges and corners of a box with a force above 0.05 N outside",
    filled(
      "{} of {}; the paper's method {}", { ours.sum("above"), ours.sum("strokes"), papers.sum("above") }) };
}

SummaryRow thinPlate(const TableRows& rows)
{
  const TableRows through = rows.where("part", "through plate 0.6 mm");
  const TableRows ours = through.where("method", "surface-fit");
  return { "Hands that go right through a plate of 0.6 mm, at up to 1 m/s, and are let go or pushed on",
    filled("{} of {}; the paper's method {}",
      { ours.last("pops"), ours.last("strokes"),
        through.where("method", "gradient-steps-tuned").last("pops") }) };
}

constexpr Rule kRules[] = {
  { Page::Performance, "resample", "points", resampling },
  { Page::Performance, "resample", "zoom", zooming },
  { Page::Performance, "proxy", "size", proxyTime },
  { Page::Performance, "io", "read", reading },
  { Page::Performance, "bandwidth", "search", bandwidthTime },
  { Page::Performance, "bandwidth", "touch", firstTouch },
  { Page::Performance, "servo", "loop", servo },
  { Page::Performance, "render", "turning", turning },
  { Page::Performance, "render", "response", keyToHand },
  { Page::Performance, "render", "first_picture", firstPicture },
  { Page::Accuracy, "proxy", "shapes", forceOnShapes },
  { Page::Accuracy, "proxy", "methods", forceByMethod },
  { Page::Accuracy, "proxy", "scans", forceOnScans },
  { Page::Accuracy, "friction", "ratio", friction },
  { Page::Accuracy, "bandwidth", "settling", bandwidthScatter },
  { Page::Accuracy, "bandwidth", "truncation", density },
  { Page::Accuracy, "touch", "scans", touchOnMeshes },
  { Page::Accuracy, "touch", "edges", touchOverEdges },
  { Page::Accuracy, "touch", "thin", thinPlate },
};

} // namespace

std::vector<SummaryRow> summaryOf(const Report& report, Page page)
{
  std::vector<SummaryRow> rows;
  for (const Rule& rule : kRules)
  {
    for (const ReportPart& part : report.parts)
    {
      if (rule.page == page && rule.task == report.task && rule.part == part.key)
      {
        SummaryRow row = rule.row(TableRows(part.table));
        if (!row.question.empty() && !row.answer.empty())
        {
          rows.push_back(std::move(row));
        }
      }
    }
  }
  return rows;
}

std::size_t numberOfSummaryRows(Page page)
{
  return std::size_t(std::count_if(
    std::begin(kRules), std::end(kRules), [page](const Rule& rule) { return rule.page == page; }));
}

} // namespace bench
} // namespace pointhaptics
