/// Does the proxy hold on real scans? And where the scan has a mesh: is the force right?
#include "Benchmark/Harness/Statistics.h"
#include "Benchmark/Proxy/Strokes.h"
#include "Benchmark/Proxy/Studies/Studies.h"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{
namespace
{

/// A tick whose force falls by more than this is a drop, newtons.
constexpr double kDrop = 0.2;

struct ScanFigures
{
  int strokes = 0;
  int drops = 0;  ///< Strokes in which a tick lets the force fall by more than kDrop.
  int rims = 0;   ///< Strokes in which the surface ended under the hand.
  int losses = 0; ///< Strokes in which the surface could not be followed for a tick or more.
  int nonFinite = 0;
  double largestChange = 0.0; ///< Of the force within a tick beyond 2 K |dH|, newtons.
  std::vector<double> steps;  ///< Over K |dH|, sorted.
  std::vector<double> microseconds;
};

void add(const StrokeTrace& trace, ScanFigures& figures)
{
  const double stiffness = ContactParameters().stiffness;
  bool dropped = false;
  std::uint32_t status = 0;
  for (std::size_t i = 0; i < trace.states.size(); ++i)
  {
    const ProxyState& state = trace.states[i];
    figures.nonFinite += !isFinite(state.force) || !isFinite(state.proxy) || !isFinite(state.normal);
    status |= state.status;
    if (i == 0)
    {
      continue;
    }
    const ProxyState& last = trace.states[i - 1];
    const double moved = norm(state.hip - last.hip);
    const double step = norm(state.force - last.force);
    dropped = dropped || norm(last.force) - norm(state.force) > kDrop;
    figures.largestChange = std::max(figures.largestChange, step - 2.0 * stiffness * moved);
    if (moved > kSmallestMove && (state.contact || last.contact))
    {
      figures.steps.push_back(step / (stiffness * moved));
    }
  }
  ++figures.strokes;
  figures.drops += dropped;
  figures.rims += (status & kProxyBallContact) != 0;
  figures.losses += (status & kProxyBallContact) != 0;
  figures.microseconds.insert(
    figures.microseconds.end(), trace.microseconds.begin(), trace.microseconds.end());
}

ScanFigures feelScan(const HapticScene& scene, int count, bool following)
{
  ScanFigures figures;
  for (const Stroke& stroke : strokesOn(scene, count))
  {
    add(feelStroke(scene, stroke, following), figures);
  }
  std::sort(figures.steps.begin(), figures.steps.end());
  std::sort(figures.microseconds.begin(), figures.microseconds.end());
  return figures;
}

double at(const std::vector<double>& sorted, double part)
{
  return sorted.empty() ? 0.0 : quantile(sorted, part);
}

/// The nearest point of a mesh.
class Mesh
{
public:
  Mesh(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& triangles)
  {
    vtkNew<vtkPoints> vertices;
    vertices->SetDataTypeToDouble();
    for (const Vec3& p : points)
    {
      vertices->InsertNextPoint(p.x, p.y, p.z);
    }
    vtkNew<vtkCellArray> faces;
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    {
      const vtkIdType ids[3] = { triangles[i], triangles[i + 1], triangles[i + 2] };
      faces->InsertNextCell(3, ids);
    }
    mesh_->SetPoints(vertices);
    mesh_->SetPolys(faces);
    locator_->SetDataSet(mesh_);
    locator_->BuildLocator();
  }

  Vec3 nearest(const Vec3& p) const
  {
    double closest[3] = { 0.0, 0.0, 0.0 };
    vtkIdType cell = 0;
    int sub = 0;
    double d2 = 0.0;
    const double x[3] = { p.x, p.y, p.z };
    locator_->FindClosestPoint(x, closest, cell_, cell, sub, d2);
    return { closest[0], closest[1], closest[2] };
  }

private:
  vtkNew<vtkPolyData> mesh_;
  vtkNew<vtkStaticCellLocator> locator_;
  vtkNew<vtkGenericCell> cell_;
};

} // namespace

