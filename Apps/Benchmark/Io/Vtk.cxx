#include "Benchmark/Io/Rival.h"

#include <vtkDataArray.h>
#include <vtkDelimitedTextReader.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <stdexcept>

namespace pointhaptics
{
namespace bench
{
namespace io
{
namespace
{

class Vtk : public Rival
{
public:
  std::string readerOf(FileKind kind) const override
  {
    switch (kind)
    {
      case FileKind::BinaryPly:
      case FileKind::AsciiPly:
        return "vtkPLYReader";
      case FileKind::Csv:
      case FileKind::Xyz:
        return "vtkDelimitedTextReader";
      case FileKind::Vtp:
        return "vtkXMLPolyDataReader";
      default:
        return {};
    }
  }
  std::string writerOf(FileKind kind) const override
  {
    return kind == FileKind::BinaryPly ? "vtkPLYWriter" : kind == FileKind::Vtp ? "vtkXMLPolyDataWriter" : "";
  }
  void read(FileKind kind, const std::string& path) override
  {
    if (kind == FileKind::Csv || kind == FileKind::Xyz)
    {
      vtkNew<vtkDelimitedTextReader> reader;
      reader->SetFileName(path.c_str());
      reader->SetFieldDelimiterCharacters(kind == FileKind::Csv ? "," : " ");
      reader->SetHaveHeaders(kind == FileKind::Csv);
      reader->SetDetectNumericColumns(true);
      reader->Update();
      table_ = reader->GetOutput();
    }
    else if (kind == FileKind::Vtp)
    {
      vtkNew<vtkXMLPolyDataReader> reader;
      reader->SetFileName(path.c_str());
      reader->Update();
      cloud_ = reader->GetOutput();
    }
    else
    {
      vtkNew<vtkPLYReader> reader;
      reader->SetFileName(path.c_str());
      reader->Update();
      cloud_ = reader->GetOutput();
    }
  }
  void discard() override
  {
    cloud_ = nullptr;
    table_ = nullptr;
  }
  std::vector<double> points() const override
  {
    std::vector<double> xyz(
      3 * std::size_t(table_ ? table_->GetNumberOfRows() : cloud_->GetNumberOfPoints()));
    for (std::size_t i = 0; i < xyz.size(); ++i)
    {
      const vtkIdType row = vtkIdType(i / 3);
      const int axis = int(i % 3);
      vtkDataArray* column = table_ ? vtkDataArray::SafeDownCast(table_->GetColumn(axis)) : nullptr;
      xyz[i] = column ? column->GetComponent(row, 0)
        : table_      ? table_->GetValue(row, axis).ToDouble()
                      : cloud_->GetPoint(row)[axis];
    }
    return xyz;
  }
  std::int64_t resultBytes() const override
  {
    return 1024 * std::int64_t(table_ ? table_->GetActualMemorySize() : cloud_->GetActualMemorySize());
  }

  void load(vtkPolyData* cloud) override { cloud_ = cloud; }
  void write(FileKind kind, const std::string& path) override
  {
    int written = 0;
    if (kind == FileKind::Vtp)
    {
      vtkNew<vtkXMLPolyDataWriter> writer;
      writer->SetInputData(cloud_);
      writer->SetFileName(path.c_str());
      writer->SetDataModeToAppended();
      writer->EncodeAppendedDataOff();
      writer->SetCompressorTypeToNone();
      written = writer->Write();
    }
    else
    {
      vtkNew<vtkPLYWriter> writer;
      writer->SetInputData(cloud_);
      writer->SetFileName(path.c_str());
      writer->SetArrayName("RGB");
      written = writer->Write();
    }
    if (written != 1)
    {
      throw std::runtime_error(path + ": VTK cannot write it");
    }
  }

private:
  vtkSmartPointer<vtkPolyData> cloud_;
  vtkSmartPointer<vtkTable> table_;
};

} // namespace

std::unique_ptr<Rival> makeVtk()
{
  return std::make_unique<Vtk>();
}

} // namespace io
} // namespace bench
} // namespace pointhaptics
