/// @file
/// The files of the window: those that a person steps through, those that are read, and those that are shown.
#pragma once

#include "CloudLoader.h"
#include "FileWatch.h"
#include "HapticViewerOptions.h"
#include "ToolContext.h"

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

class vtkAbstractTransform;

namespace pointhaptics
{

class PictureControls;

/// Files that are being read to be shown.
struct FileLoad
{
  enum class Kind
  {
    New,    ///< To be fitted to the workspace.
    Turned, ///< To be fitted with another axis upwards: what was chosen for them stays.
    Again,  ///< They have changed: model and camera stay.
    Finer,  ///< All points of what is shown coarsely: model, camera and colours stay.
  };
  std::vector<std::string> files;
  Kind kind = Kind::New;
  HapticViewerOptions options;  ///< Options when the load began.
  std::function<void()> then;   ///< Called when the cloud is shown.
  std::function<void()> failed; ///< Called when it cannot be read.
  FileWatch watch;              ///< State of the files before the first byte was read.

  bool isFitted() const { return kind == Kind::New || kind == Kind::Turned; }
};

/// Reads files in the loader's thread and hands the finished cloud to the window. GUI thread only.
class ShownFiles
{
public:
  struct Window
  {
    /// Shows the cloud in the place of the former one.
    std::function<void(LoadedCloud cloud, const FileLoad& load)> show;
    /// Tells the notes of the readers.
    std::function<void(const std::vector<std::string>& notes)> warn;
    std::function<void(const std::string& error)> complain;
    /// Shows the part that is done; no words: nothing is read any more.
    std::function<void(const std::string& words, double part)> progress;
  };

  /// All must outlive this. @p model is the transform of the shown model.
  ShownFiles(const ToolContext& context, PictureControls& controls, const HapticViewerObserver& observer,
    vtkAbstractTransform* model, std::vector<std::string> files, Window window);

  /// The window shows file number @p cloud, or all of them, as it was opened.
  void begin(std::size_t cloud);
  const std::vector<std::string>& shown() const { return shown_; }
  bool areSeveral() const { return files_.size() > 1; }
  bool isReading() const { return loader_.busy(); }
  /// Reads @p files in the place of the present ones.
  void open(const std::vector<std::string>& files);
  /// Reads all points of a cloud that is shown coarsely.
  void refine();
  /// Reads the next file (@p direction 1) or the previous one (-1) that can be read; where they are shown
  /// together, shows one of them alone or all.
  void step(int direction) { this->step(direction, 0); }
  /// Reads the file again with the next axis upwards; the picture stays until then.
  void turnUp();
  /// The axis that points up in @p file: as it was turned here; else that of the options, else as it was
  /// kept.
  std::string upOf(const std::string& file);
  /// At each timer event: shows what was read, and reads what has changed.
  void follow();
  /// Gives up what is being read. False: nothing is.
  bool cancel();
  void stop() { loader_.cancel(); }

private:
  void step(int direction, std::size_t skipped);
  /// @param up axis that points up; empty: upOf() the first file.
  void load(const std::vector<std::string>& files, FileLoad::Kind kind, std::function<void()> then,
    const std::string& up = {});
  void take();
  void end(std::function<void()> FileLoad::*next = nullptr);

  const ToolContext& context_;
  PictureControls& controls_;
  const HapticViewerObserver& observer_;
  const HapticViewerOptions asked_; ///< Options at the start: some are for each new cloud.
  vtkAbstractTransform* model_;
  std::vector<std::string> files_;
  std::size_t index_ = 0;                  ///< Index of the file that was last asked for.
  std::vector<std::string> shown_;         ///< One of files_, or all together.
  std::map<std::string, std::string> ups_; ///< Axes that point up, of files.
  FileWatch watch_;
  int sinceLook_ = 0;
  bool wasFiner_ = false; ///< What is read took the place of the other points of a coarse cloud.
  FileLoad loading_;      ///< Valid while loader_ is busy.
  Window window_;
  CloudLoader loader_;
};

} // namespace pointhaptics
