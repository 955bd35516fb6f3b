/**
 * @class   vtkDistributedVoxelMeanResampler
 * @brief   vtkVoxelMeanResampler for points that lie on several processes
 *
 * Each process gives its points as input and gets a part of the voxels as output: contiguous ranges of voxel
 * indices with about as many voxels each. The outputs of all ranks, by rank one after the other, are the
 * output of vtkVoxelMeanResampler for all points, bit for bit: however many processes there are and however
 * the points are split. That holds for points, counts, covariances and averaged arrays.
 *
 * Each rank accumulates its points on the common lattice; the sums of voxels, which are exact integers, are
 * exchanged by ranges of voxel indices and merged. What is sent is in proportion to the active voxels (64
 * bytes each, 160 with covariances, and 8 to 16 for each number of an array; of categorical arrays up to 16
 * for each value that occurs in a voxel), not to the points.
 *
 * Properties are those of vtkVoxelMeanResampler and must be the same on all ranks; so must be the names,
 * types and components of the arrays, but for ranks without points, which may have none. The numbers of
 * clipped and invalid points are those of all ranks. Other representatives than the mean need the points of a
 * voxel together: points, not sums, go to the rank that has their voxel. ComputeVoxelIndex numbers the voxels
 * of all ranks, KeepOriginalPointIds the points.
 *
 * Update() is collective: all ranks of the controller call it. AbortExecute is not looked at, as other ranks
 * would wait. Composite datasets are refused: ranks may have other blocks. Where the controller has one
 * process, all is as in vtkVoxelMeanResampler. Memory: a second pass over the points where there are arrays;
 * else as vtkVoxelMeanResampler, and the messages.
 *
 * @sa vtkVoxelMeanResampler vtkMultiProcessController
 */
#ifndef vtkDistributedVoxelMeanResampler_h
#define vtkDistributedVoxelMeanResampler_h

#include "PointHapticsParallelModule.h" // For export macro
#include "vtkMultiProcessController.h"  // For Controller
#include "vtkVoxelMeanResampler.h"

class POINTHAPTICSPARALLEL_EXPORT vtkDistributedVoxelMeanResampler : public vtkVoxelMeanResampler
{
public:
  static vtkDistributedVoxelMeanResampler* New();
  vtkTypeMacro(vtkDistributedVoxelMeanResampler, vtkVoxelMeanResampler);
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
  vtkDistributedVoxelMeanResampler();
  ~vtkDistributedVoxelMeanResampler() override;

#ifndef __VTK_WRAP__
  std::string ProblemOf(vtkDataObject* input) override;
  bool SaysAgain() const override;
  bool BeginRun(const Clouds& clouds) override;
  bool RunCloud(vtkPointSet* cloud, const Outputs& outputs) override;
#endif

private:
  vtkSmartPointer<vtkMultiProcessController> Controller;
  vtkTypeInt64 NumberOfBytesSent = 0;

  vtkDistributedVoxelMeanResampler(const vtkDistributedVoxelMeanResampler&) = delete;
  void operator=(const vtkDistributedVoxelMeanResampler&) = delete;
};

#endif
