#include "FileWatch.h"

namespace pointhaptics
{

FileWatch::Stamp FileWatch::stampOf(const std::string& name)
{
  std::error_code error;
  std::error_code sizeError;
  const auto time = std::filesystem::last_write_time(name, error);
  const std::uintmax_t size = std::filesystem::file_size(name, sizeError);
  return error || sizeError ? Stamp() : Stamp({ time, size });
}

void FileWatch::watch(const std::vector<std::string>& files)
{
  files_.clear();
  for (const std::string& name : files)
  {
    const Stamp stamp = stampOf(name);
    files_.push_back({ name, stamp, stamp });
  }
}

bool FileWatch::look()
{
  bool changed = false;
  for (Watched& file : files_)
  {
    const Stamp stamp = stampOf(file.name);
    if (stamp && stamp == file.last && stamp != file.known)
    {
      file.known = stamp;
      changed = true;
    }
    file.last = stamp;
  }
  return changed;
}

} // namespace pointhaptics
