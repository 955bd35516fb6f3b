/// @file
/// What the commands share that read one cloud and write another: IN -o OUT --threads --json.
#pragma once

#include "Clouds/Pipeline.h"

#include <cstdint>
#include <string>

namespace CLI
{
class App;
}

namespace pointhaptics
{
namespace app
{

struct CloudToCloudOptions
{
  std::string input;
  std::string output;
  double resolution = 0.0;  ///< Of the input, in its units; 0: all of it.
  std::int64_t threads = 0; ///< 0: all.
  bool json = false;

  void addTo(CLI::App& command);
  /// Asks whether the output can be written before any work is done, sets the threads and reads the input.
  /// False:
  /// @p message says what failed.
  bool open(const std::string& command, Cloud& cloud, std::string& message) const;
  /// Reads the input, or where ranks read it together this one's part.
  bool read(Cloud& cloud, std::string& message, Ranks* ranks = nullptr) const;
};

} // namespace app
} // namespace pointhaptics
