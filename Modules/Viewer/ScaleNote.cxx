#include "ScaleNote.h"

#include "Core/Base/QuantityText.h"

#include <vtkMatrix4x4.h>

#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr double kSame = 0.005;
constexpr double kUnderTheHand = 1e-3; // metres
constexpr int kDigits = 2;

} // namespace

std::string describeScale(vtkMatrix4x4* modelMatrix, const std::string& unit, double metresPerUnit)
{
  const double inHand = std::cbrt(std::abs(modelMatrix->Determinant())); // of one unit, metres
  const double reduction = metresPerUnit / inHand;
  if (std::abs(reduction - 1.0) <= kSame)
  {
    return "1 : 1, as large as it is";
  }
  const std::string ratio =
    reduction > 1.0 ? "1 : " + ratioText(reduction) : ratioText(1.0 / reduction) + " : 1";
  const double thing = kUnderTheHand * reduction;
  const bool isImperial = unit == "ft" || unit == "in" || unit == "yd";
  return ratio + "; 1 mm in the hand is " +
    (isImperial ? lengthText(thing, unit, metresPerUnit, kDigits) : lengthText(thing, kDigits));
}

} // namespace pointhaptics
