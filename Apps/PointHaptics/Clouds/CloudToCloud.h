/// @file
/// What the commands share that read clouds and write others: IN... -o OUT --merge --threads --json.
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
  std::string input;  ///< The one at hand.
  std::string output; ///< Of the one at hand; before, a pattern (expandedName()).
  bool merge = false;
  ReadOptions reading;
  WriteOptions writing;
  std::int64_t threads = 0; ///< 0: all.
  bool json = false;

  /// @param lastIsOutput whether the last of several IN is OUT where -o is not given.
  void addTo(CLI::App& command, bool lastIsOutput = false);
  /// Reads the input, or where ranks read it together this one's part.
  bool read(Cloud& cloud, std::string& message, Ranks* ranks = nullptr) const;
};

/// What came of one cloud.
struct CloudResult
{
  std::string summary;
  nlohmann::ordered_json json;
};

/// As JSON where it @p isJson, else as a line.
void print(const CloudResult& result, bool isJson);

/// Reads each input of @p options, or all of them merged, and calls @p work with it and with the options as
/// they are for this one: it adds the outputs, and throws Failure. Once all are done the outputs appear, and
/// what came of them is printed. @return an ExitCode.
int runOnClouds(const std::string& command, const CloudToCloudOptions& options, Files& files,
  const std::function<CloudResult(const CloudToCloudOptions& options, Cloud& cloud)>& work);

} // namespace pointhaptics::app
