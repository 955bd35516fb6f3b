/**
 * @class   vtkDistributedPointCloudReader
 * @brief   vtkPointCloudReader for a pipeline that runs on several processes
 *
 * Each process gets the piece that its pipeline asks for: where that is piece r of n on rank r of n, as in
 * ParaView and in vtkMPIController programs, the ranks read the file together, each its part
 * (vtkPointCloudReader::SetRanks says which formats have parts). Update() is then collective. The pieces, by
 * rank one after the other, are the cloud of vtkPointCloudReader bit for bit.
 *
 * With any other request a process reads alone: piece 0 is the whole cloud, others are empty.
 *
 * A fault of one rank is an error of each: vtkErrorMacro with the message of the first that has it, and an
 * empty output. Properties must be the same on all ranks.
 *
 * @sa vtkPointCloudReader vtkDistributedVoxelMeanResampler vtkMultiProcessController
 */
#ifndef vtkDistributedPointCloudReader_h
#define vtkDistributedPointCloudReader_h

#include "PointHapticsParallelModule.h" // For export macro
#include "vtkMultiProcessController.h"  // For Controller
#include "vtkPointCloudReader.h"
#include "vtkSmartPointer.h" // For Controller

class POINTHAPTICSPARALLEL_EXPORT vtkDistributedPointCloudReader : public vtkPointCloudReader
{
public:
  static vtkDistributedPointCloudReader* New();
  vtkTypeMacro(vtkDistributedPointCloudReader, vtkPointCloudReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The processes that read the file: a vtkMPIController, or null for this process alone. Default: the global
   * controller.
   */
  vtkSetSmartPointerMacro(Controller, vtkMultiProcessController);
  vtkGetSmartPointerMacro(Controller, vtkMultiProcessController);
  ///@}

protected:
  vtkDistributedPointCloudReader();
  ~vtkDistributedPointCloudReader() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkSmartPointer<vtkMultiProcessController> Controller;

  vtkDistributedPointCloudReader(const vtkDistributedPointCloudReader&) = delete;
  void operator=(const vtkDistributedPointCloudReader&) = delete;
};

#endif
