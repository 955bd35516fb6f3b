/// @file
/// Which vector instructions the inner loops use; chosen at run time in one build.
#pragma once

namespace pointhaptics
{

/// Every choice gives the same bits; they differ in speed only.
enum class InstructionSet
{
  Automatic, ///< The best this machine has.
  Baseline,  ///< What every processor of the family has (SSE2 on x86-64).
  Avx2,      ///< AVX2, FMA, BMI and BMI2.
  Avx512,    ///< AVX-512 F, DQ, BW, VL and VPOPCNTDQ.
};

/// The best set that this machine and this build have, not above @p wanted. Thread-safe.
InstructionSet usableInstructionSet(InstructionSet wanted = InstructionSet::Automatic) noexcept;

} // namespace pointhaptics
