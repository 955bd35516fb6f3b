// A recording of a running servo loop is felt again to the last bit, and a bad one is refused in one line.
#include "Recording.h"
#include "RecordingWriter.h"
#include "Replay.h"

#include "HapticSceneBuilder.h"
#include "LocalSceneProvider.h"
#include "vtkVoxelMeanResampler.h"

#include "MadeClouds.h"
#include "Unit/Haptics/ServoLoopFixtures.h"

#include <gtest/gtest.h>
#include <vtkMatrix4x4.h>
#include <vtkMatrixToLinearTransform.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace pointhaptics;

namespace
{

/// In and out of the sphere of 25 mm, and along it.
Vec3 handAt(double seconds)
{
  const double depth = 0.0275 - 0.004 * std::pow(std::sin(6.0 * seconds), 2);
  return depth * Vec3{ std::cos(0.4 * seconds), std::sin(0.4 * seconds), 0.1 };
}

VoxelMeanSettings voxels()
{
  VoxelMeanSettings settings;
  settings.lattice.dimensions = { 300, 300, 300 };
  settings.lattice.automaticWorkspace = false;
  settings.lattice.workspace = defaultWorkspace();
  settings.computeCovariance = true;
  return settings;
}

std::shared_ptr<const HapticScene> wholeScene(vtkPolyData* cloud)
{
  vtkNew<vtkVoxelMeanResampler> resampler;
  vtkNew<vtkMatrix4x4> matrix;
  vtkNew<vtkMatrixToLinearTransform> transform;
  transform->SetInput(matrix);
  const VoxelMeanSettings settings = voxels();
  resampler->SetSettings(settings);
  resampler->SetTransform(transform);
  resampler->SetInputData(cloud);
  resampler->Update();
  Status status = Status::Ok;
  return makeHapticScene(resampler->GetOutput(), status, true, LocalBandwidthSettings(), &settings);
}

class RecordingTest : public ::testing::Test
{
protected:
  RecordingTest()
  {
    header_.program = "test 1";
    header_.settings = R"({"stiffness": 700})";
    header_.cloud = { { "/no/where/sphere.ply" }, 0.0, cloud_->GetNumberOfPoints(), checksumOf(cloud_) };
    port_.path = handAt;
  }
  ~RecordingTest() override
  {
    std::filesystem::remove(file_);
    std::filesystem::remove(file_ + ".part");
  }

  /// Until the loop has answered @p ticks more: on a busy machine it leaves some out.
  void recordFor(std::size_t ticks)
  {
    this->take();
    const std::size_t end = samples_.size() + ticks;
    EXPECT_TRUE(trial::eventually(
      [&]
      {
        this->take();
        return samples_.size() >= end;
      }));
  }
  void take()
  {
    std::vector<ServoSample> samples;
    loop_.takeTrace(samples);
    writer_.add(loop_, samples);
    samples_.insert(samples_.end(), samples.begin(), samples.end());
  }
  void start()
  {
    ASSERT_TRUE(writer_.open(file_, header_, message_)) << message_;
    loop_.publishScene(whole_);
    ServoSettings settings = trial::plainSettings();
    settings.limits.maximumForce = 2.0;
    ASSERT_EQ(loop_.start(port_, HapticParameters(), settings), Status::Ok);
  }
  void stop()
  {
    loop_.stop();
    this->take();
    ASSERT_TRUE(writer_.close(message_)) << message_;
    EXPECT_EQ(writer_.problem(), "");
  }
  /// Expects that the recording is felt again with the same bits.
  void replay(std::size_t leastContacts)
  {
    Recording recording;
    ASSERT_TRUE(readRecording(file_, recording, message_)) << message_;
    EXPECT_TRUE(isOf(recording, cloud_, message_)) << message_;
    Replay replay(recording, cloud_);
    const ReplayDifference& difference = replay.difference();
    std::size_t contacts = 0;
    while (!replay.isAtEnd())
    {
      const RecordedTick& row = replay.row();
      ServoSample sample;
      ASSERT_TRUE(replay.step(sample, message_)) << message_;
      contacts += sample.state.contact;
      EXPECT_EQ(sample.tick, row.tick);
    }
    EXPECT_EQ(difference.sameTicks, difference.ticks) << difference.text();
    EXPECT_EQ(difference.ticks, writer_.numberOfTicks());
    EXPECT_GE(contacts, leastContacts);
  }
  std::string text() const
  {
    std::ostringstream stream;
    stream << std::ifstream(file_).rdbuf();
    return stream.str();
  }
  /// In the file, one for each marker: a row has the number of its newest.
  std::vector<std::uint64_t> markedTicks()
  {
    Recording recording;
    EXPECT_TRUE(readRecording(file_, recording, message_)) << message_;
    std::vector<std::uint64_t> ticks;
    for (const RecordedTick& row : recording.ticks)
    {
      EXPECT_TRUE(row.marker == 0 || row.marker > ticks.size());
      ticks.resize(std::max<std::size_t>(ticks.size(), row.marker), row.tick);
    }
    return ticks;
  }
  /// Expects that the file with @p text is refused by a line with @p words.
  void refuse(const std::string& text, const std::string& words)
  {
    std::ofstream(file_) << text;
    Recording recording;
    message_.clear();
    EXPECT_FALSE(readRecording(file_, recording, message_)) << words;
    EXPECT_NE(message_.find(words), std::string::npos) << message_;
    EXPECT_EQ(message_.find(file_), 0u) << message_;
    EXPECT_EQ(message_.find('\n'), std::string::npos) << message_;
    EXPECT_TRUE(recording.ticks.empty());
  }

