// Calls ALSA by its functions' names: its header need not be there, nor its library.
#include "Devices/Sound/ContactTone.h"
#include "Devices/Sound/SoundOutput.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <dlfcn.h>

namespace pointhaptics
{
namespace
{

// Constants of ALSA's interface, which does not change within libasound.so.2.
constexpr int kPlayback = 0;
constexpr int kSigned16 = 2; // little endian
constexpr int kInterleaved = 3;
constexpr unsigned int kLatencyMicroseconds = 30000;
constexpr const char* kDevice = "default";

void ignore(const char*, int, const char*, int, const char*, ...) {}

struct Alsa
{
  void* library = nullptr;
  int (*open)(void**, const char*, int, int) = nullptr;
  int (*setParameters)(void*, int, int, unsigned int, unsigned int, int, unsigned int) = nullptr;
  long (*write)(void*, const void*, unsigned long) = nullptr;
  int (*recover)(void*, int, int) = nullptr;
  int (*drop)(void*) = nullptr;
  int (*close)(void*) = nullptr;
  const char* (*problem)(int) = nullptr;

  template <typename Function>
  bool find(Function& function, const char* name)
  {
    function = reinterpret_cast<Function>(dlsym(this->library, name));
    return function != nullptr;
  }
  bool load(const char* name)
  {
    this->library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    int (*silence)(void (*)(const char*, int, const char*, int, const char*, ...)) = nullptr;
    if (this->library && this->find(silence, "snd_lib_error_set_handler"))
    {
      silence(ignore); // it is said once, below
    }
    return this->library && this->find(this->open, "snd_pcm_open") &&
      this->find(this->setParameters, "snd_pcm_set_params") && this->find(this->write, "snd_pcm_writei") &&
      this->find(this->recover, "snd_pcm_recover") && this->find(this->drop, "snd_pcm_drop") &&
      this->find(this->close, "snd_pcm_close") && this->find(this->problem, "snd_strerror");
  }
};

/// Plays through ALSA. The library stays loaded, as it has threads and handlers of its own.
class Loudspeaker : public SoundOutput
{
public:
  explicit Loudspeaker(const Alsa& alsa)
    : alsa_(alsa)
  {
  }
  ~Loudspeaker() override
  {
    if (pcm_)
    {
      alsa_.drop(pcm_);
      alsa_.close(pcm_);
    }
  }
  bool open(std::string& message)
  {
    int error = alsa_.open(&pcm_, kDevice, kPlayback, 0);
    if (error < 0)
    {
      pcm_ = nullptr;
    }
    else
    {
      error = alsa_.setParameters(pcm_, kSigned16, kInterleaved, 1,
        static_cast<unsigned int>(ContactTone::kSamplesPerSecond), 1, kLatencyMicroseconds);
    }
    if (error < 0)
    {
      message = std::string("the machine's sound output \"") + kDevice +
        "\" cannot be opened: " + alsa_.problem(error) +
        "; connect one, or end what uses it, and look at what aplay -L lists";
    }
    return error >= 0;
  }
  bool write(const float* samples, std::size_t count, std::string& message) override
  {
    while (count > 0)
    {
      const std::size_t some = std::min(count, block_.size());
      std::transform(samples, samples + some, block_.begin(),
        [](float sample)
        { return static_cast<std::int16_t>(std::lround(32767.0F * std::clamp(sample, -1.0F, 1.0F))); });
      long written = alsa_.write(pcm_, block_.data(), some);
      if (written < 0)
      {
        // The buffer ran empty, or the machine slept.
        const int error = alsa_.recover(pcm_, static_cast<int>(written), 1);
        if (error < 0)
        {
          message = std::string("the machine's sound output failed: ") + alsa_.problem(error) +
            "; look whether it is still connected, and begin again";
          return false;
        }
        written = 0;
      }
      samples += written;
      count -= static_cast<std::size_t>(written);
    }
    return true;
  }

private:
  Alsa alsa_;
  void* pcm_ = nullptr;
  std::array<std::int16_t, 1024> block_{};
};

} // namespace

std::unique_ptr<SoundOutput> openLoudspeaker(std::string& message, const char* library)
{
  Alsa alsa;
  if (!alsa.load(library))
  {
    message = std::string("sound needs ") + library +
      ", which is not there; install ALSA's library (Debian: libasound2), or write the sound to a file with "
      "feel --sound-file";
    return nullptr;
  }
  auto loudspeaker = std::make_unique<Loudspeaker>(alsa);
  return loudspeaker->open(message) ? std::move(loudspeaker) : nullptr;
}

} // namespace pointhaptics
