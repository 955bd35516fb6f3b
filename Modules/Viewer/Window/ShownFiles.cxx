#include "ShownFiles.h"

#include "PictureControls.h"
#include "ViewScene.h"

#include "PolyDataAccess.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace pointhaptics
{
namespace
{

constexpr const char* kAxes[] = { "z", "-z", "y", "-y", "x", "-x" };
/// Timer events, 33 ms apart, between two looks at the files.
constexpr int kLooksApart = 8;

} // namespace

ShownFiles::ShownFiles(const ToolContext& context, PictureControls& controls,
  const HapticViewerObserver& observer, vtkAbstractTransform* model, std::vector<std::string> files,
  Window window)
  : context_(context)
  , controls_(controls)
  , observer_(observer)
  , asked_(context.options)
  , model_(model)
  , files_(std::move(files))
  , window_(std::move(window))
{
}

void ShownFiles::begin(std::size_t cloud)
{
  const bool areAll = context_.options.together || files_.empty();
  shown_ = areAll ? files_ : std::vector<std::string>{ files_[cloud] };
  index_ = context_.options.together ? files_.size() : cloud;
  watch_.watch(shown_);
}

/// Begins to read files; a load in flight is given up.
void ShownFiles::load(const std::vector<std::string>& files, FileLoad::Kind kind, std::function<void()> then,
  const std::string& up)
{
  const bool isNew = kind == FileLoad::Kind::New;
  HapticViewerOptions options = context_.options;
  if (isNew)
  {
    options.clip.clear(); // it is of another cloud, as are colours that nobody asked for on the way in
    options.colorBy = asked_.colorBy;
    options.picture.colorRange = asked_.picture.colorRange;
    options.picture.hidden.clear();
  }
  if (kind == FileLoad::Kind::Turned)
  {
    controls_.forgetHeights(options.picture);
  }
  options.up = up.empty() ? this->upOf(files.front()) : up;
  wasFiner_ = wasFiner_ || loading_.kind == FileLoad::Kind::Finer;
  loading_ = { files, kind, options, std::move(then), {}, FileWatch() };
  loading_.watch.watch(files);
  CloudRequest request(files, options);
  request.makesScene = true;
  request.measuresLater = kind != FileLoad::Kind::Turned;
  request.resamplesLater = true;
  request.mostPoints = loading_.isFitted() ? options.coarsePoints : 0;
  if (kind == FileLoad::Kind::Finer)
  {
    request.before = context_.scene.showing();
  }
  AffineTransform model;
  if (!loading_.isFitted() && affineFromTransform(model_, model))
  {
    request.placement = transformOf(context_.scene.modelMatrix());
    request.model = model;
  }
  loader_.start(std::move(request));
}

void ShownFiles::open(const std::vector<std::string>& files)
{
  const bool areAll = context_.options.together;
  this->load(areAll ? files : std::vector<std::string>{ files.front() }, FileLoad::Kind::New,
    [this, files]
    {
      files_ = files;
      index_ = 0;
    });
}

void ShownFiles::refine()
{
  wasFiner_ = false;
  if (context_.scene.isCoarse())
  {
    const auto say = [this]
    {
      const ViewScene& scene = context_.scene;
      context_.say(fmt::format("{}: all {} points", scene.title(), scene.numberOfPoints()));
    };
    this->load(shown_, FileLoad::Kind::Finer, say);
  }
}

void ShownFiles::follow()
{
  if (loader_.busy())
  {
    this->take();
  }
  if (context_.options.watch && ++sinceLook_ >= kLooksApart && !loader_.busy())
  {
    sinceLook_ = 0;
    if (watch_.look())
    {
      this->load(
        shown_, FileLoad::Kind::Again, [this] { context_.say("read again: " + context_.scene.title()); });
    }
  }
}

/// Takes the cloud, once it is read.
void ShownFiles::take()
{
  LoadedCloud cloud;
  std::string message;
  const bool isFiner = loading_.kind == FileLoad::Kind::Finer;
  if (!loader_.take(cloud, message))
  {
    const CloudLoader::Step step = loader_.step();
    if (loader_.seconds() > kProgressDelay)
    {
      window_.progress(
        step.name + std::string(isFiner ? " all of " : " ") + titleOf(loading_.files), step.part);
    }
    return;
  }
  if (!message.empty())
  {
    window_.complain(message); // the window shows what it showed before
    this->end(&FileLoad::failed);
    wasFiner_ && !loader_.busy() ? this->refine() : void();
    return;
  }
  const std::vector<std::string> notes = isFiner ? std::vector<std::string>() : cloud.notes; // they were told
  shown_ = loading_.files;
  watch_ = loading_.watch;
  window_.show(std::move(cloud), loading_);
  this->end(&FileLoad::then);
  window_.warn(notes);
  this->refine();
}

/// Then what the load asks for: one of its two functions, or nothing.
void ShownFiles::end(std::function<void()> FileLoad::*next)
{
  window_.progress("", 1.0);
  const FileLoad ended = std::exchange(loading_, FileLoad());
  if (next && ended.*next)
  {
    (ended.*next)();
  }
}

bool ShownFiles::cancel()
{
  if (!loader_.busy())
  {
    return false;
  }
  loader_.cancel();
  const bool isFiner = loading_.kind == FileLoad::Kind::Finer;
  context_.say(titleOf(loading_.files) + ": not read" + (isFiner ? " to its end" : "") +
    ", it was cancelled; the " + (isFiner ? "coarse level" : "former cloud") + " stays");
  this->end();
  wasFiner_ ? this->refine() : void();
  return true;
}

/// @param skipped files that could not be read on the way.
void ShownFiles::step(int direction, std::size_t skipped)
{
  if (!this->areSeveral())
  {
    context_.say("there is no other file");
    return;
  }
  const bool together = context_.options.together;
  const std::size_t count = files_.size() + (together ? 1 : 0);
  // The next key continues from here, not from a broken or cancelled file.
  index_ = (index_ + count + std::size_t(direction)) % count;
  if (together)
  {
    controls_.showAlone(index_);
    return;
  }
  this->load({ files_[index_] }, FileLoad::Kind::New,
    [this, index = index_]
    { context_.say(fmt::format("file {} of {}: {}", index + 1, files_.size(), context_.scene.title())); });
  if (skipped + 2 < files_.size()) // the file that is shown is not read again
  {
    loading_.failed = [this, direction, skipped] { this->step(direction, skipped + 1); };
  }
}

void ShownFiles::turnUp()
{
  const bool isTurning = loader_.busy() && loading_.kind == FileLoad::Kind::Turned;
  if (shown_.empty() || (loader_.busy() && loading_.kind == FileLoad::Kind::New))
  {
    context_.say(shown_.empty() ? "the points are of no file" : "a file is being read; turn it after that");
    return;
  }
  // Another key before the turn is seen goes on from its axis.
  const std::string present = isTurning ? loading_.options.up : axisName(context_.scene.cloudUp());
  const auto* found = std::find(std::begin(kAxes), std::end(kAxes), present);
  const std::string next = kAxes[(found - std::begin(kAxes) + 1) % std::size(kAxes)];
  const auto keep = [this, next]
  {
    ups_[shown_.front()] = next;
    observer_.keepUp ? observer_.keepUp(shown_.front(), next) : void();
    context_.say("up: " + next);
  };
  this->load(shown_, FileLoad::Kind::Turned, keep, next);
}

std::string ShownFiles::upOf(const std::string& file)
{
  if (asked_.up == "auto" && ups_.count(file) == 0 && observer_.upOf)
  {
    ups_[file] = observer_.upOf(file);
  }
  const auto found = ups_.find(file);
  return found == ups_.end() || found->second.empty() ? asked_.up : found->second;
}

} // namespace pointhaptics
