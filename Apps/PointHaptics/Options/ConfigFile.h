/// @file
/// --config: options as a JSON object.
#pragma once

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

/// Long names of the options a configuration file may set, without the dashes.
std::vector<std::string> configurableNames(CLI::App& command);

/// Takes the values of the JSON file for the options of @p command that the command line does not give. Keys
/// among @p ignored are of another command, and mean nothing here. Ends in a usage error where a key or a
/// value is wrong. @throws Failure where the file cannot be read.
void applyConfigFile(CLI::App& command, const std::string& fileName, const std::vector<std::string>& ignored);

/// How the cloud of a recording was read and cut.
struct RecordedReading
{
  std::vector<double> clip;
  std::string hide; ///< As --hide takes it.
  std::string up = "auto";
  std::vector<std::string> columns;
  bool salvage = false;
  bool vertices = false;
};

/// @p settings: a configuration in one line, as recordings keep it.
RecordedReading recordedReading(const std::string& settings);

} // namespace pointhaptics::app