ReportPart studyScans(StudyContext& context)
{
  ReportPart part;
  if (context.options.scans.empty())
  {
    return part;
  }
  part.page = Page::Accuracy;
  part.title = "Real scans";
  part.text = fmt::format(
    "Scans fitted into 95 mm, {} strokes each at random places that can be reached from outside. A\n"
    "stroke is pressed to 1 mm, then slid 10 mm at 10 mm/s, straight on or following the felt surface\n"
    "at 1 mm depth.\n"
    "\n"
    "- drops: strokes in which the force falls by more than {} N within a tick.\n"
    "- rims: strokes that came to where the scan has no points; lost: strokes in which the surface\n"
    "  had to be found again.\n"
    "- change: the most that a tick changes the force beyond 2 K|dH|, to be at most the settle rate,\n"
    "  0.1 N.\n"
    "- times: every tick is timed once, whatever the machine did meanwhile.",
    context.options.strokes, kDrop);
  part.table.header = { "scan", "points", "hand", "strokes", "drops", "rims", "lost", "not finite",
    "change N", "step p50", "p99", "p50 us", "p99", "p99.9" };
  for (const Scan& scan : context.options.scans)
  {
    context.progress("strokes on " + scan.name);
    double scale = 1.0;
    Vec3 middle;
    const Scene scene = sceneOf(fitted(scan.points, scale, middle));
    if (!scene)
    {
      part.remarks.push_back("Left out: " + scan.name + " has no finite points");
      continue;
    }
    for (const bool following : { false, true })
    {
      const ScanFigures f = feelScan(*scene, context.options.strokes, following);
      const std::string hand = following ? "following" : "straight";
      part.table.rows.push_back({ scan.name, grouped(std::int64_t(scan.points.size())), hand,
        fmt::format("{}", f.strokes), fmt::format("{}", f.drops), fmt::format("{}", f.rims),
        fmt::format("{}", f.losses), fmt::format("{}", f.nonFinite), fmt::format("{:.4f}", f.largestChange),
        brief(at(f.steps, 0.5)), brief(at(f.steps, 0.99)), brief(at(f.microseconds, 0.5)),
        brief(at(f.microseconds, 0.99)), brief(at(f.microseconds, 0.999)) });
      part.rows.push_back(
        { { "scan", scan.name }, { "points", scan.points.size() }, { "hand", hand }, { "strokes", f.strokes },
          { "drops", f.drops }, { "rims", f.rims }, { "lost", f.losses }, { "not_finite", f.nonFinite },
          { "largest_change_newton", f.largestChange }, { "step_p50", at(f.steps, 0.5) },
          { "step_p99", at(f.steps, 0.99) }, { "p50_us", at(f.microseconds, 0.5) },
          { "p99_us", at(f.microseconds, 0.99) }, { "p999_us", at(f.microseconds, 0.999) } });
      if (f.nonFinite > 0)
      {
        context.wrong = fmt::format("{}: {} states that are not finite", scan.name, f.nonFinite);
      }
    }
  }
  return part;
}

ReportPart studyMeshes(StudyContext& context)
{
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Scans beside their own meshes";
  part.text =
    "The cloud is the mesh's vertices, fitted into 95 mm, felt by the straight strokes of the scans\n"
    "above. Ideal is the spring to the nearest point of the triangles. Ticks in contact count, 0.05\n"
    "to 1.5 mm inside, whose nearest point is on the side that was pressed. A smooth surface through\n"
    "the vertices is not the flat triangles between them: the difference is part of the error.";
  part.table.header = { "scan", "triangles", "ticks", "median error %", "RMS error %", "95 % below",
    "median angle" };
  for (const Scan& scan : context.options.scans)
  {
    if (scan.triangles.empty())
    {
      continue;
    }
    context.progress("the mesh of " + scan.name);
    double scale = 1.0;
    Vec3 middle;
    const std::vector<Vec3> points = fitted(scan.points, scale, middle);
    const Scene scene = sceneOf(points);
    const Mesh mesh(points, scan.triangles);
    const double stiffness = ContactParameters().stiffness;
    std::vector<double> errors;
    std::vector<double> angles;
    double squares = 0.0;
    double scaleSquares = 0.0;
    for (const Stroke& stroke : strokesOn(*scene, context.options.strokes))
    {
      for (const ProxyState& state : feelStroke(*scene, stroke, false).states)
      {
        const Vec3 toMesh = mesh.nearest(state.hip) - state.hip;
        const double depth = norm(toMesh);
        if (!state.contact || depth < 5e-5 || depth > 1.5e-3 || dot(toMesh, state.normal) <= 0.5 * depth)
        {
          continue;
        }
        const double error = norm(state.force - stiffness * toMesh);
        errors.push_back(100.0 * error / (stiffness * depth));
        squares += error * error;
        scaleSquares += stiffness * stiffness * depth * depth;
        const double cosine = dot(normalized(state.force, toMesh), toMesh / depth);
        angles.push_back(57.29577951308232 * std::acos(std::clamp(cosine, -1.0, 1.0)));
      }
    }
    std::sort(errors.begin(), errors.end());
    std::sort(angles.begin(), angles.end());
    const double rms = scaleSquares > 0.0 ? 100.0 * std::sqrt(squares / scaleSquares) : 0.0;
    part.table.rows.push_back(
      { scan.name, grouped(std::int64_t(scan.triangles.size() / 3)), grouped(std::int64_t(errors.size())),
        brief(at(errors, 0.5)), brief(rms), brief(at(errors, 0.95)), brief(at(angles, 0.5)) });
    part.rows.push_back({ { "scan", scan.name }, { "triangles", scan.triangles.size() / 3 },
      { "ticks", errors.size() }, { "median_error_percent", at(errors, 0.5) }, { "rms_error_percent", rms },
      { "p95_error_percent", at(errors, 0.95) }, { "median_angle_degrees", at(angles, 0.5) } });
  }
  return part;
}

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
