#include "FileBytes.h"

#include "FileProblem.h"

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace fs = std::filesystem;

namespace pointhaptics::io
{

namespace
{

void checkIsReadable(const std::string& path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
  {
    throw FileProblem(vtkErrorCode::FileNotFoundError, "there is no such file", "check the path");
  }
  if (status.type() == fs::file_type::none)
  {
    throw FileProblem(
      vtkErrorCode::CannotOpenFileError, error.message(), "check the path and its permissions");
  }
  if (fs::is_directory(status))
  {
    throw FileProblem(vtkErrorCode::CannotOpenFileError, "this is a folder", "name one file inside it");
  }
  if (!fs::is_regular_file(status))
  {
    throw FileProblem(
      vtkErrorCode::CannotOpenFileError, "this is not a regular file", "save the stream to a file first");
  }
}

} // namespace

FileBytes::FileBytes(const std::string& path)
{
  checkIsReadable(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file)
  {
    throw FileProblem(
      vtkErrorCode::CannotOpenFileError, std::strerror(errno), "check that you may read the file");
  }
  size_ = static_cast<std::size_t>(fs::file_size(path));
  if (size_ == 0)
  {
    throw FileProblem(vtkErrorCode::PrematureEndOfFileError, "the file is empty (0 bytes)",
      "export the cloud again or copy the file again");
  }
  data_.reset(new char[size_]);
  const std::size_t got = std::fread(data_.get(), 1, size_, file.get());
  if (got != size_)
  {
    throw FileProblem(vtkErrorCode::CannotOpenFileError,
      "reading stopped at byte " + std::to_string(got) + " of " + std::to_string(size_),
      "check the disk, or wait until the file is completely written");
  }
}

std::string lowerExtension(const std::string& path)
{
  std::string extension = fs::path(path).extension().string();
  for (char& c : extension)
  {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension.empty() ? extension : extension.substr(1);
}

} // namespace pointhaptics::io
