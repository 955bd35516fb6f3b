// Files of the window: which are read, and how one comes in the place of another.
#include "ViewWindow.h"

#include "ClippedCloud.h"
#include "PolyDataAccess.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <fmt/format.h>
#include <vtkMatrix4x4.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

namespace pointhaptics
{
namespace
{

constexpr const char* kAxes[] = { "z", "-z", "y", "-y", "x", "-x" };

} // namespace

void ViewWindow::onFilesDropped(void* callData)
{
  auto* names = static_cast<vtkStringArray*>(callData);
  std::vector<std::string> files;
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    files.push_back(names->GetValue(i));
  }
  if (!files.empty())
  {
    this->load(options_.together ? files : std::vector<std::string>{ files.front() }, Load::New,
      [this, files]
      {
        files_ = files;
        fileIndex_ = 0;
      });
  }
}

/// Begins to read files; a load in flight is given up.
void ViewWindow::load(const std::vector<std::string>& files, Load kind, std::function<void()> then)
{
  HapticViewerOptions options = options_;
  if (kind == Load::New)
  {
    options.clip.clear(); // it is of another cloud, as are colours that nobody asked for on the way in
    options.colorBy = asked_.colorBy;
    options.picture.colorRange = asked_.picture.colorRange;
    options.picture.hidden.clear();
  }
  options.up = this->upOf(files.front());
  loading_ = { files, kind, options, std::move(then), {}, FileWatch() };
  loading_.watch.watch(files);
  CloudRequest request(files, options);
  request.makesScene = true;
  request.measuresLater = true;
  request.resamplesLater = true;
  request.mostPoints = kind == Load::New ? options.coarsePoints : 0;
  if (kind == Load::Finer)
  {
    request.before = scene_.showing();
  }
  AffineTransform model;
  if (kind != Load::New && affineFromTransform(style_->GetModelTransform(), model))
  {
    request.placement = transformOf(scene_.modelMatrix());
    request.model = model;
  }
  loader_.start(std::move(request));
}

/// Reads all points of a cloud that is shown coarsely.
void ViewWindow::refine()
{
  this->load(shown_, Load::Finer,
    [this] { this->say(fmt::format("{}: all {} points", scene_.title(), scene_.numberOfPoints())); });
}

/// Called at every timer event.
void ViewWindow::followLoading()
{
  if (!loader_.busy())
  {
    return;
  }
  LoadedCloud cloud;
  std::string message;
  if (!loader_.take(cloud, message))
  {
    const CloudLoader::Step step = loader_.step();
    const std::string words =
      step.name + std::string(loading_.kind == Load::Finer ? " all of " : " ") + titleOf(loading_.files);
    if (loader_.seconds() > kProgressDelay && progress_->SetProgress(words, step.part))
    {
      this->setTitle(words);
      interactor_->Render();
    }
    return;
  }
  if (!message.empty())
  {
    this->say(message, kError); // the window shows what it showed before
    this->endLoading(&Loading::failed);
    return;
  }
  const std::vector<std::string> notes =
    loading_.kind == Load::Finer ? std::vector<std::string>() : cloud.notes; // they were told
  this->show(std::move(cloud));
  this->endLoading(&Loading::then);
  this->warn(notes);
  if (scene_.isCoarse())
  {
    this->refine();
  }
}

/// Reports each note of the readers as a warning.
void ViewWindow::warn(const std::vector<std::string>& notes)
{
  for (const std::string& note : notes)
  {
    observer_.say(kWarning, note);
  }
  if (!notes.empty())
  {
    news_ += (news_.empty() ? "" : "\n") + shortNote(notes);
    this->showNote();
  }
}

/// Then what the load asks for: one of its two functions, or nothing.
void ViewWindow::endLoading(std::function<void()> Loading::*next)
{
  if (progress_->Hide())
  {
    this->setTitle(scene_.title());
    this->forgiveEscape();
    interactor_->Render();
  }
  const Loading ended = std::move(loading_);
  loading_ = Loading();
  if (next && ended.*next)
  {
    (ended.*next)();
  }
}

