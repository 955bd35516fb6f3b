#include "vtkPVPointCloudWriter.h"

#include "vtkPointCloudWriter.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

vtkStandardNewMacro(vtkPVPointCloudWriter);

int vtkPVPointCloudWriter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto* ranks = vtkMultiProcessController::GetGlobalController();
  const vtkIdType own = vtkDataObject::GetData(inputs[0])->GetNumberOfElements(vtkDataObject::POINT);
  vtkIdType all = 0;
  ranks->AllReduce(&own, &all, 1, vtkCommunicator::SUM_OP);
  if (all > 0)
  {
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  auto* writer = vtkPointCloudWriter::SafeDownCast(this->GetWriter());
  if (writer && ranks->GetLocalProcessId() == 0)
  {
    writer->SetFileName(this->GetFileName());
    writer->SetInputData(vtkNew<vtkPolyData>());
    writer->Write();
    writer->RemoveAllInputConnections(0);
  }
  return 1;
}
