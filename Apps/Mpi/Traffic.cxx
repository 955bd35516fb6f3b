#include "Traffic.h"

#include "Job.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics::app
{

void Traffic::addTo(CLI::App& command)
{
  command.add_flag("--traffic", this->isWanted,
    "Say on stderr how many bytes the ranks read of IN, and sent each other for the computation");
}

void Traffic::show(Job& job, std::int64_t sent) const
{
  if (!this->isWanted)
  {
    return;
  }
  const std::int64_t sentByAll =
    job.ranks().reduce(sent, [](std::int64_t a, std::int64_t b) { return a + b; });
  const std::int64_t mostRead =
    job.ranks().reduce(this->read, [](std::int64_t a, std::int64_t b) { return std::max(a, b); });
  if (job.isRoot())
  {
    fmt::print(stderr, "{} bytes read by a rank at most\n{} bytes sent between {} ranks\n", mostRead,
      sentByAll, job.ranks().size());
  }
}

} // namespace pointhaptics::app
