/**
 * @class   vtkPointCloudWriter
 * @brief   write a point cloud with every array: .vtp, .ply, .pcd, .las, .laz, .csv or .xyz by extension
 *
 * Input: any vtkPointSet with at least one point. Points keep their precision (float or double).
 * vtkPointCloudReader gives the same points and arrays back, within what the format can say:
 *
 * Documentation/Formats.md says what that is: types, grids of coordinates, units, names.
 *
 * Arrays of strings are left out. Characters and names that a format cannot hold, or that mean something else
 * to a reader, are changed: .ply, .pcd and .xyz say in comments "ArrayName" what they were, so that
 * vtkPointCloudReader gives them back; of .las, .laz and .csv GetNotes() does.
 * GetNotes() lists whatever the format could not hold of this cloud.
 *
 * The file is written beside its target under a temporary name and renamed when complete: after a fault the
 * target is as it was before. Write() returns 1, or 0 with an error code (vtkErrorCode), a vtkErrorMacro and
 * GetErrorMessage() `file: format: what; cure`.
 *
 * ProgressEvent is invoked from 0 to 1 while it writes. An observer that sets AbortExecute stops it, within
 * 32768 points (.ply, .pcd, .csv), one axis (.las, while it seeks a grid) or one array (.vtp):
 * Write() returns 0 with vtkErrorCode::UserError and a message, without an error event, and the target is as
 * it was before.
 *
 * One writer serves one thread at a time.
 *
 * @sa vtkPointCloudReader
 */
#ifndef vtkPointCloudWriter_h
#define vtkPointCloudWriter_h

#include "PointHapticsIOModule.h" // For export macro
#include "vtkWriter.h"

#include <string> // For std::string
#include <vector> // For std::vector

class vtkPointSet;

class POINTHAPTICSIO_EXPORT vtkPointCloudWriter : public vtkWriter
{
public:
  static vtkPointCloudWriter* New();
  vtkTypeMacro(vtkPointCloudWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write; its extension chooses the format. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The extension that chooses the format instead of the file name's, such as "ply". Default: empty.
   */
  vtkSetMacro(Extension, const std::string&);
  const std::string& GetExtension() const { return this->Extension; }
  ///@}

  ///@{
  /**
   * Step of the coordinates in .las and .laz, in their unit. 0: see above. Default: 0.
   */
  vtkSetMacro(LasScale, double);
  vtkGetMacro(LasScale, double);
  ///@}

  ///@{
  /**
   * Whether .pcd keeps the type and the name of every array, as those of other formats do. Off: coordinates,
   * normals and intensity are floats, and intensity, curvature and label (an unsigned integer) have these
   * names, as PCL's point types read no others; GetNotes() says what is rounded, and by how much. Default:
   * off.
   */
  vtkSetMacro(KeepDoubles, bool);
  vtkGetMacro(KeepDoubles, bool);
  vtkBooleanMacro(KeepDoubles, bool);
  ///@}

  /**
   * Write the file. Returns 1 when it is complete under its name, else 0.
   */
  int Write() override;

  /**
   * Error of the last Write(), in one line; empty when all went well. Never null.
   */
  const char* GetErrorMessage() const { return this->ErrorMessage.c_str(); }

  /**
   * Losses of the last Write(), where the format could not hold the cloud, one sentence each; empty when a
   * reader gets back all there was.
   */
  const std::vector<std::string>& GetNotes() const { return this->Notes; }

  /**
   * Points in the file of the last Write(): all of the cloud but those that GetNotes() says were left out; 0
   * when there is no file.
   */
  vtkGetMacro(NumberOfPointsWritten, vtkIdType);

  /**
   * True if a file of this name can be written: asked of its extension.
   */
  static bool CanWrite(const std::string& fileName);

  /**
   * The extensions that can be written, for messages: ".vtp, .ply, .pcd, .las, .laz, .csv or .xyz". Static
   * storage.
   */
  static const char* GetExtensions();

protected:
  vtkPointCloudWriter() = default;
  ~vtkPointCloudWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkPointCloudWriter(const vtkPointCloudWriter&) = delete;
  void operator=(const vtkPointCloudWriter&) = delete;

  void WriteCloud(vtkPointSet* cloud);
  void Fail(unsigned long code, const std::string& message);

  char* FileName = nullptr;
  std::string Extension;
  double LasScale = 0.0;
  bool KeepDoubles = false;
  std::string ErrorMessage;
  std::string Format;
  std::vector<std::string> Notes;
  vtkIdType NumberOfPointsWritten = 0;
};

#endif
