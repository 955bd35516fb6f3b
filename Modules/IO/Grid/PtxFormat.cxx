#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"
#include "ReadTask.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointhaptics::io
{

namespace
{

/// How many of up to @p most numbers @p line begins with.
int takeNumbers(std::string_view line, double* values, int most)
{
  int count = 0;
  while (count < most && takeNumber(line, values[count]))
  {
    ++count;
  }
  return count;
}

/// Reads scan after scan.
class PtxReader
{
public:
  explicit PtxReader(ReadTask& task)
    : task_(task)
    , lines_(withoutByteOrderMark(task.bytes))
  {
    points_->SetDataTypeToDouble();
    intensity_->SetName("intensity");
    colors_->SetName("RGB");
    colors_->SetNumberOfComponents(3);
    scans_->SetName("ScanIndex");
  }
  void read()
  {
    while (lines_.nextFilled(line_) && readScan())
    {
      ++scan_;
    }
  }
  void moveTo(vtkPolyData* cloud);

private:
  void failIf(bool isWrong, const std::string& expected) const
  {
    failFormatIf(isWrong, "write the scan again, as PTX or E57", "line {}: {} stands where {} was expected",
      lines_.lineNumber(), isWrong ? inQuotes(line_) : "", expected);
  }
  std::uint64_t count()
  {
    unsigned long long value = 0;
    failIf(!parseCount(trimmed(line_), value) || value == 0, "a number of columns or rows");
    return value;
  }
  void nextLine()
  {
    const bool isThere = lines_.nextFilled(line_);
    failTruncatedIf(!isThere, "the file ends at line {} before its points", lines_.lineNumber());
  }
  void nextNumbers(double* values, int wanted)
  {
    nextLine();
    failIf(takeNumbers(line_, values, wanted) != wanted,
      std::to_string(wanted) + " numbers of the scanner's place");
  }
  bool readScan();
  void addPoint(const double* values, int count);

  ReadTask& task_;
  LineReader lines_;
  std::string_view line_;
  unsigned int scan_ = 0;
  std::uint64_t promised_ = 0;
  std::uint64_t unreturned_ = 0;
  bool hasColors_ = false;
  std::array<double, 16> pose_{}; ///< Row vectors are multiplied from the left.
  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> intensity_;
  vtkNew<vtkUnsignedCharArray> colors_;
  vtkNew<vtkUnsignedIntArray> scans_;
};

/// @return false where the file ends within it and is salvaged.
bool PtxReader::readScan()
{
  constexpr std::uint64_t kShortestLine = 8; // "0 0 0 0" and its end
  const std::uint64_t columns = count();
  nextLine();
  const std::uint64_t rows = count();
  failTruncatedIf(rows > (task_.bytes.size() / kShortestLine + 1) / columns,
    "line {}: a scan of {} x {} points in a file of {} bytes", lines_.lineNumber(), columns, rows,
    task_.bytes.size());
  double ignored[3]; // place and axes of the scanner, which the matrix has, too
  for (int i = 0; i < 4; ++i)
  {
    nextNumbers(ignored, 3);
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    nextNumbers(&pose_[4 * i], 4);
  }
  promised_ += columns * rows;
  for (std::uint64_t i = 0; i < columns * rows; ++i)
  {
    double values[7];
    const int found = lines_.nextFilled(line_) ? takeNumbers(line_, values, 7) : 0;
    if (found != 4 && found != 7)
    {
      if (found == 0 && lines_.isAtEnd())
      {
        task_.endAt(static_cast<std::uint64_t>(points_->GetNumberOfPoints()), promised_,
          "the file ends at line " + std::to_string(lines_.lineNumber()) + " inside scan " +
            std::to_string(scan_ + 1));
        return false;
      }
      failIf(true, "x y z intensity, and perhaps red green blue,");
    }
    addPoint(values, found);
    task_.step(i, lines_.position(), task_.bytes.size());
  }
  return true;
}

void PtxReader::addPoint(const double* values, int count)
{
  if (values[0] == 0.0 && values[1] == 0.0 && values[2] == 0.0)
  {
    ++unreturned_;
    return;
  }
  double place[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    place[axis] = task_.applyPoses
      ? values[0] * pose_[axis] + values[1] * pose_[4 + axis] + values[2] * pose_[8 + axis] + pose_[12 + axis]
      : values[axis];
  }
  points_->InsertNextPoint(place);
  intensity_->InsertNextValue(static_cast<float>(values[3]));
  for (int channel = 4; channel < 7; ++channel)
  {
    const double color = count == 7 ? std::clamp(std::nearbyint(values[channel]), 0.0, 255.0) : 0.0;
    colors_->InsertNextValue(
      color >= 0.0 ? static_cast<unsigned char>(color) : static_cast<unsigned char>(0));
  }
  scans_->InsertNextValue(scan_);
  hasColors_ = hasColors_ || count == 7;
}

void PtxReader::moveTo(vtkPolyData* cloud)
{
  points_->GetNumberOfPoints() == 0 ? failNoPoints() : void();
  cloud->SetPoints(points_);
  cloud->GetPointData()->AddArray(intensity_);
  if (hasColors_)
  {
    cloud->GetPointData()->AddArray(colors_);
  }
  if (scans_->GetNumberOfValues() > 0 && scans_->GetValue(scans_->GetNumberOfValues() - 1) > 0)
  {
    cloud->GetPointData()->AddArray(scans_);
  }
  setActiveAttributes(cloud);
  if (unreturned_ > 0)
  {
    task_.notes.push_back(std::to_string(unreturned_) +
      (unreturned_ == 1 ? " ray without return is" : " rays without return are") +
      " left out: their points are written as 0 0 0");
  }
}

} // namespace

bool looksLikePtx(const FormatStart& start)
{
  LineReader lines(start.bytes);
  std::string_view line;
  unsigned long long count = 0;
  for (int i = 0; i < 2; ++i)
  {
    if (!start.isText || !lines.nextFilled(line) || !parseCount(trimmed(line), count))
    {
      return false;
    }
  }
  double values[4];
  for (int i = 0; i < 5 && lines.nextFilled(line); ++i)
  {
    if (takeNumbers(line, values, 4) != (i < 4 ? 3 : 4))
    {
      return false;
    }
  }
  return true;
}

/// All scans as one cloud, their poses applied unless the task says otherwise; rays without return are left
/// out.
void readPtx(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "PTX";
  PtxReader reader(task);
  reader.read();
  reader.moveTo(cloud);
}

} // namespace pointhaptics::io
