/// @file
/// Forces as the figures that commands print.
#pragma once

namespace pointhaptics::app
{

/// Rounding leaves about 1e-14 N where a surface is met without depth: no figure, but nothing.
inline double forceFigure(double newtons)
{
  constexpr double kSmallest = 1e-9;
  return newtons < kSmallest ? 0.0 : newtons;
}

} // namespace pointhaptics::app
