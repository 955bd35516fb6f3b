#include "IO/Vtk/VtpWriter.h"

#include "IO/Columns/CloudColumns.h"
#include "IO/FileProblem.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Vtk/ErrorCollector.h"
#include "IO/WriteTask.h"

#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <cstdint>
#include <streambuf>
#include <string>
#include <vector>

namespace pointhaptics::io
{

namespace
{

/// Passes VTK's stream on to OutputStream, which keeps the reason of a fault: VTK forgets it.
class OutputBuffer : public std::streambuf
{
public:
  explicit OutputBuffer(OutputStream& out)
    : out_(out)
  {
  }

protected:
  std::streamsize xsputn(const char* bytes, std::streamsize size) override
  {
    out_.writeAt(place_, { bytes, static_cast<std::size_t>(size) }); // where it throws the stream turns bad
    place_ += static_cast<std::uint64_t>(size);
    end_ = std::max(end_, place_);
    return size;
  }
  int_type overflow(int_type c) override
  {
    const char byte = traits_type::to_char_type(c);
    return traits_type::eq_int_type(c, traits_type::eof()) || this->xsputn(&byte, 1) == 1
      ? traits_type::not_eof(c)
      : traits_type::eof();
  }
  pos_type seekoff(off_type offset, std::ios::seekdir from, std::ios::openmode) override
  {
    const std::uint64_t base = from == std::ios::cur ? place_ : from == std::ios::end ? end_ : 0;
    place_ = base + static_cast<std::uint64_t>(offset);
    return static_cast<off_type>(place_);
  }
  pos_type seekpos(pos_type place, std::ios::openmode mode) override
  {
    return this->seekoff(off_type(place), std::ios::beg, mode);
  }

private:
  OutputStream& out_;
  std::uint64_t place_ = 0;
  std::uint64_t end_ = 0;
};

/// VTK's writer takes no notice of AbortExecute; this one does at each progress report, at least once an
/// array: the rest is written nowhere, and Write() fails.
class VtpWriter : public vtkXMLPolyDataWriter
{
public:
  static VtpWriter* New();
  vtkTypeMacro(VtpWriter, vtkXMLPolyDataWriter);
  /// @p buffer gets the bytes, in place of the file that VTK opens.
  void writeInto(std::streambuf* buffer) { buffer_ = buffer; }

protected:
  int StartFile() override
  {
    this->Stream->rdbuf(buffer_);
    return this->Superclass::StartFile();
  }
  void UpdateProgressDiscrete(float progress) override
  {
    this->Superclass::UpdateProgressDiscrete(progress);
    if (this->AbortExecute && this->Stream)
    {
      this->Stream->setstate(std::ios::badbit);
    }
  }

private:
  std::streambuf* buffer_ = nullptr;
};
vtkStandardNewMacro(VtpWriter);

/// The name that XML can hold. An empty one is no name to VTK's reader.
std::string xmlName(vtkAbstractArray* array)
{
  std::string name = utf8Name(array->GetName() ? array->GetName() : "");
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r'; },
    '_');
  for (const char* none : { "\xef\xbf\xbe", "\xef\xbf\xbf" })
  {
    for (std::size_t at = name.find(none); at != std::string::npos; at = name.find(none))
    {
      name.replace(at, 3, "_");
    }
  }
  return name.empty() ? "unnamed" : name;
}

std::string escaped(const std::string& name)
{
  std::string result;
  for (const char c : name)
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool isPlain = byte >= 0x20 && c != '&' && c != '<' && c != '>' && c != '"';
    result += isPlain ? std::string(1, c) : "&#" + std::to_string(byte) + ";";
  }
  return result;
}

/// VTK writes names into attributes of XML as they are: arrays whose names would end these get others, which
/// read back as the names. The values are shared.
void escapeNames(vtkFieldData* data)
{
  std::vector<vtkSmartPointer<vtkAbstractArray>> arrays;
  std::vector<int> roles;
  bool isSame = true;
  auto* attributes = vtkDataSetAttributes::SafeDownCast(data);
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    arrays.emplace_back(data->GetAbstractArray(i));
    roles.push_back(attributes ? attributes->IsArrayAnAttribute(i) : -1);
    const std::string name = escaped(xmlName(arrays.back()));
    auto* numbers = vtkDataArray::SafeDownCast(arrays.back());
    if (numbers && (!numbers->GetName() || name != numbers->GetName()))
    {
      const auto renamed = vtkSmartPointer<vtkDataArray>::Take(numbers->NewInstance());
      renamed->ShallowCopy(numbers);
      renamed->SetName(name.c_str());
      arrays.back() = renamed;
      isSame = false;
    }
  }
  for (std::size_t i = 0; i < arrays.size() && !isSame; ++i)
  {
    i == 0 ? data->Initialize() : void();
    const int at = data->AddArray(arrays[i]);
    roles[i] >= 0 ? static_cast<void>(attributes->SetActiveAttribute(at, roles[i])) : void();
  }
}

/// All arrays at the end of the file, as they are in memory.
void useRawData(vtkXMLWriter* writer)
{
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
}

} // namespace

void writeVtp(WriteTask& task)
{
  if (!task.out.isReplacing())
  {
    throw FileProblem(vtkErrorCode::CannotOpenFileError, "VTP files cannot be written to a pipe or a device",
      "choose the name of a new file, or .ply, .pcd, .las, .laz, .csv or .xyz");
  }
  vtkPointSet* cloud = task.cloud;
  vtkNew<vtkPolyData> written;
  if (vtkPolyData* polyData = vtkPolyData::SafeDownCast(cloud))
  {
    written->ShallowCopy(polyData);
  }
  else
  {
    written->SetPoints(cloud->GetPoints());
    written->GetPointData()->ShallowCopy(cloud->GetPointData());
    written->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  }
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const std::string given = utf8Name(array->GetName() ? array->GetName() : "");
    if (xmlName(array) != given)
    {
      task.notes.add("array " + inQuotes(given) + " is called " + xmlName(array));
    }
  }
  escapeNames(written->GetPointData());
  escapeNames(written->GetFieldData());
  if (written->GetNumberOfCells() == 0)
  {
    setOneVertexPerPoint(written);
  }
  vtkNew<ErrorCollector> errors;
  OutputBuffer buffer(task.out);
  vtkNew<VtpWriter> writer;
  writer->writeInto(&buffer);
  useRawData(writer);
  writer->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->SetInputData(written);
  writer->SetFileName(task.out.path().c_str());
  RelayedProgress progress(writer, task.algorithm, 0.0, 1.0);
  const bool isWritten = writer->Write() == 1;
  progress.finish();
  task.out.checkEarlier();
  if (!isWritten || !errors->first().empty())
  {
    throw FileProblem(vtkErrorCode::CannotOpenFileError,
      errors->first().empty() ? "writing stopped" : errors->first(),
      "check the folder, its permissions and the free space");
  }
}

std::string vtpText(vtkPolyData* cloud)
{
  vtkNew<vtkPolyData> written;
  written->ShallowCopy(cloud);
  escapeNames(written->GetPointData());
  escapeNames(written->GetFieldData());
  vtkNew<vtkXMLPolyDataWriter> writer;
  useRawData(writer);
  writer->SetInputData(written);
  writer->WriteToOutputStringOn();
  writer->Write();
  return writer->GetOutputString();
}

} // namespace pointhaptics::io
