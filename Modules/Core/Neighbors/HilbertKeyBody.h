/// @file
/// Places on Hilbert's curve. Included by one source per instruction set, as NeighborKernelBody.h is.
#pragma once

#include <cstdint>

namespace pointhaptics
{
namespace simd
{
namespace
{

constexpr int kHilbertBits = 10;

/// 10 bits with two free places before every one.
inline std::uint32_t spreadBits(std::uint32_t v)
{
  v = (v | v << 16) & 0x030000FFu;
  v = (v | v << 8) & 0x0300F00Fu;
  v = (v | v << 4) & 0x030C30C3u;
  return (v | v << 2) & 0x09249249u;
}

/// Skilling's AxesToTranspose without branches, then the bits of the three words in turn. A plain loop, for
/// the compiler to vectorise.
void hilbertKeys(
  const std::uint32_t* xs, const std::uint32_t* ys, const std::uint32_t* zs, int count, std::uint32_t* keys)
{
  for (int i = 0; i < count; ++i)
  {
    std::uint32_t x = xs[i];
    std::uint32_t y = ys[i];
    std::uint32_t z = zs[i];
    for (int bit = kHilbertBits - 1; bit > 0; --bit)
    {
      const std::uint32_t low = (1u << bit) - 1u;
      x ^= low & (0u - (x >> bit & 1u));
      const std::uint32_t fromY = 0u - (y >> bit & 1u);
      const std::uint32_t swapY = (x ^ y) & low & ~fromY;
      x ^= swapY ^ (low & fromY);
      y ^= swapY;
      const std::uint32_t fromZ = 0u - (z >> bit & 1u);
      const std::uint32_t swapZ = (x ^ z) & low & ~fromZ;
      x ^= swapZ ^ (low & fromZ);
      z ^= swapZ;
    }
    y ^= x;
    z ^= y;
    std::uint32_t flip = 0;
    for (int bit = kHilbertBits - 1; bit > 0; --bit)
    {
      flip ^= ((1u << bit) - 1u) & (0u - (z >> bit & 1u));
    }
    keys[i] = spreadBits(x ^ flip) << 2 | spreadBits(y ^ flip) << 1 | spreadBits(z ^ flip);
  }
}

}
} // namespace simd
} // namespace pointhaptics
