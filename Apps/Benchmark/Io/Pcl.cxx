// Includes PCL: must see no -march flag, or Eigen's alignment differs from that of Debian's PCL.
#include "Benchmark/Io/Rival.h"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vtkPolyData.h>

#include <stdexcept>

namespace pointhaptics::bench::io
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
    return kind == FileKind::BinaryPly ? "pcl::io::loadPLYFile"
      : kind == FileKind::BinaryPcd    ? "pcl::io::loadPCDFile"
                                       : "";
  }
  std::string writerOf(FileKind kind) const override
  {
    return kind == FileKind::BinaryPly ? "pcl::io::savePLYFileBinary"
      : kind == FileKind::BinaryPcd    ? "pcl::io::savePCDFileBinary"
                                       : "";
  }
  void read(FileKind kind, const std::string& path) override
  {
    check(
      kind == FileKind::BinaryPly ? pcl::io::loadPLYFile(path, cloud_) : pcl::io::loadPCDFile(path, cloud_),
      path);
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
    check(kind == FileKind::BinaryPly ? pcl::io::savePLYFileBinary(path, cloud_)
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
} // namespace pointhaptics::bench::io

/// See kMakeRival.
extern "C" pointhaptics::bench::io::Rival* pointhapticsMakeRival()
{
  return new pointhaptics::bench::io::Pcl;
}
