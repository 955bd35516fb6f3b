#include "FileWatch.h"

namespace pointhaptics
{

std::vector<FileWatch::Stamp> FileWatch::stamps() const
{
  std::vector<Stamp> stamps;
  for (const std::string& name : files_)
  {
    std::error_code error;
    std::error_code sizeError;
    const auto time = std::filesystem::last_write_time(name, error);
    const std::uintmax_t size = std::filesystem::file_size(name, sizeError);
    stamps.push_back(error || sizeError ? Stamp() : Stamp({ time, size }));
  }
  return stamps;
}

void FileWatch::watch(const std::vector<std::string>& files)
{
  files_ = files;
  known_ = last_ = this->stamps();
}

bool FileWatch::look()
{
  bool changed = false;
  const std::vector<Stamp> now = this->stamps();
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    if (now[i] && now[i] == last_[i] && now[i] != known_[i])
    {
      known_[i] = now[i];
      changed = true;
    }
  }
  last_ = now;
  return changed;
}

} // namespace pointhaptics
