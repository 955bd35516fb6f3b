/// @file
/// A cloud as a scene: read, fitted, resampled, coloured, with camera and props.
#pragma once

#include "ClippedCloud.h"
#include "HapticViewerOptions.h"
#include "LoadedCloud.h"
#include "ShownCloud.h"

#include "ClipBoxMark.h"
#include "CloudOrientation.h"
#include "Core/Base/AffineTransform.h"
#include "Core/Base/PointView.h"
#include "DistanceMark.h"
#include "EventLink.h"
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
class vtkLookupTable;
class vtkMatrix4x4;
class vtkPolyData;
class vtkRenderer;
class vtkScalarBarActor;
class vtkVoxelMeanResampler;

namespace pointhaptics
{

/// The colour of text on a background of that name.
Vec3 inkOn(const std::string& ground);

/// Background of a picture: that of its settings, or the nearest one of its theme.
std::string groundOf(const PictureSettings& picture);

/// Points of a profile: way along the line, and height along the up axis, in the unit of the cloud.
using ProfilePoints = std::vector<std::array<double, 2>>;

/// GUI thread only. Frames: the cloud's (as in the file) and the workspace's; metres in the latter.
class POINTHAPTICSVIEWER_EXPORT ViewScene
{
public:
  ViewScene();
  ~ViewScene();

  /// Shows what loadCloud() made of a request with these @p options; resamples nothing. False: no point lies
  /// in the workspace, @p message says so; the scene shows that.
  bool open(LoadedCloud loaded, const HapticViewerOptions& options, std::string& message);
  /// Chooses between the points of the file (the default) and the felt means. Some colours belong to means
  /// alone: while one of them is shown, means are. @return as setColorBy()
  bool setShowsFelt(bool felt);
  /// Shows the finished measurement of a cloud that was opened plain; the camera follows, unless it was
  /// moved. @param waits until it is there. @return true if the picture changed.
  bool followMeasurement(bool waits);
  /// Part of the measurement that is done, 0 to 1; nothing: none is under way.
  std::optional<double> measuredPart() const
  {
    return loaded_.measurement ? std::optional(loaded_.measurement->part()) : std::nullopt;
  }
  /// Draws the model where @p model, from the file to the workspace, puts it.
  void placeModel(vtkMatrix4x4* model);
  /// Puts the camera where it sees all of the cloud. @p contact, if given, is turned into view.
  void placeCamera(const ProxyState* contact = nullptr);
  /// Sets the camera to @p camera, as HapticViewerOptions::camera; empty: leaves it.
  void setCamera(const std::vector<double>& camera);
  /// Puts the camera @p azimuth degrees to the right of the cloud's front and @p elevation above, with its up
  /// upwards, where the cloud fills the window.
  void lookFrom(double azimuth, double elevation);
  /// As lookFrom(), from the camera's present direction.
  void fitView();
  /// Turns the camera by @p degrees about the vertical line through the middle of the cloud, to the left.
  void turnView(double degrees);
  /// Makes @p place, in the frame of the file, the focal point, in the same direction.
  void centerView(const Vec3& place);
  /// Moves the camera along the horizon, and upwards; metres of the workspace.
  void walk(double right, double up, double forward);
  /// Turns the camera on its place, degrees to the right and downwards; the horizon stays level.
  void lookAround(double right, double down);
  /// Distance from the camera to its focal point, as HapticViewerOptions::camera has it: see fitCamera().
  double viewDistance() const;

  /// Draws this and later clouds as @p picture says.
  void setPicture(const PictureSettings& picture);
  /// True if the window shows two pictures; it may lack the buffers for the requested ones.
  bool isStereo() const;
  const PictureSettings& picture() const { return picture_; }
  /// True if a bar shows which values the colours stand for.
  bool isColoredByMap();
  /// What the picture is coloured by, as findColorSource() takes it.
  std::string colorArray() const { return coloredBy_.empty() ? shown_->colors.array : coloredBy_; }
  /// The values at the two ends of the bar.
  std::array<double, 2> shownColorRange();
  struct ColorBarPlace
  {
    double along = 0.0;  ///< 0 at the lower end of the strip of colours, 1 at the upper.
    double pixels = 1.0; ///< Height of the strip.
  };
  /// Finds the place on the strip of colours under a place of the window, in pixels from its lower left
  /// corner; nothing: it is elsewhere.
  std::optional<ColorBarPlace> placeOnColorBar(double x, double y);

