#include "vtkPVKernelBandwidthFilter.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPVKernelBandwidthFilter);
