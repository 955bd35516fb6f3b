/**
 * @class   vtkHapticProps
 * @brief   what a person sees of the touch: workspace, proxy, normal, hand and force
 *
 * The workspace is a black wire frame. The proxy is a pink sphere of its radius (see
 * SmallestSphereRadius), translucent and pale in free space, where it sits at the hand; solid in contact,
 * where it rests on the surface. A green line stands on the contact point along the surface normal. The HIP
 * (the point the hand holds) is a small blue ball, and an orange arrow from the sphere shows the force on the
 * hand, with a gauge in newtons beside its tip (vtkHapticGauge). What the cloud hides of the last three is
 * drawn faintly over it, so that the hand is never lost inside an object.
 *
 * Use:
 *
 * @code
 * vtkNew< vtkHapticProps > props;
 * props->SetWorkspaceBounds(bounds);
 * props->AddTo(renderer);
 * props->Update(servoLoop.latest().state); // from the GUI thread, as often as wanted
 * @endcode
 *
 * Frame: workspace, metres and newtons. Not thread safe: GUI thread only.
 * @sa vtkInteractorStyleHaptic
 */
#ifndef vtkHapticProps_h
#define vtkHapticProps_h

#include "EventLink.h"      // For the begin of a render
#include "vtkHapticGauge.h" // For the gauge

#include "Haptics/Proxy.h" // For ProxyState

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkArrowSource.h"                // For shapes that change
#include "vtkMatrix4x4.h"                  // For the marks
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkOutlineSource.h"
#include "vtkOverlayActor.h"
#include "vtkWeakPointer.h" // For the renderer

#include <array>

class vtkRenderer;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticProps : public vtkObject
{
public:
  static vtkHapticProps* New();
  vtkTypeMacro(vtkHapticProps, vtkObject);

  /**
   * Box drawn as the wire frame: xmin, xmax, ymin, ymax, zmin, zmax. Its longest edge also sets the size of
   * the HIP ball, the normal's length, the lines, and the length of the force arrow: 6 % of it per newton, at
   * most 40 %. Default: the 10 cm cube about the origin.
   */
  void SetWorkspaceBounds(const double bounds[6]);

  ///@{
  /**
   * The sphere is drawn no smaller than this, metres, and still touches the contact point: a radius of some
   * tenths of a millimetre is a few pixels. Where the camera is so near that this radius is more than 24
   * points of the screen (1/72 inch), it is 24 points. 0 (default): always as large as the proxy.
   */
  vtkSetClampMacro(SmallestSphereRadius, double, 0.0, 1e9);
  vtkGetMacro(SmallestSphereRadius, double);
  ///@}

  /**
   * Shows the wire frame only, as at first, until the next Update().
   */
  void HideTouch();

  /**
   * Show the hand and what it feels (HIP ball, force arrow, gauge) with the touch. Off: proxy sphere and
   * normal only, as in a figure. Default: on.
   */
  void SetHandVisibility(bool visible);

  /**
   * Draw a light line with dark edges about sphere, arrow, normal and HIP: they are seen on every background
   * and every colour of cloud. Lines are as wide as the window's dots per inch say. Not where the hand is
   * not shown. Default: off.
   */
  vtkSetMacro(OutlineVisibility, bool);

  /**
   * Draw the marks in colours that people with colour vision deficiencies tell apart (white normal, yellow
   * sphere, sky-blue HIP, vermilion force), thicker, with the gauge on an opaque plate. Default: off.
   */
  void SetHighContrast(bool high);

  /**
   * The gauge beside the arrow.
   */
  vtkHapticGauge* GetGauge() { return this->Gauge; }

  ///@{
  /**
   * Add all props to @p renderer, or take them out. The renderer is not kept alive.
   */
  void AddTo(vtkRenderer* renderer);
  void RemoveFrom(vtkRenderer* renderer);
  ///@}

  /**
   * Move the props to @p state. True: the picture changed (by more than 1/10000 of the workspace) and is
   * worth a render.
   */
  bool Update(const pointhaptics::ProxyState& state);

  ///@{
  /**
   * Show where a hand in free space would touch: a yellow line from @p hip to @p point of the cloud, and a
   * ring about it, the smaller the nearer. True: the picture changed. GetNearest: the point; whether it is
   * shown.
   */
  bool ShowNearest(const double hip[3], const double point[3]);
  bool HideNearest();
  bool GetNearest(double point[3]) const;
  ///@}

  ///@{
  /**
   * The single actors, for other colours or tests.
   */
  vtkActor* GetProxyActor() { return this->Proxy.actor; }
  vtkActor* GetNormalActor() { return this->Normal.actor; }
  vtkActor* GetHipActor() { return this->Hip.actor; }
  vtkActor* GetForceActor() { return this->Force.actor; }
  vtkActor* GetWorkspaceActor() { return this->Frame; }
  ///@}

protected:
  vtkHapticProps();
  ~vtkHapticProps() override;

private:
  vtkHapticProps(const vtkHapticProps&) = delete;
  void operator=(const vtkHapticProps&) = delete;

  /// A shape of size 1, and the matrix that makes of it what is drawn.
  struct Mark
  {
    vtkNew<vtkOverlayActor> actor;
    vtkNew<vtkMatrix4x4> matrix;

    void setUp(vtkAlgorithmOutput* shape, const double color[3], bool lit, double hidden);
    void place(
      const pointhaptics::Vec3& origin, const pointhaptics::Vec3& along, double length, double thickness);
    pointhaptics::Vec3 column(int column) const;
  };

  /// In the order they are drawn: the sphere lets see what stands in it, and the force hides the normal.
  std::array<vtkOverlayActor*, 4> All() { return { Normal.actor, Proxy.actor, Hip.actor, Force.actor }; }
  template <typename Visit>
  void ForEach(Visit&& visit);
  void SetUpRims(vtkAlgorithmOutput* line);
  void PlaceRims();
  void Place();
  double PointAt(const pointhaptics::Vec3& place) const;
  pointhaptics::Vec3 Lift(
    const pointhaptics::Vec3& center, const pointhaptics::Vec3& along, double way) const;
  double DrawnRadius() const;
  void UpdateAgain();

  double SmallestSphereRadius = 0.0;
  bool HandVisibility = true;
  bool OutlineVisibility = false;
  bool HighContrast = false;
  vtkNew<vtkOutlineSource> Box;
  vtkNew<vtkActor> Frame;
  vtkNew<vtkArrowSource> RimArrows[2];
  Mark Proxy;
  Mark Normal;
  Mark Hip;
  Mark Force;
  /// Light and dark rims of All() the marks in their order, of the way to the nearest point and of its ring:
  /// a ring about a ball, the back of a larger arrow, or a line.
  std::array<std::array<Mark, 2>, 6> Rims;
  bool ShowsNearest = false;
  pointhaptics::Vec3 Nearest;
  pointhaptics::Vec3 NearestTo;
  vtkNew<vtkHapticGauge> Gauge;
  vtkWeakPointer<vtkRenderer> Renderer;
  double Edge = 0.1;
  bool IsShown = false;
  pointhaptics::ProxyState State;
  double ArrowLength = 0.0;
  pointhaptics::EventLink OnStart{ [this]
    {
      this->Place();
      this->PlaceRims();
    } };
};

#endif