  /// Finds the nearest point drawn at a place of the window, in the frame of the file; a voxel mean while
  /// means are drawn. False: none is within 8 pixels.
  bool placeAt(int x, int y, Vec3& place);
  /// Number in the legend of classes or files whose colour or name is at a place of the window; nothing: none
  /// is there.
  std::optional<double> labelOnColorBar(double x, double y);
  /// Names of the files of a cloud of several; touch and picture have those that are not hidden.
  std::vector<std::string> fileNames() const;
  /// True for heights and arrays of the files; others are computed for the present picture alone.
  bool canHideBy(const std::string& array) const;
  /// Hides all outside of HapticViewerOptions::clip @p clip; touch follows with clipFelt() and the next
  /// scene.
  void setClip(const std::vector<double>& clip);
  void clipFelt();
  /// The box with its handles.
  ClipBoxMark& clipMark() { return clipMark_; }
  /// Bounds of the cloud's finite points, but for a few far ones, in the frame of the file; empty: there is
  /// none.
  const Bounds& cloudBounds();
  /// Bounds of what setClip() leaves.
  Bounds shownBox() { return clipBox(clip_, loaded_.cloud).value_or(this->cloudBounds()); }
  /// In the frame that is drawn; its coordinates are the file's but for degrees: see toLocalFrame().
  vtkPolyData* cloud() { return loaded_.cloud; }
  /// PictureSettings::measure in words: the distance, and in a second line that along each axis. Empty: there
  /// is none.
  std::vector<std::string> measuredText() const;

  /// Heights of the shown points near the line of PictureSettings::measure; empty: there is none.
  ProfilePoints profile() const;

  /// @p layout places the scalar bar and leaves room for the directions of the axes; numbers of axes and
  /// gauge give way to what it places. Without one the bar stands at the right edge. The layout must live
  /// until leaveLayout().
  void join(ScreenLayout& layout);
  void leaveLayout();

  /// Shows box, bounds and directions of the cloud's own frame. They stay at the model's former place until
  /// placeAxes().
  void showAxes(bool visible);
  bool showsAxes() const { return wantsAxes_; }
  /// Places the axes for @p model, from the file to the workspace.
  void placeAxes(vtkMatrix4x4* model);

  /// Shows only the cloud in one colour on white, the workspace, proxy and normal.
  void showFigure(bool figure);
  bool isFigure() const { return figure_; }

  /// Colours by @p name, one of colorChoices(): at once where the means have the array, else with the next
  /// scene that has. @return true if such a scene is needed, with the present settings of the filters.
  bool setColorBy(const std::string& name);
  const std::string& colorBy() const { return colorBy_; }
  /// True while the picture waits for the colours of setColorBy().
  bool awaitsColors() const { return coloredBy_ != colorBy_; }
  /// Names that setColorBy() takes, each once. The default choice comes first where it has a name; Height,
  /// rgb, known arrays of the file, the array that the user named, Clay and the arrays of the pipeline
  /// follow.
  /// @pre a cloud is shown.
  std::vector<std::string> colorChoices() const;
  /// Lights clouds with photographed colours fully too, and means that have normals.
  void showAmbient(bool ambient);
  /// True if the picture needs the residuals of addSurfaceArrays().
  bool wantsResiduals() const;
  /// Makes the arrays of addSurfaceArrays() that the picture needs, and waits for them: for pictures without
  /// a window.
  void completeMeans(bool useCovariance);
  /// Call it when the means changed: colours those that have come, and follows the range of the arrays of the
  /// pipeline; arrays of the file keep their colours.
  void meansChanged();

  /// The up axis in the frame of the cloud.
  const Vec3& cloudUp() const { return loaded_.orientation.up; }
  bool isUpGuessed() const { return loaded_.orientation.isGuess; }
  /// Unit vector along an axis of the workspace, from its centre to the side the person looks from.
  Vec3 towardsViewer() const;
  /// Scene of the shown means; takes the one that came with the cloud where there is one.
  std::shared_ptr<const HapticScene> makeScene(bool useCovariance, Status& status);
  /// False: the cloud has no means yet, until meansChanged().
  bool isResampled() const { return loaded_.isResampled; }
  /// LoadedCloud::findsLattice.
  bool findsLattice() const { return loaded_.findsLattice; }
  /// Number of times that clouds were resampled for this scene: by loadCloud(), or by the filters below.
  int resamplings() const { return resamplings_; }
  /// describeScale() of the model as it was opened.
  std::string scaleNote() const;
  /// Unit of the file in texts: as the options say, else as the file says, else metres.
  const LengthUnit& unit() const { return unit_; }
  /// Unit that the file seems to have, where it is another; the name is empty where it seems to have none.
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
  bool isCoarse() const { return loaded_.isCoarse; }
  /// Request to show a finer level of the same files in place of this one: see CloudRequest::before. It keeps
  /// the colours of open().
  ShownRequest showing() const;
  vtkRenderer* renderer() { return renderer_; }
  vtkHapticProps* props() { return props_; }
  /// Off until it is enabled: then the picture must be refined when it rests.
  LevelOfDetail& detail() { return drawsFelt_ ? feltDetail_ : detail_; }
  const LevelOfDetail& detail() const { return drawsFelt_ ? feltDetail_ : detail_; }
  /// True if the picture rests and can become finer: render it.
  bool refinementDue();
  const Bounds& workspace() const { return loaded_.workspace; }
  std::array<double, 6> workspaceBounds() const;
  /// Mean edge of a voxel, metres; 0 before open().
  double voxelSize() const;
  /// Text for the window's title: the names of the files.
  const std::string& title() const { return loaded_.title; }
  vtkIdType numberOfPoints() const;
  /// Number of points that are not finite.
  vtkIdType numberOfInvalidPoints() const { return loaded_.invalid; }

private:
  static constexpr double kMemorySeconds = 2.0; ///< Delay after the last work that needs memory.

