// How one cloud comes in the place of another.
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
#include <thread>

namespace pointhaptics
{
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
    files_.open(files);
  }
}

/// Shows the part of the files that is read, or hides the bar.
void ViewWindow::showProgress(const std::string& words, double part)
{
  if (!words.empty() && progress_->SetProgress(words, part))
  {
    this->setTitle(words);
    interactor_->Render();
  }
  else if (words.empty() && progress_->Hide())
  {
    this->setTitle(scene_.title());
    this->forgiveEscape();
    interactor_->Render();
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

void ViewWindow::show(LoadedCloud cloud, const FileLoad& load)
{
  const bool isNew = load.kind == FileLoad::Kind::New;
  // A file that changed so much that it is placed anew is looked at anew; what was chosen for it stays.
  const bool keepsModel = !load.isFitted() && cloud.placement == transformOf(scene_.modelMatrix()) &&
    areAlike(cloud.workspace, scene_.workspace());
  const AffineTransform model = cloud.model;
  std::string message;
  this->endRecording("another cloud is shown");
  if (player_)
  {
    player_->stop(); // it is of the former cloud
  }
  if (load.kind == FileLoad::Kind::Turned)
  {
    controls_.forgetHeights(options_.picture);
  }
  // From here on the window shows the new cloud, also where none of it lies in the workspace.
  if (!scene_.open(std::move(cloud), load.options, message))
  {
    this->say(message, kError);
  }
  style_->SetWorkspaceBounds(scene_.workspaceBounds().data());
  style_->SetResampler(scene_.resampler());
  if (isNew)
  {
    options_.colorBy = load.options.colorBy;
    options_.picture.colorRange = load.options.picture.colorRange;
    options_.picture.measure.clear(); // they were in the first cloud
    options_.picture.hidden.clear();
    clipping_.forget();
  }
  this->setSceneOptions();
  if (!keepsModel)
  {
    this->releaseHand();
  }
  this->adoptModel(model, keepsModel, load.options);
  this->followOptions(load.options);
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
  scene_.setPicture(options_.picture); // as it is by now
  if (options_.picture.hidden != load.options.picture.hidden)
  {
    this->clipFelt();
  }
  if (load.isFitted())
  {
    options_.camera.clear(); // it was for the first cloud
  }
  if (!keepsModel && options_.camera.empty())
  {
    scene_.placeCamera();
  }
  style_->GetStatus().setEmptyCause(this->hiddenWords());
  this->setTitle(scene_.title());
  this->showSliderValues();
  style_->GetScenes().poll(); // its scene is made while the picture is drawn
  this->findIdeal();
  profile_.follow();
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
void ViewWindow::followOptions(const HapticViewerOptions& then)
{
  bool waits = options_.felt != then.felt && scene_.setShowsFelt(options_.felt);
  if (options_.clip != then.clip)
  {
    scene_.setClip(options_.clip);
    this->clipFelt();
  }
  waits = (options_.colorBy != then.colorBy && scene_.setColorBy(options_.colorBy)) || waits;
  if (waits)
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
void ViewWindow::adoptModel(const AffineTransform& model, bool keepsModel, const HapticViewerOptions& then)
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
  const bool isFiner = voxelSize != then.voxels.lattice.voxelSize;
  if (isFiner)
  {
    scene_.resampler()->SetVoxelSize(voxelSize);
  }
  if (isFiner || radiusScale != then.bandwidth.radiusScale)
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

} // namespace pointhaptics
