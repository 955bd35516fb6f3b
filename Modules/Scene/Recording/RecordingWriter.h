/// @file
/// Writes a recording while the servo loop runs, from its samples and inputs.
#pragma once

#include "Recording.h"

#include "Haptics/ServoLoop.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <cstdio>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics
{

/// Takes what ServoLoop::takeTrace() and takeInputs() give, in the thread that calls these: the servo thread
/// knows nothing of it. Rows wait in an unnamed temporary file, as the header, which has the scenes and
/// events, comes before them; close() puts both into the file, which appears then. One thread.
class POINTHAPTICSSCENE_EXPORT RecordingWriter
{
public:
  /// Begins a recording. It has the samples from the first one on that begins anew (kTickBegins): call
  /// ServoLoop::beginAnew(), or open it before the loop starts. False: @p message says why it cannot be
  /// written, and the cure.
  bool open(const std::string& fileName, const RecordingHeader& header, std::string& message);
  bool isOpen() const { return rows_ != nullptr; }
  /// Whether the hand still has to let go of what it touches.
  bool isWaiting() const { return isOpen() && numberOfTicks_ == 0; }
  /// To be called with all samples of a loop, open or not, after ServoLoop::takeTrace(): it remembers what
  /// was published.
  void add(ServoLoop& loop, const std::vector<ServoSample>& samples);
  ///@{
  /// The same without a loop: what was published before a sample comes before it.
  void publish(PublishedScene scene) { published_.scenes.push_back(std::move(scene)); }
  void publish(PublishedParameters parameters) { published_.parameters.push_back(parameters); }
  void add(const ServoSample& sample);
  ///@}
  /// Sets a marker at @p tick, the newest that is finished, or at the first one while there is none. @return
  /// its number, 1, 2, ..., of that tick's where it has one; 0: nothing is recorded.
  std::uint32_t mark(std::uint64_t tick);
  std::uint64_t numberOfTicks() const { return numberOfTicks_; }
  std::uint32_t numberOfMarkers() const { return markers_; }
  const std::string& fileName() const { return fileName_; }
  /// Ends the recording and writes it. False: @p message says why nothing, or not all, could be written. Of
  /// no effect where none is open.
  bool close(std::string& message);
  /// What ended the recording before close(): ticks that were lost, or a loop that started again; empty:
  /// nothing did.
  const std::string& problem() const { return problem_; }

private:
  struct CloseFile
  {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void addRow(const ServoSample& sample);
  void writeRow(std::uint64_t marksUntil);
  void addEvents(const ServoSample& sample);
  void addEvent(std::uint64_t tick, RecordedEvent::Kind kind, bool on = false);
  void addScene(const ServoSample& sample);
  void addParameters(const ServoSample& sample);
  void addCloud(std::uint64_t number, const std::shared_ptr<const SceneOrigin>& origin);
  void end(const std::string& problem);

  std::string fileName_;
  RecordingHeader header_;
  std::unique_ptr<std::FILE, CloseFile> rows_;
  std::string lines_; ///< Of the header: clouds, parameters and events.
  std::map<std::uint64_t, bool> clouds_;
  std::string row_;                 ///< The newest, without its marker, which may still come.
  std::deque<std::uint64_t> marks_; ///< Ticks of markers that are not written yet, ascending.
  std::uint64_t lastMark_ = 0;      ///< Tick of the newest marker, written or not.
  std::uint32_t markers_ = 0;
  std::uint64_t numberOfTicks_ = 0;
  std::uint64_t lost_ = 0; ///< Samples the loop had lost when the recording began.
  ServoSample last_;
  std::uint32_t lastFlags_ = 0;
  bool lastWriting_ = true;
  std::string problem_;
  ServoInputs published_; ///< From the inputs of the newest sample on.
};

} // namespace pointhaptics
