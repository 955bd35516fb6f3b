// Points of surveyors: the order of northing and easting, and the names that other languages give them.
#include "CloudFiles.h"

#include <algorithm>

namespace
{

using Survey = CloudFiles;

/// Where the second point of @p text lies.
void expectSecond(const std::string& file, double x, double y, double z)
{
  const ReadResult result = readCloud(file);
  ASSERT_EQ(result.error, "");
  double p[3];
  result.cloud->GetPoint(1, p);
  EXPECT_NEAR(p[0], x, 1e-3);
  EXPECT_NEAR(p[1], y, 1e-3);
  EXPECT_NEAR(p[2], z, 1e-3);
}

TEST_F(Survey, AWordOfLettersNamesTheColumns)
{
  const std::string rows = "1,20.5,100.25,5,GRND\n2,21.5,101.25,6,GRND\n";
  for (const char* title : { "PNEZD\n", "# PNEZD (comma delimited)\n", "Point file, PNEZD:\n" })
  {
    SCOPED_TRACE(title);
    expectSecond(write("a.csv", title + rows), 101.25, 21.5, 6);
  }
  expectSecond(write("b.csv", "# PENZD\n" + rows), 21.5, 101.25, 6);
  expectSecond(write("c.csv", "PNEZ\n1,20.5,100.25,5\n2,21.5,101.25,6\n"), 101.25, 21.5, 6);
  expectSecond(write("d.txt", "# NEZ\n20.5 100.25 5\n21.5 101.25 6\n"), 101.25, 21.5, 6);
  expectSecond(write("e.txt", "# YXH\n20.5 100.25 5\n21.5 101.25 6\n"), 101.25, 21.5, 6);
  expectSecond(write("f.txt", "# ENZ\n20.5 100.25 5\n21.5 101.25 6\n"), 21.5, 101.25, 6);
  expectSecond(write("g.txt", "# PEN of Zoe\n20.5 100.25 5\n21.5 101.25 6\n"), 21.5, 101.25, 6);
}

TEST_F(Survey, TheOrderIsAWordOfItsOwnAndGivesWayToNames)
{
  const std::string rows = "1,20.5,100.25,5,GRND\n2,21.5,101.25,6,GRND\n";
  for (const char* title :
    { "pnezd\n", "# P-N-E-Z-D\n", "\"PNEZD\"\n", "# Order=PNEZD\n", "# PNEZD/comma\n" })
  {
    SCOPED_TRACE(title);
    const std::string file = write("a.csv", title + rows);
    expectSecond(file, 101.25, 21.5, 6);
    EXPECT_NE(readCloud(file).notes.at(0).find("orders the columns"), std::string::npos);
  }
  for (const char* prose :
    { "# ZEN camera\n", "HEN LANE\n", "# the nez of it\n", "# PNEZ2\n", "# NEZ\n# x y z\n" })
  {
    SCOPED_TRACE(prose);
    expectSecond(write("b.txt", std::string(prose) + "20.5 100.25 5\n21.5 101.25 6\n"), 21.5, 101.25, 6);
    EXPECT_TRUE(readCloud(path("b.txt")).notes.empty());
  }
}

TEST_F(Survey, DescriptionsHaveAnyWordsOrNone)
{
  for (const char* rows :
    { "1,20.5,100.25,5\n2,21.5,101.25,6,GRND\n", "1,20.5,100.25,5,GRND\n2,21.5,101.25,6,\n",
      "1,20.5,100.25,5,GRND\n2,21.5,101.25,6\n", "1 20.5 100.25 5 EDGE OF ROAD 0\n2 21.5 101.25 6 GRND\n",
      "1 20.5 100.25 5 GRND\n2 21.5 101.25 6 EDGE OF ROAD 0\n" })
  {
    SCOPED_TRACE(rows);
    expectSecond(write("a.csv", std::string("PNEZD\n") + rows), 101.25, 21.5, 6);
  }
}

TEST_F(Survey, EpochsBeforeMapCoordinatesAreTimes)
{
  for (const char* three : { "000", "" }) // milliseconds and seconds
  {
    std::string rows;
    for (const char* row : { "1700000000", "1700000002", "1700000003" })
    {
      rows += row + std::string(three) + " 412345.2 5350000.1 530.5\n";
    }
    EXPECT_NE(readCloud(write("a.txt", rows)).cloud->GetPointData()->GetArray("time"), nullptr);
  }
}

TEST_F(Survey, NumberedPointsOfUtmAreTakenByTheirDigits)
{
  const std::string northing = "1,5350000.1,412345.2,530,GRND\n2,5350003.1,412347.2,531,GRND\n"
                               "3,5350001.1,412341.2,532,EDGE\n";
  expectSecond(write("a.csv", northing), 412347.2, 5350003.1, 531);
  const std::vector<std::string> notes = readCloud(path("a.csv")).notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
    [](const std::string& note) { return note.find("taken as id,y,x,z,-") != std::string::npos; }));
  // Names and repeated numbers are like numbers.
  expectSecond(write("f.csv", "CP1,5350000.1,412345.2,530,GRND\nCP2,5350003.1,412347.2,531,GRND\n"), 412347.2,
    5350003.1, 531);
  expectSecond(write("g.csv",
                 "7,5350000.1,412345.2,530.5,A\n8,5350003.1,412347.2,531.5,A\n"
                 "7,5350000.1,412345.2,530.5,A\n"),
    412347.2, 5350003.1, 531.5);
  expectSecond(
    write("b.csv", "1,412345.2,5350000.1,530\n2,412347.2,5350003.1,531\n3,412341.2,5350001.1,532\n"),
    412347.2, 5350003.1, 531);
  // Without numbers or texts these may be feet of a state plane, whose eastings have a digit more.
  expectSecond(
    write("e.csv", "17,1005432.1,210321.5,42.5\n4,1005435.1,210323.5,43.5\n9,1005433.1,210325.5,44.5\n"),
    1005435.1, 210323.5, 43.5);
  ASSERT_EQ(readCloud(path("e.csv")).notes.size(), 1u);
  EXPECT_NE(readCloud(path("e.csv")).notes[0].find("--columns id,y,x,z"), std::string::npos);
  // A code of numbers is like texts; of local coordinates nobody can tell.
  expectSecond(
    write("h.csv", "1,5350000.1,412345.2,530,17\n2,5350003.1,412347.2,531,17\n3,5350001.1,412341.2,532,4\n"),
    412347.2, 5350003.1, 531);
  expectSecond(write("i.csv", "CP1,5000.1,2500.2,53,IP\nCP2,5003.1,2502.2,54,IP\n"), 5003.1, 2502.2, 54);
  EXPECT_NE(readCloud(path("i.csv")).notes.at(0).find("--columns -,y,x,z,-"), std::string::npos);
  expectSecond(write("c.xyz", "2100000.1 712345.2 530\n2100003.1 712347.2 531\n2100001.1 712341.2 532\n"),
    2100003.1, 712347.2, 531);
  EXPECT_EQ(readCloud(path("c.xyz")).notes.size(), 1u) << "it is said";
  EXPECT_TRUE(readCloud(write("d.xyz", "412345.2 5350000.1 530\n412347.2 5350003.1 531\n")).notes.empty());
}

