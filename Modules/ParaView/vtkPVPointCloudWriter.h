/**
 * @class   vtkPVPointCloudWriter
 * @brief   vtkParallelSerialWriter of a vtkPointCloudWriter, which hears of empty clouds too
 *
 * The superclass ends without a word where no rank has points. Here the inner writer gets the empty cloud and
 * reports it as everywhere else.
 *
 * @sa vtkPointCloudWriter
 */
#ifndef vtkPVPointCloudWriter_h
#define vtkPVPointCloudWriter_h

#include "PointHapticsParaViewModule.h" // For export macro
#include "vtkParallelSerialWriter.h"

class POINTHAPTICSPARAVIEW_EXPORT vtkPVPointCloudWriter : public vtkParallelSerialWriter
{
public:
  static vtkPVPointCloudWriter* New();
  vtkTypeMacro(vtkPVPointCloudWriter, vtkParallelSerialWriter);

protected:
  vtkPVPointCloudWriter() = default;
  ~vtkPVPointCloudWriter() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPVPointCloudWriter(const vtkPVPointCloudWriter&) = delete;
  void operator=(const vtkPVPointCloudWriter&) = delete;
};

#endif
