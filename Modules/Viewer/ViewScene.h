/// @file
/// A cloud as a scene: read, fitted, resampled, coloured, with camera and props.
#pragma once

#include "HapticViewerOptions.h"
#include "LoadedCloud.h"
#include "ShownCloud.h"

#include "ClipBoxMark.h"
#include "CloudOrientation.h"
#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "DistanceMark.h"
#include "Haptics/HapticScene.h"
#include "Haptics/Proxy.h"
#include "IO/Info/LengthUnit.h"
#include "LevelOfDetail.h"
#include "PointHapticsViewerModule.h" // For export macro
#include "ScreenLayout.h"
#include "vtkSplatMapper.h"
#include "vtkWorkspaceBrackets.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkActor;
class vtkCloudAxes;
class vtkHapticProps;
class vtkKernelBandwidthFilter;
class vtkMatrix4x4;
class vtkPolyData;
class vtkRenderer;
class vtkScalarBarActor;
class vtkVoxelMeanResampler;

namespace pointhaptics
{

/// The colour of text on a background of that name.
Vec3 inkOn(const std::string& ground);

/// The background that a picture has: that of its settings, or the nearest one of its theme.
std::string groundOf(const PictureSettings& picture);

/// GUI thread only. Frames: the cloud's (as in the file) and the workspace's; metres in the latter.
class POINTHAPTICSVIEWER_EXPORT ViewScene
{
public:
  ViewScene();
  ~ViewScene();

  /// Reads @p files into one cloud, resamples and shows it. False: @p message says which file and why, and
  /// the scene is as it was before, or that no point lies in the workspace.
  bool open(const std::vector<std::string>& files, const HapticViewerOptions& options, std::string& message);
  /// Shows what loadCloud() made of a request with these @p options; resamples nothing. False: no point lies
  /// in the workspace, @p message says so; the scene shows that.
  bool open(LoadedCloud loaded, const HapticViewerOptions& options, std::string& message);
  /// The points of the file (the default), or the means that are felt. Some colours are of means alone:
  /// while one of them is shown, means are.
  void setShowsFelt(bool felt);
  bool showsFelt() const { return showsFelt_; }
  /// Shows what was measured of a cloud that was opened plain; the camera follows, unless it was moved.
  /// @param waits until it is there. @return whether something is shown otherwise.
  bool followMeasurement(bool waits);
  /// Where @p model, from the file to the workspace, puts what is drawn.
  void placeModel(vtkMatrix4x4* model);
  /// Puts the camera where it sees all of the cloud. @p contact, if given, is turned into view.
  void placeCamera(const ProxyState* contact = nullptr);
  /// Where @p camera says: HapticViewerOptions::camera; nothing where that is empty.
  void setCamera(const std::vector<double>& camera);
  /// Puts the camera @p azimuth degrees to the right of the cloud's front and @p elevation above, with its up
  /// upwards, where the cloud fills the window.
  void lookFrom(double azimuth, double elevation);
  /// As lookFrom(), from the camera's present direction.
  void fitView();
  /// Takes the camera @p degrees about the vertical line through the middle of the cloud: it turns to the
  /// left.
  void turnView(double degrees);
  /// From camera to focal point, as HapticViewerOptions::camera has it: see fitCamera().
  double viewDistance() const;

  /// Draws this and later clouds as @p picture says.
  void setPicture(const PictureSettings& picture);
  /// True if the window shows two pictures: not where it has no buffers for those that are asked for.
  bool isStereo() const;
  const PictureSettings& picture() const { return picture_; }
  /// True if a bar tells which values the colours stand for.
  bool isColoredByMap();
  /// The values at the two ends of the bar.
  std::array<double, 2> shownColorRange();
  struct ColorBarPlace
  {
    double along = 0.0;  ///< 0 at the lower end of the strip of colours, 1 at the upper.
    double pixels = 1.0; ///< Height of the strip.
  };
  /// Where on the strip of colours a place of the window is, in pixels from its lower left corner; nothing:
  /// it is elsewhere.
  std::optional<ColorBarPlace> placeOnColorBar(double x, double y);

  /// Where the nearest point is, in the frame of the file, that is drawn at a place of the window; a voxel
  /// mean while means are drawn. False: none is within 8 pixels.
  bool placeAt(int x, int y, Vec3& place);
  /// Shows nothing outside of HapticViewerOptions::clip @p clip; what is felt follows with clipFelt() and the
  /// next scene.
  void setClip(const std::vector<double>& clip);
  void clipFelt();
  /// The box with its handles.
  ClipBoxMark& clipMark() { return clipMark_; }
  /// Bounds of the cloud's finite points, but for a few far ones, in the frame of the file; empty: there is
  /// none.
  const Bounds& cloudBounds();
  /// PictureSettings::measure in words: the distance, and in a second line that along each axis. Empty: there
  /// is none.
  std::vector<std::string> measuredText() const;

