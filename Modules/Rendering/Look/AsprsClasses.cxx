#include "AsprsClasses.h"

#include <iterator>

namespace pointhaptics
{
namespace
{

constexpr const char* kNames[] = { "never classified", "unclassified", "ground", "low vegetation",
  "medium vegetation", "high vegetation", "building", "low noise", "reserved", "water", "rail",
  "road surface", "reserved", "wire guard", "wire conductor", "transmission tower", "wire connector",
  "bridge deck", "high noise", "overhead structure", "ignored ground", "snow", "temporal exclusion" };
constexpr int kFirstOfUsers = 64;
constexpr int kLast = 255;

} // namespace

const char* asprsClassName(int number)
{
  if (number < 0 || number > kLast)
  {
    return "no class";
  }
  return number < int(std::size(kNames)) ? kNames[number]
    : number < kFirstOfUsers             ? "reserved"
                                         : "user defined";
}

} // namespace pointhaptics
