/// @file
/// The cells near a position, laid out for the fit's inner loops and reused while fits stay near it.
#pragma once

#include "Core/Surface/CellPyramid.h"
#include "Core/Surface/FitKernel.h"
#include "Core/Surface/RadiusField.h"

namespace pointhaptics
{

/// Memory of local fits: neighbourhoods of cells and of field nodes, and the rows of the normal equations.
/// Neighbourhoods are gathered once and serve all fits whose balls lie inside. About 350 kB; allocate it
/// once, on the heap. Plain state, one thread. No member function allocates, locks or throws.
class FitCells
{
public:
  /// Cells are gathered this much further than a fit looks, if there is room: a HIP at 50 mm/s then stays
  /// inside for about ten ticks.
  static constexpr double kMargin = 1.25;

  /// @param wanted the instructions to use, as far as this machine has them; the results are the same.
  explicit FitCells(InstructionSet wanted = InstructionSet::Automatic, double margin = kMargin)
    : kernels_(&simd::fitKernels(wanted))
    , margin_(margin)
  {
  }

  /// Drops all that was gathered. Call it before a pyramid or field is used whose address another one had.
  void invalidate() noexcept;
  /// Switches to @p pyramid and @p field, which equal the last ones in the box @p same: cells gathered there
  /// stay.
  void carryOver(const CellPyramid& pyramid, const RadiusField& field, const Bounds& same) noexcept;

  /// The cells of @p level that may lie within @p radius of @p center, and maybe others; mixed cells as their
  /// children. If they are more than a block holds, it takes the next coarser level that fits, and @p level
  /// receives that.
  const simd::FitBlock& near(
    const CellPyramid& pyramid, int& level, const Vec3& center, double radius) noexcept;

  /// RadiusField::at() from gathered nodes; equal to it up to rounding.
  LocalScale scaleAt(const CellPyramid& pyramid, const RadiusField& field, const Vec3& position,
    Vec3& radiusGradient) noexcept;

  const simd::FitKernels& kernels() const noexcept { return *kernels_; }
  simd::FitRows& rows() noexcept { return rows_; }
  /// True where some block was too small since the last call of clearOverflow().
  bool overflowed() const noexcept { return overflowed_; }
  void clearOverflow() noexcept { overflowed_ = false; }

private:
  bool gather(
    const CellPyramid& pyramid, int level, const Vec3& center, double reach, simd::FitBlock& block) noexcept;

  const simd::FitKernels* kernels_;
  double margin_;
  const CellPyramid* pyramid_ = nullptr;
  const RadiusField* field_ = nullptr;
  simd::FitBlock blocks_[2]; ///< Blocks of even and of odd levels: a fit blends two neighbouring levels.
  simd::FieldBlock nodes_;
  simd::FitRows rows_;
  bool overflowed_ = false;
};

} // namespace pointhaptics
