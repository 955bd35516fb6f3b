#include "IO/Vtk/SharedVtp.h"

#include "IO/Columns/CloudColumns.h"
#include "IO/Vtk/VtkXmlChecks.h"
#include "IO/Vtk/VtpWriter.h"
#include "IO/Vtk/XmlTags.h"

#include "Core/Base/OutputFile.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

namespace
{

constexpr std::uint64_t kSizeBytes = sizeof(std::uint64_t); ///< Bytes in front of an array, which hold its
                                                            ///< size.

/// How vertices are numbered: two arrays of a file.
enum class Vertices
{
  None,
  Of32Bits,
  Of64Bits,
};

std::uint64_t bytesOfTuple(vtkDataArray* array)
{
  return static_cast<std::uint64_t>(array->GetDataTypeSize()) *
    static_cast<std::uint64_t>(array->GetNumberOfComponents());
}

/// Parts of the file that the ranks write, and their knowledge of each other.
class Parts
{
public:
  Parts(Ranks& ranks, vtkPolyData* piece);

  /// True if all of them can be written apart.
  bool fit() const { return fit_ && points_ > 0; }
  vtkIdType points() const { return points_; }
  vtkIdType pointsBefore() const { return before_; }
  /// The arrays of the points, and last their places.
  const std::vector<vtkDataArray*>& arrays() const { return arrays_; }
  double low(std::size_t array) const { return lows_[array]; }
  double high(std::size_t array) const { return highs_[array]; }
  bool verticesHave64Bits() const { return vertices_ == Vertices::Of64Bits; }
  /// Number of blocks in the file: arrays, and the two of the vertices.
  std::size_t count() const { return arrays_.size() + 2; }
  std::uint64_t tupleBytes(std::size_t array) const
  {
    return array < arrays_.size() ? bytesOfTuple(arrays_[array]) : verticesHave64Bits() ? 8 : 4;
  }

private:
  bool takeArrays(vtkPolyData* piece);

