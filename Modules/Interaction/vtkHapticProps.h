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

#include "Haptics/Proxy.h" // For ProxyState

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkObject.h"

#include <memory> // For Internals

class vtkActor;
class vtkHapticGauge;
class vtkRenderer;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticProps : public vtkObject
{
public:
  static vtkHapticProps* New();
  vtkTypeMacro(vtkHapticProps, vtkObject);

  /**
   * Box drawn as the wire frame: xmin, xmax, ymin, ymax, zmin, zmax. Its longest edge also sets the size of
   * the HIP ball, the normal's length and the lines. Default: the 10 cm cube about the origin.
   */
  void SetWorkspaceBounds(const double bounds[6]);
  vtkGetVector6Macro(WorkspaceBounds, double);

  ///@{
  /**
   * Length of the force arrow per newton, metres; above 0. An arrow longer than 40 % of the workspace is cut
   * to that. Default: 0.006 m/N.
   */
  vtkSetClampMacro(ForceScale, double, 1e-9, 1e9);
  vtkGetMacro(ForceScale, double);
  ///@}

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
   * Show the gauge beside the force arrow. Default: on.
   */
  void SetGaugeVisibility(bool visible);

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
  void SetOutlineVisibility(bool visible);

  /**
   * Draw the marks in colours that people with colour vision deficiencies tell apart (white normal, yellow
   * sphere, sky-blue HIP, vermilion force), thicker, with the gauge on an opaque plate. Default: off.
   */
  void SetHighContrast(bool high);

  /**
   * The gauge, to set its range.
   */
  vtkHapticGauge* GetGauge();

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
  vtkActor* GetProxyActor();
  vtkActor* GetNormalActor();
  vtkActor* GetHipActor();
  vtkActor* GetForceActor();
  vtkActor* GetWorkspaceActor();
  ///@}

protected:
  vtkHapticProps();
  ~vtkHapticProps() override;

  double WorkspaceBounds[6];
  double SmallestSphereRadius = 0.0;
  double ForceScale = 0.006;
  bool GaugeVisibility = true;
  bool HandVisibility = true;
  bool OutlineVisibility = false;
  bool HighContrast = false;

private:
  vtkHapticProps(const vtkHapticProps&) = delete;
  void operator=(const vtkHapticProps&) = delete;

  void UpdateAgain();

  struct Internals;
  std::unique_ptr<Internals> Parts;
};

#endif
