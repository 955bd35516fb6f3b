#include "Options/Files.h"

#include "Options/OptionParsing.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"
#include "Terminal/StandardStreams.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace pointhaptics::app
{
namespace
{

/// Links that are followed by hand: as many as the system follows.
constexpr int kMostLinks = 40;

// The role of an option is kept in the option itself, as the name of its first check.
constexpr const char* kReads = "reads";
constexpr const char* kWrites = "writes";
constexpr const char* kReadsAndWrites = "reads and writes";
constexpr const char* kPlaceholders[] = { "{stem}", "{name}", "{folder}" };

/// True if @p name is one of the names that the system gives to an open stream of this process, such as
/// /dev/stdout, and leads to the standard stream @p stream.
bool isStandard(const std::string& name, int stream)
{
  struct stat named = {};
  struct stat own = {};
  if (::stat(name.c_str(), &named) != 0 || ::fstat(stream, &own) != 0 || named.st_dev != own.st_dev ||
    named.st_ino != own.st_ino)
  {
    return false;
  }
  std::error_code error;
  const fs::path folder = fs::canonical("/proc/self/fd", error);
  fs::path place = fs::absolute(name, error);
  for (int link = 0; link < kMostLinks && !error && fs::is_symlink(place, error); ++link)
  {
    if (fs::canonical(place.parent_path(), error) == folder)
    {
      return true;
    }
    place = place.parent_path() / fs::read_symlink(place, error);
  }
  return false;
}

/// Keeps the role in @p option, and takes all names of standard input and output for "-".
CLI::Option* mark(CLI::Option* option, const std::string& role)
{
  const auto take = [](std::string& name)
  {
    name = isStandard(name, STDIN_FILENO) || isStandard(name, STDOUT_FILENO) ? kStandardStream : name;
    return std::string();
  };
  return option->transform(CLI::Validator(take, "", role));
}

std::vector<std::string> wordsOf(const std::string& text)
{
  std::istringstream words(text);
  return { std::istream_iterator<std::string>(words), {} };
}

/// The entry of @p name among @p entries, or their end.
template <typename Entries>
auto find(Entries& entries, const std::string& name)
{
  return std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
}

std::string startOfFile(const std::string& name, std::size_t size)
{
  std::ifstream file(name, std::ios::binary);
  std::string start(size, ' ');
  file.read(start.data(), std::streamsize(size));
  return start;
}

/// Each unfinished output is an open file.
void allowManyFiles(std::size_t count)
{
  struct rlimit limit = {};
  constexpr rlim_t kOthers = 100;
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < 2 * count + kOthers)
  {
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, 2 * count + kOthers);
    static_cast<void>(::setrlimit(RLIMIT_NOFILE, &limit));
  }
}

/// Ends in a usage error where @p pattern has a word in braces that stands for nothing.
void checkPlaceholders(const std::string& option, const std::string& pattern)
{
  const std::vector<std::string> known(std::begin(kPlaceholders), std::end(kPlaceholders));
  for (std::size_t begin = 0; (begin = pattern.find('{', begin)) != std::string::npos; ++begin)
  {
    const std::size_t end = pattern.find('}', begin);
    const std::string word = end == std::string::npos ? "" : pattern.substr(begin, end + 1 - begin);
    requireUsage(word.empty() || std::find(known.begin(), known.end(), word) != known.end(), option, pattern,
      fmt::format(
        "{} stands for nothing{}; there are {}", word, didYouMean(word, known), fmt::join(known, ", ")));
  }
}

} // namespace

CLI::Option* addInput(CLI::App& command, const std::string& name, std::string& file,
  const std::string& description, const std::string& form)
{
  return mark(command.add_option(name, file, description)->type_name(form), kReads);
}

CLI::Option* addInput(
  CLI::App& command, const std::string& name, std::vector<std::string>& files, const std::string& description)
{
  return mark(command.add_option(name, files, description)->type_name(""), kReads);
}

CLI::Option* addInputsAndOutput(CLI::App& command, const std::string& name, std::vector<std::string>& files,
  const std::vector<std::string>& extensions, const std::string& description)
{
  return mark(command.add_option(name, files, description)->type_name(""),
    fmt::format("{} {}", kReadsAndWrites, fmt::join(extensions, " ")));
}

CLI::Option* addOutput(CLI::App& command, const std::string& name, std::string& file,
  const std::vector<std::string>& extensions, const std::string& description, const std::string& form)
{
  return mark(command.add_option(name, file, description)->type_name(form),
    fmt::format("{} {}", kWrites, fmt::join(extensions, " ")));
}

void allowExtension(CLI::Option& output, const std::string& extension)
{
  CLI::Validator& role = *output.get_validator(0);
  role.name(role.get_name() + " " + extension);
}

