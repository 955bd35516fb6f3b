/// @file
/// Which vector instructions the inner loops use; chosen at run time in one build.
#pragma once

namespace pointhaptics
{

/// Every choice gives the same bits; they differ in speed only.
enum class InstructionSet
{
  Automatic, ///< The best this machine has.
  Baseline,  ///< Instructions of every processor of the family (SSE2 on x86-64).
  Avx2,      ///< AVX2, FMA, BMI and BMI2.
};

/// The best set that this machine and this build have, not above @p wanted. Thread-safe.
InstructionSet usableInstructionSet(InstructionSet wanted = InstructionSet::Automatic) noexcept;

/// The loops to use of a family that is compiled for each set: the one place that chooses. @p avx2 gives null
/// where the compiler or the processor family lacks them; it is called where the machine has its
/// instructions, which it may use. Thread-safe.
template <typename Loops>
const Loops& loopsFor(InstructionSet wanted, const Loops& (*baseline)(), const Loops* (*avx2)())
{
  const Loops* const loops = usableInstructionSet(wanted) == InstructionSet::Avx2 ? avx2() : nullptr;
  return loops ? *loops : baseline();
}

} // namespace pointhaptics
