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
#include "vtkDataArraySelection.h"      // For Categorical
#include "vtkDistributedVoxelMeanResampler.h"
#include "vtkNew.h" // For Categorical

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

  /**
   * As in vtkVoxelMeanResampler.
   */
  void SetAutomaticWorkspace(bool automatic) override;

  using vtkDistributedVoxelMeanResampler::SetWorkspaceBounds;
  void SetWorkspaceBounds(const double bounds[6]) override;
  ///@{
  /**
   * Least corner and edges of the box that is the workspace where AutomaticWorkspace is off: what a box in
   * the view moves.
   */
  void SetWorkspacePosition(double x, double y, double z);
  void SetWorkspaceSize(double x, double y, double z);
  ///@}

  /**
   * The input's point arrays, those with labels enabled: these are the CategoricalArrays, by their exact
   * names. Arrays that it does not know yet come from the input before each update, enabled where
   * IsCategoricalArray() was true until then.
   */
  vtkDataArraySelection* GetCategoricalArraySelection() { return this->Categorical; }
  void AddCategoricalArray(const char* name) override;
  void RemoveCategoricalArray(const char* name) override;
  void ClearCategoricalArrays() override;

protected:
  vtkPVVoxelMeanResampler();
  ~vtkPVVoxelMeanResampler() override = default;

#ifndef __VTK_WRAP__
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  std::string ProblemOf(vtkDataObject* input) override;
  bool RunCloud(vtkPointSet* cloud, const Outputs& outputs) override;
#endif

private:
  vtkPVVoxelMeanResampler(const vtkPVVoxelMeanResampler&) = delete;
  void operator=(const vtkPVVoxelMeanResampler&) = delete;

  void ApplyChosen();
  void Tick(const char* name, bool isTicked);

  int LatticeMode = ByDimensions;
  pointhaptics::LatticeSettings Chosen;     // with the voxel size of both modes
  pointhaptics::Vec3 Size{ 0.1, 0.1, 0.1 }; // as it was set: the workspace's own is rounded
  vtkNew<vtkDataArraySelection> Categorical;
};

#endif
