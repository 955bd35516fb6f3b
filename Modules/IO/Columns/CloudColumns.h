/// @file
/// Named, typed columns of a file and the vtkPolyData they become.
#pragma once

#include "Bytes/StridedCopy.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

class vtkIdList;
class vtkPolyData;

namespace pointhaptics::io
{

struct ReadTask;

/// More columns than any cloud has: headers with more are refused before names are compared.
constexpr std::size_t kMostColumns = 4096;

/// One column as its file names it.
struct Column
{
  std::string name;
  int type = VTK_FLOAT; ///< VTK type
  int components = 1;
};

/// An array of the VTK type @p type, whose values are undefined.
vtkSmartPointer<vtkDataArray> makeArray(
  int type, int components, vtkIdType tuples, const std::string& name = {});

/// Columns with these names.
std::vector<Column> columnsCalled(const std::vector<std::string>& names);

/// Which of @p columns become x, y and z: those called so, else those called so in other words, such as
/// "POINT_X", "y [m]", "xcoord", "field.z", "easting" and "Points:2"; depths where there are no heights.
/// @return whether all three were found.
bool findCoordinates(const std::vector<Column>& columns, std::vector<std::size_t>& found);
/// Returns the columns of x, y and z. @throws FileProblem where there are none.
std::vector<std::size_t> coordinatesOf(const std::vector<Column>& columns);

/// "mm" of "X1 (mm)" and "x_mm", the names of coordinates; empty where the name says no unit. What stands in
/// square brackets may be one that nobody knows.
std::string coordinateUnit(const std::string& name);
/// "x" of "X [m]", "easting" of "easting": what names the axis, in lower case.
std::string coordinateWord(const std::string& name);

/// True if @p name is that of a channel of colours, or of a component of normals.
bool isColorName(const std::string& name);
bool isNormalName(const std::string& name);

/// The values of one component of a column where a file has them.
struct StoredColumn
{
  ConstColumnView source; ///< From the first row on.
  std::size_t column = 0;
  int component = 0;
  bool isSwapped = false; ///< The bytes of each value stand the other way round.
};

/// Plans where each column goes, owns the arrays, and hands them over when they are filled:
/// - x y z, or what coordinatesOf() finds, become the points: double when one of them is double or
/// an integer of 4 bytes and more, else float. Those of a column called "-z" get the other sign, and so do
/// depths, which count down, where more of them are above 0 than below;
/// - red green blue [alpha] (or r g b [a], Rf Gf Bf and the like), all unsigned char, become "RGB" or "RGBA",
/// the active scalars; of other types they become "Color16" (unsigned short) or "Color", beside an "RGB" made
/// of them (shownColors());
/// - nx ny nz or normal_x normal_y normal_z become "Normals", the active normals;
/// - name_0 name_1 ... in this order become one array "name" (of the widest of their types);
/// - every other column becomes an array of its name and type.
/// The values of an array are undefined until its columns are filled.
class CloudColumns
{
public:
  /// @throws FileProblem when @p columns have no x, y, z; std::bad_alloc. The caller has checked @p rows
  /// against the size of the file.
  CloudColumns(const std::vector<Column>& columns, vtkIdType rows);

  /// Where component @p component of column @p column is to be written.
  ColumnView target(std::size_t column, int component = 0) const;

  /// Has moveTo() make an "RGB" of the colours in column @p column, which stands behind them.
  void showColors(std::size_t column);

  /// The array of column @p column.
  vtkDataArray* arrayOf(std::size_t column) const { return arrays_[places_[column].array]; }

  /// Copies all rows, in blocks of records that stay in the cache, with progress of @p task.
  void fill(const std::vector<StoredColumn>& stored, const ReadTask& task) const;
  /// Takes away all rows but the first @p rows. Rows that a torn file lacks are undefined: nothing may look
  /// at them.
  void cut(std::uint64_t rows);
  /// Gives points and arrays to @p cloud, of the rows that are there. Collective where ranks read the file of
  /// @p task together.
  void moveTo(vtkPolyData* cloud, ReadTask& task);

private:
  struct Place
  {
    std::size_t array = 0;
    int component = 0;
  };
  void planPoints();
  void turnAxes(ReadTask& task);
  /// @return whether there are such columns.
  bool planNamed(
    const std::vector<std::vector<std::string>>& names, const char* arrayName, bool (*accepts)(int));
  void planNumbered();
  /// @param type VTK_VOID: the widest of the columns.
  void add(const std::string& name, const std::vector<std::size_t>& columns, int type = VTK_VOID);

  const std::vector<Column> columns_;
  vtkIdType rows_;
  std::vector<bool> placed_;
  std::set<std::string> names_; ///< names of the arrays
  std::vector<Place> places_;
  std::vector<vtkSmartPointer<vtkDataArray>> arrays_; ///< the first one holds the points
  std::vector<std::size_t> coordinates_;              ///< columns of x, y and z
  std::size_t colors_ = 0;                            ///< Those that are no bytes; 0: there are none.
  std::size_t shownBehind_ = 0; ///< The array behind which the bytes made of them stand.
};

/// An array "RGB" of bytes made of @p colors, whose largest value is @p most: 1, 255 or 65535. NaN is 0.
vtkSmartPointer<vtkDataArray> bytesOfColors(vtkDataArray* colors, double most);

/// Gives @p cloud one vertex cell per point and no other cell.
void setOneVertexPerPoint(vtkPolyData* cloud);

/// Takes away all points but @p kept, with their values in all arrays.
void keepPoints(vtkPolyData* cloud, vtkIdList* kept);

/// Makes the arrays RGB, RGBA and Normals the active scalars and normals where they have the right shape.
void setActiveAttributes(vtkPolyData* cloud);

} // namespace pointhaptics::io
