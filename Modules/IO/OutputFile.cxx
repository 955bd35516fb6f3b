#include "OutputFile.h"

#include "FileProblem.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>

namespace fs = std::filesystem;

namespace pointhaptics::io
{

namespace
{

[[noreturn]] void failSystem(const std::string& what, int error)
{
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  throw FileProblem(full ? vtkErrorCode::OutOfDiskSpaceError : vtkErrorCode::CannotOpenFileError,
    what + ": " + std::strerror(error),
    full ? "free some space on the disk or write elsewhere"
         : "check that the folder exists and that you may write in it");
}

} // namespace

TemporaryFile::TemporaryFile(const std::string& target)
  : target_(target)
{
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    throw FileProblem(vtkErrorCode::CannotOpenFileError,
      fs::is_directory(status) ? "this is a folder" : "this exists and is not a regular file",
      "choose the name of a new file");
  }
  // A link stays a link: the file it points to is replaced.
  const fs::path resolved = fs::is_symlink(target, error) ? fs::canonical(target, error) : fs::path(target);
  target_ = error ? target : resolved.string();
  std::random_device random;
  const fs::path final(target_);
  path_ = (final.parent_path() / ("." + final.filename().string() + "." + std::to_string(random()) + ".part"))
            .string();
}

TemporaryFile::~TemporaryFile()
{
  if (!committed_)
  {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
}

void TemporaryFile::commit()
{
  std::error_code error;
  fs::rename(path_, target_, error);
  if (error)
  {
    failSystem("cannot rename the finished file", error.value());
  }
  committed_ = true;
}

OutputStream::OutputStream(const std::string& path)
  : file_(std::fopen(path.c_str(), "wbx"))
{
  if (!file_)
  {
    failSystem("cannot create the file", errno);
  }
}

OutputStream::~OutputStream()
{
  if (file_)
  {
    std::fclose(file_);
  }
}

void OutputStream::write(const char* data, std::size_t size)
{
  if (std::fwrite(data, 1, size, file_) != size)
  {
    failSystem("writing stopped", errno);
  }
}

void OutputStream::close()
{
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0)
  {
    failSystem("writing stopped", errno);
  }
}

} // namespace pointhaptics::io