  vtkSmartPointer<vtkPolyData> cloud_ = trial::shapeCloud(Shape::Sphere, 100000);
  std::shared_ptr<const HapticScene> whole_ = wholeScene(cloud_);
  std::string file_ =
    (std::filesystem::temp_directory_path() / ("recording-" + std::to_string(std::uintptr_t(this)) + ".csv"))
      .string();
  std::string message_;
  RecordingHeader header_;
  RecordingWriter writer_;
  trial::ScriptedPort port_;
  std::vector<ServoSample> samples_;
  ServoLoop loop_;
};

TEST_F(RecordingTest, ARunWithMotionsOfTheModelAndOtherSettingsIsFeltAgain)
{
  this->start();
  this->recordFor(300);
  Status status = Status::Ok;
  loop_.publishScene(whole_->moved(AffineTransform::scaling({ 1.02, 1.02, 1.02 }), status));
  this->recordFor(150);
  HapticParameters parameters;
  parameters.contact.stiffness = 500.0;
  parameters.contact.damping = 0.3;
  parameters.contact.staticFriction = parameters.contact.dynamicFriction = 0.4;
  ASSERT_EQ(loop_.setParameters(parameters), Status::Ok);
  this->recordFor(150);
  parameters.method = ProxyMethod::GradientSteps;
  ASSERT_EQ(loop_.setParameters(parameters), Status::Ok);
  loop_.publishScene(whole_);
  this->recordFor(150);
  loop_.setClutched(true);
  this->recordFor(120);
  loop_.setClutched(false);
  this->recordFor(400);
  loop_.publishScene(nullptr);
  this->recordFor(50);
  this->stop();
  this->replay(200);
}

TEST_F(RecordingTest, FinerScenesAreMadeAgain)
{
  cloud_ = trial::shapeCloud(Shape::Idol, 150000);
  whole_ = wholeScene(cloud_);
  header_.cloud.points = cloud_->GetNumberOfPoints();
  header_.cloud.checksum = checksumOf(cloud_);
  LocalSceneProvider provider;
  provider.setCloud(cloud_->GetPoints());
  // Moved, before the whole cloud is resampled there.
  const AffineTransform place = AffineTransform::scaling({ 1.01, 1.01, 1.01 });
  std::shared_ptr<const HapticScene> finer;
  SurfacePoint surface;
  for (vtkIdType i = 0; i < cloud_->GetNumberOfPoints() && !finer; i += 500)
  {
    Vec3 point;
    cloud_->GetPoint(i, &point.x);
    surface = closestPoint(Shape::Idol, point);
    Bounds hand;
    hand.include(place.apply(surface.point));
    finer = provider.refine(hand, whole_, place);
  }
  ASSERT_TRUE(finer && finer->fallback());
  port_.path = [=](double seconds)
  { return place.apply(surface.point) + 0.001 * std::cos(40.0 * seconds) * surface.normal; };
  this->start();
  this->recordFor(100);
  loop_.publishScene(finer);
  this->recordFor(300);
  Status status = Status::Ok;
  loop_.publishScene(finer->moved(AffineTransform(), status));
  this->recordFor(100);
  this->stop();
  this->replay(100);
  EXPECT_NE(this->text().find("kind=fine"), std::string::npos);
}

TEST_F(RecordingTest, AFaultyDeviceIsReplayedToo)
{
  // Silences of the device, in and out of contact, short and longer than what makes a hand new.
  port_.readStatus = [](int n)
  { return n % 400 > 250 && n % 400 < 250 + (n > 500 ? 130 : 20) ? Status::DeviceSilent : Status::Ok; };
  port_.writeStatus = [](int n) { return n % 333 == 100 ? Status::DeviceLost : Status::Ok; };
  this->start();
  this->recordFor(1500);
  this->stop();
  this->replay(200);
}

TEST_F(RecordingTest, ItBeginsWhenTheHandIsFreeAndHasMarkers)
{
  loop_.publishScene(whole_);
  ASSERT_EQ(loop_.start(port_, HapticParameters(), trial::plainSettings()), Status::Ok);
  ASSERT_TRUE(trial::eventually([&] { return loop_.latest().state.contact; }));
  this->take();
  ASSERT_TRUE(writer_.open(file_, header_, message_)) << message_;
  EXPECT_EQ(writer_.mark(loop_.latest().tick), 1u);
  EXPECT_EQ(writer_.mark(loop_.latest().tick), 2u) << "of the first tick, too";
  loop_.beginAnew();
  ASSERT_TRUE(trial::eventually(
    [&]
    {
      this->take();
      return !writer_.isWaiting();
    }));
  this->recordFor(300);
  const std::uint64_t marked = loop_.latest().tick;
  EXPECT_EQ(writer_.mark(marked), 3u);
  this->recordFor(300);
  this->stop();
  this->replay(100);
  Recording recording;
  ASSERT_TRUE(readRecording(file_, recording, message_)) << message_;
  EXPECT_GT(recording.ticks.front().tick, 1u);
  EXPECT_EQ(this->markedTicks(),
    (std::vector<std::uint64_t>{ recording.ticks.front().tick, recording.ticks.front().tick, marked }));
  EXPECT_EQ(recording.ticks.back().buttons, 5u);
  EXPECT_EQ(recording.header.settings, header_.settings);
  EXPECT_EQ(recording.header.program, header_.program);
}

/// Nothing comes after the tick that a marker was set at: the loop is idle, or the recording ends.
TEST_F(RecordingTest, AMarkerAtTheLastTickIsWritten)
{
  this->start();
  this->recordFor(100);
  const std::uint64_t taken = samples_.back().tick;
  ASSERT_TRUE(trial::eventually([&] { return loop_.latest().tick > taken + 1; }));
  EXPECT_EQ(writer_.mark(taken), 1u);
  loop_.stop();
  const std::uint64_t last = loop_.latest().tick;
  EXPECT_EQ(writer_.mark(last, "end\nof trial"), 2u);
  EXPECT_EQ(writer_.mark(last, "pause"), 3u) << "of the same tick";
  this->stop();
  EXPECT_EQ(writer_.numberOfMarkers(), 3u);
  EXPECT_EQ(this->markedTicks(), (std::vector<std::uint64_t>{ taken, last, last }));
  Recording recording;
  ASSERT_TRUE(readRecording(file_, recording, message_)) << message_;
  EXPECT_EQ(this->text().find("# marker 1:"), std::string::npos);
  EXPECT_NE(this->text().find("# marker 2: end of trial\n"), std::string::npos);
  EXPECT_NE(this->text().find("# marker 3: pause\n"), std::string::npos);
}

TEST_F(RecordingTest, AMarkerOfAnIdleHandIsWritten)
{
  port_.path = [](double) { return Vec3{ 0.06, 0.0, 0.0 }; };
  ServoSettings settings = trial::plainSettings();
  settings.idlesWhenStill = true;
  ASSERT_TRUE(writer_.open(file_, header_, message_)) << message_;
  ASSERT_EQ(loop_.start(port_, HapticParameters(), settings), Status::Ok);
  ASSERT_TRUE(trial::eventually([&] { return loop_.statistics().idleTicks > 0; }));
  this->take();
  const std::uint64_t marked = samples_.back().tick;
  EXPECT_EQ(writer_.mark(marked), 1u);
  ASSERT_TRUE(writer_.close(message_)) << message_;
  loop_.stop();
  EXPECT_EQ(this->markedTicks(), std::vector<std::uint64_t>{ marked });
}

TEST_F(RecordingTest, ALostTickEndsIt)
{
  ASSERT_TRUE(writer_.open(file_, header_, message_)) << message_;
  loop_.publishScene(whole_);
  ServoSettings settings = trial::plainSettings();
  settings.traceCapacity = 50;
  ASSERT_EQ(loop_.start(port_, HapticParameters(), settings), Status::Ok);
  ASSERT_TRUE(trial::eventually([&] { return loop_.latest().tick > 20; }));
  this->take();
  ASSERT_TRUE(trial::eventually([&] { return loop_.statistics().lostTraceSamples > 0; }));
  this->take();
  loop_.stop();
  EXPECT_NE(writer_.problem().find("lost"), std::string::npos);
  ASSERT_TRUE(writer_.close(message_)) << message_;
  this->replay(0);
}

TEST_F(RecordingTest, WhatIsNoRecordingIsRefusedInOneLine)
{
  this->start();
  this->recordFor(200);
  this->stop();
  const std::string good = this->text();
  const auto with = [&good](const std::string& from, const std::string& to)
  {
    const std::size_t place = good.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return std::string(good).replace(place, from.size(), to);
  };
  std::string head;
  std::string rows;
  std::istringstream lines(good.substr(0, good.find("# end: ")));
  for (std::string line; std::getline(lines, line);)
  {
    (head.empty() || line.front() == '#' ? head : rows) += line + "\n";
  }
  this->refuse("", "no recording");
  this->refuse("t,x,y,z\n0,0,0,0\n", "no recording");
  this->refuse(std::string(5000, 'x'), "no recording");
  this->refuse(with("recording: 2", "recording: 3"), "another version");
  this->refuse(head, "no row");
  this->refuse(with(" checksum=", " checksum=g"), "names no cloud");
  std::string late = good;
  for (std::size_t at = 0; (at = late.find("# tick ", at)) != std::string::npos;)
  {
    const std::size_t end = late.find('\n', at) + 1;
    const bool isParameters = late.substr(at, end - at).find(": parameters") != std::string::npos;
    isParameters ? void(late.erase(at, end - at)) : void(at = end);
  }
  this->refuse(late, "no parameters are in force");
  this->refuse(with("buttons,marker", "buttons"), "no recording");
  this->refuse(head + rows.substr(0, rows.size() - 20) + "\n" + rows, "cut off");
  this->refuse(head + "nan" + rows.substr(rows.find(',')), "NaN");
  this->refuse(head + "inf" + rows.substr(rows.find(',')), "out of range");
  this->refuse(head + rows + rows, "not after");
  this->refuse(with("scene of=", "scene of=77"), "no such event");
  this->refuse(with(": parameters 2", ": parameters 77"), "no such event");
  this->refuse(with("kind=whole", "kind=half"), "no such scene");
  this->refuse(with("kind=whole", "kind=region"), "no such scene");
  this->refuse(with("model=1,0", "model=0,0"), "no such scene");
  this->refuse(with("contact.stiffness=800", "contact.stiffness=-1"), "no such parameters");
  this->refuse(with("bandwidth.rule=0", "bandwidth.rule=9"), "no such scene");
  this->refuse(with("rate=1000", "rate=0"), "servo setting");
  this->refuse(with("points=100000", "points=many"), "points");
  this->refuse(with("# file: ", "# note: "), "names no cloud");
  std::filesystem::remove(file_);
  Recording recording;
  EXPECT_FALSE(readRecording(file_, recording, message_));
  EXPECT_NE(message_.find("cannot be opened"), std::string::npos);
}

TEST_F(RecordingTest, ItIsReadAsItWasWrittenByTheFirstVersion)
{
  this->start();
  this->recordFor(500);
  this->stop();
  std::string head = "# pointhaptics recording: 1\n";
  std::string table;
  std::istringstream lines(this->text());
  for (std::string line; std::getline(lines, line);)
  {
    const bool isNew = line.rfind("# pointhaptics", 0) == 0 || line.rfind("# started", 0) == 0 ||
      line.rfind("# monotonic", 0) == 0 || line.rfind("# limits", 0) == 0 || line.rfind("# end", 0) == 0;
    (line.front() == '#' ? head : table) += isNew ? "" : line + "\n";
  }
  std::ofstream(file_) << head + table;
  this->replay(100);
}

TEST_F(RecordingTest, WhatWasFeltStandsBesideItBeforeItEnds)
{
  this->start();
  this->recordFor(1500);
  EXPECT_FALSE(std::filesystem::exists(file_));
  Recording recording;
  ASSERT_TRUE(readRecording(file_ + ".part", recording, message_)) << message_;
  EXPECT_GE(recording.ticks.back().tick + 1100, samples_.back().tick);
  EXPECT_NE(recording.note.find("it was not ended"), std::string::npos) << recording.note;
  this->stop();
  EXPECT_FALSE(std::filesystem::exists(file_ + ".part"));
  ASSERT_TRUE(readRecording(file_, recording, message_)) << message_;
  EXPECT_EQ(recording.note, "");
}

TEST_F(RecordingTest, OneThatIsThereIsNotReplaced)
{
  this->start();
  this->recordFor(50);
  std::ofstream(file_) << "of another program";
  loop_.stop();
  EXPECT_FALSE(writer_.close(message_));
  EXPECT_NE(message_.find(file_ + ".part has what came before"), std::string::npos) << message_;
  EXPECT_EQ(this->text(), "of another program");
  RecordingWriter other;
  EXPECT_FALSE(other.open(file_, header_, message_));
  EXPECT_NE(message_.find(".part is there"), std::string::npos) << message_;
}

TEST_F(RecordingTest, AFullDiskLeavesWhatCameBefore)
{
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 100000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  this->start();
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const bool isFull = trial::eventually(
    [&]
    {
      this->take();
      return !writer_.problem().empty();
    });
  EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(isFull);
  loop_.stop();
  EXPECT_FALSE(writer_.close(message_));
  EXPECT_NE(message_.find(".part has what came before"), std::string::npos) << message_;
  Recording recording;
  ASSERT_TRUE(readRecording(file_ + ".part", recording, message_)) << message_;
  EXPECT_GT(recording.ticks.size(), 100u);
}

TEST_F(RecordingTest, LinesThatComeByASocketAreMarkers)
{
  this->start();
  this->recordFor(1); // a marker before the first tick is in its row
  MarkerSocket socket;
  ASSERT_TRUE(socket.open(0, loop_, message_)) << message_;
  writer_.follow(&socket);
  const int client = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(std::uint16_t(socket.port()));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  for (const std::string text : { "trial 1: rough\n", "trial 2: smo" })
  {
    ASSERT_EQ(::send(client, text.data(), text.size(), 0), ssize_t(text.size()));
  }
  ASSERT_TRUE(trial::eventually(
    [&]
    {
      this->take();
      return writer_.numberOfMarkers() == 1;
    }));
  const std::uint64_t between = loop_.latest().tick;
  this->recordFor(20);
  ASSERT_EQ(::send(client, "oth", 3, 0), 3);
  ::close(client); // ends the line
  ASSERT_TRUE(trial::eventually(
    [&]
    {
      this->take();
      return writer_.numberOfMarkers() == 2;
    }));
  this->stop();
  Recording recording;
  ASSERT_TRUE(readRecording(file_, recording, message_)) << message_;
  EXPECT_NE(this->text().find("# marker 1: trial 1: rough\n"), std::string::npos);
  EXPECT_NE(this->text().find("# marker 2: trial 2: smooth\n"), std::string::npos);
  EXPECT_EQ(this->text().find("# marker 3:"), std::string::npos);
  const std::vector<std::uint64_t> ticks = this->markedTicks();
  ASSERT_EQ(ticks.size(), 2u);
  EXPECT_LE(ticks[0], between);
  EXPECT_GT(ticks[1], between);
  MarkerSocket taken;
  EXPECT_FALSE(taken.open(socket.port(), loop_, message_));
  EXPECT_NE(message_.find("give another port"), std::string::npos) << message_;
}

TEST_F(RecordingTest, AnotherCloudIsRefused)
{
  this->start();
  this->recordFor(100);
  this->stop();
  Recording recording;
  ASSERT_TRUE(readRecording(file_, recording, message_)) << message_;
  double p[3];
  cloud_->GetPoints()->GetPoint(7, p);
  p[0] = std::nextafter(float(p[0]), 1.0F);
  cloud_->GetPoints()->SetPoint(7, p);
  EXPECT_FALSE(isOf(recording, cloud_, message_));
  EXPECT_NE(message_.find("others"), std::string::npos) << message_;
  cloud_->GetPoints()->InsertNextPoint(p);
  EXPECT_FALSE(isOf(recording, cloud_, message_));
  EXPECT_NE(message_.find("100001 points"), std::string::npos) << message_;
}

TEST_F(RecordingTest, TheLastLineSaysWhyItEndsEarly)
{
  for (const std::string why : { "", "what is felt was clipped" })
  {
    this->start();
    this->recordFor(100);
    this->take();
    ASSERT_TRUE(writer_.close(message_, why)) << message_;
    loop_.stop();
    EXPECT_EQ(writer_.problem(), why);
    std::ifstream file(file_);
    std::string last;
    for (std::string line; std::getline(file, line);)
    {
      last = line;
    }
    const std::string end = why.empty() ? " ticks" : " ticks; it ends early: " + why;
    EXPECT_EQ(last.rfind("# end: ", 0), 0u) << last;
    EXPECT_EQ(last.substr(last.size() - std::min(last.size(), end.size())), end);
    Recording recording;
    ASSERT_TRUE(readRecording(file_, recording, message_)) << message_;
    EXPECT_EQ(recording.note, "");
  }
}

} // namespace
