#include "CloudFiles.h"

#include "IO/Info/LengthUnit.h"

#include "vtkFieldData.h"
#include "vtkStringArray.h"
#include "vtkVariant.h"

#include <cmath>
#include <string>

namespace
{

class Text : public CloudFiles
{
};

TEST_F(Text, PlainXyzWithEverySeparator)
{
  for (const char* separator : { " ", "\t", ",", ", ", ";", " ; " })
  {
    const std::string s = separator;
    const ReadResult result = readCloud(write("a.xyz", "1" + s + "2" + s + "3\n4" + s + "5" + s + "6.5\n"));
    ASSERT_EQ(result.error, "") << "separator '" << s << "'";
    ASSERT_EQ(result.points(), 2);
    EXPECT_EQ(result.cloud->GetPoint(1)[2], 6.5);
    EXPECT_EQ(result.cloud->GetPoints()->GetDataType(), VTK_FLOAT);
    EXPECT_EQ(result.cloud->GetNumberOfVerts(), 2);
  }
}

TEST_F(Text, ManyDigitsMakeDoublePoints)
{
  const ReadResult result = readCloud(write("a.txt", "684766.39 5017773.08 1\n684766.4 5017773.1 2\n"));
  EXPECT_EQ(result.cloud->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(result.cloud->GetPoint(0)[1], 5017773.08);
}

TEST_F(Text, DecimalExponentsAreNumbers)
{
  const ReadResult result = readCloud(write("a.xyz", "1.5e-3 2E+2 -3.25e0\n1e5,1E-5,+.5e1\n"));
  EXPECT_NE(result.error, "") << "two separators";
  const ReadResult same = readCloud(write("b.xyz", "1.5e-3 2E+2 -3.25e0\n1e5 1E-5 +.5e1\n"));
  ASSERT_EQ(same.error, "");
  EXPECT_FLOAT_EQ(static_cast<float>(same.cloud->GetPoint(0)[0]), 0.0015f);
  EXPECT_EQ(same.cloud->GetPoint(0)[1], 200.0);
  EXPECT_EQ(same.cloud->GetPoint(0)[2], -3.25);
  EXPECT_EQ(same.cloud->GetPoint(1)[0], 100000.0);
  EXPECT_EQ(same.cloud->GetPoint(1)[2], 5.0);
}

TEST_F(Text, CarriageReturnsBlankLinesCommentsAndNan)
{
  const ReadResult result = readCloud(
    write("a.xyz", "\xef\xbb\xbf# made by hand\r\n\r\n// again\r\n+1 2 3\r\n\r\nnan NaN inf\r\n-1 -2 -Inf"));
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.points(), 3);
  EXPECT_EQ(result.cloud->GetPoint(0)[0], 1.0);
  EXPECT_TRUE(std::isnan(result.cloud->GetPoint(1)[0]));
  EXPECT_TRUE(std::isinf(result.cloud->GetPoint(2)[2]));
}

TEST_F(Text, PtsKeepsItsFirstPoint)
{
  const ReadResult result = readCloud(write("a.pts", "2\n1 2 3 -100 10 20 30\n4 5 6 200 40 50 60\n"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.format, "PTS");
  ASSERT_EQ(result.points(), 2);
  EXPECT_EQ(result.cloud->GetPoint(0)[0], 1.0);
  EXPECT_EQ(result.value("intensity", 0), -100);
  EXPECT_EQ(result.value("RGB", 1, 2), 60);
}

TEST_F(Text, PtsMayHoldSeveralScansButNotFewerPointsThanItSays)
{
  EXPECT_EQ(readCloud(write("a.pts", "1\n1 2 3 4\n2\n5 6 7 8\n9 8 7 6\n")).points(), 3);
  expectRefused(readCloud(write("b.pts", "3\n1 2 3 4\n5 6 7 8\n")), "1 points before");
  expectRefused(readCloud(write("c.pts", "1\n1 2 3 4\n5 6 7 8\n")), "line 3");
  expectRefused(readCloud(write("d.pts", "99999999999999\n1 2 3 4\n")), "line 1");
}

TEST_F(Text, ColumnsWithoutHeaderAreGuessed)
{
  const ReadResult four = readCloud(write("4.xyz", "1 2 3 0.5\n"));
  EXPECT_EQ(four.value("intensity", 0), 0.5);
  const ReadResult colors = readCloud(write("6.xyz", "1 2 3 0 128 255\n"));
  EXPECT_EQ(colors.value("RGB", 0, 1), 128);
  const ReadResult normals = readCloud(write("6n.xyz", "1 2 3 0 -0.6 0.8\n1 2 3 0 0 1\n"));
  EXPECT_EQ(normals.array("RGB"), nullptr);
  EXPECT_EQ(normals.value("Normals", 1, 2), 1.0);
  const ReadResult neither = readCloud(write("6x.xyz", "1 2 3 0 -128 255\n1 2 3 0 0 1.5\n"));
  EXPECT_EQ(neither.cloud->GetPointData()->GetNumberOfArrays(), 3);
  const ReadResult five = readCloud(write("5.xyz", "1 2 3 4 5.5\n"));
  EXPECT_EQ(five.array("column_4")->GetDataType(), VTK_INT);
  EXPECT_EQ(five.value("column_5", 0), 5.5);
}

TEST_F(Text, HeaderNamesTheColumns)
{
  const ReadResult csv =
    readCloud(write("a.csv", "\"gain\",X,Y,Z,Red,Green,Blue,label\n0.25,1,2,3,9,8,7,\n0.5,4,5,6,6,5,4,12\n"));
  ASSERT_EQ(csv.error, "");
  EXPECT_EQ(csv.format, "text (comma separated)");
  EXPECT_EQ(csv.cloud->GetPoint(1)[0], 4.0);
  EXPECT_EQ(csv.value("gain", 0), 0.25);
  EXPECT_EQ(csv.value("RGB", 0, 0), 9);
  EXPECT_TRUE(std::isnan(csv.value("label", 0)));
  EXPECT_EQ(csv.value("label", 1), 12);
  const ReadResult commented = readCloud(write("b.txt", "//X Y Z heat\n1 2 3 4\n"));
  EXPECT_EQ(commented.value("heat", 0), 4);
  const ReadResult paraview = readCloud(
    write("c.csv", "\"RGB:0\",\"RGB:1\",\"RGB:2\",\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3,4,5,6\n"));
  EXPECT_EQ(paraview.cloud->GetPoint(0)[2], 6.0);
  EXPECT_EQ(paraview.value("RGB", 0, 2), 3);
}

TEST_F(Text, ANumberMayHaveACommaForItsPoint)
{
  for (const char* text : { "x;y;z;w\n-0,25;1;3,5e1;7\n1;2,5;3;8\n", "-0,25\t1\t3,5e1\t7\n1 2,5 3 8\n",
         "X Y Z w\n-0,25 1 3,5e1 7\n1 2,5 3 8\n" })
  {
    const ReadResult result = readCloud(write("a.csv", text));
    ASSERT_EQ(result.error, "") << text;
    ASSERT_EQ(result.points(), 2) << text;
    EXPECT_EQ(result.cloud->GetPoint(0)[0], -0.25) << text;
    EXPECT_EQ(result.cloud->GetPoint(0)[2], 35.0) << text;
    EXPECT_EQ(result.cloud->GetPoint(1)[1], 2.5) << text;
  }
  EXPECT_EQ(readCloud(write("b.csv", "1,2,3\n4,5,6\n")).cloud->GetPoint(1)[2], 6.0) << "they separate";
  EXPECT_EQ(readCloud(write("c.csv", "\"x\",\"y\",\"z\"\n\"1\",\"2.5\",3\n")).cloud->GetPoint(0)[1], 2.5);
  expectRefused(
    readCloud(write("d.csv", "x;y;z\n1.234,5;1;2\n")), "line 2, column 1: '1.234,5' is not a number");
}

TEST_F(Text, ColumnsOfTextsAreLeftOutAndNamed)
{
  const ReadResult named = readCloud(write("a.csv",
    "time,x,y,z,\"class, German\",gain\n2024-05-01 12:00,1,2,3,\"Geb\xc3\xa4ude, alt\",4\n"
    "2024-05-01 12:01,5,6,7,,8\n"));
  ASSERT_EQ(named.error, "");
  EXPECT_EQ(named.cloud->GetPoint(1)[2], 7.0);
  EXPECT_EQ(named.value("gain", 1), 8);
  EXPECT_EQ(named.cloud->GetPointData()->GetNumberOfArrays(), 1);
  ASSERT_EQ(named.notes.size(), 2U);
  EXPECT_EQ(named.notes[0],
    "column 'time' holds texts, such as '2024-05-01 12:00' in line 2, and is left out; write numbers in "
    "their "
    "place to keep it");
  EXPECT_NE(named.notes[1].find("'class, German' holds texts, such as 'Geb\xc3\xa4ude, alt' in line 2"),
    std::string::npos)
    << named.notes[1];

  const ReadResult plain = readCloud(write("b.txt", "A1 1 2 3 tree 4\nA2 5 6 7 \"tall tree\" 8\n"));
  ASSERT_EQ(plain.error, "");
  EXPECT_EQ(plain.cloud->GetPoint(1)[0], 5.0);
  EXPECT_EQ(plain.value("intensity", 1), 8);
  ASSERT_EQ(plain.notes.size(), 3U);
  EXPECT_EQ(plain.notes[0].find(
              "no header names the columns, which are taken as -,x,y,z,-,intensity; where northing"),
    0U)
    << plain.notes[0];
  EXPECT_NE(plain.notes[2].find("column 5 holds texts, such as 'tree' in line 1"), std::string::npos);
}

TEST_F(Text, TextsAmongNumbersAreNanAndCounted)
{
  const ReadResult result = readCloud(write("a.csv", "x,y,z,gain\n1,2,3,4\n5,6,7,gap\n8,9,10,11\n"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.value("gain", 0), 4);
  EXPECT_TRUE(std::isnan(result.value("gain", 1)));
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_EQ(result.notes[0],
    "1 of 3 cells of column 'gain' hold no number, such as 'gap' in line 3, and become NaN; write numbers in "
    "their place to keep them");
  expectRefused(
    readCloud(write("b.csv", "x,y,z,gain\n1,2,3,4\n5,6,-,7\n")), "line 3, column 3: '-' is not a number");
  expectRefused(readCloud(write("c.csv", "x,y,z\n1,a,3\n5,b,7\n")), "line 2, column 2: 'a' is not");
  expectRefused(readCloud(write("d.txt", "1 one 3\n")), "line 1, column 2: 'one' is not a number");
}

TEST_F(Text, TabsSeparateTextsOfSeveralWords)
{
  for (const char* text : { "x\ty\tz\tclass\tGPS Time\n1\t2\t3\tGround\t7\n4\t5\t6\tHigh Vegetation\t\n",
         "1\t2\t3\tHigh Vegetation\t7\n4\t5\t6\tGround\t8\n" })
  {
    const ReadResult result = readCloud(write("a.txt", text));
    ASSERT_EQ(result.error, "") << text;
    EXPECT_EQ(result.format, "text (tab separated)");
    EXPECT_EQ(result.cloud->GetPoint(1)[2], 6.0) << text;
    EXPECT_EQ(result.cloud->GetPointData()->GetNumberOfArrays(), 1) << text;
    EXPECT_EQ(result.cloud->GetPointData()->GetArray(0)->GetComponent(0, 0), 7.0) << text;
  }
  const ReadResult aligned = readCloud(write("b.txt", "x\ty\tz\n1\t\t2 3\n4 5 6\n"));
  ASSERT_EQ(aligned.error, "");
  EXPECT_EQ(aligned.cloud->GetPoint(0)[2], 3.0);
}

TEST_F(Text, CommentsMayEndALine)
{
  for (const char* text : { "1 2 3 # first\n4 5 6 // second one\n", "1,2,3 # first\n4,5,6 // second, one\n" })
  {
    const ReadResult result = readCloud(write("a.xyz", text));
    ASSERT_EQ(result.error, "") << text;
    EXPECT_EQ(result.cloud->GetPoint(1)[2], 6.0) << text;
    EXPECT_EQ(result.cloud->GetPointData()->GetNumberOfArrays(), 0) << text;
  }
}

TEST_F(Text, CommasThatSeparateAndMarkDecimalsAreRefusedUnlessQuoted)
{
  const ReadResult quoted = readCloud(write("a.csv", "\"x\",\"y\",\"z\"\n\"-1,5\",\"2,5\",\"3\"\n"));
  ASSERT_EQ(quoted.error, "");
  EXPECT_EQ(quoted.cloud->GetPoint(0)[0], -1.5);
  EXPECT_EQ(quoted.cloud->GetPoint(0)[1], 2.5);
  for (const char* text : { "x,y,z\n1,5,2,5,3,5\n", "1,25,2,50,3,75\n-1,05,2,50,3,75\n" })
  {
    expectRefused(
      readCloud(write("b.csv", text)), "mark decimals, too: write decimal points, put numbers in");
  }
  EXPECT_EQ(readCloud(write("c.csv", "1,2,3,0,128,255\n")).value("RGB", 0, 2), 255);
  EXPECT_EQ(readCloud(write("d.csv", "0.5,02,3,0,128,255\n")).value("RGB", 0, 2), 255)
    << "points mark decimals";
}

TEST_F(Text, CoordinatesAreFoundByWhatTheyAreCalled)
{
  for (const char* header : { "POINT_X,POINT_Y,POINT_Z", "x_coord,y_coord,z_coord", "E,N,H", "X,Y,Height",
         "East (m),North (m),Altitude (m)", "x|y|z" })
  {
    const bool isByBars = header[1] == '|';
    const ReadResult result =
      readCloud(write("a.csv", std::string(header) + (isByBars ? "\n1|2|3\n" : "\n1,2,3\n")));
    ASSERT_EQ(result.error, "") << header;
    EXPECT_EQ(result.cloud->GetPoint(0)[2], 3.0) << header;
  }
  const ReadResult unit = readCloud(write("b.csv", "X [mm];Y [mm];Z [mm];h\n1;2;3;4\n"));
  ASSERT_EQ(unit.error, "");
  EXPECT_EQ(unit.value("h", 0), 4);
  vtkAbstractArray* said = unit.cloud->GetFieldData()->GetAbstractArray("LengthUnit");
  ASSERT_NE(said, nullptr);
  EXPECT_EQ(said->GetVariantValue(0).ToString(), "mm");
  EXPECT_EQ(readCloud(write("c.csv", "x [mm],y,z\n1,2,3\n")).cloud->GetFieldData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(readCloud(write("d.csv", "pos_x,x,y,z,E\n9,1,2,3,8\n")).cloud->GetPoint(0)[0], 1.0);
}

TEST_F(Text, MarksBetweenThousandsAreRefused)
{
  for (const char* text : { "x;y;z\n1;2;3\n1.234,56;5.678,25;1,5\n", "1.234,56 5.678,25 1,5\n",
         "1 2 3\n-1.234.567,5\t5 1\n", "x,y,z\n\"1,234.56\",\"2\",\"3\"\n", "x;y;z\n1;12'345.6;3\n" })
  {
    expectRefused(readCloud(write("a.txt", text)), "without marks between thousands");
  }
}

TEST_F(Text, ColoursOfSixteenBitsAndFractionsAreShown)
{
  const ReadResult words = readCloud(write("a.csv", "x,y,z,r,g,b\n1,2,3,0,256,65535\n1,2,4,7,65279,1\n"));
  ASSERT_EQ(words.error, "");
  EXPECT_EQ(words.array("Color16")->GetDataType(), VTK_UNSIGNED_SHORT);
  EXPECT_EQ(words.value("Color16", 1, 1), 65279);
  ASSERT_NE(words.cloud->GetPointData()->GetScalars(), nullptr);
  EXPECT_STREQ(words.cloud->GetPointData()->GetScalars()->GetName(), "RGB");
  EXPECT_EQ(words.value("RGB", 0, 1), 1);
  EXPECT_EQ(words.value("RGB", 0, 2), 255);
  EXPECT_EQ(words.value("RGB", 1, 1), 254);
  const ReadResult parts =
    readCloud(write("b.csv", "x y z red green blue\n1 2 3 0 0.5 1\n1 2 3 nan 0.25 0\n"));
  ASSERT_NE(parts.array("RGB"), nullptr);
  EXPECT_EQ(parts.value("Color", 0, 1), 0.5);
  EXPECT_EQ(parts.value("RGB", 0, 1), 128);
  EXPECT_EQ(parts.value("RGB", 0, 2), 255);
  EXPECT_EQ(parts.value("RGB", 1, 0), 0);
  const ReadResult large = readCloud(write("c.csv", "x y z red green blue\n1 2 3 0.5 200 255\n"));
  EXPECT_EQ(large.value("RGB", 0, 1), 200);
  EXPECT_EQ(readCloud(write("d.csv", "x y z r g b\n1 2 3 -5 2 3\n")).array("RGB"), nullptr) << "no colours";
}

TEST_F(Text, NamesTheLineOfWhatIsWrong)
{
  expectRefused(readCloud(write("a.xyz", "1 2 3\n4 five 6\n")), "line 2, column 2: 'five'");
  expectRefused(readCloud(write("a.xyz", "1 2 3\n4 5\n")), "line 2: 2 columns where 3");
  expectRefused(readCloud(write("a.xyz", "1 2 3\n4 5 6 7\n")), "line 2: 4 columns where 3");
  expectRefused(readCloud(write("a.xyz", "1 2 3\n1e999 5 6\n")), "1e999");
  expectRefused(
    readCloud(write("a.csv", "left,right,up\n1,2,3\n")), "x, y and z, but 'left', 'right', 'up'; name the");
  const ReadResult degrees = readCloud(write("a.csv", "lat,lon,height\n48,11,3\n"));
  EXPECT_EQ(degrees.cloud->GetPoint(0)[0], 11.0);
  EXPECT_NE(degrees.notes.front().find("degrees of longitude and latitude"), std::string::npos);
  expectRefused(readCloud(write("a.csv",
                  "\xff\xfe"
                  "x")),
    "numbers of a point");
  expectRefused(readCloud(write("a.ptx", "2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n")), "the file ends at line 6");
  EXPECT_EQ(
    readCloud(write("a.csv", "Easting,Northing,Elevation\n684766.39,5017773.08,7\n")).cloud->GetPoint(0)[2],
    7.0);
  expectRefused(readCloud(write("a.csv", "x,y,z\n")), "holds no points");
  expectRefused(readCloud(write("a.csv", "# nothing\n")), "holds no points");
  expectRefused(
    readCloud(write("a.txt", "Dear all,\nthe cloud is attached.\n")), "no line holds the numbers");
  expectRefused(readCloud(write("cameras.txt", "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n1 A 9 8 7\n")),
    "open points3D.txt");
  expectRefused(readCloud(write("a.xyz", "1 2\n3 4\n")), "2 columns");
}

TEST_F(Text, ObjKeepsColorsAndNormalsAndIgnoresFaces)
{
  const ReadResult result = readCloud(write("a.obj",
    "# comment\no thing\nv 0 1 2 1.0 0.5 0\nv 3 4 5 0 0 1\nvn 0 0 1\nvn 0 1 0\nvt 0 0\nf 1//1 2//2 1//1\n"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.format, "OBJ");
  ASSERT_EQ(result.points(), 2);
  EXPECT_EQ(result.value("RGB", 0, 1), 128);
  EXPECT_EQ(result.value("Normals", 1, 1), 1.0);
  EXPECT_EQ(result.cloud->GetNumberOfPolys(), 0);
  const ReadResult plain = readCloud(write("a.txt", "v 512700.125 1 2 1\nv 1 2 3\nvn 0 0 1\n"));
  ASSERT_EQ(plain.error, "");
  EXPECT_EQ(plain.cloud->GetPoints()->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(plain.array("Normals"), nullptr);
  expectRefused(readCloud(write("b.obj", "v 1 2 3\nv 1 two 3\n")), "line 2: 'two'");
  expectRefused(readCloud(write("b.obj", "v 1 2 3\nv 1 2\n")), "line 2");
  expectRefused(readCloud(write("b.obj", "o empty\n")), "holds no points");
}

TEST_F(Text, TimesBeforeTheCoordinatesAreTimes)
{
  std::string path;
  std::string profile;
  for (int i = 1; i <= 40; ++i)
  {
    const double t = 0.1 * i;
    const std::string begin = std::to_string(t) + " " + std::to_string(1.0 + 0.001 * (i * i - 1)) + " " +
      std::to_string(2.0 + std::sin(t)) + " ";
    path += begin + std::to_string(3.0 - t * t) + "\n";
    profile += begin + std::to_string(i * i % 7) + "\n"; // heights of a scanner, and intensities
  }
  EXPECT_EQ(readCloud(write("profile.txt", profile)).array("time"), nullptr);
  for (const std::string& rows :
    { path, std::string("1714564800.1 1 2 3\n1714564801 2 2 3\n1714564807 1 5 4\n") })
  {
    const ReadResult result = readCloud(write("a.txt", rows));
    ASSERT_EQ(result.error, "");
    EXPECT_EQ(result.cloud->GetPoint(0)[0], 1.0) << rows;
    ASSERT_NE(result.array("time"), nullptr) << rows;
    EXPECT_GT(result.value("time", 2), 0.25);
  }
  // A line of a scanner goes on by the same step, and so do others of its coordinates.
  EXPECT_EQ(readCloud(write("b.txt", "0.1 0 2 3\n0.2 0 2.5 4\n0.3 0 2.1 4\n")).array("time"), nullptr);
  EXPECT_EQ(readCloud(write("c.txt", "1 7 2 3\n2 1 5 4\n3 3 1 4\n")).array("time"), nullptr);
}

TEST_F(Text, CoordinatesOfUnlikeUnitsAreRefused)
{
  expectRefused(readCloud(write("a.csv", "x_m,y_m,z_mm\n1,2,3000\n4,5,6000\n")),
    "'z_mm' is in mm, other coordinates are in m");
  EXPECT_EQ(readCloud(write("b.csv", "x_m,y_m,depth_mm,z_m\n1,2,3000,7\n4,5,6000,8\n")).error, "");
}

TEST_F(Text, ColumnsThatAreOddAreLabels)
{
  std::string decimals, white, yellow, first, constant;
  for (int i = 0; i < 40; ++i)
  {
    const std::string place = std::to_string(0.37 * i) + " " + std::to_string(0.5 * (i % 7)) + " 0.25 ";
    const std::string label = std::to_string(i % 3);
    decimals += place + "0.6 0 0.8 " + label + ".000000\n";
    white += place + "255 255 255 " + label + "\n";
    first += place + label + " 128 128 128\n";
    yellow += place + label + " 255 255 0\n";
    constant +=
      place + std::to_string(6 * i) + " " + std::to_string(5 * i) + " " + std::to_string(i) + " 7\n";
  }
  const ReadResult normals = readCloud(write("a.txt", decimals));
  ASSERT_TRUE(normals.array("label") && normals.array("Normals")) << normals.notes[0];
  for (const std::string& text : { white, constant })
  {
    const ReadResult last = readCloud(write("b.txt", text));
    EXPECT_NE(last.notes[0].find("x,y,z,red,green,blue,label"), std::string::npos) << last.notes[0];
  }
  for (const std::string& text : { first, yellow })
  {
    const ReadResult before = readCloud(write("c.txt", text));
    EXPECT_NE(before.notes[0].find("x,y,z,label,red,green,blue"), std::string::npos) << before.notes[0];
  }
}

TEST_F(Text, CellsMayHaveNoValue)
{
  const ReadResult most = readCloud(write("c.csv", "x,y,z,t\n1,2,3,NULL\n1,2,4,NA\n1,2,5,1.5\n"));
  ASSERT_TRUE(most.array("t"));
  EXPECT_EQ(most.value("t", 2), 1.5);
}

TEST_F(Text, UnitsMayStickToTheAxis)
{
  const ReadResult result = readCloud(write("a.csv", "Xmm,Ymm,Zmm\n1,2,3\n4,5,6\n"));
  ASSERT_EQ(result.error, "");
  EXPECT_EQ(result.points(), 2);
  const auto unit =
    vtkStringArray::SafeDownCast(result.cloud->GetFieldData()->GetAbstractArray("LengthUnit"));
  ASSERT_TRUE(unit);
  EXPECT_EQ(unit->GetValue(0), "mm");
}

TEST_F(Text, MeshesMayHaveAGluedCountAndContinuedLines)
{
  const ReadResult off = readCloud(write("a.off", "OFF3 1 0\n0 0 0\n1 0 0\n0 1 2\n3 0 1 2\n"));
  ASSERT_EQ(off.error, "");
  EXPECT_EQ(off.points(), 3);
  EXPECT_EQ(off.cloud->GetPoint(2)[2], 2.0);
  const ReadResult obj =
    readCloud(write("a.obj", "v 0 0 \\\n 3\nv 1 \\\r\n0 \\\r\n0\nv 0 1 0\nf 1 \\\n2 3\n"));
  ASSERT_EQ(obj.error, "");
  EXPECT_EQ(obj.points(), 3);
  EXPECT_EQ(obj.cloud->GetPoint(0)[2], 3.0);
  EXPECT_EQ(obj.notes[0], "the points are the vertices of 1 face");
}

TEST_F(Text, LabelsBecomeTheClassesOfLas)
{
  const ReadResult text =
    readCloud(write("a.csv", "x,y,z,scalar_Label,wide label\n1,2,3,2,300\n4,5,6,200,1\n"));
  std::vector<std::string> notes;
  ASSERT_EQ(writeCloud(text.cloud, path("a.las")), "");
  const ReadResult las = readCloud(path("a.las"));
  EXPECT_EQ(las.value("Classification", 0), 2.0);
  EXPECT_EQ(las.value("Classification", 1), 200.0);
  EXPECT_FALSE(las.array("scalar_Label"));
  EXPECT_TRUE(las.array("wide label"));
}

TEST_F(Text, CellsInQuotationMarksMayHaveSeveralLines)
{
  const ReadResult result = readCloud(write("a.csv",
    "x,y,z,note,w\r\n1,2,3,\"first\r\nsecond, third\",7\r\n4,5,6,\"say \"\"hi\"\"\n\",8\r\n7,8,9,\"5\" "
    "pipe,9\r\n"));
  ASSERT_EQ(result.error, "");
  ASSERT_EQ(result.points(), 3);
  EXPECT_EQ(result.value("w", 1), 8.0);
  EXPECT_EQ(result.cloud->GetPoint(2)[2], 9.0);
  EXPECT_EQ(readCloud(write("b.csv", "x,y,\"z\n[mm]\"\n1,2,3\n")).points(), 1);
  expectRefused(readCloud(write("c.csv", "x,y,z,note\n1,2,3,\"open\n4,5\n")), "line 3: 2 columns");
}

TEST_F(Text, ColumnsTellWhatTheyAre)
{
  // COLMAP without its header: identifiers in no order.
  const ReadResult colmap = readCloud(write("a.txt",
    "63390 1.6 0.2 0.6 115 121 122 1.3\n63376 2.1 0.1 -0.2 102 209 250 1.7\n63371 1.7 0.3 0.5 245 251 249 "
    "0.6\n"));
  EXPECT_EQ(colmap.value("id", 0), 63390.0);
  EXPECT_FLOAT_EQ(colmap.cloud->GetPoint(0)[0], 1.6f);
  EXPECT_EQ(colmap.value("RGB", 1, 2), 250.0);
  // The column of fewer values is the label.
  std::string rows;
  for (int i = 0; i < 40; ++i)
  {
    const auto text = [](int value) { return std::to_string(value) + " "; };
    rows +=
      "0." + text(i) + "1." + text(i) + "3.5 10 " + text(i % 3) + "30 " + text(i % 20) + text(i % 4) + "\n";
  }
  const ReadResult labels = readCloud(write("b.txt", rows));
  ASSERT_NE(labels.array("label"), nullptr);
  ASSERT_NE(labels.array("intensity"), nullptr);
  EXPECT_EQ(labels.value("label", 7), 3.0);
  EXPECT_EQ(labels.value("intensity", 7), 7.0);
  EXPECT_EQ(
    readCloud(write("c.csv", "pos.x,pos.y,pos.z,color.r,color.g,color.b\n1,2,3,4,5,6\n")).value("RGB", 0, 2),
    6.0);
}

TEST_F(Text, LinesOfUnitsAndTitlesAreNoNames)
{
  const ReadResult units = readCloud(write("a.csv", "X,Y,Z,T\nmm,mm,mm,C\n1,2,3,4\n5,6,7,8\n"));
  ASSERT_EQ(units.error, "");
  EXPECT_EQ(units.value("T", 1), 8.0);
  auto* unit = vtkStringArray::SafeDownCast(units.cloud->GetFieldData()->GetAbstractArray("LengthUnit"));
  ASSERT_NE(unit, nullptr);
  EXPECT_EQ(unit->GetValue(0), "mm");
  const ReadResult titles =
    readCloud(write("b.csv", "Export of scan 12\nDate;2024-01-01\n\nX;Y;Z;Temp\n1;2;3;20,5\n4;5;6;21,5\n"));
  ASSERT_EQ(titles.error, "");
  EXPECT_EQ(titles.value("Temp", 1), 21.5);
  // FARO writes the ray's row and column first.
  std::string rays;
  for (int i = 0; i < 40; ++i)
  {
    const std::string k = std::to_string(i);
    rays +=
      std::to_string(i / 8) + " " + std::to_string(i % 8) + " 0." + k + " 1." + k + " 2.5 10 20 " + k + "\n";
  }
  const ReadResult faro = readCloud(write("c.xyz", rays));
  EXPECT_FLOAT_EQ(faro.cloud->GetPoint(7)[2], 2.5f);
  EXPECT_EQ(faro.value("column", 7), 7.0);
  EXPECT_EQ(faro.value("RGB", 7, 2), 7.0);
}

TEST_F(Text, MarksOfInchesAreNoCells)
{
  std::string rows = "x,y,z,c\n";
  for (int i = 0; i < 20; ++i)
  {
    rows += std::to_string(i) + (i % 2 ? ",3,4,\"6\n" : ",2,3,5\"\n");
  }
  EXPECT_EQ(readCloud(write("a.csv", rows)).points(), 20);
  // A run of marks costs one pass.
  EXPECT_EQ(readCloud(write("b.csv", "1,2,3,a\n4,5,6,a" + std::string(400000, '"') + "\n")).points(), 2);
}

TEST_F(Text, ProjectedCoordinatesGoBeforeDegrees)
{
  for (const char* header : { "lat,lon,easting,northing,elev", "easting,northing,lon,lat,elev" })
  {
    const ReadResult result = readCloud(write("a.csv", header + std::string("\n1,2,3,4,5\n")));
    const bool isFirst = header[0] == 'e';
    EXPECT_EQ(result.cloud->GetPoint(0)[0], isFirst ? 1.0 : 3.0) << header;
    EXPECT_EQ(result.cloud->GetPoint(0)[1], isFirst ? 2.0 : 4.0) << header;
  }
  EXPECT_EQ(readCloud(write("b.csv", "x (m),y (metre),z (M)\n1,2,3\n")).error, "");
}

TEST_F(Text, ColoursAmongWordsAndTheLargestFloatAreSaid)
{
  const ReadResult result = readCloud(write("a.xyz", "1 2 3 #aabbcc\n4 5 -3.4028235e38 #aabbcd\n"));
  ASSERT_EQ(result.error, "");
  EXPECT_TRUE(std::isnan(result.cloud->GetPoint(1)[2]));
  ASSERT_EQ(result.notes.size(), 2u);
  EXPECT_NE(result.notes[0].find("'#aabbcc' are comments"), std::string::npos);
  EXPECT_EQ(result.notes[1], "1 coordinate is 3.4e38, which stands for no data, and becomes NaN");
  EXPECT_NE(readCloud(write("b.xyz", "1 2 3\n4 5 1e35\n")).error, "");
}

} // namespace

TEST_F(Text, UnitsAndSystemsOfCommentsAreTaken)
{
  const auto said = [&](const std::string& text, const char* field)
  {
    const ReadResult result = readCloud(write("a.xyz", text));
    auto* words = vtkStringArray::SafeDownCast(result.cloud->GetFieldData()->GetAbstractArray(field));
    return words ? std::string(words->GetValue(0)) : result.error;
  };
  const std::string points = "1 2 3\n4 5 6\n";
  for (const char* comment : { "# units: mm", "// Unit = mm", "# Coordinate units: mm", "# units mm" })
  {
    EXPECT_EQ(said(std::string(comment) + "\n" + points, "LengthUnit"), "mm") << comment;
  }
  for (const char* comment : { "# units: counts", "# angle unit: degrees", "# Intensity units: mm" })
  {
    EXPECT_EQ(said(std::string(comment) + "\n" + points, "LengthUnit"), "") << comment;
  }
  EXPECT_EQ(said("# EPSG:25832\n" + points, "CoordinateSystem"), "EPSG:25832");
  EXPECT_EQ(said("# crs = epsg::25832\n" + points, "LengthUnit"), "");
  EXPECT_EQ(said("# EPSG:4326\n" + points, "LengthUnit"), "degree");
  EXPECT_EQ(said("# EPSG:4326\n700000 2 3\n4 5 6\n", "LengthUnit"), "") << "these are no degrees";
  EXPECT_EQ(said("# EPSG:4647\n" + points, "LengthUnit"), "") << "this one is projected";
  const ReadResult two = readCloud(write("b.xyz", "# from EPSG:4326 to EPSG:32617\n" + points));
  ASSERT_FALSE(two.notes.empty());
  EXPECT_EQ(two.notes[0],
    "comments name several coordinate systems, EPSG:4326 and EPSG:32617, of which none is taken");
}

TEST_F(Text, YardsAreUnitsAsFeetAre)
{
  for (const char* header : { "x [yd],y [yd],z [yd]", "x_yds,y_yds,z_yds", "X (yards),Y (yards),Z (yards)" })
  {
    const ReadResult result = readCloud(write("a.csv", std::string(header) + "\n1,2,3\n"));
    ASSERT_EQ(result.error, "") << header;
    const auto unit = pointhaptics::lengthUnitOf(result.cloud, pointhaptics::Bounds());
    EXPECT_EQ(unit.name, "yd") << header;
    EXPECT_EQ(unit.metres, 0.9144) << header;
  }
}

TEST_F(Text, HeightsOfDegreesKeepTheirUnit)
{
  const std::string text = "lon,lat,height [ft]\n8,47,1000\n8.001,47,1100\n";
  const ReadResult result = readCloud(write("a.csv", text));
  ASSERT_EQ(result.error, "");
  ASSERT_FALSE(result.notes.empty());
  EXPECT_EQ(result.notes[0], "heights are in ft, x and y in degrees");
  const auto local = pointhaptics::inLocalMetres(result.cloud);
  EXPECT_NEAR(local->GetPoint(1)[2] - local->GetPoint(0)[2], 30.48, 1e-9);
  EXPECT_NEAR(pointhaptics::fromLocalFrame(local, { 0, 0, 30.48 }).z, 100.0, 1e-9);
}
