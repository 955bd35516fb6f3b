#include "Core/Base/OutputFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include <sys/stat.h>

namespace fs = std::filesystem;

namespace
{

using pointhaptics::OutputFile;
using pointhaptics::Status;

class OutputFileTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / ("pointhaptics-output-" + test);
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string name(const std::string& file) const { return (folder_ / file).string(); }
  std::string read(const std::string& file) const
  {
    std::ifstream stream(name(file), std::ios::binary);
    return { std::istreambuf_iterator<char>(stream), {} };
  }
  void put(const std::string& file, const std::string& content) const
  {
    std::ofstream(name(file), std::ios::binary) << content;
  }
  std::ptrdiff_t entries() const { return std::distance(fs::directory_iterator(folder_), {}); }
  static Status writeAll(const std::string& target, const std::string& content)
  {
    OutputFile file;
    const Status opened = file.open(target);
    const Status written = opened == Status::Ok ? file.write(content) : opened;
    return written == Status::Ok ? file.commit() : written;
  }

  fs::path folder_;
};

TEST_F(OutputFileTest, AppearsOnlyWhenCommitted)
{
  put("a.txt", "old");
  const std::string content(300000, 'n');
  {
    OutputFile file;
    ASSERT_EQ(file.open(name("a.txt")), Status::Ok);
    ASSERT_EQ(file.write(content), Status::Ok);
    EXPECT_EQ(read("a.txt"), "old");
    EXPECT_EQ(entries(), 2);
    ASSERT_EQ(file.commit(), Status::Ok);
    EXPECT_EQ(read("a.txt"), content);
    EXPECT_EQ(file.commit(), Status::FileNotWritable) << "there is nothing left to commit";
  }
  EXPECT_EQ(read("a.txt"), content);
  EXPECT_EQ(entries(), 1);
}

