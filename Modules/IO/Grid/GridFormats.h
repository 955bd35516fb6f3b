/// @file
/// Texts whose points are the cells of a grid.
#pragma once

namespace pointhaptics::io
{

struct FormatStart;

/// True if the first line is that of an Esri grid, "ncols 300", in any case.
bool looksLikeEsriGrid(const FormatStart& start);

/// True if two counts, for columns and rows, and twelve numbers for the scanner's place stand first.
bool looksLikePtx(const FormatStart& start);

} // namespace pointhaptics::io
