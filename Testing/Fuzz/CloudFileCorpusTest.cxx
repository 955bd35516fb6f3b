#include "CloudFileFuzz.h"

#include "FuzzRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace
{

std::vector<std::string> corpus()
{
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(POINTHAPTICS_FUZZ_CORPUS))
  {
    if (entry.is_regular_file())
    {
      paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const std::filesystem::path& path : paths)
  {
    std::ifstream stream(path, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return files;
}

void feed(const std::string& bytes)
{
  LLVMFuzzerTestOneInput(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

TEST(CloudFiles, CorpusKeepsThePromises)
{
  const std::vector<std::string> files = corpus();
  ASSERT_GT(files.size(), 20u);
  for (const std::string& bytes : files)
  {
    feed(bytes);
  }
}

/// Bytes changed, cut, doubled and exchanged between files.
TEST(CloudFiles, MutationsOfTheCorpusKeepThePromises)
{
  const std::vector<std::string> files = corpus();
  const trial::FuzzRuns runs(1500);
  for (std::uint64_t run = 0; run < runs.count; ++run)
  {
    std::mt19937_64 random(runs.first + run);
    const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random() % (limit + 1)); };
    std::string bytes = files[below(files.size() - 1)];
    for (std::size_t step = below(3); step < 4 && !bytes.empty(); ++step)
    {
      const std::size_t at = below(bytes.size() - 1);
      const std::size_t length = below(16);
      const std::string& other = files[below(files.size() - 1)];
      switch (below(4))
      {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes.resize(at);
          break;
        case 2:
          bytes.insert(at, bytes.substr(below(bytes.size() - 1), length));
          break;
        case 3:
          bytes.replace(at, length, other.substr(std::min(at, other.size()), length));
          break;
        default:
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(7)));
      }
    }
    SCOPED_TRACE("seed " + std::to_string(runs.first + run));
    feed(bytes);
  }
}

} // namespace