  bool fit_ = true;
  vtkIdType points_ = 0;
  vtkIdType before_ = 0;
  Vertices vertices_ = Vertices::None;
  std::vector<vtkDataArray*> arrays_;
  std::vector<double> lows_;
  std::vector<double> highs_;
};

/// @return false where there is more than numbers of points.
bool Parts::takeArrays(vtkPolyData* piece)
{
  const vtkIdType points = piece->GetNumberOfPoints();
  const vtkIdType vertices = piece->GetNumberOfVerts();
  bool areNumbers = piece->GetPoints() && piece->GetNumberOfCells() == vertices &&
    (vertices == 0 || vertices == points) && piece->GetCellData()->GetNumberOfArrays() == 0;
  for (int i = 0; areNumbers && i < piece->GetPointData()->GetNumberOfArrays(); ++i)
  {
    arrays_.push_back(vtkDataArray::SafeDownCast(piece->GetPointData()->GetAbstractArray(i)));
    areNumbers = arrays_.back() && arrays_.back()->GetName();
  }
  if (areNumbers)
  {
    arrays_.push_back(piece->GetPoints()->GetData());
  }
  return areNumbers &&
    std::all_of(arrays_.begin(), arrays_.end(),
      [points](vtkDataArray* array)
      {
        return array->HasStandardMemoryLayout() && array->GetDataType() != VTK_BIT &&
          array->GetNumberOfTuples() == points;
      });
}

Parts::Parts(Ranks& ranks, vtkPolyData* piece)
{
  fit_ = this->takeArrays(piece);
  Vertices own = Vertices::None;
  if (piece->GetNumberOfVerts() > 0)
  {
    own = piece->GetVerts()->IsStorage64Bit() ? Vertices::Of64Bits : Vertices::Of32Bits;
  }
  std::vector<double> ranges;
  for (std::size_t i = 0; fit_ && piece->GetNumberOfPoints() > 0 && i < arrays_.size(); ++i)
  {
    double range[2];
    arrays_[i]->GetRange(range, -1); // as VTK's writer: of vectors their length
    ranges.insert(ranges.end(), range, range + 2);
  }
  const auto fits = ranks.gatherValues(fit_);
  const auto points = ranks.gatherValues(piece->GetNumberOfPoints());
  vertices_ = ranks.reduce(own, [](Vertices a, Vertices b) { return std::max(a, b); });
  fit_ = std::all_of(fits.begin(), fits.end(), [](bool fit) { return fit; });
  points_ = std::accumulate(points.begin(), points.end(), vtkIdType(0));
  before_ = std::accumulate(points.begin(), points.begin() + ranks.rank(), vtkIdType(0));
  // As those that readers and filters make.
  const bool areMany = points_ >= std::numeric_limits<std::int32_t>::max();
  vertices_ = vertices_ == Vertices::Of64Bits || areMany ? Vertices::Of64Bits : Vertices::Of32Bits;
  lows_.assign(arrays_.size(), INFINITY);
  highs_.assign(arrays_.size(), -INFINITY);
  for (const std::string& bytes : ranks.gather(bytesOfValues(ranges)))
  {
    const auto ofRank = valuesOfBytes<double>(bytes);
    for (std::size_t i = 0; i < arrays_.size() && 2 * i + 1 < ofRank.size(); ++i)
    {
      lows_[i] = std::min(lows_[i], ofRank[2 * i]);
      highs_[i] = std::max(highs_[i], ofRank[2 * i + 1]);
    }
  }
}

/// A cloud of one point with the arrays of @p piece: VTK writes of it all but the numbers.
std::string textOfOnePoint(vtkPolyData* piece, const Parts& parts)
{
  vtkNew<vtkPolyData> one;
  vtkNew<vtkPoints> places;
  places->SetDataType(piece->GetPoints()->GetDataType());
  places->InsertNextPoint(0.0, 0.0, 0.0);
  one->SetPoints(places);
  vtkPointData* data = one->GetPointData();
  data->CopyAllOn();
  data->CopyAllocate(piece->GetPointData(), 1);
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    data->GetArray(i)->SetNumberOfTuples(1);
    data->GetArray(i)->Fill(0.0);
  }
  setOneVertexPerPoint(one);
  parts.verticesHave64Bits() ? static_cast<void>(one->GetVerts()->ConvertTo64BitStorage())
                             : static_cast<void>(one->GetVerts()->ConvertTo32BitStorage());
  one->GetFieldData()->PassData(piece->GetFieldData());
  return vtpText(one);
}

/// An array of a file.
struct Block
{
  std::uint64_t place = 0; ///< Place of its size, which its bytes follow.
  std::uint64_t bytes = 0;
  bool isShared = false;    ///< The ranks write the bytes.
  std::string_view content; ///< Else these.
};

/// A file without the numbers of its points.
class Frame
{
public:
  /// @p text: the file of one point.
  Frame(const std::string& text, const Parts& parts);

  bool fits() const { return fits_; }
  /// Where the bytes of the arrays begin that ranks write.
  std::vector<std::uint64_t> places() const;
  Status write(OutputFile& file) const;

private:
  void addBlock(std::string_view tag, const Parts& parts);
  void set(std::string_view attribute, const std::string& value);
  void setNumber(std::string_view attribute, double value);

  const std::string& text_;
  bool fits_ = true;
  bool isInPiece_ = false;
  std::size_t shared_ = 0;
  std::uint64_t next_ = 0;   ///< Where the next block lies in the text's data,
  std::uint64_t offset_ = 0; ///< and where in that of the file.
  std::uint64_t begin_ = 0;  ///< Begin of the data.
  std::string head_;
  std::vector<Block> blocks_;
};

