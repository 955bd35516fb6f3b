/// @file
/// A recording felt again while a window shows it.
#pragma once

#include "Core/Base/StoppableThread.h"
#include "Haptics/ServoLoop.h"
#include "Replay.h"

#include "vtkSmartPointer.h"

#include <memory>
#include <mutex>
#include <string>

class vtkPointSet;

namespace pointhaptics
{

/// Feels the recording in a thread of its own, as fast as it was recorded or, where scenes take longer to be
/// made than then, slower: each tick is felt once, and its forces do not depend on the machine. Its samples
/// are fed to a servo loop, from which the window has them.
class ReplayPlayer
{
public:
  /// False: @p message says what is wrong with the file, or that @p cloud is another one.
  bool open(const std::string& fileName, vtkPointSet* cloud, std::string& message);
  /// After open(): feeds @p loop, which must outlive stop(), from the first tick on.
  void start(ServoLoop& loop);
  void stop() { thread_.stop(); }

  /// Where the model is by now: from the file to the workspace. False: it was not moved since the last call.
  bool takeModel(AffineTransform& model);
  /// What there is to say: a marker, the end. Empty: nothing since the last call.
  std::string takeMessage();
  const ServoStepSettings& stepSettings() const { return recording_.header.step; }
  /// What one of the samples fed was felt with.
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
  AffineTransform model_; ///< This and the following under the mutex.
  bool hasModel_ = false;
  std::string message_;
  StoppableThread thread_;
};

} // namespace pointhaptics