std::string lowerExtension(const std::string& name)
{
  std::string extension = fs::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension.empty() ? extension : extension.substr(1);
}

std::string fileRole(const CLI::Option& option)
{
  try
  {
    // CLI11 gives checks to be changed alone.
    const std::string role = const_cast<CLI::Option&>(option).get_validator(0)->get_name();
    return role.rfind(kReads, 0) == 0 || role.rfind(kWrites, 0) == 0 ? role : std::string();
  }
  catch (const CLI::OptionNotFound&)
  {
    return {};
  }
}

bool writesFiles(const CLI::App& command)
{
  const std::vector<const CLI::Option*> options = command.get_options();
  return std::any_of(options.begin(), options.end(),
    [](const CLI::Option* option) { return fileRole(*option).find(kWrites) != std::string::npos; });
}

std::string writeFault(const std::string& name, const OutputFile& file)
{
  return fmt::format("{}: cannot be written: {}; {}", name, file.reason(), file.cure());
}

bool isGiven(const CLI::App& command, const char* name)
{
  const CLI::Option* option = command.get_option_no_throw(name);
  return option && option->count() > 0;
}

bool isPattern(const std::string& name)
{
  return std::any_of(std::begin(kPlaceholders), std::end(kPlaceholders),
    [&](const char* word) { return name.find(word) != std::string::npos; });
}

std::string expandedName(const std::string& pattern, const std::string& input)
{
  const fs::path path = input == kStandardStream ? fs::path("stdin") : fs::path(input);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  const std::string values[] = { path.stem().string(), path.filename().string(), folder };
  std::string result = pattern;
  for (std::size_t at = 0; (at = result.find('{', at)) != std::string::npos; ++at)
  {
    for (std::size_t i = 0; i < std::size(values); ++i)
    {
      const std::string_view word = kPlaceholders[i];
      if (result.compare(at, word.size(), word) == 0)
      {
        result.replace(at, word.size(), values[i]);
        at += values[i].size() - 1;
        break;
      }
    }
  }
  return result;
}

/// An output as the command line names it: maybe a pattern.
struct Files::NamedOutput : Named
{
  std::string extensions;
};

/// Ends in a usage error where nothing tells the format of the output, or nobody writes it.
void Files::checkExtension(const CLI::App& command, const NamedOutput& output)
{
  const std::vector<std::string> known = wordsOf(output.extensions);
  const bool isCloud =
    command.get_option_no_throw("--output-format") && (output.option.empty() || output.option == "--output");
  const Identity target(output.name, STDOUT_FILENO);
  const bool isStream = output.name == kStandardStream || target.isStream();
  const std::string extension = lowerExtension(output.name);
  const bool isKnown = std::find(known.begin(), known.end(), extension) != known.end();
  std::error_code ignored;
  const bool isRight = known.empty() || isKnown || (isCloud && isGiven(command, "--output-format")) ||
    (isStream && !isCloud) || fs::is_directory(output.name, ignored);
  requireUsage(isRight, output.shown(), "",
    isStream
      ? fmt::format("a stream has no extension; give --output-format, one of {}", fmt::join(known, ", "))
      : fmt::format("unknown extension \"{}\"{}; end the name in .{}",
          extension.empty() ? "" : "." + extension, didYouMean(extension, known), fmt::join(known, ", .")));
}