Frame::Frame(const std::string& text, const Parts& parts)
  : text_(text)
{
  const std::size_t appended = text.find("<AppendedData");
  const std::size_t begin = appended == std::string::npos ? appended : text.find('_', appended);
  if (begin == std::string::npos)
  {
    fits_ = false;
    return;
  }
  begin_ = begin + 1;
  head_ = text.substr(0, begin_);
  XmlTags tags(text);
  while (fits_ && tags.next() && tags.begin() < appended)
  {
    const std::string_view tag = tags.tag();
    if (tag.substr(0, 6) == "<Piece")
    {
      isInPiece_ = true;
      this->set(xmlAttribute(tag, "NumberOfPoints"), std::to_string(parts.points()));
      this->set(xmlAttribute(tag, "NumberOfVerts"), std::to_string(parts.points()));
    }
    if (tag.substr(0, 10) == "<DataArray" || tag.substr(0, 6) == "<Array")
    {
      this->addBlock(tag, parts);
    }
  }
  fits_ = fits_ && shared_ == parts.count();
}

void Frame::addBlock(std::string_view tag, const Parts& parts)
{
  const std::string_view offset = xmlAttribute(tag, "offset");
  Block block{ begin_ + offset_, 0, isInPiece_ && shared_ < parts.count(), {} };
  fits_ = offset == std::to_string(next_) && begin_ + next_ + kSizeBytes <= text_.size();
  if (fits_)
  {
    std::memcpy(&block.bytes, text_.data() + begin_ + next_, kSizeBytes);
    fits_ = block.bytes <= text_.size() - begin_ - next_ - kSizeBytes &&
      (!block.isShared || block.bytes == parts.tupleBytes(shared_));
  }
  if (!fits_)
  {
    return;
  }
  block.content = std::string_view(text_).substr(begin_ + next_ + kSizeBytes, block.bytes);
  next_ += kSizeBytes + block.bytes;
  this->set(offset, std::to_string(offset_));
  if (block.isShared)
  {
    block.bytes *= static_cast<std::uint64_t>(parts.points());
    if (shared_ < parts.arrays().size())
    {
      this->setNumber(xmlAttribute(tag, "RangeMin"), parts.low(shared_));
      this->setNumber(xmlAttribute(tag, "RangeMax"), parts.high(shared_));
    }
    ++shared_;
  }
  offset_ += kSizeBytes + block.bytes;
  blocks_.push_back(block);
}

/// VTK leaves room behind the values that it knows late.
void Frame::set(std::string_view attribute, const std::string& value)
{
  const auto at = static_cast<std::size_t>(attribute.data() - text_.data());
  const std::size_t after = text_.find_first_not_of(' ', at + attribute.size() + 1);
  fits_ = fits_ && !attribute.empty() && after != std::string::npos && at + value.size() + 1 < after;
  if (fits_)
  {
    head_.replace(at, after - at, value + '"' + std::string(after - at - value.size() - 1, ' '));
  }
}

void Frame::setNumber(std::string_view attribute, double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.11g", value); // as VTK writes it
  this->set(attribute, text);
}

std::vector<std::uint64_t> Frame::places() const
{
  std::vector<std::uint64_t> places;
  for (const Block& block : blocks_)
  {
    if (block.isShared)
    {
      places.push_back(block.place + kSizeBytes);
    }
  }
  return places;
}

Status Frame::write(OutputFile& file) const
{
  Status status = file.writeAt(0, head_);
  for (const Block& block : blocks_)
  {
    const std::string_view size(reinterpret_cast<const char*>(&block.bytes), kSizeBytes);
    status = status == Status::Ok ? file.writeAt(block.place, size) : status;
    if (!block.isShared)
    {
      status = status == Status::Ok ? file.writeAt(block.place + kSizeBytes, block.content) : status;
    }
  }
  const std::string_view tail = std::string_view(text_).substr(begin_ + next_);
  return status == Status::Ok ? file.writeAt(begin_ + offset_, tail) : status;
}