  void returnMemory();
  /// Ranges of values over which the color maps run.
  struct ColorRange
  {
    std::string coloredBy;
    double ofMeans[2];
    double ofPoints[2];
  };
  ColorRange colorRange();
  void keepColorRange(const ColorRange& before);
  void beginFrame();
  void applyLook();
  void applyColors();
  void colorPoints();
  void chooseDrawn();
  void applyNoise();
  void drawPoints();
  vtkSplatMapper* drawnMapper() { return drawsFelt_ ? mapper_ : pointsMapper_; }
  void chooseArrays();
  void chooseUnit(const HapticViewerOptions& options);
  void applyPicture();
  double textScale() const;
  ScreenBlock scalarBarBlock();
  void applyProjection();
  void applyPointSizes();
  void applyMarks();
  void applyHidden();
  void markHidden(vtkLookupTable* legend, const std::string& array) const;
  std::optional<ColorBarPlace> placeOnBar(double x, double y, bool besideStrip);
  void placeCamera(const CameraFit& fit);
  CameraFit fitFrom(const CloudLook& look, double turn = 0.0) const;
  CloudLook axisLook() const;
  Vec3 upward() const;
  void turnCamera(const Vec3& about, double degrees, const Vec3& axis);
  void moveCamera(const Vec3& way, const Vec3& wayOfFocus);
  void configure(const HapticViewerOptions& options);
  void showMeans(const HapticViewerOptions& options);

  LoadedCloud
    loaded_; ///< As it was opened, without its means; @c measurement and @c scene until they are used.
  vtkNew<vtkMatrix4x4> modelMatrix_;
  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  vtkNew<vtkSplatMapper> mapper_;
  vtkNew<vtkActor> actor_;
  std::shared_ptr<ShownCloud> shown_;
  double memoryDue_ = INFINITY;      ///< Time at which returnMemory() acts, by steadySeconds().
  std::vector<double> placedCamera_; ///< Camera as placeCamera() left it.
  double placedDistance_ = 1.0;      ///< viewDistance() of that camera.
  vtkNew<vtkSplatMapper> pointsMapper_;
  vtkNew<vtkActor> pointsActor_;
  vtkNew<vtkMatrix4x4> pointsMatrix_; ///< From the file to the workspace.
  bool showsFelt_ = false;            ///< The user asked for the means.
  bool drawsFelt_ = false;            ///< The means are drawn now.
  bool ambient_ = false;
  vtkNew<vtkWorkspaceBrackets> brackets_;
  vtkNew<vtkScalarBarActor> scalarBar_;
  bool wantsScalarBar_ = false; ///< The colours have a scale to show.
  /// The box that a ScreenLayout gave the bar, empty where it has no room; nothing: no layout places it.
  std::optional<ScreenRectangle> barBox_;
  vtkNew<vtkHapticProps> props_;
  vtkNew<vtkCloudAxes> axes_;
  bool wantsAxes_ = false;
  bool figure_ = false;
  std::string colorBy_;
  bool mapsHeights_ = false; ///< colorBy_ stands for the default, as a colour map was asked for.
  std::string ownColor_;     ///< An array of the file that the user named.
  std::string coloredBy_;    ///< Array by which the picture is coloured now.
  LengthUnit unit_;          ///< Unit of the file.
  LengthUnit likelyUnit_;
  PictureSettings picture_;
  double fixedPixels_ = 0.0; ///< HapticViewerOptions::pointSize.
  Bounds cloudBounds_;       ///< Bounds of the finite points, as in the file; empty until somebody asks.
  vtkNew<vtkRenderer> renderer_;
  std::vector<double> clip_; ///< As HapticViewerOptions::clip.
  ClipBoxMark clipMark_;
  DistanceMark distance_; ///< Declared to be destroyed before the renderer.
  LevelOfDetail detail_{ renderer_, pointsActor_ };
  LevelOfDetail feltDetail_{ renderer_, actor_ };
  int resamplings_ = 0;
  EventLink sizing_{ [this] { this->beginFrame(); } };
  EventLink counting_{ [this] { ++resamplings_; } };
};

} // namespace pointhaptics
