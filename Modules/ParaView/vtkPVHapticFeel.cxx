#include "vtkPVHapticFeel.h"

#include "vtkVoxelMeanResampler.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPVHapticFeel);

void vtkPVHapticFeel::SetVoxelSize(double size)
{
  pointhaptics::VoxelMeanSettings settings = this->GetResampler()->GetSettings();
  settings.lattice.voxelSize = size;
  this->GetResampler()->SetSettings(settings);
  this->SetRefineNearHand(!(size > 0.0));
}
