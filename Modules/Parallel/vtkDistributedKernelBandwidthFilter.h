/**
 * @class   vtkDistributedKernelBandwidthFilter
 * @brief   vtkKernelBandwidthFilter for points that lie on several processes
 *
 * Each process gives its points as input and gets them with their bandwidths, radii and densities as output:
 * those of vtkKernelBandwidthFilter for the points of all ranks, one rank after the other, bit for bit,
 * however many processes there are and however the points are split.
 *
 * Ranks exchange points for slabs of space and ghosts about them, and search neighbours there. Whether all of
 * a neighbourhood was found is looked at; where not, ghosts are asked for again in a range that is certain to
 * do. What is sent is in proportion to the points.
 *
 * Properties are those of vtkKernelBandwidthFilter and must be the same on all ranks. Update() is collective:
 * all ranks of the controller call it. AbortExecute is not looked at, as other ranks would wait.
 * Composite datasets are refused: ranks may have other blocks. Where the controller has one process, all is
 * as in vtkKernelBandwidthFilter.
 *
 * @sa vtkKernelBandwidthFilter vtkMultiProcessController
 */
#ifndef vtkDistributedKernelBandwidthFilter_h
#define vtkDistributedKernelBandwidthFilter_h

#include "PointHapticsParallelModule.h" // For export macro
#include "vtkKernelBandwidthFilter.h"
#include "vtkMultiProcessController.h" // For Controller
#include "vtkSmartPointer.h"           // For Controller

class POINTHAPTICSPARALLEL_EXPORT vtkDistributedKernelBandwidthFilter : public vtkKernelBandwidthFilter
{
public:
  static vtkDistributedKernelBandwidthFilter* New();
  vtkTypeMacro(vtkDistributedKernelBandwidthFilter, vtkKernelBandwidthFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The processes that share the cloud: a vtkMPIController, or null for this process alone. Default: the
   * global controller.
   */
  vtkSetSmartPointerMacro(Controller, vtkMultiProcessController);
  vtkGetSmartPointerMacro(Controller, vtkMultiProcessController);
  ///@}

  /**
   * Bytes that this rank has sent to others in the last update.
   */
  vtkGetMacro(NumberOfBytesSent, vtkTypeInt64);

protected:
  vtkDistributedKernelBandwidthFilter();
  ~vtkDistributedKernelBandwidthFilter() override;

#ifndef __VTK_WRAP__
  std::string ProblemOf(vtkDataObject* input) override;
  bool SaysAgain() const override;
  pointhaptics::Status Estimate(const pointhaptics::PointView& points, const std::vector<double>& counts,
    pointhaptics::BandwidthsOfPoints& found) override;
#endif

private:
  vtkSmartPointer<vtkMultiProcessController> Controller;
  vtkTypeInt64 NumberOfBytesSent = 0;

  vtkDistributedKernelBandwidthFilter(const vtkDistributedKernelBandwidthFilter&) = delete;
  void operator=(const vtkDistributedKernelBandwidthFilter&) = delete;
};

#endif