void ViewWindow::cancelLoading()
{
  loader_.cancel();
  const bool isFiner = loading_.kind == Load::Finer;
  this->say(titleOf(loading_.files) + ": not read" + (isFiner ? " to its end" : "") +
    ", it was cancelled; the " + (isFiner ? "coarse level" : "former cloud") + " stays");
  this->endLoading();
}

void ViewWindow::show(LoadedCloud cloud)
{
  const bool isNew = loading_.kind == Load::New;
  // A file that changed so much that it is placed anew is looked at anew; what was chosen for it stays.
  const bool keepsModel = !isNew && cloud.placement == transformOf(scene_.modelMatrix()) &&
    areAlike(cloud.workspace, scene_.workspace());
  const AffineTransform model = cloud.model;
  std::string message;
  this->endRecording("another cloud is shown");
  if (player_)
  {
    player_->stop(); // it is of the former cloud
  }
  shown_ = loading_.files;
  watch_ = loading_.watch;
  // From here on the window shows the new cloud, also where none of it lies in the workspace.
  if (!scene_.open(std::move(cloud), loading_.options, message))
  {
    this->say(message, kError);
  }
  style_->SetWorkspaceBounds(scene_.workspaceBounds().data());
  style_->SetResampler(scene_.resampler());
  if (isNew)
  {
    options_.colorBy = loading_.options.colorBy;
    options_.picture.colorRange = loading_.options.picture.colorRange;
    options_.picture.measure.clear(); // they were in the first cloud
    options_.picture.hidden.clear();
    clipping_.forget();
  }
  this->setSceneOptions();
  if (!keepsModel)
  {
    this->releaseHand();
  }
  this->adoptModel(model, keepsModel);
  this->followOptions();
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
  scene_.setPicture(options_.picture); // as it is by now
  if (options_.picture.hidden != loading_.options.picture.hidden)
  {
    this->clipFelt();
  }
  if (isNew)
  {
    options_.camera.clear(); // it was for the first cloud
  }
  if (!keepsModel && options_.camera.empty())
  {
    scene_.placeCamera();
  }
  this->setTitle(scene_.title());
  this->showSliderValues();
  style_->GetScenes().poll(); // what is near the hand, before the picture
  this->findIdeal();
  this->followProfile();
}

