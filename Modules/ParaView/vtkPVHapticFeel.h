/**
 * @class   vtkPVHapticFeel
 * @brief   vtkHapticFeel with the lattice among its properties
 *
 * ParaView's panel sets properties of the filter alone, and the lattice belongs to GetResampler(). The
 * workspace is a cube about the cloud, as in `pointhaptics feel`. Results, errors and threads are those of
 * vtkHapticFeel.
 *
 * @sa vtkHapticFeel
 */
#ifndef vtkPVHapticFeel_h
#define vtkPVHapticFeel_h

#include "PointHapticsParaViewModule.h" // For export macro
#include "vtkHapticFeel.h"

class POINTHAPTICSPARAVIEW_EXPORT vtkPVHapticFeel : public vtkHapticFeel
{
public:
  static vtkPVHapticFeel* New();
  vtkTypeMacro(vtkPVHapticFeel, vtkHapticFeel);
  /**
   * Edge of the voxels in metres, felt everywhere, as --voxel of the program; 0: 300 on each axis, finer near
   * the hand where that tells more. Default: 0.
   */
  void SetVoxelSize(double size);

protected:
  vtkPVHapticFeel() = default;
  ~vtkPVHapticFeel() override = default;

private:
  vtkPVHapticFeel(const vtkPVHapticFeel&) = delete;
  void operator=(const vtkPVHapticFeel&) = delete;
};

#endif
