/// @file
/// Shared by the commands that read clouds and write others: IN... -o OUT --merge --threads --json.
#pragma once

#include "Clouds/Pipeline.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

struct CloudToCloudOptions
{
  std::vector<std::string> inputs;
  std::string input;  ///< The present input.
  std::string output; ///< Output of that input; before, a pattern (expandedName()).
  bool merge = false;
  ReadOptions reading;
  WriteOptions writing;
  std::int64_t threads = 0; ///< Number of threads; 0: all.
  bool json = false;

  /// Adds the options. @param lastIsOutput true if the last of several IN is OUT where -o is not given.
  void addTo(CLI::App& command, bool lastIsOutput = false);
  /// Reads the input, or this rank's part of it where ranks read it together.
  bool read(Cloud& cloud, std::string& message, Ranks* ranks = nullptr) const;
};

/// Result of one cloud.
struct CloudResult
{
  std::string summary;
  nlohmann::ordered_json json;
};

/// Prints a result as JSON or as a line.
void print(const CloudResult& result, bool isJson);

/// Reads each input of @p options, or all of them merged, and calls @p work with it and with its options: @p
/// work adds the outputs, and throws Failure. Once all are done the outputs appear, and the results are
/// printed. @return an ExitCode.
int runOnClouds(const std::string& command, const CloudToCloudOptions& options, Files& files,
  const std::function<CloudResult(const CloudToCloudOptions& options, Cloud& cloud)>& work);

} // namespace pointhaptics::app