TEST_F(Survey, NumberedNamesAreNoNames)
{
  expectSecond(write("a.csv", "Var1,Var2,Var3\n1,2,3\n4,5.5,6\n"), 4, 5.5, 6);
  EXPECT_NE(readCloud(path("a.csv")).notes.at(0).find("taken as x,y,z; --columns"), std::string::npos);
  expectRefused(
    readCloud(write("b.csv", "band1,band2,band3\n1,2,3\n4,5.5,6\n")), "no columns named x, y and z");
}

TEST_F(Survey, GermanHeadersAreKnown)
{
  const std::string rows = "1;20.5;100.25;5\n2;21.5;101.25;6\n";
  for (const char* header :
    { "Punktnummer;Rechtswert;Hochwert;H\xc3\xb6he\n", "NR;RECHTSWERT;HOCHWERT;H\xc3\x96HE\n",
      "Nr;Rechtswert;Hochwert;H\xf6he\n", "Pkt;Rechts;Hoch;Hoehe\n", "Nr;RW;HW;H\n", "Nr;Y/Rechts;X/Hoch;Z\n",
      "Nr;Rechtswert Y;Hochwert X;Z\n", "Nr;Rechtswert [m];Hochwert [m];H\xc3\xb6he [m]\n" })
  {
    SCOPED_TRACE(header);
    expectSecond(write("a.csv", header + rows), 21.5, 101.25, 6);
  }
  expectSecond(write("b.csv", "Nr;Hochwert;Rechtswert;Hoehe\n" + rows), 101.25, 21.5, 6);
  for (const char* header :
    { "Punkt;Ostwert;Nordwert;NHN\n", "Nr;Y (Rechtswert);X (Hochwert);Z (H\xc3\xb6he)\n",
      "Point ID;Eastings;Northings;Level\n", "Pt;Grid Easting;Grid Northing;RL\n", "Punto;Est;Nord;Quota\n",
      "Pt;Eastings (m);Northings (m);Height (ODN)\n" })
  {
    SCOPED_TRACE(header);
    expectSecond(write("c.csv", header + rows), 21.5, 101.25, 6);
  }
}