  /// @p layout places the scalar bar and leaves room for the directions of the axes; numbers of axes and
  /// gauge give way to what it places. Without one the bar stands at the right edge. It must live until
  /// leaveLayout().
  void join(ScreenLayout& layout);
  void leaveLayout();

  /// Box, bounds and directions of the cloud's own frame. They stay where the model was until placeAxes().
  void showAxes(bool visible);
  bool showsAxes() const { return wantsAxes_; }
  /// Where @p model, from the file to the workspace, puts the cloud.
  void placeAxes(vtkMatrix4x4* model);

  /// Nothing but the cloud in one colour on white, the workspace, proxy and normal.
  void showFigure(bool figure);
  bool isFigure() const { return figure_; }

  /// Another thing to colour by: one of colorChoices(). It is shown at once where the means have it, else
  /// with the next scene that has; @return whether one is needed, with the filters as they are set now.
  bool setColorBy(const std::string& name);
  const std::string& colorBy() const { return colorBy_; }
  /// True if the picture still waits for what setColorBy() asked for.
  bool awaitsColors() const { return coloredBy_ != colorBy_; }
  /// rgb where there are colours, Height, the array the user named, and what the pipeline makes.
  std::vector<std::string> colorChoices() const;
  /// The whole light on clouds with photographed colours too, and on means that have normals.
  void showAmbient(bool ambient);
  bool isAmbient() const { return ambient_; }
  /// True if the picture needs the residuals of addSurfaceArrays().
  bool wantsResiduals() const;
  /// Makes the arrays of addSurfaceArrays() that the picture needs, and waits for them: for pictures without
  /// a window.
  void completeMeans(bool useCovariance);
  /// To be called when the means are others: colours what has come, and follows the range of the arrays that
  /// the pipeline makes; those of the file keep the colours they had.
  void meansChanged();

  /// Unit vector along an axis of the workspace, from its centre to the side the person looks from.
  Vec3 towardsViewer() const { return orientation_.front; }
  /// Scene of the shown means; takes the one that came with the cloud where there is one.
  std::shared_ptr<const HapticScene> makeScene(bool useCovariance, Status& status);
  /// False: the cloud has no means yet, until meansChanged().
  bool isResampled() const { return isResampled_; }
  /// LoadedCloud::findsLattice.
  bool findsLattice() const { return findsLattice_; }
  /// How often clouds were resampled for this scene: by loadCloud(), or by the filters below.
  int resamplings() const { return resamplings_; }
  /// describeScale() of the model as it was opened.
  const std::string& scaleNote() const { return scaleNote_; }
  /// Unit of the file in texts: as the options say, else as the file says, else metres.
  const LengthUnit& unit() const { return unit_; }
  /// The unit that the file seems to have where it is another; the name is empty where it seems to have none.
  const LengthUnit& likelyUnit() const { return likelyUnit_; }
  /// Takes @p unit for the file's in texts. Nothing moves: the model is as large in the hand as it was.
  void setUnit(const LengthUnit& unit);
  vtkMatrix4x4* modelMatrix() { return modelMatrix_; }
  vtkVoxelMeanResampler* resampler() { return resampler_; }
  vtkKernelBandwidthFilter* bandwidth() { return bandwidth_; }
  /// Actor of the felt means, and actor of the file's points.
  vtkActor* actor() { return actor_; }
  vtkActor* pointsActor() { return pointsActor_; }
  const ShownCloud* shown() const { return shown_.get(); }
  /// True while a coarse level of the files is shown.
  bool isCoarse() const { return isCoarse_; }
  /// How a finer level of the same files is shown in the place of this one: see CloudRequest::before. The
  /// colours of open() go on in it.
  ShownRequest showing() const;
  vtkRenderer* renderer() { return renderer_; }
  vtkHapticProps* props() { return props_; }
  /// Off until it is enabled: then the picture must be refined when it rests.
  LevelOfDetail& detail() { return drawsFelt_ ? feltDetail_ : detail_; }
  const LevelOfDetail& detail() const { return drawsFelt_ ? feltDetail_ : detail_; }
  /// The picture rests and can become finer: render it.
  bool refinementDue();
  /// The next frame is as fine as a picture gets, whatever moves: for pictures that are kept.
  void completeNextFrame();
  const Bounds& workspace() const { return workspace_; }
  void getWorkspaceBounds(double bounds[6]) const;
  /// Edges of a voxel, metres; 0 before open().
  void getVoxel(double edges[3]) const;
  /// Text for the window's title: the names of the files.
  const std::string& title() const { return title_; }
  vtkIdType numberOfPoints() const;
  vtkIdType numberOfInvalidPoints() const { return invalidPoints_; } ///< Those of them that are not finite.

private:
  static constexpr double kMemorySeconds = 2.0; ///< After the last of what takes memory for a while.

