#include "PcdPcl.h"

#include "FileProblem.h"

#ifdef POINTHAPTICS_HAVE_PCL
#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <mutex>
#include <new>
#endif

namespace pointhaptics::io
{

#ifdef POINTHAPTICS_HAVE_PCL

namespace
{

/// Keeps PCL from printing while it lives.
class SilentPcl
{
public:
  SilentPcl()
    : lock_(mutex())
    , level_(pcl::console::getVerbosityLevel())
  {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~SilentPcl() { pcl::console::setVerbosityLevel(level_); }
  SilentPcl(const SilentPcl&) = delete;
  SilentPcl& operator=(const SilentPcl&) = delete;

private:
  static std::mutex& mutex()
  {
    static std::mutex instance;
    return instance;
  }
  std::lock_guard<std::mutex> lock_;
  pcl::console::VERBOSITY_LEVEL level_;
};

[[noreturn]] void failInPcl(const std::string& detail)
{
  failFormat(
    "PCL cannot read the points" + detail, "the file is damaged or cut short: copy or write it again");
}

} // namespace

std::vector<std::uint8_t> readPcdRecords(const std::string& path, const PcdHeader& header)
{
  pcl::PCLPointCloud2 cloud;
  try
  {
    const SilentPcl silent;
    pcl::PCDReader reader;
    Eigen::Vector4f origin;
    Eigen::Quaternionf orientation;
    int version = 0;
    if (reader.read(path, cloud, origin, orientation, version) < 0)
    {
      failInPcl("");
    }
  }
  catch (const FileProblem&)
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception& fault)
  {
    failInPcl(std::string(" (") + fault.what() + ")");
  }
  if (cloud.data.size() != header.points * header.recordSize || cloud.point_step != header.recordSize)
  {
    failInPcl(" (it found " + std::to_string(cloud.data.size()) + " bytes)");
  }
  return std::move(cloud.data);
}

#else

std::vector<std::uint8_t> readPcdRecords(const std::string&, const PcdHeader&)
{
  throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError, "this build reads only ascii PCD: it has no PCL",
    "install libpcl-dev and build again with POINTHAPTICS_USE_PCL=ON, or convert the file to PLY");
}

#endif

} // namespace pointhaptics::io