TEST_F(Survey, YBeforeXIsTheEasting)
{
  const auto noteOf = [&](const char* name) { return readCloud(path(name)).notes.at(0); };
  const std::string gauss = "1,3512345.1,5654321.3,101,12\n2,3512355.1,5654331.3,102,12\n";
  expectSecond(write("a.csv", "Nr,Y,X,H,Code\n" + gauss), 3512355.1, 5654331.3, 102);
  EXPECT_NE(noteOf("a.csv").find("as surveys have it; where that is wrong, give --columns Nr,Y,X,H,Code"),
    std::string::npos);
  const std::string utm = "1,412345.2,5350000.1,530\n2,412347.2,5350003.1,531\n";
  expectSecond(write("b.csv", "Nr,Y [m],X [m],Z [m]\n" + utm), 412347.2, 5350003.1, 531);
  expectSecond(write("c.csv", "y,x,z\n1.5,2,3\n4,5.5,6\n"), 5.5, 4, 6);
  EXPECT_NE(
    noteOf("c.csv").find("as it is called; where that is wrong, give --columns x,y,z"), std::string::npos);
  const std::string mathematical = "1,5350000.1,412345.2,530\n2,5350003.1,412347.2,531\n";
  expectSecond(write("d.csv", "Nr,Y,X,H\n" + mathematical), 412347.2, 5350003.1, 531);
  EXPECT_TRUE(readCloud(path("d.csv")).notes.empty());
  expectSecond(write("e.csv", "Nr,X,Y,H\n" + mathematical), 5350003.1, 412347.2, 531);
  EXPECT_NE(noteOf("e.csv").find("X is like northings"), std::string::npos);
}

TEST_F(Survey, HeightsOverTheEllipsoidAreHeights)
{
  for (const char* title : { "h_ell", "alt_msl", "ellipsoidal_height", "EllipsoidalHeight", "h" })
  {
    SCOPED_TRACE(title);
    const std::string rows = "48.1 11.5 560\n48.2 11.6 561\n";
    expectSecond(write("a.txt", std::string("# lat lon ") + title + "\n" + rows), 11.6, 48.2, 561);
  }
}

TEST_F(Survey, TwoPointsHaveNumbersAsMoreHave)
{
  expectSecond(write("a.csv", "1,450000.12,5650000.34,100.2,TREE\n2,450010.12,5650010.34,101.2,TREE\n"),
    450010.12, 5650010.34, 101.2);
  expectSecond(write("b.txt", "1 0.25 0.5 7.5\n2 0.5 0.75 8.5\n"), 2, 0.5, 0.75);
}

} // namespace
