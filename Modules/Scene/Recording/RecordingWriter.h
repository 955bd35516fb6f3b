/// @file
/// Writes a recording while the servo loop runs, from its samples and inputs.
#pragma once

#include "CsvWriter.h"
#include "MarkerSocket.h"
#include "Recording.h"

#include "Haptics/ServoLoop.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <array>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace pointhaptics
{

/// Takes what ServoLoop::takeTrace() and takeInputs() give, in the thread that calls these: the servo thread
/// knows nothing of it. What was felt stands in NAME.part within a second (CsvWriter); close() gives it its
/// name. One thread.
class POINTHAPTICSSCENE_EXPORT RecordingWriter
{
public:
  /// Begins a recording. It has the samples from the first one on that begins anew (kTickBegins): call
  /// ServoLoop::beginAnew(), or open it before the loop starts. False: @p message says why it cannot be
  /// written, and the cure.
  bool open(const std::string& fileName, const RecordingHeader& header, std::string& message);
  bool isOpen() const { return table_.isOpen(); }
  /// True if the hand still has to let go of what it touches.
  bool isWaiting() const { return isOpen() && numberOfTicks_ == 0; }
  /// To be called with all samples of a loop, open or not, after ServoLoop::takeTrace(): it remembers what
  /// was published.
  void add(ServoLoop& loop, const std::vector<ServoSample>& samples);
  ///@{
  /// Adds samples without a loop: scenes and parameters published before a sample come before it.
  void publish(PublishedScene scene) { published_.scenes.push_back(std::move(scene)); }
  void publish(PublishedParameters parameters) { published_.parameters.push_back(parameters); }
  void add(const ServoSample& sample);
  ///@}
  /// Sets a marker at @p tick, the newest that is finished, or at the first one while there is none. @return
  /// its number, 1, 2, ...; 0: nothing is recorded. @p text: what the header says of it.
  std::uint32_t mark(std::uint64_t tick, const std::string& text = {});
  /// From here on add() sets the markers that come by @p socket, which outlives this; null: none.
  void follow(MarkerSocket* socket) { socket_ = socket; }
  std::uint64_t numberOfTicks() const { return numberOfTicks_; }
  std::uint32_t numberOfMarkers() const { return markers_; }
  const std::string& fileName() const { return fileName_; }
  /// Ends the recording. False: @p message says why not all could be written. One without a tick leaves no
  /// file: problem() says so. Of no effect where none is open. @p why: reason for which it ends early; empty:
  /// problem(). The last line of the file says it.
  bool close(std::string& message, const std::string& why = {});
  /// Reason for which the recording ended before close(): lost ticks, a loop that started again, a full disk;
  /// empty: it did not.
  const std::string& problem() const { return problem_; }

private:
  static constexpr std::size_t kFelt = std::tuple_size_v<decltype(RecordedTick::felt)>;

  void addRow(const ServoSample& sample);
  void writeRow(std::uint64_t marksUntil);
  void addEvents(const ServoSample& sample);
  void addEvent(std::uint64_t tick, const std::string& event);
  void addScene(const ServoSample& sample);
  void addParameters(const ServoSample& sample);
  void addCloud(std::uint64_t number, const std::shared_ptr<const SceneOrigin>& origin);
  void end(const std::string& problem);

  MarkerSocket* socket_ = nullptr;
  std::string fileName_;
  RecordingHeader header_;
  CsvWriter table_;
  std::set<std::uint64_t> clouds_;      ///< Whose lines are written.
  std::array<double, kFelt + 2> row_{}; ///< The newest; its marker may still come.
  bool hasRow_ = false;
  std::deque<MarkerSocket::Marker> marks_; ///< Not written yet; their ticks ascend.
  std::uint64_t lastMark_ = 0;             ///< Tick of the newest marker, written or not.
  std::uint32_t markers_ = 0;
  std::uint64_t numberOfTicks_ = 0;
  std::uint64_t lost_ = 0; ///< Samples the loop had lost when the recording began.
  ServoSample last_;
  std::uint32_t lastFlags_ = 0;
  std::string problem_;
  ServoInputs published_; ///< From the inputs of the newest sample on.
};

} // namespace pointhaptics
