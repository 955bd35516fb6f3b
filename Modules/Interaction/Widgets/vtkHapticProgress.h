/**
 * @class   vtkHapticProgress
 * @brief   a bar in the middle of the picture: what is being done, how much of it, and how to stop it
 *
 * Of fixed size in pixels. It only shows; who does the work says how far it is, and asks for a render where
 * SetProgress() returns true. GUI thread only.
 * @sa vtkHapticOverlay
 */
#ifndef vtkHapticProgress_h
#define vtkHapticProgress_h

#include "PixelBox.h"                      // For plate and bar
#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkNew.h"                        // For the actors
#include "vtkObject.h"

#include <array>  // For the actors
#include <string> // For the text

class vtkRenderer;
class vtkTextActor;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticProgress : public vtkObject
{
public:
  static vtkHapticProgress* New();
  vtkTypeMacro(vtkHapticProgress, vtkObject);

  /**
   * Shows the bar: @p what is done, such as "reading cloud.ply" (long words are shortened in the middle), and
   * the @p part of it that is, 0 to 1. True: it looks different than before.
   */
  bool SetProgress(const std::string& what, double part);

  /**
   * Hides the bar. True: it was seen before.
   */
  bool Hide();

  /// Text over the bar; empty: the bar is hidden.
  const std::string& GetText() const { return this->ShownText; }

  ///@{
  /**
   * For pointhaptics::ScreenLayout: the pixels that it takes @p part times as large as usual, and where its
   * middle is; at first in the middle of the renderer.
   */
  void Measure(vtkRenderer* renderer, double part, double size[2]);
  void Place(vtkRenderer* renderer, double x, double y);
  ///@}

  ///@{
  /**
   * Add the bar to @p renderer, one at a time, or take it out.
   */
  void AddTo(vtkRenderer* renderer);
  void RemoveFrom(vtkRenderer* renderer);
  ///@}

protected:
  vtkHapticProgress();
  ~vtkHapticProgress() override;

  pointhaptics::PixelBox Plate{ true, 1.0, 1.0, 1.0, 0.88 };
  pointhaptics::PixelBox Trough{ true, 0.80, 0.82, 0.85 };
  pointhaptics::PixelBox Bar{ true, 0.13, 0.40, 0.67 };
  vtkNew<vtkTextActor> Text;
  std::string ShownText;
  int Percent = 0;
  double Scale = 1.0; ///< Pixels per point.

  void PlaceBoxes();
  std::array<vtkActor2D*, 4> All() const;

private:
  vtkHapticProgress(const vtkHapticProgress&) = delete;
  void operator=(const vtkHapticProgress&) = delete;
};

#endif
