/**
 * @class   vtkCloudAlgorithm
 * @brief   base of the filters from points to points: composites, errors, settings that change in a run
 *
 * Input: a vtkPointSet of any kind, or a composite dataset of them (blocks, partitions, trees of both).
 * Output of a vtkPointSet: a vtkPolyData. Output of a composite: a composite of the same structure, names
 * and metadata, in which each block of points is replaced by its vtkPolyData. Other blocks (images, tables)
 * are left empty, with one warning that names them; a composite that is no tree (AMR) gives an empty
 * vtkMultiBlockDataSet.
 *
 * Errors: vtkErrorMacro with what, where, value and cure. GetErrorCode() is then not 0, GetErrorMessage() has
 * the sentence, the output is valid and empty (its points are never null), and RepeatsErrors decides about
 * further updates. An aborted update gives an empty output without an error
 * and starts anew next time. An error is the only message of its update; an empty input gives an empty output
 * without one, as whatever left it empty has said why.
 *
 * What an observer sets while the filter runs, its connections included, counts from the next update on.
 * Output ports are fixed from construction.
 *
 * Pieces: each process works on the points that its pipeline gives it. The distributed filters in Parallel
 * work on those of all.
 *
 * One thread may use an object at a time.
 *
 * @sa vtkVoxelMeanResampler vtkKernelBandwidthFilter
 */
#ifndef vtkCloudAlgorithm_h
#define vtkCloudAlgorithm_h

#include "PointHapticsFiltersModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // For clouds
#include "vtkTimeStamp.h"    // For RetryTime

#include <algorithm> // For vtkSettingEnumMacro
#include <string>    // For Fail
#include <vector>    // For clouds and warnings

class vtkDataObject;
class vtkPointSet;

/// Set and Get of the property @p name: the value @p member of the filter's Settings, which SetSettings()
/// checks and takes.
#define vtkSettingMacro(name, type, member)                                                                  \
  virtual void Set##name(type value)                                                                         \
  {                                                                                                          \
    auto settings = this->Settings;                                                                          \
    settings.member = value;                                                                                 \
    this->SetSettings(settings);                                                                             \
  }                                                                                                          \
  virtual type Get##name() const                                                                             \
  {                                                                                                          \
    return this->Settings.member;                                                                            \
  }

/// As vtkSettingMacro, for an enumeration of Core, which is an int to VTK: from 0 to @p last.
#define vtkSettingEnumMacro(name, member, last)                                                              \
  virtual void Set##name(int value)                                                                          \
  {                                                                                                          \
    auto settings = this->Settings;                                                                          \
    settings.member = static_cast<decltype(settings.member)>(std::clamp<int>(value, 0, last));               \
    this->SetSettings(settings);                                                                             \
  }                                                                                                          \
  virtual int Get##name() const                                                                              \
  {                                                                                                          \
    return static_cast<int>(this->Settings.member);                                                          \
  }

class POINTHAPTICSFILTERS_EXPORT vtkCloudAlgorithm : public vtkPolyDataAlgorithm
{
public:
  vtkAbstractTypeMacro(vtkCloudAlgorithm, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Later than what was set in a run; later than the last output where that was cut short by an error or an
   * abort.
   */
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * On: after an error each Update() runs again and says so again until the cause is mended. Off, for hosts
   * that update several times for one action of a person: nothing runs until something is set. Default: on.
   */
  vtkSetMacro(RepeatsErrors, bool);
  vtkGetMacro(RepeatsErrors, bool);
  vtkBooleanMacro(RepeatsErrors, bool);
  ///@}

  /**
   * Errors of the last update; empty: none.
   */
  const std::string& GetErrorMessage() const { return this->ErrorMessage; }

  vtkTypeBool ProcessRequest(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

protected:
#ifndef __VTK_WRAP__
  using Clouds = std::vector<vtkSmartPointer<vtkPointSet>>;
  using Outputs = std::vector<vtkSmartPointer<vtkPolyData>>;

  vtkCloudAlgorithm() = default;
  ~vtkCloudAlgorithm() override = default;

  /// Why a run over an input cannot be; empty: it can.
  virtual std::string ProblemOf(vtkDataObject*)
  {
    return {};
  }
  /// Whether an error is said again on the next update: RepeatsErrors, but for ranks, which run together or
  /// not at all.
  virtual bool SaysAgain() const
  {
    return this->RepeatsErrors;
  }
  /// Takes over settings for a run over all @p clouds. @return false after Fail() or an abort.
  virtual bool BeginRun(const Clouds& clouds) = 0;
  /// Fills an output for each port from one cloud. @return as BeginRun().
  virtual bool RunCloud(vtkPointSet* cloud, const Outputs& outputs) = 0;
  /// Releases the data of the run. False after Fail() or an abort.
  virtual void EndRun(bool) {}

  /// Reports the error @p problem; the outputs become empty.
  void Fail(const std::string& problem);
  /// Warns at the end of a run that succeeds, once however many clouds are concerned.
  void Warn(const std::string& text);
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  virtual int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*);

  bool RepeatsErrors = true;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  struct Parts;
  bool RunParts(const Parts& parts);

  bool RunsAgain = false;
  std::string ErrorMessage;
  std::vector<std::string> Warnings; ///< Warnings of this run.
  vtkTimeStamp RetryTime;

  vtkCloudAlgorithm(const vtkCloudAlgorithm&) = delete;
  void operator=(const vtkCloudAlgorithm&) = delete;
#endif
};

#endif
