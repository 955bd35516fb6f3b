/// @file
/// Which column of the cloud each field of each scan goes to.
#pragma once

#include "IO/Columns/CloudColumns.h"
#include "IO/E57/E57Scan.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace pointhaptics::io
{

/// The names that a reader of LAS gives the same things, where there are such. A field that several scans
/// have becomes one column of a type that holds the values of all.
class E57Columns
{
public:
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

  struct Place
  {
    std::size_t column = npos; ///< npos: the field is not read
    int component = 0;
    std::int64_t added = 0; ///< to each value: returns count from 1 here, from 0 in E57
  };

  /// The first three columns are x, y and z. @p movesPoints: coordinates will not stay those of the file.
  /// @throws FileProblem where a scan has no coordinates.
  E57Columns(const std::vector<E57Scan>& scans, bool movesPoints);

  const std::vector<Column>& all() const { return columns_; }
  const Place& place(std::size_t scan, std::size_t field) const { return places_[scan][field]; }
  /// Columns of which a scan has no field: its points get NaN, or 0 where these are integers.
  std::vector<std::size_t> missing(std::size_t scan) const;

  bool isSpherical(std::size_t scan) const { return isSpherical_[scan]; }
  /// The number of the scan, from 0; npos where there is one scan.
  std::size_t scanIndex() const { return scanIndex_; }
  /// Colours as stored (3 components), where these are not bytes; npos where they are, or there are none.
  std::size_t storedColor() const { return storedColor_; }
  /// The bytes made of them.
  std::size_t madeColor() const { return madeColor_; }

private:
  struct Values ///< what one column has to hold
  {
    bool hasDouble = false;
    bool hasFloat = false;
    bool hasInteger = false;
    std::int64_t minimum = std::numeric_limits<std::int64_t>::max();
    std::int64_t maximum = std::numeric_limits<std::int64_t>::min();
    int type() const;
  };
  void chooseColors(const std::vector<E57Scan>& scans);
  void addScan(const E57Scan& scan);
  Place placeOf(const E57Field& field, bool hasColors, std::set<std::size_t>& taken);
  std::size_t columnNamed(const std::string& name, int components = 1);
  void hold(std::size_t column, const E57Field& field, std::int64_t added);

  std::vector<Column> columns_;
  std::vector<Values> values_;
  std::map<std::string, std::size_t> indices_; ///< of the columns by their names
  std::vector<std::vector<Place>> places_;
  std::vector<bool> isSpherical_;
  bool hasByteColors_ = true;
  bool hasWordColors_ = true;
  std::size_t scanIndex_ = npos;
  std::size_t storedColor_ = npos;
  std::size_t madeColor_ = npos;
};

/// Arrays of flags that most files leave at zero: dropped where they are.
bool isE57Flag(const std::string& column);

/// True if a scan has the three fields of a colour.
bool hasE57Colors(const E57Scan& scan);

} // namespace pointhaptics::io
