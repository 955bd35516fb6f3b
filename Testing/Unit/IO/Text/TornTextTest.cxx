// Texts that are cut, and what may be taken for text with points.
#include "CloudFiles.h"

#include "Core/Base/Boxes.h"
#include "IO/Info/LengthUnit.h"

#include <utility>

namespace
{

class TornText : public CloudFiles
{
};

TEST_F(TornText, CutTextsAreSalvaged)
{
  const std::string zeros(300, '\0');
  std::string longText;
  while (longText.size() < 5000)
  {
    longText += "1 2 3\n";
  }
  const std::pair<std::string, vtkIdType> cut[] = { { "x,y,z\n1,2,3\n4,5", 1 }, { "x,y,z\n1,2,3\n4,5\n", 1 },
    { "1 2 3\n4 5 6\n7 8" + zeros, 2 },
    { longText + "4 5" + zeros + "1 2 3\n", vtkIdType(longText.size() / 6) } };
  for (const auto& [text, points] : cut)
  {
    vtkNew<vtkPointCloudReader> reader;
    expectRefused(readCloudBy(reader, write("a.csv", text)), "--salvage");
    reader->SalvageOn();
    const ReadResult result = readCloudBy(reader, path("a.csv"));
    EXPECT_EQ(result.error, "");
    EXPECT_EQ(result.points(), points);
    ASSERT_FALSE(result.notes.empty());
    EXPECT_NE(result.notes[0].find("points before are read"), std::string::npos) << result.notes[0];
  }
  expectRefused(readCloud(write("a.xyz", "1 2 3\n4 5 6\n" + zeros)), "byte 12: zero bytes");
  const ReadResult uneven = readCloud(write("b.csv", "x,y,z\n1,2\n4,5,6\n"));
  EXPECT_EQ(uneven.error.find("--salvage"), std::string::npos) << uneven.error;
  for (const char* name : { "a.csv", "a.ply", "a.foo" })
  {
    expectRefused(readCloud(write(name, zeros)), "the file holds only zero bytes; copy it again");
  }
}

TEST_F(TornText, TheEndMarkOfDosIsNoText)
{
  std::string text = "1 2 3\r\n4 5 6\r\n";
  for (int i = 0; i < 10; ++i, text += text) // also where it stands far behind the start
  {
    const ReadResult result = readCloud(write("a.txt", text + "\x1a"));
    EXPECT_EQ(result.error, "");
    EXPECT_EQ(result.points(), vtkIdType(text.size() / 7));
  }
}

TEST_F(TornText, UnknownUnitsAreSaid)
{
  const auto read = [&](const std::string& unit)
  { return readCloud(write("a.csv", "x [" + unit + "];y [" + unit + "];z [" + unit + "]\n1;2;3\n")); };
  const std::pair<const char*, const char*> known[] = { { "nm", "nm" }, { "dm", "dm" }, { "mil", "mil" },
    { "\xb5m", "um" } };
  for (const auto& [unit, name] : known)
  {
    EXPECT_EQ(pointhaptics::lengthUnitOf(read(unit).cloud, pointhaptics::Bounds()).name, name);
  }
  const ReadResult result = read("foo");
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("unit 'foo' is not known"), std::string::npos);
  EXPECT_TRUE(read("Ost").notes.empty());
}

TEST_F(TornText, SeparatorsThatAreReadAreNamed)
{
  expectRefused(readCloud(write("a.txt", "1:2:3\n4:5:6\n")), "separated by blanks, tabs, commas");
}

TEST_F(TornText, ImagesAreNoPoints)
{
  std::string row = "0.5";
  for (int i = 1; i < 80; ++i)
  {
    row += " " + std::to_string(i);
  }
  expectRefused(readCloud(write("a.txt", row + "\n" + row + "\n")), "80 columns without names are an image");
}

} // namespace
