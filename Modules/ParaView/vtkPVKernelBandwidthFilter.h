/**
 * @class   vtkPVKernelBandwidthFilter
 * @brief   vtkDistributedKernelBandwidthFilter that says an error once
 *
 * ParaView updates a filter several times for one action of a person. Results and threads are those of
 * vtkDistributedKernelBandwidthFilter.
 *
 * @sa vtkDistributedKernelBandwidthFilter
 */
#ifndef vtkPVKernelBandwidthFilter_h
#define vtkPVKernelBandwidthFilter_h

#include "PointHapticsParaViewModule.h" // For export macro
#include "vtkDistributedKernelBandwidthFilter.h"

class POINTHAPTICSPARAVIEW_EXPORT vtkPVKernelBandwidthFilter : public vtkDistributedKernelBandwidthFilter
{
public:
  static vtkPVKernelBandwidthFilter* New();
  vtkTypeMacro(vtkPVKernelBandwidthFilter, vtkDistributedKernelBandwidthFilter);

protected:
  vtkPVKernelBandwidthFilter() { this->RepeatsErrors = false; }
  ~vtkPVKernelBandwidthFilter() override = default;

private:
  vtkPVKernelBandwidthFilter(const vtkPVKernelBandwidthFilter&) = delete;
  void operator=(const vtkPVKernelBandwidthFilter&) = delete;
};

#endif
