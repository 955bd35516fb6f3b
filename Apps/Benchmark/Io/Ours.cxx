#include "Benchmark/Io/Rival.h"

#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <stdexcept>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pointhaptics
{
namespace bench
{
namespace io
{
namespace
{

class Ours : public Rival
{
public:
  std::string readerOf(FileKind) const override { return "ours"; }
  std::string writerOf(FileKind kind) const override
  {
    switch (kind)
    {
      case FileKind::BinaryPly:
      case FileKind::BinaryPcd:
      case FileKind::Csv:
      case FileKind::Las:
      case FileKind::Laz:
      case FileKind::Vtp:
        return "ours";
      default:
        return "";
    }
  }
  void read(FileKind, const std::string& path) override
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    if (*reader->GetErrorMessage())
    {
      throw std::runtime_error(reader->GetErrorMessage());
    }
    cloud_ = reader->GetOutput();
  }
  void discard() override { cloud_ = nullptr; }
  std::vector<double> points() const override
  {
    std::vector<double> xyz(3 * std::size_t(cloud_->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < cloud_->GetNumberOfPoints(); ++i)
    {
      cloud_->GetPoint(i, &xyz[3 * std::size_t(i)]);
    }
    return xyz;
  }
  std::int64_t resultBytes() const override { return 1024 * std::int64_t(cloud_->GetActualMemorySize()); }

  void load(vtkPolyData* cloud) override { cloud_ = cloud; }
  void write(FileKind, const std::string& path) override
  {
    vtkNew<vtkPointCloudWriter> writer;
    writer->SetInputData(cloud_);
    writer->SetFileName(path.c_str());
    if (writer->Write() != 1)
    {
      throw std::runtime_error(writer->GetErrorMessage());
    }
  }

private:
  vtkSmartPointer<vtkPolyData> cloud_;
};

class Bytes : public Rival
{
public:
  explicit Bytes(bool intoFreshMemory)
    : fresh_(intoFreshMemory)
  {
  }
  ~Bytes() override { this->release(); }
  std::string readerOf(FileKind) const override
  {
    return fresh_ ? "bytes into new memory" : "bytes into old memory";
  }
  std::string writerOf(FileKind) const override { return {}; }
  void read(FileKind, const std::string& path) override
  {
    const int file = ::open(path.c_str(), O_RDONLY);
    struct stat status = {};
    if (file < 0 || ::fstat(file, &status) != 0)
    {
      throw std::runtime_error(path + ": cannot be read");
    }
    size_ = std::size_t(status.st_size);
    if (!memory_)
    {
      memory_ = ::mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    }
    std::size_t done = 0;
    for (ssize_t got = 1; got > 0 && done < size_ && memory_ != MAP_FAILED; done += std::size_t(got))
    {
      got = ::read(file, static_cast<char*>(memory_) + done, size_ - done);
    }
    ::close(file);
    if (done != size_)
    {
      throw std::runtime_error(path + ": cannot be read");
    }
  }
  void discard() override
  {
    if (fresh_)
    {
      this->release();
    }
  }
  std::vector<double> points() const override { return {}; }
  std::int64_t resultBytes() const override { return std::int64_t(size_); }
  void load(vtkPolyData*) override {}
  void write(FileKind, const std::string&) override {}

private:
  void release()
  {
    if (memory_ && memory_ != MAP_FAILED)
    {
      ::munmap(memory_, size_);
    }
    memory_ = nullptr;
  }

  const bool fresh_;
  void* memory_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace

std::unique_ptr<Rival> makeOurs()
{
  return std::make_unique<Ours>();
}

std::unique_ptr<Rival> makeBytes(bool intoFreshMemory)
{
  return std::make_unique<Bytes>(intoFreshMemory);
}

} // namespace io
} // namespace bench
} // namespace pointhaptics