  void returnMemory();
  /// Ranges of values over which the color maps run.
  struct ColorRange
  {
    std::string coloredBy;
    double heightZero;
    double ofMeans[2];
    double ofPoints[2];
  };
  ColorRange colorRange();
  void keepColorRange(const ColorRange& before);
  void beginFrame();
  double fragments();
  void applyLook();
  void applyColors();
  void colorPoints();
  void chooseDrawn();
  void applyNoise();
  void drawPoints();
  vtkSplatMapper* drawnMapper() { return drawsFelt_ ? mapper_ : pointsMapper_; }
  void chooseArrays();
  void chooseUnit(const LoadedCloud& loaded, const HapticViewerOptions& options);
  void applyPicture();
  double textScale() const;
  ScreenBlock scalarBarBlock();
  void applyProjection();
  void applyPointSizes();
  void applyMarks();
  void placeCamera(const CameraFit& fit);
  CameraFit fitFrom(const CloudLook& look, double turn = 0.0) const;
  CloudLook axisLook() const;
  void configure(const LoadedCloud& loaded, const HapticViewerOptions& options);
  void showMeans(const LoadedCloud& loaded, const HapticViewerOptions& options);

  vtkSmartPointer<vtkPolyData> cloud_;
  vtkNew<vtkMatrix4x4> modelMatrix_;
  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  vtkNew<vtkSplatMapper> mapper_;
  vtkNew<vtkActor> actor_;
  std::shared_ptr<ShownCloud> shown_;
  ShownMeasurement measurement_;
  double memoryDue_ = INFINITY;      ///< When returnMemory() has something to do, by steadySeconds().
  std::vector<double> placedCamera_; ///< As placeCamera() left it.
  double placedDistance_ = 1.0;      ///< viewDistance() of it.
  vtkNew<vtkSplatMapper> pointsMapper_;
  vtkNew<vtkActor> pointsActor_;
  vtkNew<vtkMatrix4x4> pointsMatrix_; ///< From the file to the workspace.
  bool showsFelt_ = false;            ///< As it was asked for.
  bool drawsFelt_ = false;            ///< As it is.
  bool ambient_ = false;
  double loadedScale_ = 1.0; ///< Scale of the model as it was opened.
  vtkNew<vtkWorkspaceBrackets> brackets_;
  vtkNew<vtkScalarBarActor> scalarBar_;
  bool wantsScalarBar_ = false;
  bool layoutPlacesBar_ = false;
  bool barHasRoom_ = true;
  vtkNew<vtkHapticProps> props_;
  vtkNew<vtkCloudAxes> axes_;
  bool wantsAxes_ = false;
  bool figure_ = false;
  std::string colorBy_;
  std::string ownColor_;  ///< An array of the file that the user named.
  std::string coloredBy_; ///< Array by which the picture is coloured now.
  LengthUnit unit_;       ///< Unit of the file.
  LengthUnit likelyUnit_;
  CloudOrientation cloudOrientation_; ///< In the frame of the file.
  PictureSettings picture_;
  bool isCoarse_ = false;
  vtkIdType invalidPoints_ = 0;
  double heightZero_ = 0.0;  ///< See LoadedCloud.
  double fixedPixels_ = 0.0; ///< HapticViewerOptions::pointSize.
  Bounds cloudBounds_;       ///< Bounds of the finite points, as in the file; empty until somebody asks.
  vtkNew<vtkRenderer> renderer_;
  std::vector<double> clip_; ///< As HapticViewerOptions::clip.
  Bounds near_;              ///< LoadedCloud::near.
  ClipBoxMark clipMark_;
  DistanceMark distance_; ///< Before the renderer it goes.
  LevelOfDetail detail_{ renderer_, pointsActor_ };
  LevelOfDetail feltDetail_{ renderer_, actor_ };
  Bounds workspace_;
  CloudOrientation orientation_;
  std::string scaleNote_;
  std::string title_;
  std::shared_ptr<const HapticScene> scene_; ///< Came with the cloud, until it is asked for.
  int resamplings_ = 0;
  bool isResampled_ = true;
  bool findsLattice_ = false;
};

} // namespace pointhaptics