/// Numbers from @p first on, @p count of them, as @p Integer.
template <typename Integer>
Status writeNumbers(OutputFile& file, std::uint64_t place, vtkIdType first, vtkIdType count)
{
  constexpr vtkIdType kAtOnce = 1 << 15;
  std::vector<Integer> numbers(static_cast<std::size_t>(std::min(count, kAtOnce)));
  Status status = Status::Ok;
  for (vtkIdType done = 0; status == Status::Ok && done < count; done += kAtOnce)
  {
    numbers.resize(static_cast<std::size_t>(std::min(count - done, kAtOnce)));
    std::iota(numbers.begin(), numbers.end(), static_cast<Integer>(first + done));
    status = file.writeAt(place + static_cast<std::uint64_t>(done) * sizeof(Integer),
      { reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Integer) });
  }
  return status;
}

/// @p places: of the arrays in the file.
Status writeOwn(OutputFile& file, const std::vector<std::uint64_t>& places, const Parts& parts)
{
  const auto before = static_cast<std::uint64_t>(parts.pointsBefore());
  Status status = Status::Ok;
  for (std::size_t i = 0; status == Status::Ok && i < parts.arrays().size(); ++i)
  {
    vtkDataArray* array = parts.arrays()[i];
    const std::uint64_t bytes = parts.tupleBytes(i);
    const std::size_t size = static_cast<std::size_t>(array->GetNumberOfTuples()) * bytes;
    status =
      file.writeAt(places[i] + before * bytes, { static_cast<const char*>(array->GetVoidPointer(0)), size });
  }
  const vtkIdType own = parts.arrays().back()->GetNumberOfTuples();
  // Points of the vertices, and where each vertex ends.
  for (std::size_t i = 0; status == Status::Ok && i < 2; ++i)
  {
    const std::size_t array = parts.arrays().size() + i;
    const std::uint64_t place = places[array] + before * parts.tupleBytes(array);
    const vtkIdType first = parts.pointsBefore() + static_cast<vtkIdType>(i);
    status = parts.verticesHave64Bits() ? writeNumbers<std::int64_t>(file, place, first, own)
                                        : writeNumbers<std::int32_t>(file, place, first, own);
  }
  return status;
}

/// Opens the file on rank 0, where @p frame fits, and joins it on the others. @return the places in it; none
/// where that is not possible.
std::vector<std::uint64_t> openTogether(
  Ranks& ranks, const Frame* frame, const std::string& fileName, OutputFile& file)
{
  std::string path;
  std::vector<std::uint64_t> places;
  if (frame && frame->fits() && file.open(fileName) == Status::Ok && file.isReplacing())
  {
    path = file.path();
    places = frame->places();
  }
  path = ranks.gather(path).front();
  places = valuesOfBytes<std::uint64_t>(ranks.gather(bytesOfValues(places)).front());
  const bool isOpen = !path.empty() && (ranks.rank() == 0 || file.join(path) == Status::Ok);
  const bool areAll = ranks.reduce(isOpen, [](bool a, bool b) { return a && b; });
  return areAll ? places : std::vector<std::uint64_t>();
}

} // namespace

bool writeVtpTogether(Ranks& ranks, vtkPolyData* piece, const std::string& fileName, std::string& problem)
{
  const Parts parts(ranks, piece);
  if (!parts.fit())
  {
    return false;
  }
  const std::string text = ranks.rank() == 0 ? textOfOnePoint(piece, parts) : std::string();
  std::optional<Frame> frame;
  if (ranks.rank() == 0)
  {
    frame.emplace(text, parts);
  }
  OutputFile file;
  const std::vector<std::uint64_t> places = openTogether(ranks, frame ? &*frame : nullptr, fileName, file);
  if (places.empty())
  {
    return false;
  }
  Status status = frame ? frame->write(file) : Status::Ok;
  status = status == Status::Ok ? writeOwn(file, places, parts) : status;
  // Rank 0 gives the file its name after the others have closed it.
  status = status == Status::Ok && ranks.rank() != 0 ? file.commit() : status;
  const bool isWhole = ranks.reduce(status == Status::Ok, [](bool a, bool b) { return a && b; });
  status = isWhole && ranks.rank() == 0 ? file.commit() : status;
  if (status != Status::Ok)
  {
    problem = fileName + ": VTP: " + file.reason() + "; " + file.cure();
  }
  return true;
}

} // namespace pointhaptics::io