TEST_F(OutputFileTest, LeavesNothingBehindWithoutCommit)
{
  put("a.txt", "old");
  {
    OutputFile file;
    ASSERT_EQ(file.open(name("a.txt")), Status::Ok);
    ASSERT_EQ(file.write("new"), Status::Ok);
    ASSERT_EQ(file.open(name("b.txt")), Status::Ok) << "the first one is given up";
  }
  EXPECT_EQ(read("a.txt"), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(OutputFileTest, ReplacesWhatALinkPointsTo)
{
  put("real.txt", "old");
  fs::create_symlink("real.txt", name("link.txt"));
  fs::create_symlink(name("link.txt"), name("second.txt"));
  ASSERT_EQ(writeAll(name("second.txt"), "new"), Status::Ok);
  EXPECT_TRUE(fs::is_symlink(name("second.txt")));
  EXPECT_TRUE(fs::is_symlink(name("link.txt")));
  EXPECT_FALSE(fs::is_symlink(name("real.txt")));
  EXPECT_EQ(read("real.txt"), "new");
  EXPECT_EQ(entries(), 3);
}

TEST_F(OutputFileTest, CreatesWhatADanglingLinkPointsTo)
{
  fs::create_directory(name("folder"));
  fs::create_symlink("folder/absent.txt", name("link.txt"));
  ASSERT_EQ(writeAll(name("link.txt"), "new"), Status::Ok);
  EXPECT_TRUE(fs::is_symlink(name("link.txt")));
  EXPECT_EQ(read("folder/absent.txt"), "new");
  fs::create_symlink("nowhere/absent.txt", name("lost.txt"));
  EXPECT_EQ(writeAll(name("lost.txt"), "new"), Status::FileNotWritable);
  EXPECT_TRUE(fs::is_symlink(name("lost.txt")));
}

TEST_F(OutputFileTest, RefusesALoopOfLinks)
{
  fs::create_symlink("b.txt", name("a.txt"));
  fs::create_symlink("a.txt", name("b.txt"));
  OutputFile file;
  EXPECT_EQ(file.open(name("a.txt")), Status::FileNotWritable);
  EXPECT_NE(file.reason().find("symbolic link"), std::string::npos) << file.reason();
  EXPECT_EQ(entries(), 2);
}

TEST_F(OutputFileTest, RefusesFoldersAndPlacesThatAreNotThere)
{
  OutputFile file;
  EXPECT_EQ(file.open(name("absent/")), Status::FileNotWritable);
  EXPECT_EQ(file.open(folder_.string()), Status::FileNotWritable);
  EXPECT_EQ(file.reason(), "this is a folder");
  EXPECT_EQ(file.open(name("absent/a.txt")), Status::FileNotWritable);
  EXPECT_EQ(file.reason(), "No such file or directory");
  EXPECT_NE(file.cure(), "");
  EXPECT_EQ(file.open(""), Status::FileNotWritable);
  EXPECT_EQ(file.write("x"), Status::FileNotWritable);
}

TEST_F(OutputFileTest, WritesADeviceAsItStands)
{
  OutputFile file;
  ASSERT_EQ(file.open("/dev/null"), Status::Ok);
  EXPECT_FALSE(file.isReplacing());
  EXPECT_EQ(file.write("gone"), Status::Ok);
  EXPECT_EQ(file.commit(), Status::Ok);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(OutputFileTest, TakesBytesAtAnyPlace)
{
  OutputFile file;
  ASSERT_EQ(file.open(name("a.txt")), Status::Ok);
  EXPECT_EQ(file.writeAt(4, "late"), Status::Ok);
  EXPECT_EQ(file.writeAt(0, "soon"), Status::Ok);
  EXPECT_EQ(file.commit(), Status::Ok);
  EXPECT_EQ(read("a.txt"), "soonlate");
  OutputFile none;
  EXPECT_EQ(none.writeAt(0, "x"), Status::FileNotWritable);
}

TEST_F(OutputFileTest, SaysThatTheDiskIsFull)
{
  if (!fs::is_character_file("/dev/full"))
  {
    GTEST_SKIP() << "no /dev/full on this system";
  }
  OutputFile file;
  ASSERT_EQ(file.open("/dev/full"), Status::Ok);
  static_cast<void>(file.write("x"));
  EXPECT_EQ(file.commit(), Status::FileNotWritable);
  EXPECT_TRUE(file.isDiskFull());
}

TEST_F(OutputFileTest, KeepsThePermissionsOfWhatItReplaces)
{
  put("private.txt", "old");
  fs::permissions(name("private.txt"), fs::perms::owner_read | fs::perms::owner_write);
  ASSERT_EQ(writeAll(name("private.txt"), "new"), Status::Ok);
  EXPECT_EQ(fs::status(name("private.txt")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFileTest, RefusesAFileThatIsWriteProtected)
{
  put("kept.txt", "old");
  fs::permissions(name("kept.txt"), fs::perms::owner_read);
  OutputFile file;
  EXPECT_EQ(file.check(name("kept.txt")), Status::FileNotWritable);
  EXPECT_EQ(file.open(name("kept.txt")), Status::FileNotWritable);
  EXPECT_EQ(file.reason(), "the file is write-protected");
  EXPECT_EQ(read("kept.txt"), "old");
  EXPECT_EQ(entries(), 1);
}

TEST_F(OutputFileTest, RemovesThePartsThatNobodyHas)
{
  put(".a.txt.1.part", "of a killed process");
  put(".a.txt.2.part", "of another one");
  put(".b.txt.1.part", "of another target");
  OutputFile first;
  ASSERT_EQ(first.open(name("a.txt")), Status::Ok);
  OutputFile second;
  ASSERT_EQ(second.open(name("a.txt")), Status::Ok) << "two may write one target";
  EXPECT_NE(first.path(), second.path());
  EXPECT_EQ(entries(), 3);
  ASSERT_EQ(first.write("first"), Status::Ok);
  ASSERT_EQ(second.write("second"), Status::Ok);
  ASSERT_EQ(second.commit(), Status::Ok);
  ASSERT_EQ(first.commit(), Status::Ok);
  EXPECT_EQ(read("a.txt"), "first");
  EXPECT_EQ(entries(), 2);
}

TEST_F(OutputFileTest, IsWrittenInPlaceWhereAnotherOneCommitsIt)
{
  OutputFile outer;
  ASSERT_EQ(outer.open(name("a.txt")), Status::Ok);
  ASSERT_EQ(writeAll(outer.path(), "content"), Status::Ok);
  EXPECT_FALSE(fs::exists(name("a.txt")));
  EXPECT_EQ(entries(), 1);
  ASSERT_EQ(outer.commit(), Status::Ok);
  EXPECT_EQ(read("a.txt"), "content");
}

TEST_F(OutputFileTest, TakesNamesAsLongAsTheFileSystemDoes)
{
  const std::string longest(251, 'n');
  ASSERT_EQ(writeAll(name(longest + ".txt"), "new"), Status::Ok);
  EXPECT_EQ(read(longest + ".txt"), "new");
}

} // namespace
