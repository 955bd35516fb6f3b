/// @file
/// Which format a file has, told by its content.
#pragma once

#include <string>
#include <string_view>

namespace pointhaptics::io
{

enum class CloudFormat
{
  Ply,
  Pcd,
  Vtp,
  Obj,
  Las,
  Text,
};

/// Looks at the first bytes; @p extension (lower case, no dot) decides only between OBJ and columns of text.
/// @throws FileProblem for what is recognised but not read here (E57, gzip, ...), naming a converter, and for
/// what is not recognised at all.
CloudFormat identifyFormat(std::string_view bytes, const std::string& extension);

/// "PLY" and so on: the format's short name.
const char* nameOf(CloudFormat format);

/// @p bytes without the UTF-8 byte order mark some editors put in front.
std::string_view withoutByteOrderMark(std::string_view bytes);

} // namespace pointhaptics::io
