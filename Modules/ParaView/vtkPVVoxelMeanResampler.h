/**
 * @class   vtkPVVoxelMeanResampler
 * @brief   vtkDistributedVoxelMeanResampler whose lattice does not depend on the order of its properties
 *
 * In vtkVoxelMeanResampler the property set last rules: VoxelSize or Dimensions, WorkspaceBounds or
 * AutomaticWorkspace. ParaView sends the properties that changed, in an order of its own, and shows the
 * others as they are. Here all of them are kept, and LatticeMode and AutomaticWorkspace alone say which rule.
 *
 * Its output has the field data ClippedPoints and InvalidPoints, the numbers of the superclass over all
 * blocks so far, as the Information tab shows field data.
 *
 * It computes nothing: results and errors are those of vtkDistributedVoxelMeanResampler. One thread may use
 * an object at a time.
 *
 * @sa vtkDistributedVoxelMeanResampler
 */
#ifndef vtkPVVoxelMeanResampler_h
#define vtkPVVoxelMeanResampler_h

#include "Core/Base/Lattice.h"          // For Chosen
#include "PointHapticsParaViewModule.h" // For export macro
#include "vtkDistributedVoxelMeanResampler.h"

class POINTHAPTICSPARAVIEW_EXPORT vtkPVVoxelMeanResampler : public vtkDistributedVoxelMeanResampler
{
public:
  static vtkPVVoxelMeanResampler* New();
  vtkTypeMacro(vtkPVVoxelMeanResampler, vtkDistributedVoxelMeanResampler);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum LatticeModeType
  {
    ByVoxelSize = 0,
    ByDimensions = 1
  };
  ///@{
  /**
   * Whether VoxelSize or Dimensions gives the lattice. Default: ByDimensions.
   */
  void SetLatticeMode(int mode);
  vtkGetMacro(LatticeMode, int);
  ///@}

  ///@{
  /**
   * As in vtkVoxelMeanResampler, but kept until LatticeMode asks for them. By voxel size, one that is not
   * above 0 is an error of the update: vtkErrorMacro, and an empty output.
   */
  void SetVoxelSize(double size) override;
  void SetDimensions(int nx, int ny, int nz) override;
  void SetDimensions(const int dimensions[3]) override;
  ///@}

  ///@{
  /**
   * As in vtkVoxelMeanResampler, but bounds do not turn AutomaticWorkspace off.
   */
  void SetAutomaticWorkspace(bool automatic) override;
  void SetWorkspaceBounds(double x0, double x1, double y0, double y1, double z0, double z1) override;
  void SetWorkspaceBounds(const double bounds[6]) override;
  ///@}

protected:
  vtkPVVoxelMeanResampler();
  ~vtkPVVoxelMeanResampler() override = default;

#ifndef __VTK_WRAP__
  std::string ProblemOf(vtkDataObject* input) override;
  bool RunCloud(vtkPointSet* cloud, const Outputs& outputs) override;
#endif

private:
  vtkPVVoxelMeanResampler(const vtkPVVoxelMeanResampler&) = delete;
  void operator=(const vtkPVVoxelMeanResampler&) = delete;

  void ApplyLattice();

  int LatticeMode = ByDimensions;
  pointhaptics::LatticeSettings Chosen; // with the voxel size of both modes
};

#endif
