/// @file
/// A recording felt again while a window shows it.
#pragma once

#include "Core/Base/StoppableThread.h"
#include "Haptics/ServoLoop.h"
#include "Replay.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <mutex>
#include <optional>
#include <string>

class vtkPointSet;

namespace pointhaptics
{

/// Feels the recording in a thread of its own, as fast as it was recorded, or slower where scenes take longer
/// to be made. Each tick is felt once, and its forces do not depend on the machine. Samples are fed to a
/// servo loop, from which the window takes them.
class ReplayPlayer
{
public:
  /// Opens a recording. False: @p message names the fault of the file, or says that @p cloud is another one.
  bool open(const std::string& fileName, vtkPointSet* cloud, std::string& message);
  /// After open(): feeds @p loop, which must outlive stop(), from the first tick on.
  void start(ServoLoop& loop)
  {
    thread_.start([this, &loop] { this->run(loop); });
  }
  void stop() { thread_.stop(); }

  /// The present transform of the model, from the file to the workspace; nothing: it did not move since the
  /// last call.
  std::optional<AffineTransform> takeModel();
  /// Message since the last call: a marker, the end. Empty: none.
  std::string takeMessage();
  const ServoStepSettings& stepSettings() const { return recording_.header.step; }
  /// Parameters that one of the samples fed was felt with.
  const ContactParameters& contactOf(const ServoSample& sample) const
  {
    return recording_.parameters.at(sample.parameters).contact;
  }

private:
  void run(ServoLoop& loop);
  void say(const std::string& news);

  std::string fileName_;
  Recording recording_;
  vtkSmartPointer<vtkPointSet> cloud_;
  std::mutex mutex_;
  std::optional<AffineTransform> model_; ///< Guarded by the mutex, as is the message.
  std::string message_;
  StoppableThread thread_;
};

} // namespace pointhaptics
