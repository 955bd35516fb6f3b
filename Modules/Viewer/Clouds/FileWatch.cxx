#include "FileWatch.h"

namespace pointhaptics
{

FileWatch::Stamp FileWatch::stampOf(const std::string& name)
{
  std::error_code error;
  Stamp stamp;
  stamp.time = std::filesystem::last_write_time(name, error);
  stamp.exists = !error;
  stamp.size = stamp.exists ? std::filesystem::file_size(name, error) : 0;
  stamp.exists = stamp.exists && !error;
  return stamp;
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
    if (stamp.exists && stamp == file.last && !(stamp == file.known))
    {
      file.known = stamp;
      changed = true;
    }
    file.last = stamp;
  }
  return changed;
}

} // namespace pointhaptics
