#include "CloudFiles.h"
#include "E57File.h"

#include <cstdint>

namespace
{

E57TestScan smallScan()
{
  return { { e57Double("cartesianX", { 1, 2 }), e57Double("cartesianY", { 3, 4 }),
             e57Double("cartesianZ", { 5, 6 }) },
    "", "" };
}

class HostileE57 : public CloudFiles
{
protected:
  ReadResult read(const std::string& bytes) const { return readCloud(write("a.e57", bytes)); }
  ReadResult read(const E57TestFile& file) const { return read(file.bytes()); }
  /// Refused, in one line.
  void refuse(const ReadResult& result, const std::string& part) const
  {
    expectRefused(result, part);
    EXPECT_EQ(result.error.find('\n'), std::string::npos) << result.error;
  }
  /// A good file with @p value at the logical byte @p at, and right checksums.
  template <typename T>
  std::string changed(std::size_t at, T value) const
  {
    std::string logical = e57Logical(E57TestFile{ { smallScan() } }.bytes());
    put(logical, at, value);
    return e57Physical(logical);
  }
};

TEST_F(HostileE57, CutShortAnywhereIsRefused)
{
  const std::string good = E57TestFile{ { smallScan() } }.bytes();
  ASSERT_EQ(read(good).error, "");
  for (std::size_t size = 8; size < good.size(); size += 1 + size / 64)
  {
    refuse(read(good.substr(0, size)), "a.e57: E57");
  }
}

TEST_F(HostileE57, EveryChangedByteIsNoticed)
{
  const std::string good = E57TestFile{ { smallScan() } }.bytes();
  for (std::size_t at = 8; at < good.size(); at += 13)
  {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    refuse(read(bad), at < 48 ? "byte " : "(CRC-32C)");
  }
}

TEST_F(HostileE57, HeadersThatLieAreRefused)
{
  refuse(read(changed(8, std::uint32_t{ 2 })), "byte 8: version 2.0, but 1.0 is read here; ");
  refuse(read(changed(16, std::uint64_t{ 1 } << 60)), "byte 16: the header says 1152921504606846976 bytes");
  refuse(read(changed(16, std::uint64_t{ 1000 })), "no whole pages");
  refuse(read(changed(24, ~std::uint64_t{ 0 })), "byte 24: the XML section is at byte 18446744073709551615");
  refuse(read(changed(24, std::uint64_t{ 1022 })), "where no content is");
  refuse(read(changed(32, std::uint64_t{ 1 } << 62)), "byte 32: an XML section of");
  refuse(read(changed(40, std::uint64_t{ 4096 })), "byte 40: pages of 4096 bytes");
}

TEST_F(HostileE57, SectionsAndPacketsThatLieAreRefused)
{
  refuse(read(changed(48, std::uint8_t{ 3 })), "byte 48: a section of kind 3");
  refuse(read(changed(56, std::uint64_t{ 1 } << 50)), "byte 48: a section of 1125899906842624 bytes");
  refuse(read(changed(56, std::uint64_t{ 3 })), "byte 48: a section of 3 bytes");
  refuse(read(changed(64, std::uint64_t{ 1 } << 50)), "its first packet is at byte 1125899906842624");
  refuse(read(changed(64, std::uint64_t{ 48 })), "outside of its section");
  refuse(read(changed(80, std::uint8_t{ 9 })), "byte 80: scan 1 'scan 1': a packet of kind 9");
  refuse(read(changed(82, std::uint16_t{ 0 })), "a packet of 1 bytes");
  refuse(read(changed(82, std::uint16_t{ 0xffff })), "a packet of 65536 bytes");
  refuse(read(changed(84, std::uint16_t{ 2 })), "does not have the 3 streams");
  refuse(read(changed(86, std::uint16_t{ 60000 })), "whose streams are longer");
}

TEST_F(HostileE57, PromisedPointsAreHeldAgainstTheBytes)
{
  E57TestScan scan = smallScan();
  for (const char* count : { "3", "1000000000000", "18446744073709551615" })
  {
    scan.recordCount = count;
    refuse(read({ { scan } }), std::string("'cartesianX' has 16 bytes, but ") + count + " points of 64 bits");
    vtkNew<vtkPointCloudReader> salvaging;
    salvaging->SalvageOn();
    const ReadResult there = readCloudBy(salvaging, write("salvaged.e57", E57TestFile{ { scan } }.bytes()));
    EXPECT_EQ(there.error, "") << count;
    EXPECT_EQ(there.points(), 2) << count;
  }
  scan.recordCount = "-1";
  refuse(read({ { scan } }), "recordCount '-1' is no count");
  // Nothing is stored for a field whose limits are the same.
  E57TestScan constant{ { e57Integer("cartesianX", 7, 7, { 7 }), e57Integer("cartesianY", 7, 7, { 7 }),
                          e57Integer("cartesianZ", 7, 7, { 7 }) },
    "", "1000000000000" };
  refuse(read({ { constant } }), "points that are all the same");
  constant.recordCount = "2";
  EXPECT_EQ(read({ { constant } }).points(), 2);
}

TEST_F(HostileE57, ManyConstantFieldsDoNotFillTheMemory)
{
  E57TestScan scan = smallScan();
  for (E57TestField& field : scan.fields)
  {
    field = e57Integer(field.name, 0, 1, std::vector<std::int64_t>(8000, 1));
  }
  for (int i = 0; i < 2000; ++i)
  {
    scan.fields.push_back(
      { "c" + std::to_string(i), "type=\"ScaledInteger\" minimum=\"1\" maximum=\"1\"", 0, {} });
  }
  scan.bytesPerPart = 1000;
  refuse(read({ { scan } }), "8000 points of 16003 bytes would be more than 100 times");
}

TEST_F(HostileE57, ScansThatShareBytesAreRefused)
{
  E57TestFile file{ { smallScan(), smallScan() } };
  file.sharesSection = true;
  refuse(read(file), "overlaps another one; ");
}

TEST_F(HostileE57, XmlBombsAreRefused)
{
  E57TestFile file{ { smallScan() } };
  file.prologue = "<!DOCTYPE e57Root [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]>\n";
  refuse(read(file), "XML line 2: a document type, which could declare entities; ");
  file.prologue.clear();
  for (const std::size_t depth : { 65, 100000 })
  {
    file.xml.clear();
    for (std::size_t i = 0; i < depth; ++i)
    {
      file.xml.insert(0, "<a>");
      file.xml += depth == 65 ? "</a>" : "";
    }
    refuse(read(file), "more than 64 XML elements inside each other");
  }
  file.xml.clear();
  for (int i = 0; i < 500001; ++i)
  {
    file.xml += "<a/>";
  }
  refuse(read(file), "more than 500000 XML elements");
  file.xml = "<a></b>";
  refuse(read(file), "XML line 3: mismatched tag");
}

TEST_F(HostileE57, DescriptionsThatCannotBeAreRefused)
{
  const auto withField = [&](const std::string& attributes)
  {
    E57TestScan scan = smallScan();
    scan.fields.push_back({ "odd", attributes, 8, { 1, 2 } });
    return read({ { scan } });
  };
  refuse(withField("type=\"Integer\" minimum=\"5\" maximum=\"4\""), "odd maximum '4' is below the minimum");
  refuse(withField("type=\"Integer\" minimum=\"five\""), "odd minimum 'five' is no integer of 64 bits");
  refuse(withField("type=\"Integer\" minimum=\"-9223372036854775809\""), "is no integer of 64 bits");
  refuse(withField("type=\"ScaledInteger\" scale=\"nan\""), "odd scale 'nan' is no finite number");
  refuse(withField("type=\"Blob\""), "odd 'Blob' is no type of a record's field");
  E57TestScan twice = smallScan();
  twice.fields.push_back(e57Double("cartesianX", { 1, 2 }));
  refuse(read({ { twice } }), "'cartesianX' comes twice");
  E57TestScan flat = smallScan();
  flat.fields.pop_back();
  refuse(read({ { flat } }), "has neither cartesianX, cartesianY, cartesianZ nor sphericalRange");
  E57TestScan turned = smallScan();
  turned.xml = e57Pose({ 0, 0, 0, 0 }, { 0, 0, 0 });
  refuse(read({ { turned } }), "a quaternion of length 0");
}

} // namespace
