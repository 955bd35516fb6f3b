/**
 * @class   vtkPointCloudReader
 * @brief   read raw point clouds: PLY, PCD, LAS, LAZ, E57, VTK, OBJ, PTX, text and others (GetFormatTable())
 *
 * The format is detected by the file's content; the extension decides only between OBJ and columns of text,
 * and for a binary STL inside a gzip file. Files packed by gzip are read as if they were unpacked (VTP, PVTP
 * and VTU are not).
 *
 * Output: points, one vertex cell per point, and every scalar field of the file as a point data array with
 * its name and type. Fields that belong together become one array: red green blue [alpha] become "RGB" or
 * "RGBA" (unsigned char, the active scalars; colours of other types are kept as "Color16" or "Color" beside
 * an "RGB" made of them), nx ny nz or normal_x normal_y normal_z become "Normals" (the active normals),
 * name_0 name_1 ... become "name". Lines are dropped, and faces but for SetSamples().
 *
 * Points are double where the file's numbers need it (double fields, LAS, E57 with scaled integers or poses,
 * text and OBJ with more than 6 significant digits), else float. Points that are NaN or infinite are kept; a
 * finite coordinate beyond 1e30 is taken for damage. Coordinates are those of the file: nothing is moved,
 * scaled or turned, but for the poses of E57's scans.
 *
 * What becomes of each format is in Documentation/Formats.md.
 *
 * Faults give an empty output, an error code (vtkErrorCode), a vtkErrorMacro, and GetErrorMessage() with
 * `file: format: what, where, value; cure`; RepeatsErrors decides about further updates. Sizes that a file
 * claims are checked against its length before anything is allocated, so hostile files fail cleanly.
 *
 * Costs the file's (unpacked) size in memory beside the output, and less than 64 MB more; STL needs its
 * vertices twice, and OBJ all its numbers as doubles, up to twice the file's size. A gzip file may unpack to
 * 100 times its size (64 MB at least), no more. One reader serves one thread at a time.
 *
 * @sa vtkPointCloudWriter
 */
#ifndef vtkPointCloudReader_h
#define vtkPointCloudReader_h

#include "PointHapticsIOModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkTimeStamp.h" // For RetryTime

#include <string> // For std::string
#include <vector> // For std::vector

namespace pointhaptics
{
class Ranks;
namespace io
{
struct ReadTask;
}
}