Files::Identity::Identity(const std::string& name, int standardStream)
{
  struct stat status = {};
  const bool isStandard = name == kStandardStream;
  exists = isStandard ? ::fstat(standardStream, &status) == 0 : ::stat(name.c_str(), &status) == 0;
  isDevice = exists && S_ISCHR(status.st_mode);
  isPipe = exists && (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
  device = status.st_dev;
  number = status.st_ino;
  if (exists || isStandard)
  {
    place = exists ? std::string() : name;
    return;
  }
  std::error_code error;
  fs::path target = name;
  // A link to nothing is written through: two of them may name one file.
  for (int link = 0; link < kMostLinks && fs::is_symlink(target, error); ++link)
  {
    target = target.parent_path() / fs::read_symlink(target, error);
  }
  const bool hasFolder = ::stat((target.parent_path() / ".").c_str(), &status) == 0;
  device = hasFolder ? status.st_dev : 0;
  number = hasFolder ? status.st_ino : 0;
  place = hasFolder ? target.filename().string() : fs::weakly_canonical(target, error).string();
}

bool Files::Identity::operator==(const Identity& other) const
{
  return !isDevice && exists == other.exists && device == other.device && number == other.number &&
    place == other.place;
}

Files::Files() = default;
Files::~Files() = default;

void Files::takeOutput(
  const CLI::App& command, const NamedOutput& output, const std::vector<std::string>& clouds)
{
  checkExtension(command, output);
  if (output.name == kStandardStream)
  {
    requireUsage(!isGiven(command, "--json"), "--json", "",
      "standard output is the file; leave it out, or name a file to write");
    takeStandardOutput();
  }
  // Commands that can merge their inputs make one output of each else.
  const bool isOfEach = command.get_option_no_throw("--merge") != nullptr;
  if (isOfEach)
  {
    checkPlaceholders(output.option, output.name);
    requireUsage(!isMerged_ || !isPattern(output.name), "--merge", "",
      "makes one cloud, and " + output.name + " stands for several; leave out one of them");
    requireUsage(isMerged_ || isPattern(output.name) || clouds.size() < 2, output.shown(), "",
      fmt::format("{} inputs and one output; put {{stem}} into its name for one of each, or give --merge to "
                  "make one cloud of them",
        clouds.size()));
  }
  if (!isOfEach || !isPattern(output.name))
  {
    this->addOutput(output.name, output.option);
    return;
  }
  allowManyFiles(clouds.size());
  for (const std::string& cloud : clouds)
  {
    this->addOutput(expandedName(output.name, cloud), output.option);
  }
}

void Files::take(const CLI::App& command)
{
  inputs_.clear();
  outputs_.clear();
  isMerged_ = isGiven(command, "--merge");
  noClobber_ = isGiven(command, "--no-clobber");
  isForced_ = isGiven(command, "--force");
  std::vector<NamedOutput> outputs;
  std::vector<std::string> clouds;
  for (const CLI::Option* option : command.get_options())
  {
    const std::string role = fileRole(*option);
    std::vector<std::string> names = role.empty() ? std::vector<std::string>() : option->results();
    const std::string shown = option->get_positional() ? std::string() : "--" + option->get_single_name();
    const bool isBoth = role.rfind(kReadsAndWrites, 0) == 0;
    if (isBoth && names.size() > 1 && !isGiven(command, "--output"))
    {
      outputs.push_back({ { "", names.back() }, role.substr(std::string(kReadsAndWrites).size()) });
      names.pop_back();
      std::error_code ignored;
      // A list of inputs whose output was forgotten must not cost the last of them.
      requireUsage(isForced_ || !fs::is_regular_file(outputs.back().name, ignored), outputs.back().name, "",
        "is there already, and may be one of the inputs; name the output by -o, or give --force");
    }
    for (const std::string& name : role == kReads || isBoth ? names : std::vector<std::string>())
    {
      this->addInput(name, shown);
      clouds.insert(clouds.end(), option->get_positional() ? 1 : 0, name);
    }
    if (role.rfind(kWrites, 0) == 0 && !names.empty())
    {
      outputs.push_back({ { shown, names.back() }, role.substr(std::string(kWrites).size()) });
    }
  }
  for (const NamedOutput& output : outputs)
  {
    this->takeOutput(command, output, clouds);
  }
}

/// @p output is one of outputs_; those after it are checked against it.
void Files::check(const Entry& output) const
{
  const Identity& own = output.identity;
  const auto input = std::find_if(inputs_.begin(), inputs_.end(),
    [&](const Entry& entry)
    {
      const bool areStreams =
        entry.name == kStandardStream && output.name == kStandardStream && (own.isStream() || !own.exists);
      return own == entry.identity && !areStreams;
    });
  requireUsage(input == inputs_.end(), output.shown(), "",
    fmt::format("this is the input {}, which would be lost; choose another name for the output",
      input == inputs_.end() ? "" : input->shown()));
  const auto other = std::find_if(outputs_.begin(), outputs_.end(),
    [&](const Entry& entry)
    { return &entry == &output || entry.name == output.name || own == entry.identity; });
  requireUsage(&*other == &output, output.shown(), "",
    fmt::format(
      "this is the same file as the output {}; give each output a name of its own", other->shown()));
  if (output.name == kStandardStream)
  {
    return;
  }
  const bool isThere = own.exists && !own.isStream();
  constexpr std::size_t kHeader = 1024; // of a recording: its first lines
  const bool isRecording = isThere && !isForced_ &&
    startOfFile(output.name, kHeader).find("# pointhaptics recording: ") != std::string::npos;
  requireUsage(!isRecording, output.shown(), "",
    "is a recording, and a touch cannot be made again; choose another name, or give --force");
  requireUsage(!noClobber_ || !isThere, output.shown(), "",
    "is there already, and --no-clobber forbids to replace it; choose another name");
  OutputFile file;
  const bool canBeWritten = file.check(output.name) == Status::Ok;
  require(canBeWritten, writeFault(output.name, file));
}

void Files::addInput(const std::string& name, const std::string& option)
{
  Identity identity(name, STDIN_FILENO);
  const auto twin = std::find_if(inputs_.begin(), inputs_.end(),
    [&](const Entry& entry) { return entry.name == name || entry.identity == identity; });
  const bool isDrained =
    name == kStandardStream ? find(inputs_, name) != inputs_.end() : twin != inputs_.end() && identity.isPipe;
  requireUsage(!isDrained, name, "", "standard input and pipes can be read once; leave out the second one");
  warn(isMerged_ && twin != inputs_.end()
      ? "is the same file as " + twin->name + ", so its points count twice; leave one out"
      : "",
    name);
  inputs_.push_back({ { option, name }, std::move(identity) });
  for (const Entry& output : outputs_)
  {
    this->check(output);
  }
}

void Files::addOutput(const std::string& name, const std::string& option)
{
  outputs_.push_back({ { option, name }, Identity(name, STDOUT_FILENO) });
  this->check(outputs_.back());
}

void Files::dropOutput(const std::string& name)
{
  outputs_.remove_if([&](const Entry& output) { return output.name == name; });
}

void Files::protect(const std::string& name)
{
  const auto output = find(outputs_, name);
  if (output == outputs_.end() || name == kStandardStream || output->identity.isStream())
  {
    return;
  }
  const std::string part = OutputFile::keptPartOf(name);
  for (const std::string& file : { name, part })
  {
    std::error_code ignored;
    requireUsage(isForced_ || !fs::exists(file, ignored), output->shown(), "",
      fmt::format("{} is there, and a touch cannot be made again; choose another name, or give --force",
        file == part ? part : "it"));
  }
}

void Files::keep(const std::string& name)
{
  this->protect(name);
  const auto output = find(outputs_, name);
  if (output != outputs_.end())
  {
    output->isKept = true;
    if (isForced_)
    {
      OutputFile::forgetKept(name);
    }
  }
}

bool Files::isStream(const std::string& name) const
{
  const auto found = find(inputs_, name);
  return name == kStandardStream || (found != inputs_.end() && found->identity.isPipe);
}

std::string Files::input(const std::string& name)
{
  if (!this->isStream(name))
  {
    return name;
  }
  std::string& path = copies_[name];
  if (path.empty())
  {
    folder_ = folder_ ? std::move(folder_) : std::make_unique<TemporaryFolder>();
    // The name is the title of a window, too.
    path = folder_->path(fs::path(shownFile(name)).filename().string());
    copyInput(name == kStandardStream ? std::string() : name, path);
    showAs(path, shownFile(name));
  }
  return path;
}

std::string Files::output(const std::string& name)
{
  if (name == kStandardStream)
  {
    showAs("/dev/stdout", "standard output");
    return "/dev/stdout";
  }
  const auto found = find(outputs_, name);
  if (found == outputs_.end())
  {
    return name;
  }
  if (found->path.empty())
  {
    found->path = name;
    found->file = std::make_unique<OutputFile>();
    if (found->identity.isStream())
    {
      found->file.reset();
    }
    else if (found->file->open(name, found->isKept) == Status::Ok)
    {
      found->path = found->file->path();
      showAs(found->path, name);
    }
    // Else the writer of the file meets the same fault, and says it.
  }
  return found->path;
}

void Files::commit()
{
  std::string message;
  for (Entry& output : outputs_)
  {
    std::error_code ignored;
    const bool isNew = !fs::exists(output.name, ignored);
    if (output.file && noClobber_ && !isNew)
    {
      message =
        output.name + ": has come meanwhile, and --no-clobber forbids to replace it; choose another name";
    }
    else if (output.file && output.file->commit() != Status::Ok)
    {
      message = writeFault(output.name, *output.file);
    }
    if (!message.empty())
    {
      this->revert();
      throw Failure(message);
    }
    if (output.file && isNew)
    {
      created_.push_back(output.file->path()); // the file, not a link to it
    }
  }
}

void Files::revert()
{
  for (const std::string& name : created_)
  {
    ::unlink(name.c_str());
  }
}

void Files::printPlan(bool asJson) const
{
  nlohmann::ordered_json plan = { { "reads", nlohmann::ordered_json::array() },
    { "writes", nlohmann::ordered_json::array() } };
  std::string text;
  for (const Entry& input : inputs_)
  {
    require(input.identity.exists, input.name + ": there is no such file; check the path");
    plan["reads"].push_back(input.name);
    text += fmt::format("would read {}\n", shownFile(input.name));
  }
  for (const Entry& output : outputs_)
  {
    const bool replaces =
      output.identity.exists && !output.identity.isStream() && output.name != kStandardStream;
    plan["writes"].push_back({ { "file", output.name }, { "replaces", replaces } });
    text +=
      fmt::format("would {} {}\n", replaces ? "replace" : "write", shownFile(output.name, "standard output"));
  }
  asJson ? printJson(plan) : printNow(stdout, text);
}

} // namespace pointhaptics::app
