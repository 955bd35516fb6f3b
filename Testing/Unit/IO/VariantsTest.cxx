// Other files of the kinds in ExportersTest.cxx: what programs write where they write it a little otherwise.
#include "CloudFiles.h"

namespace
{

class Variants : public CloudFiles
{
protected:
  ReadResult salvage(const std::string& file) const
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SalvageOn();
    return readCloudBy(reader, file);
  }
};

/// An array of floats: x y z for each row of points, or with @p isTurned in three rows.
std::string numpy(int points, bool isTurned)
{
  const std::string shape = isTurned ? "3, " + std::to_string(points) : std::to_string(points) + ", 3";
  const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + shape + "), }\n";
  std::string bytes("\x93NUMPY\1\0", 8);
  append(bytes, static_cast<std::uint16_t>(header.size()));
  bytes += header;
  for (int i = 0; i < 3 * points; ++i)
  {
    const int point = isTurned ? i % points : i / 3;
    const int axis = isTurned ? i / points : i % 3;
    append(bytes, static_cast<float>(10 * point + axis));
  }
  return bytes;
}

TEST_F(Variants, NumpyWithPointsInColumnsIsTurned)
{
  for (const bool isTurned : { false, true })
  {
    const ReadResult result = readCloud(write("a.npy", numpy(50, isTurned)));
    ASSERT_EQ(result.error, "");
    ASSERT_EQ(result.points(), 50);
    EXPECT_EQ(result.notes.size(), isTurned ? 1u : 0u);
    EXPECT_EQ(result.cloud->GetPoint(49)[2], 492.0);
  }
}

TEST_F(Variants, HalvesOfNumpyAreFloats)
{
  std::string array = numpy(2, false).substr(0, 128);
  array.replace(array.find("<f4"), 3, "<f2");
  array.resize(10 + static_cast<unsigned char>(array[8]));
  for (const int bits : { 0x3c00, 0xc000, 0x3555, 0x0001, 0x7bff, 0x8000 })
  {
    append(array, static_cast<std::uint16_t>(bits));
  }
  const ReadResult result = readCloud(write("a.npy", array));
  ASSERT_EQ(result.error, "");
  const float expected[] = { 1.0f, -2.0f, 0.333251953125f, 0x1p-24f, 65504.0f, 0.0f };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(result.cloud->GetPoint(i / 3)[i % 3], double(expected[i]));
  }
}

TEST_F(Variants, CutNumpyAndSplatsAreSalvaged)
{
  const std::string array = numpy(4, false);
  const std::string file = write("a.npy", array.substr(0, array.size() - 5));
  expectRefused(readCloud(file), "--salvage");
  EXPECT_EQ(salvage(file).points(), 3);
  std::string splats;
  for (int i = 0; i < 3; ++i)
  {
    for (const float value : { 1.0f, 2.0f, 3.0f + static_cast<float>(i), 0.1f, 0.1f, 0.1f })
    {
      append(splats, value);
    }
    splats += std::string("\x10\x20\x30\xff\xff\x80\x80\x80", 8);
  }
  const std::string cut = write("a.splat", splats.substr(0, splats.size() - 5));
  expectRefused(readCloud(cut), "within its record 3");
  EXPECT_EQ(salvage(cut).points(), 2);
  for (const int floats : { 4, 5 }) // of KITTI and nuScenes
  {
    std::string scan;
    for (int i = 0; i < 10 * floats; ++i)
    {
      append(scan, i % floats == 4 ? 7.0f : 1.5f + 0.1f * static_cast<float>(i));
    }
    const std::string half = write("a.bin", scan.substr(0, scan.size() - 6));
    expectRefused(readCloud(half), "within its record 10");
    EXPECT_EQ(salvage(half).points(), 9);
    EXPECT_EQ(salvage(half).array("ring") != nullptr, floats == 5);
  }
}

TEST_F(Variants, Utf16WithoutAMarkIsText)
{
  const std::string text = "x,y,z\n1,2,3\n4,5,6.5\n";
  for (const bool isBig : { false, true })
  {
    std::string wide;
    for (const char c : text)
    {
      wide += isBig ? std::string{ '\0', c } : std::string{ c, '\0' };
    }
    const ReadResult result = readCloud(write("a.csv", wide));
    ASSERT_EQ(result.error, "") << isBig;
    EXPECT_EQ(result.cloud->GetPoint(1)[2], 6.5) << isBig;
  }
}

TEST_F(Variants, ImagesOfNumpyAreNoPoints)
{
  std::string image = numpy(70 * 32, false);
  image.replace(image.find("(2240, 3)"), 9, "(96,  70)");
  const std::string file = write("a.npy", image);
  expectRefused(readCloud(file), "70 columns without names are an image");
  vtkNew<vtkPointCloudReader> reader;
  std::vector<std::string> names{ "x", "y", "z" };
  names.resize(70, "-");
  reader->SetColumns(names);
  EXPECT_EQ(readCloudBy(reader, file).points(), 96);
}

TEST_F(Variants, AnEmptyFileOfVtkHoldsNoPoints)
{
  const ReadResult result = readCloud(write("a.vtp",
    "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>"
    "<Piece NumberOfPoints=\"0\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
    "NumberOfPolys=\"0\"><Points></Points></Piece></PolyData></VTKFile>\n"));
  EXPECT_TRUE(result.validWithoutPoints) << result.error;
}

} // namespace
