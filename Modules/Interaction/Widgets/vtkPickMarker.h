/**
 * @class   vtkPickMarker
 * @brief   where the picked point is: its voxel as a box, its bandwidth as three circles, and a cross
 *
 * The cross is of one size on the screen, so that a voxel of a pixel is found; what the cloud hides of the
 * marker is drawn all the same. Frame: workspace, metres. GUI thread only.
 * @sa vtkInteractorStyleHaptic
 */
#ifndef vtkPickMarker_h
#define vtkPickMarker_h

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkObject.h"

#include <memory> // For Internals

class vtkRenderer;

class POINTHAPTICSINTERACTION_EXPORT vtkPickMarker : public vtkObject
{
public:
  static vtkPickMarker* New();
  vtkTypeMacro(vtkPickMarker, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Mark @p point. @param voxel bounds of its voxel, or null: none is drawn. @param bandwidth radius of the
   * circles, metres; 0: none are drawn.
   */
  void Mark(const double point[3], const double voxel[6], double bandwidth);

  ///@{
  /**
   * Show or hide. Default: off until the first Mark().
   */
  void SetVisibility(bool visible);
  bool GetVisibility() const;
  ///@}

  ///@{
  /**
   * Add it to @p renderer, or take it out; once is enough.
   */
  void AddTo(vtkRenderer* renderer);
  void RemoveFrom(vtkRenderer* renderer);
  ///@}

protected:
  vtkPickMarker();
  ~vtkPickMarker() override;

private:
  vtkPickMarker(const vtkPickMarker&) = delete;
  void operator=(const vtkPickMarker&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Parts;
};

#endif
