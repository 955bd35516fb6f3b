/**
 * @class   vtkHapticOverlay
 * @brief   words over the picture: a status line, and the list of keys on request
 *
 * Text on a translucent plate, so that it reads on every cloud. GUI thread only.
 * @sa vtkInteractorStyleHaptic
 */
#ifndef vtkHapticOverlay_h
#define vtkHapticOverlay_h

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkNew.h"                        // For the actors
#include "vtkObject.h"

#include <string> // For the texts

class vtkRenderer;
class vtkTextActor;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticOverlay : public vtkObject
{
public:
  static vtkHapticOverlay* New();
  vtkTypeMacro(vtkHapticOverlay, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Text at the upper left, one or more lines; empty hides it. True: it is another text than before.
   */
  bool SetStatus(const std::string& text);

  /**
   * Text of the help plate in the middle. Default: the keys and drags of vtkInteractorStyleHaptic.
   */
  void SetHelp(const std::string& text);

  ///@{
  /**
   * Show the help. Default: off.
   */
  void SetHelpVisibility(bool visible);
  bool GetHelpVisibility() const;
  ///@}

  ///@{
  /**
   * Add both to @p renderer, or take them out.
   */
  void AddTo(vtkRenderer* renderer);
  void RemoveFrom(vtkRenderer* renderer);
  ///@}

protected:
  vtkHapticOverlay();
  ~vtkHapticOverlay() override;

  vtkNew<vtkTextActor> Status;
  vtkNew<vtkTextActor> Help;
  std::string StatusText;

private:
  vtkHapticOverlay(const vtkHapticOverlay&) = delete;
  void operator=(const vtkHapticOverlay&) = delete;
};

#endif