class POINTHAPTICSIO_EXPORT vtkPointCloudReader : public vtkPolyDataAlgorithm
{
public:
  static vtkPointCloudReader* New();
  vtkTypeMacro(vtkPointCloudReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Distance between neighbouring points that is fine enough, in the file's units, finite and 0 or more; 0:
   * all points. Cloud optimised point clouds (COPC) are read down to the level of their octree that has it:
   * fewer bytes and less work. Other files are read whole. Default: 0.
   */
  vtkSetClampMacro(Resolution, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Resolution, double);
  ///@}

  ///@{
  /**
   * At most so many points, where the file has an octree: cloud optimised point clouds are read down to the
   * finest level with no more (the coarsest one is always read), and IsCoarse() says whether finer ones were
   * left out. Other files are read whole. Default: 0, which is no bound.
   */
  vtkSetClampMacro(MostPoints, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(MostPoints, vtkIdType);
  /// True if the last update left out points.
  bool IsCoarse() const { return this->Coarse; }
  ///@}

  ///@{
  /**
   * Only points inside this box, edges included, are given: xmin, xmax, ymin, ymax, zmin, zmax in the file's
   * units. Of cloud optimised point clouds only the nodes that touch it are read; others are read whole
   * first. Default: 1, -1, 1, -1, 1, -1, which is no box: all points.
   */
  vtkSetVector6Macro(Box, double);
  vtkGetVector6Macro(Box, double);
  ///@}

  ///@{
  /**
   * Reads no arrays beside the points where that saves work: LAS, LAZ and COPC. Default: off.
   */
  vtkSetMacro(OnlyPositions, bool);
  vtkGetMacro(OnlyPositions, bool);
  vtkBooleanMacro(OnlyPositions, bool);
  ///@}

  ///@{
  /**
   * Whether the output has a vertex cell for each point, as filters and mappers of VTK want it. The filters
   * of this project need none: without them reading saves 8 bytes a point and their time. Default: on.
   */
  vtkSetMacro(GenerateVertices, bool);
  vtkGetMacro(GenerateVertices, bool);
  vtkBooleanMacro(GenerateVertices, bool);
  ///@}

  ///@{
  /**
   * The extension to go by instead of the file name's, where the content leaves the format open: "obj" or
   * "xyz". Default: empty.
   */
  vtkSetMacro(Extension, const std::string&);
  const std::string& GetExtension() const { return this->Extension; }
  ///@}

  ///@{
  /**
   * Whether scans of a file with poses (E57) are moved to where they belong. Off: each point is in the frame
   * of its scanner, and the field data has the poses. Default: on.
   */
  vtkSetMacro(ApplyPoses, bool);
  vtkGetMacro(ApplyPoses, bool);
  vtkBooleanMacro(ApplyPoses, bool);
  ///@}

  ///@{
  /**
   * Names of the columns of a text, for one whose header says nothing or the wrong thing; "-" leaves a column
   * out, and so does a name less. Three must be x, y and z. Of NumPy each column is named; other formats take
   * no notice. Default: none.
   */
  void SetColumns(const std::vector<std::string>& names);
  const std::vector<std::string>& GetColumns() const { return this->Columns; }
  ///@}

  ///@{
  /**
   * Reads a file whose header promises more than follows as far as it goes, and says in GetNotes() how far:
   * LAS, LAZ, PLY, PCD (not compressed), PTS and E57. Off: it is refused, with the counts. Default: off.
   */
  vtkSetMacro(Salvage, bool);
  vtkGetMacro(Salvage, bool);
  vtkBooleanMacro(Salvage, bool);
  ///@}

  ///@{
  /**
   * Gives points whose x and y are degrees of longitude and latitude in metres to the east and north of their
   * medians, as view and feel take them; z stays. Box is in degrees all the same. Other files take no notice.
   * Default: off.
   */
  vtkSetMacro(LocalMetres, bool);
  vtkGetMacro(LocalMetres, bool);
  vtkBooleanMacro(LocalMetres, bool);
  ///@}

  ///@{
  /**
   * What the points of a file with faces are (STL, OBJ, OFF, PLY, VTK and VTP with polygons): 0, its vertices
   * in their order; AUTOMATIC, samples of its faces, so many that their spacing is at most a quarter of the
   * median edge, from 200,000 to 2 million, or the vertices where these are more; else so many samples. They
   * lie evenly by area, and the same file gives the same ones, bit for bit. Arrays are interpolated, labels
   * (integers but colours and intensities) are those of the nearest vertex, and normals those of the face
   * where the vertices have none. Other files take no notice. Of a file with faces GetNotes() says what its
   * points are. Default: 0.
   */
  static constexpr vtkIdType AUTOMATIC = -1;
  vtkSetClampMacro(Samples, vtkIdType, -1, 100000000);
  vtkGetMacro(Samples, vtkIdType);
  /// Whether the points of the last update are samples.
  bool HasSamples() const { return this->Sampled; }
  ///@}

  ///@{
  /**
   * On: after a fault each Update(), and with it each picture of a scene, reads again and says so again until
   * the cause is mended. Off, for hosts that update several times for one action of a person, and for scenes
   * that go on without the file: nothing is read until something is set. Several
   * ranks say a fault once, as they read together or not at all. Default: on.
   */
  vtkSetMacro(RepeatsErrors, bool);
  vtkGetMacro(RepeatsErrors, bool);
  vtkBooleanMacro(RepeatsErrors, bool);
  ///@}

  /**
   * The extensions of all formats that are read, without dots.
   */
  static std::vector<std::string> GetExtensions();

  /**
   * A table of them in Markdown: name, extensions, and the extension that is written.
   */
  static std::string GetFormatTable();

  /**
   * The processes that read the file together: each gets its part of the points, as many on each, one after
   * the other in the order of the file, with the same arrays. Update() is then collective. Binary PLY and
   * PCD, LAS, LAZ and COPC are read in parts: a process reads headers and its own bytes; of a PVTP the starts
   * of all pieces, and those pieces that have its points. Other files are read whole by each, and cut. A
   * fault of one ends the reading of all. Null (the default): this process reads all. The ranks must outlive
   * updates.
   */
  vtkSetMacro(Ranks, pointhaptics::Ranks*);

  /**
   * True if the last update ended without points and without a fault of its own, as another of the ranks had
   * one.
   */
  bool FailedElsewhere() const { return this->OtherRankFailed; }

  /**
   * Bytes of the file that the last update read.
   */
  vtkGetMacro(NumberOfBytesRead, vtkTypeInt64);

  /**
   * Parts of its file that the cloud of the last update lacks, one line each.
   */
  const std::vector<std::string>& GetNotes() const { return this->Notes; }

  /**
   * True if the last update found a valid file that announces no points. This is an error, too, but the
   * output has the field data that the file gave.
   */
  bool IsValidWithoutPoints() const { return this->ValidWithoutPoints; }

  /**
   * Error of the last update, in one line; empty when all went well. Never null; valid until the next update.
   */
  const char* GetErrorMessage() const { return this->ErrorMessage.c_str(); }

  /**
   * The format found by the last update, such as "PLY (binary little endian)". Never null; empty when it
   * was not recognised.
   */
  const char* GetFormat() const { return this->Format.c_str(); }

  /**
   * Later than the last output where that was cut short by a fault or an abort.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkPointCloudReader();
  ~vtkPointCloudReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPointCloudReader(const vtkPointCloudReader&) = delete;
  void operator=(const vtkPointCloudReader&) = delete;

  void ReadInto(vtkPolyData* cloud);
  void ReadPart(pointhaptics::io::ReadTask& task, vtkPolyData* cloud);
  void ReadWhole(pointhaptics::io::ReadTask& task, vtkPolyData* cloud);
  void ReadTogether(pointhaptics::io::ReadTask& task, vtkPolyData* cloud);
  void Finish(pointhaptics::io::ReadTask& task, vtkPolyData* cloud);
  void FinishFaces(pointhaptics::io::ReadTask& task, vtkPolyData* cloud);
  std::string ExtensionOf(const std::string& path) const;
  bool IsShared() const;
  void Fail(unsigned long code, const std::string& message);

  char* FileName = nullptr;
  double Resolution = 0.0;
  vtkIdType MostPoints = 0;
  bool Coarse = false;
  double Box[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  bool OnlyPositions = false;
  bool GenerateVertices = true;
  std::string Extension;
  std::string ErrorMessage;
  std::string Format;
  std::vector<std::string> Notes;
  std::vector<std::string> Columns;
  bool Salvage = false;
  bool LocalMetres = false;
  vtkIdType Samples = 0;
  bool Sampled = false;
  bool ApplyPoses = true;
  bool ValidWithoutPoints = false;
  pointhaptics::Ranks* Ranks = nullptr;
  bool OtherRankFailed = false;
  bool RepeatsErrors = true;
  bool RunsAgain = false;
  vtkTimeStamp RetryTime;
  vtkTypeInt64 NumberOfBytesRead = 0;
};

#endif
