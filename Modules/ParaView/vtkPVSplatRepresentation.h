/**
 * @class   vtkPVSplatRepresentation
 * @brief   representation "Point Haptics Splats": points as the viewer of pointhaptics draws them
 *
 * The points of any dataset or composite, each as a round splat that closes to a surface with its neighbours
 * and is lit by the normal measured there (vtkSplatMapper). Colours, opacity, transform and selections of
 * points are those of the superclass. Points are measured once for each input, about 1 us a point on one
 * core; a block and the points of a rank are measured each by themselves.
 *
 * Cells that are no vertices are not drawn, no decimated points are drawn during interaction, and colours and
 * visibility of single blocks do not count.
 *
 * @sa vtkSplatMapper
 */
#ifndef vtkPVSplatRepresentation_h
#define vtkPVSplatRepresentation_h

#include "PointHapticsParaViewModule.h" // For export macro
#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkNew.h" // For Splats

class vtkSplatMapper;

class POINTHAPTICSPARAVIEW_EXPORT vtkPVSplatRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkPVSplatRepresentation* New();
  vtkTypeMacro(vtkPVSplatRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Factor on the measured diameters, above 0. Default: 1.
   */
  void SetSplatScale(double scale);

  /**
   * How much of the light is seen, 0 (the colours themselves) to 1 (default).
   */
  void SetSplatLight(double strength);

  ///@{
  /**
   * Splats are points, and all of them are drawn whatever these say.
   */
  using vtkGeometryRepresentationWithFaces::SetRepresentation;
  void SetRepresentation(const char*) override {}
  void SetSuppressLOD(bool) override {}
  ///@}

  void SetArrayIdNames(const char* pointArray, const char* cellArray) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;

protected:
  vtkPVSplatRepresentation();
  ~vtkPVSplatRepresentation() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPVSplatRepresentation(const vtkPVSplatRepresentation&) = delete;
  void operator=(const vtkPVSplatRepresentation&) = delete;

  void SetDrawnData(vtkDataObject* data);

  vtkNew<vtkSplatMapper> Splats;
  vtkMTimeType DrawnTime = 0; // of the data that is drawn
  double SplatScale = 1.0;
};

#endif
