/// @file
/// The files of a command: each option that names one says whether it is read or written, and one object
/// checks them all before any is opened.
#pragma once

#include "Core/Base/OutputFile.h"

#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace CLI
{
class App;
class Option;
}

namespace pointhaptics::app
{

class TemporaryFolder;

/// Standard input or output in place of a file.
constexpr const char* kStandardStream = "-";
/// The name of a file in messages.
inline std::string shownFile(const std::string& name, const char* stream = "standard input")
{
  return name == kStandardStream ? stream : name;
}

/// Adds an option or argument that names files to read. @p form: of the value, for the help.
CLI::Option* addInput(CLI::App& command, const std::string& name, std::string& file,
  const std::string& description, const std::string& form = {});
CLI::Option* addInput(CLI::App& command, const std::string& name, std::vector<std::string>& files,
  const std::string& description);
/// As addInput(); the last of several files is written unless -o is given.
CLI::Option* addInputsAndOutput(CLI::App& command, const std::string& name, std::vector<std::string>& files,
  const std::vector<std::string>& extensions, const std::string& description);
/// Adds an option that names a file to write. @p extensions: those that the name may have, without dots;
/// empty: any. The name may have others where --output-format is given.
CLI::Option* addOutput(CLI::App& command, const std::string& name, std::string& file,
  const std::vector<std::string>& extensions, const std::string& description,
  const std::string& form = "OUT");
/// Adds one more extension to those that an output option takes.
void allowExtension(CLI::Option& output, const std::string& extension);

/// The extension of a file name, in lower case, without its dot.
std::string lowerExtension(const std::string& name);
/// "reads", "writes EXTENSION..." or "reads and writes EXTENSION..."; empty for an option that names no file.
std::string fileRole(const CLI::Option& option);
/// True if an option of @p command names an output.
bool writesFiles(const CLI::App& command);

/// That @p file, which has failed, cannot be written under @p name.
std::string writeFault(const std::string& name, const OutputFile& file);

/// True if @p command has the option @p name, and it was given.
bool isGiven(const CLI::App& command, const char* name);

/// The output for @p input by a pattern: "{stem}" is the name of the input without folder and extension,
/// "{name}" without its folder, "{folder}" its folder.
std::string expandedName(const std::string& pattern, const std::string& input);
bool isPattern(const std::string& name);

/// Inputs and outputs of one run. Outputs are written to parts (OutputFile.h), and commit() gives all of them
/// their names at once; without it none appears.
class Files
{
public:
  Files();
  ~Files();
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  /// Takes the files that the options of @p command name; what was taken before is forgotten, but for streams
  /// that were copied. Ends in a usage
  /// error where an output is an input or another output, whatever it is called, has an extension that cannot
  /// be written, or exists although --no-clobber forbids it. @throws Failure where one cannot be written.
  void take(const CLI::App& command);
  /// One more input, which no option names; checked like the others.
  void addInput(const std::string& name, const std::string& option = {});
  void addOutput(const std::string& name, const std::string& option = {});
  /// Forgets an output that others are made of.
  void dropOutput(const std::string& name);

  /// Ends in a usage error where the output @p name, or the part of one that was ended, is there and --force
  /// does not allow to replace it: a recording.
  void protect(const std::string& name);
  /// As protect(); what is written of it stays, in NAME.part, whatever happens: the touch of a person.
  void keep(const std::string& name);

  /// True if the input @p name can be read once alone.
  bool isStream(const std::string& name) const;
  /// Where the content of an input can be read as often as wanted: pipes and standard input are copied to a
  /// temporary file. @throws Failure
  std::string input(const std::string& name);
  /// Where to write the content of an output.
  std::string output(const std::string& name);
  /// Gives all outputs their names. @throws Failure; none has appeared then.
  void commit();
  /// Removes the files that commit() has created, where another process could not give its outputs theirs.
  void revert();
  /// Prints what would be read and written (--dry-run). @throws Failure where an input is not there.
  void printPlan(bool asJson) const;

private:
  /// Which file a name means: its number. Files that do not exist have the number of their folder, and a name
  /// there.
  struct Identity
  {
    bool exists = false;
    bool isDevice = false; ///< True for devices such as /dev/null, which keep nothing of what is written.
    bool isPipe = false;
    dev_t device = 0;
    ino_t number = 0;
    std::string place; ///< Empty where it exists.

    Identity(const std::string& name, int standardStream);
    bool isStream() const { return isDevice || isPipe; }
    bool operator==(const Identity& other) const;
  };
  struct Named
  {
    std::string option;
    std::string name;

    std::string shown() const { return option + (option.empty() ? "" : " ") + name; }
  };
  struct Entry : Named
  {
    Identity identity;
    std::string path = {}; ///< Where it is written; empty until it is asked for.
    std::unique_ptr<OutputFile> file = {};
    bool isKept = false;
  };
  struct NamedOutput;
  static void checkExtension(const CLI::App& command, const NamedOutput& output);
  void takeOutput(const CLI::App& command, const NamedOutput& output, const std::vector<std::string>& clouds);
  void check(const Entry& output) const;

  std::list<Entry> inputs_;
  std::list<Entry> outputs_;
  std::map<std::string, std::string> copies_; ///< Of streams, by their names.
  std::vector<std::string> created_;
  std::unique_ptr<TemporaryFolder> folder_;
  bool isMerged_ = false;
  bool noClobber_ = false;
  bool isForced_ = false;
};

} // namespace pointhaptics::app
