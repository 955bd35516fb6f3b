// Files as other programs export them: each stands for a kind that public reports describe.
#include "CloudFiles.h"

#include "vtkFieldData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace
{

class Exporters : public CloudFiles
{
protected:
  ReadResult readNamed(const std::string& name, const std::string& content, std::vector<std::string> columns)
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SetColumns(columns);
    return readCloudBy(reader, write(name, content));
  }
  ReadResult salvage(const std::string& name, const std::string& content)
  {
    vtkNew<vtkPointCloudReader> reader;
    reader->SalvageOn();
    return readCloudBy(reader, write(name, content));
  }
};

bool isSaid(const std::vector<std::string>& notes, const std::string& part)
{
  for (const std::string& note : notes)
  {
    if (note.find(part) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

std::string unitOf(const ReadResult& result)
{
  vtkAbstractArray* unit = result.cloud->GetFieldData()->GetAbstractArray("LengthUnit");
  return unit ? unit->GetVariantValue(0).ToString() : std::string();
}

void expectPoint(const ReadResult& result, vtkIdType row, double x, double y, double z)
{
  ASSERT_EQ(result.error, "");
  ASSERT_LT(row, result.points());
  const double* p = result.cloud->GetPoint(row);
  EXPECT_FLOAT_EQ(static_cast<float>(p[0]), static_cast<float>(x));
  EXPECT_FLOAT_EQ(static_cast<float>(p[1]), static_cast<float>(y));
  EXPECT_FLOAT_EQ(static_cast<float>(p[2]), static_cast<float>(z));
}

const std::string kColmap = "# 3D point list with one line of data per point:\n#   POINT3D_ID, X, Y, Z, R, "
                            "G, B, ERROR, TRACK[] as (IMAGE_ID, "
                            "POINT2D_IDX)\n";

TEST_F(Exporters, ACommentNamesTheColumnsAndAListBehindThemIsLeftOut)
{
  const ReadResult plain =
    readCloud(write("a.txt", kColmap + "1000 0.1 0.2 0.3 255 0 0 0.5\n1001 0.2 0.2 0.3 255 0 9 0.4\n"));
  expectPoint(plain, 0, 0.1, 0.2, 0.3);
  EXPECT_EQ(plain.value("POINT3D_ID", 1), 1001);
  EXPECT_EQ(plain.value("RGB", 1, 2), 9);
  EXPECT_EQ(plain.value("ERROR", 0), 0.5);
  EXPECT_TRUE(plain.notes.empty());
  const ReadResult tracks = readCloud(write(
    "b.txt", kColmap + "1000 0.1 0.2 0.3 255 0 0 0.5 1 5 2 7\n1001 0.2 0.2 0.3 255 0 9 0.4 1 9 2 8 3 4\n"));
  expectPoint(tracks, 1, 0.2, 0.2, 0.3);
  EXPECT_EQ(tracks.value("RGB", 1, 2), 9);
  EXPECT_TRUE(isSaid(tracks.notes, "behind column 8, 'ERROR', is left out"));
  const ReadResult bare = readCloud(write("c.txt",
    "1000 0.1 0.2 0.3 255 0 0 0.5 1 5 2 7 9 9\n1001 0.2 0.2 0.3 255 0 9 0.4 1 9\n1002 0.2 0.2 0.3 1 2 3 0.4 "
    "1 9 2 8\n"));
  expectPoint(bare, 1, 0.2, 0.2, 0.3);
  EXPECT_TRUE(isSaid(bare.notes, "behind column 10"));
  expectRefused(readCloud(write("d.txt", "1 2 3 4 5\n1 2 3 4 5\n1 2 3 4")), "line 3: 4 columns where 5");
}

TEST_F(Exporters, ColumnsWithoutNamesAreTakenByTheirValuesAndThatIsSaid)
{
  const ReadResult survey = readCloud(write("a.csv",
    "1,4000000.1,500000.2,100.3,GRND\n2,4000001.1,500001.2,100.4,GRND\n3,4000002.1,500003.2,100.5,EDGE\n"));
  expectPoint(survey, 1, 500001.2, 4000001.1, 100.4);
  EXPECT_EQ(survey.value("id", 2), 3);
  EXPECT_TRUE(isSaid(survey.notes, "taken as id,y,x,z,-; where northing and easting"));
  const ReadResult unit =
    readCloud(write("a.xyzrgb", "0 0 0 0.9 0.2 0.1\n1 0 0 0.8 0.1 0.1\n0 1 0 0.2 0.9 0.3\n"));
  ASSERT_NE(unit.array("RGB"), nullptr);
  EXPECT_EQ(unit.array("Normals"), nullptr);
  EXPECT_NEAR(unit.value("RGB", 0, 0), 229.5, 0.5);
  EXPECT_TRUE(isSaid(unit.notes, "taken as x,y,z,red,green,blue"));
  const ReadResult label =
    readCloud(write("a.txt", "0 0 0 200 10 20 3\n1 0 0 201 11 21 4\n0 1 0 19 210 20 3\n"));
  EXPECT_EQ(label.value("RGB", 2, 1), 210);
  EXPECT_EQ(label.value("label", 1), 4);
  const ReadResult normals =
    readCloud(write("b.txt", "0 0 0 200 10 20 0 0 1\n1 0 0 201 11 21 0 0.6 0.8\n0 1 0 19 210 20 1 0 0\n"));
  EXPECT_EQ(normals.value("RGB", 1, 0), 201);
  EXPECT_EQ(normals.value("Normals", 1, 2), static_cast<double>(0.8f));
  const ReadResult both = readCloud(write("c.txt", "0 0 0 0 0 1 9 8 7\n1 0 0 0 -0.6 0.8 9 8 6\n"));
  EXPECT_EQ(both.value("RGB", 1, 2), 6);
  EXPECT_EQ(both.value("Normals", 1, 1), static_cast<double>(-0.6f));
  EXPECT_TRUE(readCloud(write("d.txt", "0 0 0\n1 2 3\n")).notes.empty());
}

TEST_F(Exporters, TheUserNamesColumns)
{
  const ReadResult named = readNamed("a.txt", "7 1 2 3 4\n8 5 6 7 8\n", { "-", "z", "y", "x", "gain" });
  expectPoint(named, 1, 7, 6, 5);
  EXPECT_EQ(named.value("gain", 0), 4);
  EXPECT_EQ(named.cloud->GetPointData()->GetNumberOfArrays(), 1);
  EXPECT_TRUE(named.notes.empty());
  expectPoint(readNamed("b.csv", "a,b,c,d\n1,2,3,4\n", { "x", "y", "z" }), 0, 1, 2, 3);
  expectRefused(
    readNamed("c.txt", "1 2 3\n", { "x", "y", "q" }), "no columns named x, y and z, but 'x', 'y', 'q'");
  expectRefused(readNamed("d.txt", "1 2 3\n", { "x", "y", "z", "q" }), "3 columns, but 4 are named");
  expectRefused(
    readNamed("e.txt", "1 2 3\n", { "x", "y" }), "--columns has 2 names, and a point needs three");
}

TEST_F(Exporters, NumbersAndLinesOfOtherProgramsAreRead)
{
  expectPoint(readCloud(write("a.csv", "sep=;\nX;Y;Z\n1,5;2,5;3,5\n2,5;3,5;4,5\n")), 0, 1.5, 2.5, 3.5);
  expectPoint(readCloud(write("b.csv", "\"sep=,\"\nX,Y,Z\n1.5,2.5,3.5\n")), 0, 1.5, 2.5, 3.5);
  expectPoint(readCloud(write("c.txt", "1.0D+00 2.0d0 3.0D-01\n2.0D+00 2.0D+00 3.0D-01\n")), 0, 1, 2, 0.3);
  const ReadResult nan =
    readCloud(write("d.txt", "1 2 3\n1.#QNAN -1.#IND 1.#SNAN\n-1.#INF 1.#INF00 nan(ind)\n4 5 6\n"));
  ASSERT_EQ(nan.error, "");
  EXPECT_TRUE(std::isnan(nan.cloud->GetPoint(1)[0]) && std::isnan(nan.cloud->GetPoint(1)[1]));
  EXPECT_EQ(nan.cloud->GetPoint(2)[0], -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(nan.cloud->GetPoint(2)[2]));
  for (const char* comment :
    { "% x y z", "! made by me", "; made by me", "> made by me", "Scan of 2 rooms", "//" })
  {
    expectPoint(readCloud(write("e.txt", std::string(comment) + "\n1 2 3\n4 5 6\n")), 1, 4, 5, 6);
  }
  const ReadResult titled = readCloud(write("f.txt", "Scan of the hall\n\nx y z gain\n1 2 3 4\n"));
  expectPoint(titled, 0, 1, 2, 3);
  EXPECT_EQ(titled.value("gain", 0), 4);
  std::string wide;
  for (const char c : std::string("\xff\xfe") + "x y z\r\n1 2 3\r\n4 5 6\r\n")
  {
    wide += wide.size() < 2 ? std::string(1, c) : std::string{ c, '\0' };
  }
  expectPoint(readCloud(write("g.txt", wide)), 1, 4, 5, 6);
}

TEST_F(Exporters, CoordinatesAreFoundUnderTheNamesOfOtherPrograms)
{
  const struct
  {
    const char* header;
    const char* unit;
  } known[] = { { "X_m,Y_m,Z_m", "m" }, { "x_mm,y_mm,z_mm", "mm" }, { "X1 (mm),Y1 (mm),Z1 (mm)", "mm" },
    { "xcoord,ycoord,zcoord", "" }, { "field.x,field.y,field.z", "" },
    { "\"Points_m_XYZ:0\",\"Points_m_XYZ:1\",\"Points_m_XYZ:2\"", "m" }, { "Rechtswert,Hochwert,Hoehe", "" },
    { "Points:0,Points:1,Points:2", "" }, { "pos_x,pos_y,pos_z", "" },
    { "X (world),Y (world),Z (world)", "" }, { "Easting [ft],Northing [ft],Elevation [ft]", "ft" } };
  for (const auto& each : known)
  {
    const ReadResult result = readCloud(write("a.csv", std::string(each.header) + ",t\n1,2,3,9\n4,5,7,9\n"));
    expectPoint(result, 1, 4, 5, 7);
    EXPECT_EQ(unitOf(result), each.unit) << each.header;
    EXPECT_EQ(result.value("t", 0), 9) << each.header;
  }
  const ReadResult colors =
    readCloud(write("b.asc", "//X Y Z Rf Gf Bf\n2\n0 0 0 0.5 0.1 0.2\n1 1 1 0.5 0.1 0.2\n"));
  ASSERT_EQ(colors.error, "");
  EXPECT_EQ(colors.value("RGB", 0, 0), 128);
}

TEST_F(Exporters, GridsOfHeightsAreTheMiddlesOfTheirCells)
{
  for (const char* head : { "NCOLS 3\nNROWS 2\nXLLCORNER 10\nYLLCORNER 20\nCELLSIZE 2\nNODATA_VALUE -9999\n",
         "ncols 3\nnrows 2\nxllcenter 11\nyllcenter 21\ndx 2\ndy 2\nnodata_value -9999\n" })
  {
    const ReadResult grid = readCloud(write("a.asc", std::string(head) + "1 2 3\n4 -9999\n6\n"));
    ASSERT_EQ(grid.error, "");
    ASSERT_EQ(grid.points(), 5);
    expectPoint(grid, 0, 11, 23, 1);
    expectPoint(grid, 4, 15, 21, 6);
  }
  expectRefused(
    readCloud(write("b.asc", "ncols 3\nnrows 2\ncellsize 1\n1 2 3\n4 5\n")), "after 5 of 6 heights");
  expectRefused(
    readCloud(write("c.asc", "ncols 30000\nnrows 20000\ncellsize 1\n1 2 3\n")), "cells in a file of");
  expectRefused(
    readCloud(write("d.asc", "ncols 1\nnrows x\ncellsize 1\n1 2 3\n")), "line 2: 'nrows' has no number");
  EXPECT_EQ(salvage("e.asc", "ncols 3\nnrows 2\ncellsize 1\n1 2 3\n4 5\n").points(), 5);
}

TEST_F(Exporters, ScansOfPtxStandWhereTheirPosesSay)
{
  const std::string ptx =
    "2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n5 0 0 1\n1 2 3 0.5\n0 0 0 "
    "0.5\n1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n0 0 9 1\n1 2 3 0.25 10 "
    "20 30\n";
  const ReadResult scans = readCloud(write("a.ptx", ptx));
  ASSERT_EQ(scans.points(), 2);
  EXPECT_EQ(scans.format, "PTX");
  expectPoint(scans, 0, 6, 2, 3);
  expectPoint(scans, 1, -2, 1, 12);
  EXPECT_EQ(scans.value("intensity", 1), 0.25);
  EXPECT_EQ(scans.value("RGB", 1, 2), 30);
  EXPECT_EQ(scans.value("RGB", 0, 2), 0);
  EXPECT_EQ(scans.value("ScanIndex", 1), 1);
  EXPECT_TRUE(isSaid(scans.notes, "1 ray without return is left out"));
  expectRefused(readCloud(write("b.ptx", ptx.substr(0, ptx.rfind("0.25")))), "where x y z intensity");
  expectRefused(readCloud(write("c.ptx", "90000000\n90000000\n" + ptx.substr(4))), "points in a file of");
}

const std::string kPlyHead =
  "format ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n";

TEST_F(Exporters, RecordsOfPlyAreNumbersAndNotLines)
{
  const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  const std::string head = "ply\n" + kPlyHead + colors;
  for (const char* body : { "1 2 3 \n125 137 139 \n4 5 6 \n7 8 9 \n", "1 2 3 125 137 139 4 5 6 7 8 9\n",
         "1 2 3 125 137 139\n4 5 6 7 8 9", "1\n2\n3\n125\n137\n139\n4 5\n6\n7 8 9\n",
         "1 2 3 125\n137 139 4 5 6 7\n8 9\n" })
  {
    const ReadResult result = readCloud(write("a.ply", head + body));
    ASSERT_EQ(result.error, "") << body;
    expectPoint(result, 1, 4, 5, 6);
    EXPECT_EQ(result.value("RGB", 0, 2), 139) << body;
    EXPECT_EQ(result.value("RGB", 1, 2), 9) << body;
  }
  expectRefused(readCloud(write("b.ply", head + "1 2 3 4 5 6 7\n1 2 3 4 5 6\n")), "line 11: '7' follows");
  expectRefused(readCloud(write("c.ply", head + "1.00 2.00 3.00 4 5\n1.00 2.00 3.00 4 5 6\n")),
    "line 11: property 'blue' is missing");
}

TEST_F(Exporters, HeadersOfPlyAreReadWithWhatOthersPutThere)
{
  const std::string body = kPlyHead + "end_header\n1 2 3\n4 5 6\n";
  for (const std::string& start : { std::string("\xef\xbb\xbfply\n"), std::string("ply \n"),
         std::string("ply\r\n"), std::string("\nply\n"), std::string("PLY\n") })
  {
    expectPoint(readCloud(write("a.ply", start + body)), 1, 4, 5, 6);
  }
  std::string oldMac =
    "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\nproperty char y\n"
    "property char z\nend_header\n";
  std::replace(oldMac.begin(), oldMac.end(), '\n', '\r');
  expectPoint(readCloud(write("f.ply", oldMac + "\n\n\n")), 0, 10, 10, 10);
  const ReadResult stray = readCloud(write("b.ply", "ply\nbye\nbye\n" + body));
  expectPoint(stray, 1, 4, 5, 6);
  EXPECT_TRUE(isSaid(stray.notes, "2 lines of the header, beginning with 'bye' in line 2"));
  const ReadResult wide = readCloud(write("c.ply",
    "ply\n" + kPlyHead +
      "property int64 t\nproperty uint64 u\nproperty bool b\nend_header\n1 2 3 5000000000 "
      "18446744073709551615 1\n4 5 6 -9007199254740993 +9007199254740993 0\n"));
  ASSERT_EQ(wide.error, "");
  EXPECT_EQ(wide.array("t")->GetVariantValue(1).ToLongLong(), -9007199254740993ll);
  EXPECT_EQ(wide.array("u")->GetVariantValue(0).ToUnsignedLongLong(), 18446744073709551615ull);
  EXPECT_EQ(wide.array("u")->GetVariantValue(1).ToUnsignedLongLong(), 9007199254740993ull);
  EXPECT_EQ(wide.value("b", 0), 1);
  EXPECT_EQ(
    readCloud(write("e.ply", "ply\n" + kPlyHead + "property int64 t\nend_header\n1 2 3 1e3\n4 5 6 7\n"))
      .value("t", 0),
    1000)
    << "the number, and not its beginning";
  const ReadResult lists = readCloud(write("d.ply",
    "ply\n" + kPlyHead + "property list uchar uint view_indices\nend_header\n1 2 3 2 7 8\n4 5 6 0\n"));
  expectPoint(lists, 1, 4, 5, 6);
  EXPECT_TRUE(isSaid(lists.notes, "the list 'view_indices'"));
}

TEST_F(Exporters, SplatsHaveTheirColoursAndFaintOnesAreLeftOut)
{
  std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
    "property float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\nproperty float opacity\n"
    "end_header\n1 2 3 1.7724538 -1.7724538 0 3\n4 5 6 0 0 0 -6\n";
  const ReadResult result = readCloud(write("a.ply", ply));
  ASSERT_EQ(result.points(), 1);
  EXPECT_EQ(result.value("RGB", 0, 0), 255);
  EXPECT_EQ(result.value("RGB", 0, 1), 0);
  EXPECT_EQ(result.value("RGB", 0, 2), 128);
  EXPECT_TRUE(isSaid(result.notes, "1 of 2 splats are left out"));
  std::string splat;
  for (int i = 0; i < 2; ++i)
  {
    for (const float value : { 1.0f, 2.0f, 3.0f, 0.1f, 0.1f, 0.1f })
    {
      append(splat, value + static_cast<float>(i));
    }
    splat += std::string("\x0a\x14\x1e", 3) + static_cast<char>(i == 0 ? 255 : 3) +
      std::string("\xff\x80\x80\x80", 4);
  }
  const ReadResult packed = readCloud(write("a.splat", splat));
  ASSERT_EQ(packed.points(), 1);
  EXPECT_EQ(packed.value("RGBA", 0, 2), 30);
}

TEST_F(Exporters, RawRecordsAreKnownBySizeAndValues)
{
  std::string kitti;
  std::string rings;
  for (int i = 0; i < 20; ++i)
  {
    for (const float value : { 10.0f + static_cast<float>(i), -3.5f, 0.25f, 0.5f })
    {
      append(kitti, value);
      append(rings, value);
    }
    append(rings, static_cast<float>(i));
  }
  for (const char* name : { "a.bin", "a", "a.txt" })
  {
    const ReadResult result = readCloud(write(name, kitti));
    ASSERT_EQ(result.points(), 20) << result.error;
    expectPoint(result, 3, 13, -3.5, 0.25);
    EXPECT_EQ(result.value("intensity", 3), 0.5);
  }
  const ReadResult ringed = readCloud(write("a.pcd.bin", rings));
  ASSERT_EQ(ringed.points(), 20) << ringed.error;
  EXPECT_EQ(ringed.value("ring", 19), 19);
  expectRefused(readCloud(write("b.bin", kitti.substr(1))), "a binary file of an unknown kind");
}

std::string numpy(const std::string& header, const std::string& body)
{
  std::string bytes("\x93NUMPY\x01\x00", 8);
  append(bytes, static_cast<std::uint16_t>(header.size()));
  return bytes + header + body;
}

TEST_F(Exporters, ArraysOfNumpyAreRead)
{
  std::string body;
  for (const double value : { 1.0, 2.0, 3.0, 4.0, 5.0, 6.5 })
  {
    append(body, value);
  }
  expectPoint(
    readCloud(write("a.npy", numpy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n", body))),
    1, 4, 5, 6.5);
  expectPoint(
    readCloud(write("b.npy", numpy("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }\n", body))), 1,
    2, 4, 6.5);
  std::string records;
  append(records, 7.0f);
  append(records, std::uint16_t{ 9 });
  append(records, 8.0f);
  append(records, 9.0f);
  const ReadResult named = readCloud(write("c.npy",
    numpy("{'descr': [('z', '<f4'), ('ring', '<u2'), ('x', '<f4'), ('y', '<f4')], 'fortran_order': False, "
          "'shape': "
          "(1,), }\n",
      records)));
  expectPoint(named, 0, 8, 9, 7);
  EXPECT_EQ(named.value("ring", 0), 9);
  expectRefused(
    readCloud(write("d.npy",
      numpy("{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000, 4000000000, 3), }\n", body))),
    "more rows");
  expectRefused(
    readCloud(write("e.npy", numpy("{'descr': '|O', 'fortran_order': False, 'shape': (2, 3), }\n", body))),
    "'|O'");
  expectRefused(readCloud(write("f.npy", numpy("{'descr': '<f8'}", body))), "'fortran_order'");
}

TEST_F(Exporters, WhatIsNotReadIsNamedWithTheWayOut)
{
  const struct
  {
    const char* name;
    std::string start;
    const char* words;
  } foreign[] = { { "a.gltf", "{\"asset\": {\"version\": \"2.0\"}}", "glTF" },
    { "a.drc", "DRACO\x02\x02", "draco_decoder" }, { "a.tif", std::string("II*\0\x08\0\0\0", 8), "gdal2xyz" },
    { "a.bag", "#ROSBAG V2.0\n", "bag_to_pcd" }, { "a.pcap", "\xd4\xc3\xb2\xa1\x02", "pcap" },
    { "tileset.json", "{\"geometricError\": 1}", "3D Tiles" },
    { "ept.json", "{\"hierarchyType\": \"json\"}", "EPT" },
    { "cloud.js", "{\"octreeDir\": \"data\"}", "Potree" },
    { "a.usdz", std::string("PK\x03\x04") + std::string(22, '\0') + std::string("\x08\0\0\0", 4) + "room.usd",
      "USDZ" },
    { "a.bin", "CCB2\x01", "CloudCompare" }, { "a.rxp", std::string("\x01\0\xfe\xca", 4), "RIEGL" },
    { "a.zip", std::string("PK\x03\x04") + std::string(22, '\0') + std::string("\x09\0\0\0", 4) + "cloud.ply",
      "cloud.ply" },
    { "packed.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty uint packed_position\nend_header\n1\n",
      "splat-transform" },
    { "a.las", "version https://git-lfs.github.com/spec/v1\n", "git lfs pull" } };
  for (const auto& each : foreign)
  {
    expectRefused(readCloud(write(each.name, each.start)), each.words);
  }
}

/// One record with user, number and text.
std::string lasRecord(const std::string& user, int id, const std::string& text, const std::string& content)
{
  std::string record(54, '\0');
  record.replace(2, user.size(), user);
  put(record, 18, static_cast<std::uint16_t>(id));
  put(record, 20, static_cast<std::uint16_t>(content.size()));
  record.replace(22, text.size(), text);
  return record + content;
}

std::string withRecords(std::string las, const std::string& records, std::uint32_t count)
{
  const std::size_t head = las[25] == 4 ? 375 : 227;
  las.insert(head, records);
  put(las, 96, static_cast<std::uint32_t>(head + records.size()));
  put(las, 100, count);
  return las;
}

std::string extraBytes(std::uint8_t type, std::uint8_t options, const std::string& name)
{
  std::string descriptor(192, '\0');
  descriptor[2] = static_cast<char>(type);
  descriptor[3] = static_cast<char>(options);
  descriptor.replace(4, name.size(), name);
  descriptor.replace(160, 9, "described");
  return descriptor;
}

TEST_F(Exporters, NoDataOfExtraBytesIsNanAndComesBack)
{
  constexpr std::int16_t kNone = -32768;
  for (const bool isWide : { false, true })
  {
    std::string descriptor = extraBytes(4, 0x09, "Height above ground");
    isWide ? put(descriptor, 40, std::int64_t{ kNone }) : put(descriptor, 40, kNone);
    put(descriptor, 112, 0.1);
    std::string las = makeLas(4, 0, 22);
    put(las, 375 + 20, std::int16_t{ 150 });
    put(las, 375 + 22 + 20, kNone);
    las = withRecords(las, lasRecord("LASF_Spec", 4, "Extra", descriptor), 1);
    const ReadResult result = readCloud(write("a.las", las));
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(result.value("Height above ground", 0), 0.1 * 150);
    EXPECT_TRUE(std::isnan(result.value("Height above ground", 1)));
    std::vector<std::string> notes;
    ASSERT_EQ(writeCloud(result.cloud, path("b.las"), &notes), "");
    EXPECT_TRUE(notes.empty()) << notes[0];
    std::ifstream file(path("b.las"), std::ios::binary);
    const std::string again((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(again.substr(375), las.substr(375)) << "the same records and points";
    ASSERT_EQ(writeCloud(result.cloud, path("c.laz")), "");
    expectSameBits(
      result.array("Height above ground"), readCloud(path("c.laz")).array("Height above ground"));
    result.array("Height above ground")->SetComponent(0, 0, 15.03);
    ASSERT_EQ(writeCloud(result.cloud, path("d.las")), "");
    EXPECT_EQ(readCloud(path("d.las")).value("Height above ground", 0), 15.03) << "no multiple of the step";
  }
}

TEST_F(Exporters, LasKeepsWhatItCameWith)
{
  std::string las = makeLas(2, 0, 20);
  put(las, 4, std::uint16_t{ 4711 });
  las.replace(8, 16, "0123456789abcdef");
  las.replace(26, 9, "scanner 9");
  put(las, 90, std::uint16_t{ 200 });
  put(las, 92, std::uint16_t{ 2021 });
  las = withRecords(las,
    lasRecord("LASF_Spec", 0, "Classes", std::string("\x02ground\0\0\0\0\0\0\0\0\0", 16)) +
      lasRecord("somebody", 1234, "own record", "kept as it is"),
    2);
  const ReadResult result = readCloud(write("a.las", las));
  ASSERT_EQ(writeCloud(result.cloud, path("b.las")), "");
  std::ifstream file(path("b.las"), std::ios::binary);
  const std::string again((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(again.substr(227), las.substr(227));
  EXPECT_EQ(again.substr(4, 2), las.substr(4, 2));
  EXPECT_EQ(again.substr(8, 16), las.substr(8, 16));
  EXPECT_EQ(again.substr(26, 32), las.substr(26, 32));
  EXPECT_EQ(again.substr(90, 4), las.substr(90, 4));
  std::string ids = makeLas(2, 0, 28);
  put(ids, 227 + 20, std::int64_t{ 9007199254740993 });
  ids = withRecords(ids, lasRecord("LASF_Spec", 4, "Extra", extraBytes(8, 0, "Nanoseconds")), 1);
  ASSERT_EQ(writeCloud(readCloud(write("e.las", ids)).cloud, path("f.las")), "");
  EXPECT_EQ(
    readCloud(path("f.las")).array("Nanoseconds")->GetVariantValue(0).ToLongLong(), 9007199254740993ll);
  const ReadResult six = readCloud(write("c.las", makeLas(4, 6, 30)));
  ASSERT_EQ(writeCloud(six.cloud, path("d.las")), "");
  EXPECT_EQ(readCloud(path("d.las")).format, "LAS 1.4 (point format 6)");
  ASSERT_EQ(writeCloud(six.cloud, path("g.laz")), "");
  ASSERT_EQ(writeCloud(readCloud(path("g.laz")).cloud, path("h.laz")), "");
  EXPECT_EQ(readCloud(path("h.laz")).format, readCloud(path("g.laz")).format) << "packed formats have a mark";
}

TEST_F(Exporters, ExtendedRecordsOfLasStayBehindThePoints)
{
  std::string las = makeLas(4, 6, 30);
  std::string far(60, '\0');
  far.replace(2, 8, "somebody");
  put(far, 18, std::uint16_t{ 7 });
  put(far, 20, std::uint64_t{ 5 });
  put(las, 235, static_cast<std::uint64_t>(las.size()));
  put(las, 243, std::uint32_t{ 1 });
  las += far + "bytes";
  const ReadResult result = readCloud(write("a.las", las));
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(writeCloud(result.cloud, path("b.las")), "");
  std::ifstream file(path("b.las"), std::ios::binary);
  const std::string again((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(again.substr(375), las.substr(375));
  EXPECT_EQ(again.substr(235, 12), las.substr(235, 12));
  ASSERT_EQ(writeCloud(result.cloud, path("c.laz")), "");
  EXPECT_EQ(readCloud(path("c.laz")).error, "");
}

TEST_F(Exporters, DegreesAreSaid)
{
  std::string keys;
  for (const int value : { 1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, 4269 })
  {
    append(keys, static_cast<std::uint16_t>(value));
  }
  const ReadResult result = readCloud(
    write("a.las", withRecords(makeLas(2, 0, 20), lasRecord("LASF_Projection", 34735, "", keys), 1)));
  EXPECT_EQ(unitOf(result), "degree");
  EXPECT_TRUE(isSaid(result.notes, "degrees of longitude and latitude"));
  const std::string text = "GEOGCS[\"WGS 84\",UNIT[\"degree\",0.0174532925199433]]";
  const ReadResult words = readCloud(
    write("b.las", withRecords(makeLas(4, 6, 30), lasRecord("LASF_Projection", 2112, "", text), 1)));
  EXPECT_EQ(unitOf(words), "degree");
}

TEST_F(Exporters, FloatsFarFromTheOriginAreSaid)
{
  std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\nproperty float z\n"
    "end_header\n";
  for (int i = 0; i < 400; ++i)
  {
    ply += std::to_string(515385 + i % 20) + " " + std::to_string(4918360 + i / 20) + " 3\n";
  }
  EXPECT_TRUE(isSaid(readCloud(write("a.ply", ply)).notes, "a grid of steps of 0.5 in y"));
  EXPECT_TRUE(readCloud(write("b.txt", "515385.1 4918360.2 3\n515386.1 4918361.2 3\n")).notes.empty());
}

TEST_F(Exporters, WhatIsCutIsRefusedOrSalvaged)
{
  const auto expectSalvaged =
    [&](const std::string& name, const std::string& content, vtkIdType points, const char* refusal)
  {
    const ReadResult refused = readCloud(write(name, content));
    expectRefused(refused, refusal);
    EXPECT_NE(refused.error.find("--salvage"), std::string::npos) << refused.error;
    const ReadResult result = salvage(name, content);
    EXPECT_EQ(result.error, "") << name;
    EXPECT_EQ(result.points(), points) << name;
    EXPECT_TRUE(isSaid(result.notes, "are read, of")) << name;
  };
  std::string las = makeLas(2, 0, 20);
  put(las, 107, std::uint32_t{ 3 });
  expectSalvaged("a.las", las, 2, "only 40 bytes follow (2 points)");
  const std::string head =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nend_header\n";
  expectSalvaged("a.ply", head + "1.00 2.00 3.00\n4 5 6\n", 2, "after 2 of 3 vertices");
  EXPECT_EQ(salvage("b.ply", head + "1 2 3\n4 5 6\n7 8").points(), 2);
  std::string binary = head;
  binary.replace(binary.find("ascii"), 5, "binary_little_endian");
  for (const float value : { 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f })
  {
    append(binary, value);
  }
  expectSalvaged("c.ply", binary, 2, "counts 3 vertices");
  const std::string pcd =
    "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\n";
  expectSalvaged("a.pcd", pcd + "DATA ascii\n1.00 2.00 3.00\n4 5 6\n", 2, "after 2 of 3 points");
  expectSalvaged("b.pcd", pcd + "DATA binary\n" + binary.substr(head.size() + 15), 2, "counts 3 points");
  expectSalvaged("a.pts", "3\n1 2 3 4\n5 6 7 8\n", 2, "1 points before");
  EXPECT_EQ(salvage("b.pts", "3\n1 2 3 4\n5 6 7 8\n9 1").points(), 2);
  std::string faces = head + "1 2 3\n4 5 6\n";
  faces.insert(faces.find("end_header"), "element face 1\nproperty list uchar int vertex_indices\n");
  const ReadResult torn = salvage("d.ply", faces);
  EXPECT_EQ(torn.points(), 2);
  EXPECT_EQ(torn.notes.size(), 1u) << "nothing is said of faces";
  expectRefused(
    salvage("c.pcd", pcd + "DATA binary_compressed\n" + std::string("\x30\0\0\0\x24\0\0\0abc", 11)),
    "these hold no whole point");
}

TEST_F(Exporters, DepthsCountDown)
{
  const std::string rows = "4.5,52.25,12.5\n4.75,52.5,20.5\n";
  const ReadResult depths = readCloud(write("a.csv", "longitude,latitude,depth\n" + rows));
  expectPoint(depths, 1, 4.75, 52.5, -20.5);
  EXPECT_TRUE(isSaid(depths.notes, "z is column 'depth' with the other sign, which counts down"));
  expectPoint(readCloud(write("b.csv", "lon,lat,depth [m]\n4.5,52.25,-12.5\n")), 0, 4.5, 52.25, -12.5);
  expectPoint(readNamed("d.csv", rows, { "lon", "lat", "-z" }), 1, 4.75, 52.5, -20.5);
}

} // namespace
