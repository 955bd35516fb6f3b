#include "AsprsClasses.h"

#include "vtksys/SystemTools.hxx"

#include <iterator>

namespace pointhaptics
{
namespace
{

constexpr AsprsClass kClasses[] = {
  { "never classified", { 0.60, 0.60, 0.60 } },
  { "unclassified", { 0.65, 0.65, 0.65 } },
  { "ground", { 0.66, 0.50, 0.34 } },
  { "low vegetation", { 0.62, 0.76, 0.40 } },
  { "medium vegetation", { 0.40, 0.68, 0.34 } },
  { "high vegetation", { 0.22, 0.54, 0.30 } },
  { "building", { 0.90, 0.45, 0.36 } },
  { "low noise", { 0.95, 0.35, 0.60 } },
  { "reserved", { 0.85, 0.80, 0.55 } },
  { "water", { 0.30, 0.56, 0.86 } },
  { "rail", { 0.55, 0.45, 0.65 } },
  { "road surface", { 0.55, 0.57, 0.62 } },
  { "reserved", { 0.65, 0.65, 0.65 } },
  { "wire guard", { 0.95, 0.85, 0.40 } },
  { "wire conductor", { 0.98, 0.72, 0.30 } },
  { "transmission tower", { 0.80, 0.55, 0.30 } },
  { "wire connector", { 0.95, 0.60, 0.25 } },
  { "bridge deck", { 0.78, 0.70, 0.62 } },
  { "high noise", { 0.95, 0.35, 0.60 } },
  { "overhead structure", { 0.60, 0.60, 0.60 } },
  { "ignored ground", { 0.60, 0.60, 0.60 } },
  { "snow", { 0.60, 0.60, 0.60 } },
  { "temporal exclusion", { 0.60, 0.60, 0.60 } },
};
constexpr AsprsClass kReserved = { "reserved", { 0.60, 0.60, 0.60 } };
constexpr AsprsClass kUserDefined = { "user defined", { 0.60, 0.60, 0.60 } };
constexpr AsprsClass kNone = { "no class", { 0.60, 0.60, 0.60 } };
constexpr int kFirstOfUsers = 64;
constexpr int kLast = 255;

} // namespace

const AsprsClass& asprsClass(int number)
{
  if (number < 0 || number > kLast)
  {
    return kNone;
  }
  return number < int(std::size(kClasses)) ? kClasses[number]
    : number < kFirstOfUsers               ? kReserved
                                           : kUserDefined;
}

bool holdsAsprsClasses(const std::string& array)
{
  const std::string name = "classification";
  const std::string prefix = "scalar_";
  const std::string lowered = vtksys::SystemTools::LowerCase(array);
  return lowered == name || lowered == prefix + name;
}

} // namespace pointhaptics