/// The hand feels nothing until another cloud is there: that one does not come to it as a model that moves.
void ViewWindow::releaseHand()
{
  constexpr int kMostMilliseconds = 100;
  style_->GetScenes().release();
  const bool isFelt = servo_.running() && !player_;
  for (int i = 0; i < kMostMilliseconds && isFelt && servo_.latest().scene != 0; ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Applies the options that keys changed while the cloud was read.
void ViewWindow::followOptions()
{
  if (options_.felt != loading_.options.felt)
  {
    scene_.setShowsFelt(options_.felt);
  }
  if (options_.clip != loading_.options.clip)
  {
    scene_.setClip(options_.clip);
    this->clipFelt();
  }
  if (options_.colorBy != loading_.options.colorBy && scene_.setColorBy(options_.colorBy))
  {
    this->setSceneOptions();
    style_->InvalidateModel();
  }
}

/// Gives the style the model, with the scene that came with the cloud, or with one to be made.
void ViewWindow::giveModel(vtkMatrix4x4* matrix)
{
  if (scene_.isResampled())
  {
    Status status = Status::Ok;
    style_->AdoptModel(matrix, scene_.makeScene(options_.voxels.computeCovariance, status));
  }
  else
  {
    style_->StartModel(matrix, scene_.findsLattice());
  }
}

/// Shows the cloud that was read in the frame in which it was resampled. Moves that the user made meanwhile
/// are repeated where @p keepsModel.
void ViewWindow::adoptModel(const AffineTransform& model, bool keepsModel)
{
  vtkNew<vtkMatrix4x4> kept;
  kept->DeepCopy(style_->GetModelTransform()->GetMatrix());
  AffineTransform keptModel;
  const bool isMoved =
    keepsModel && affineFromTransform(style_->GetModelTransform(), keptModel) && !(keptModel == model);
  vtkNew<vtkMatrix4x4> matrix;
  setElements(matrix, model);
  this->giveModel(matrix);
  if (isMoved)
  {
    style_->SetModelMatrix(kept);
  }
  const double radiusScale = options_.bandwidth.radiusScale;
  const double voxelSize = options_.voxels.lattice.voxelSize;
  const bool isFiner = voxelSize != loading_.options.voxels.lattice.voxelSize;
  if (isFiner)
  {
    scene_.resampler()->SetVoxelSize(voxelSize);
  }
  if (isFiner || radiusScale != loading_.options.bandwidth.radiusScale)
  {
    scene_.bandwidth()->SetRadiusScale(radiusScale);
    style_->InvalidateModel();
  }
}

/// Finds the exact force for the chart, where the shown cloud is a shape that has one.
void ViewWindow::findIdeal()
{
  const std::shared_ptr<IdealForce> ideal = idealFor(scene_, options_);
  wholeIdeal_ = ideal ? std::make_shared<IdealForce>(*ideal) : nullptr;
  style_->GetDisplay().setIdealForce(ideal ? [this, ideal](const ServoSample& sample)
      { return idealForce(*ideal, scene_, sample.state.hip, this->contactOf(sample)); }
                                           : std::function<double(const ServoSample&)>());
}

/// Shows the next file in @p direction that can be read; where they are shown together, one of them alone or
/// all. @param skipped files that could not be read on the way.
void ViewWindow::stepFrom(int direction, std::size_t skipped)
{
  if (files_.size() < 2)
  {
    this->say("there is no other file");
    return;
  }
  const std::size_t count = files_.size() + (options_.together ? 1 : 0);
  // The next key continues from here, not from a broken or cancelled file.
  fileIndex_ = (fileIndex_ + count + std::size_t(direction)) % count;
  if (options_.together)
  {
    controls_.showAlone(fileIndex_);
    return;
  }
  this->load({ files_[fileIndex_] }, Load::New,
    [this, index = fileIndex_]
    { this->say(fmt::format("file {} of {}: {}", index + 1, files_.size(), scene_.title())); });
  if (skipped + 2 < files_.size()) // the file that is shown is not read again
  {
    loading_.failed = [this, direction, skipped] { this->stepFrom(direction, skipped + 1); };
  }
}

/// Reads the file again with the next axis upwards.
void ViewWindow::turnUp()
{
  const std::string present = axisName(scene_.cloudUp());
  const auto* found = std::find(std::begin(kAxes), std::end(kAxes), present);
  const std::string next = kAxes[(found - std::begin(kAxes) + 1) % std::size(kAxes)];
  if (shown_.empty() || loader_.busy())
  {
    this->say(shown_.empty() ? "the points are of no file" : "a file is being read; turn it after that");
    return;
  }
  ups_[shown_.front()] = next;
  if (observer_.keepUp)
  {
    observer_.keepUp(shown_.front(), next);
  }
  this->load(shown_, Load::New, [this, next] { this->say("up: " + next); });
}

/// The axis that points up in @p file: as it was turned here; else that of the options, else as it was kept.
std::string ViewWindow::upOf(const std::string& file)
{
  if (asked_.up == "auto" && ups_.count(file) == 0 && observer_.upOf)
  {
    ups_[file] = observer_.upOf(file);
  }
  const auto found = ups_.find(file);
  return found == ups_.end() || found->second.empty() ? asked_.up : found->second;
}

} // namespace pointhaptics
