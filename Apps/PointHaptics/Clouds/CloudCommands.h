/// @file
/// The commands that read clouds and write others: IN... -o OUT --merge --threads --json. Those whose work
/// pointhaptics-mpi shares are here, too.
#pragma once

#include "Clouds/Pipeline.h"
#include "Options/SettingOptions.h"
#include "Options/SharedOptions.h"
#include "Terminal/CommandLine.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

class vtkVoxelMeanResampler;

namespace pointhaptics
{
class CsvWriter;
namespace app
{

/// Result of one cloud.
struct CloudResult
{
  std::string summary;
  nlohmann::ordered_json json;
};

/// Reads each of its inputs, or all of them merged, and makes an output of it.
struct CloudCommand : Command
{
  std::vector<std::string> inputs;
  std::string input;  ///< The present input.
  std::string output; ///< Output of that input; before, a pattern (expandedName()).
  bool merge = false;
  ReadOptions reading;
  WriteOptions writing;
  std::int64_t threads = 0; ///< Number of threads; 0: all.
  bool json = false;
  std::vector<std::string> lengths; ///< Options of lengths, "--voxel 5"; filled in by complete().
  bool unitIsGiven = false;         ///< --unit; filled in by complete().

  void addTo(CLI::App& command) override;
  void complete(CLI::App& command, Files& files) override;
  /// Once all clouds are done the outputs appear, and the results are printed.
  int run(Files& files) final;
  /// Adds the outputs of @p cloud, the present input. @throws Failure
  virtual CloudResult work(Cloud& cloud, Files& files) = 0;
  /// Prints a result as JSON or as a line.
  void print(const CloudResult& result) const;
  /// The result of the present cloud: @p figures, the same as @p numbers, and which files they are of.
  CloudResult resultOf(const std::string& figures, const nlohmann::ordered_json& numbers) const;
  /// The unit of the files' coordinates that --unit says, which become metres.
  virtual std::string unitOfFile() const { return "m"; }
  /// The unit of the given lengths, where @p cloud says that its own is no metre, or that --unit contradicts
  /// the cloud's; else empty.
  std::string unitNote(vtkPolyData* cloud) const;

protected:
  /// @param lastIsOutput true if the last of several IN is OUT where -o is not given.
  void addFiles(CLI::App& command, bool lastIsOutput);
};

/// Figures of a cloud or a part of it. Points that are not finite have radius 0: they take no part.
struct BandwidthFigures
{
  double smallestRadius = INFINITY;
  double largestRadius = 0.0;
  std::int64_t points = 0;
  std::int64_t invalid = 0;
};

BandwidthFigures bandwidthFigures(vtkPolyData* cloud);
/// Joins the figures of two parts.
BandwidthFigures together(const BandwidthFigures& a, const BandwidthFigures& b);

struct BandwidthCommand : CloudCommand
{
  BandwidthOptions bandwidth;
  std::string unit = "m"; ///< --unit

  void addTo(CLI::App& command) override;
  CloudResult work(Cloud& cloud, Files& files) override;
  std::string unitOfFile() const override { return this->unit; }
  /// @p cloud in metres where --unit is given. @throws Failure where lengths mean nothing in it.
  vtkSmartPointer<vtkPolyData> prepared(vtkPolyData* cloud) const;
  /// @throws Failure where no point is finite.
  CloudResult result(const BandwidthFigures& figures) const;
};

/// Numbers of points.
struct ResampleFigures
{
  std::int64_t in = 0;
  std::int64_t out = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
};

/// Header of the file of --voxel-index.
constexpr const char* kVoxelIndexHeader = "voxel";
/// Row in the output of each point's voxel, or -1. @pre ComputeVoxelIndex is on.
std::vector<std::int64_t> voxelIndexOf(vtkVoxelMeanResampler* resampler);
void addVoxelIndex(const std::vector<std::int64_t>& rows, CsvWriter& file);

struct ResampleCommand : CloudCommand
{
  LatticeOptions lattice;
  std::int64_t minimumPoints = 1;
  std::string voxelIndex; ///< File to write; empty: none.

  void addTo(CLI::App& command) override;
  void complete(CLI::App& command, Files& files) override;
  CloudResult work(Cloud& cloud, Files& files) override;
  std::string unitOfFile() const override { return this->lattice.unit; }

  /// Sets all options on @p resampler and updates it with @p cloud. @throws Failure
  void update(vtkVoxelMeanResampler* resampler, vtkPolyData* cloud) const;
  /// unitNote(), and that rays of @p cloud which did not return are among the points of @p means.
  /// Collective where @p ranks have parts of the cloud: the same on all.
  std::vector<std::string> notes(vtkPolyData* cloud, vtkPolyData* means, Ranks& ranks) const;
  /// @throws Failure where no voxel is left.
  CloudResult result(const ResampleFigures& figures) const;
  /// Completes the means before they are written.
  void finish(vtkPolyData* means) const;
};

} // namespace app
} // namespace pointhaptics
