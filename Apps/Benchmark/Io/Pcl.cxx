// Includes PCL: must see no -march flag, or Eigen's alignment differs from that of Debian's PCL.
#include "Benchmark/Io/Rival.h"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vtkPolyData.h>

#include <stdexcept>

namespace pointhaptics
{
namespace bench
{
namespace io
{
namespace
{

/// PCL's readers for a point type drop the other fields: x y z and intensity here, without the colours.
class Pcl : public Rival
{
public:
  Pcl() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  std::string readerOf(FileKind kind) const override
  {
    switch (kind)
    {
      case FileKind::BinaryPly:
      case FileKind::AsciiPly:
        return "pcl::io::loadPLYFile";
      case FileKind::BinaryPcd:
      case FileKind::CompressedPcd:
      case FileKind::AsciiPcd:
        return "pcl::io::loadPCDFile";
      default:
        return {};
    }
  }
  std::string writerOf(FileKind kind) const override
  {
    switch (kind)
    {
      case FileKind::BinaryPly:
        return "pcl::io::savePLYFileBinary";
      case FileKind::BinaryPcd:
        return "pcl::io::savePCDFileBinary";
      case FileKind::CompressedPcd:
        return "pcl::io::savePCDFileBinaryCompressed";
      default:
        return {};
    }
  }
  void read(FileKind kind, const std::string& path) override
  {
    const bool isPly = kind == FileKind::BinaryPly || kind == FileKind::AsciiPly;
    check(isPly ? pcl::io::loadPLYFile(path, cloud_) : pcl::io::loadPCDFile(path, cloud_), path);
  }
  void discard() override { cloud_ = {}; }
  std::vector<double> points() const override
  {
    std::vector<double> xyz;
    xyz.reserve(3 * cloud_.size());
    for (const pcl::PointXYZI& p : cloud_)
    {
      xyz.insert(xyz.end(), { double(p.x), double(p.y), double(p.z) });
    }
    return xyz;
  }
  std::int64_t resultBytes() const override { return std::int64_t(cloud_.size() * sizeof(pcl::PointXYZI)); }

  void load(vtkPolyData* cloud) override
  {
    cloud_ = {};
    for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
    {
      double p[3];
      cloud->GetPoint(i, p);
      pcl::PointXYZI point;
      point.x = float(p[0]);
      point.y = float(p[1]);
      point.z = float(p[2]);
      point.intensity = float(i);
      cloud_.push_back(point);
    }
  }
  void write(FileKind kind, const std::string& path) override
  {
    check(kind == FileKind::BinaryPly     ? pcl::io::savePLYFileBinary(path, cloud_)
        : kind == FileKind::CompressedPcd ? pcl::io::savePCDFileBinaryCompressed(path, cloud_)
                                          : pcl::io::savePCDFileBinary(path, cloud_),
      path);
  }

private:
  static void check(int result, const std::string& path)
  {
    if (result < 0)
    {
      throw std::runtime_error(path + ": PCL cannot read or write it");
    }
  }
  pcl::PointCloud<pcl::PointXYZI> cloud_;
};

} // namespace
} // namespace io
} // namespace bench
} // namespace pointhaptics

/// See kMakeRival.
extern "C" pointhaptics::bench::io::Rival* pointhapticsMakeRival()
{
  return new pointhaptics::bench::io::Pcl;
}
