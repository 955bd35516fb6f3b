#include "Options/ConfigFile.h"

#include "Options/Files.h"
#include "Options/OptionParsing.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace pointhaptics::app
{

std::vector<std::string> configurableNames(CLI::App& command)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      const std::set<std::string> others = { "help", "version", "config", "write-config", "recent" };
      if (others.count(name) == 0 && commonOptions().count(name) == 0)
      {
        names.push_back(name);
      }
    }
  }
  return names;
}

namespace
{

/// One JSON value as it would stand on the command line. False: objects and null have no such form.
bool textOf(const nlohmann::json& value, std::string& text)
{
  if (value.is_string())
  {
    text = value.get<std::string>();
    return true;
  }
  if (value.is_array())
  {
    text.clear();
    for (const nlohmann::json& element : value)
    {
      std::string part;
      if (element.is_array() || !textOf(element, part))
      {
        return false;
      }
      text += (text.empty() ? "" : ",") + part;
    }
    return true;
  }
  if (value.is_boolean() || value.is_number())
  {
    text = value.dump();
    return true;
  }
  return false;
}

bool isGivenOnCommandLine(const CLI::Option* option, const std::vector<const CLI::Option*>& given)
{
  return std::find(given.begin(), given.end(), option) != given.end();
}

/// The command line wins: also over a key that cannot stand beside one of its options.
bool isOverruled(CLI::Option* option, const std::vector<const CLI::Option*>& given)
{
  if (isGivenOnCommandLine(option, given))
  {
    return true;
  }
  for (CLI::Option* other : given.empty() ? std::set<CLI::Option*>() : option->get_excludes())
  {
    if (isGivenOnCommandLine(other, given))
    {
      return true;
    }
  }
  return false;
}

std::string applyValue(CLI::Option* option, const std::string& key, const nlohmann::json& value)
{
  std::string text;
  if (!textOf(value, text))
  {
    return fmt::format("key \"{}\": give a number, a text, true or false, or a list of numbers", key);
  }
  for (const CLI::Option* other : option->get_excludes())
  {
    if (other->count() > 0)
    {
      return fmt::format(
        "key \"{}\" cannot stand beside \"{}\"; keep one of them", key, other->get_single_name());
    }
  }
  try
  {
    option->add_result(text);
    option->run_callback();
  }
  catch (const CLI::Error& error)
  {
    return fmt::format("key \"{}\": {}", key, error.what());
  }
  return {};
}

std::string applyKeys(CLI::App& command, const nlohmann::json& keys, const std::vector<std::string>& ignored)
{
  std::vector<const CLI::Option*> given;
  for (const CLI::Option* option : command.get_options())
  {
    if (option->count() > 0)
    {
      given.push_back(option);
    }
  }
  const std::vector<std::string> names = configurableNames(command);
  for (const auto& item : keys.items())
  {
    if (std::find(ignored.begin(), ignored.end(), item.key()) != ignored.end())
    {
      continue;
    }
    if (std::find(names.begin(), names.end(), item.key()) == names.end())
    {
      return fmt::format("unknown key \"{}\"{}; valid keys: {}", item.key(), didYouMean(item.key(), names),
        fmt::join(names, ", "));
    }
    CLI::Option* option = command.get_option("--" + item.key());
    const std::string problem =
      isOverruled(option, given) ? std::string() : applyValue(option, item.key(), item.value());
    if (!problem.empty())
    {
      return problem;
    }
  }
  return {};
}

} // namespace

RecordedReading recordedReading(const std::string& settings)
{
  const nlohmann::json keys = nlohmann::json::parse(settings, nullptr, false, true);
  // Lists and flags as the command line has them.
  const auto text = [&keys](const char* key)
  {
    std::string value;
    return keys.is_object() && keys.contains(key) && textOf(keys.at(key), value) ? value : std::string();
  };
  RecordedReading reading;
  if (!parseNumbers(text("clip"), reading.clip))
  {
    reading.clip.clear();
  }
  reading.hide = text("hide");
  reading.up = keys.contains("up") ? text("up") : reading.up;
  const std::string columns = text("columns");
  reading.columns = columns.empty() ? std::vector<std::string>() : CLI::detail::split(columns, ',');
  reading.salvage = text("salvage") == "true";
  reading.vertices = text("vertices") == "true";
  return reading;
}

void applyConfigFile(CLI::App& command, const std::string& fileName, const std::vector<std::string>& ignored)
{
  Files files; // for a pipe
  files.addInput(fileName);
  std::error_code error;
  std::ifstream file(files.input(fileName));
  if (!file || std::filesystem::is_directory(fileName, error))
  {
    throw Failure(fmt::format("{}: cannot be opened; check the name given to --config", fileName));
  }
  nlohmann::json keys;
  std::string place;
  try
  {
    keys = nlohmann::json::parse(file, nullptr, true, true);
  }
  catch (const nlohmann::json::parse_error& fault)
  {
    place = fmt::format(" at byte {}", fault.byte);
  }
  if (!keys.is_object())
  {
    throwUsage(fileName, "",
      fmt::format("not a JSON object{}; write {{\"stiffness\": 600, \"up\": \"z\"}} for example", place));
  }
  if (const std::string problem = applyKeys(command, keys, ignored); !problem.empty())
  {
    throwUsage(fileName, "", problem);
  }
}

} // namespace pointhaptics::app
