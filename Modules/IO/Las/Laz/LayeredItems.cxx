#include "IO/Las/Laz/LayeredItems.h"

#include "IO/Las/Laz/ArithmeticDecoder.h"
#include "IO/Las/Laz/ArithmeticEncoder.h"

namespace pointhaptics::io
{

template <typename Coder>
void LayeredItems<Coder>::code(char* records, std::size_t count)
{
  labels_.resize(std::max(labels_.size(), count));
  for (std::size_t point = 0; point < count && !Coder::kEncodes; ++point)
  {
    std::copy_n(first_.data(), first_.size(), records + point * first_.size());
  }
  for (CodedLayer& each : layers_)
  {
    each.isUsed ? std::visit([&](auto& layer) { codeLayer(layer, each.coder, records, count); }, each.layer)
                : void();
  }
}

template <typename Coder>
template <typename OneLayer>
void LayeredItems<Coder>::codeLayer(OneLayer& layer, Coder& stored, char* records, std::size_t count)
{
  Coder coder = std::move(stored); // a local one stays in registers
  for (std::size_t point = 0; point < count; ++point)
  {
    layer.code(coder, labels_[point], records + point * first_.size());
  }
  stored = std::move(coder);
}

template void LayeredItems<ArithmeticDecoder>::code(char*, std::size_t);
template void LayeredItems<ArithmeticEncoder>::code(char*, std::size_t);

} // namespace pointhaptics::io
