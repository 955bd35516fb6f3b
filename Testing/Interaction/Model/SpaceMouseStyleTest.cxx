#include "vtkInteractorStyleHaptic.h"

#include "Devices/SpaceMouse/SpaceMouse.h"

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTransform.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

using namespace pointhaptics;

namespace
{

/// Report that the puck repeats.
struct Cap
{
  std::atomic<int> shift[3] = { 0, 0, 0 };
  std::atomic<int> turn[3] = { 0, 0, 0 };
  std::atomic<int> buttons{ 0 };
};

class CapLink : public HidLink
{
public:
  explicit CapLink(Cap& cap)
    : cap_(cap)
  {
  }
  int read(std::uint8_t* bytes, int, int) override
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    next_ = !next_;
    if (next_)
    {
      bytes[0] = 3;
      bytes[1] = std::uint8_t(cap_.buttons);
      return 2;
    }
    bytes[0] = 1;
    for (int i = 0; i < 6; ++i)
    {
      const int value = i < 3 ? cap_.shift[i] : cap_.turn[i - 3];
      bytes[1 + 2 * i] = std::uint8_t(value);
      bytes[2 + 2 * i] = std::uint8_t(value >> 8);
    }
    return 13;
  }
  bool write(const std::uint8_t*, int) override { return true; }

private:
  Cap& cap_;
  bool next_ = false;
};

class CapBus : public HidBus
{
public:
  explicit CapBus(Cap& cap)
    : cap_(cap)
  {
  }
  std::vector<HidFound> find() override { return { { 0x256f, 0xc635, "cap", "cap" } }; }
  std::unique_ptr<HidLink> open(const HidFound&, std::string&) override
  {
    return std::make_unique<CapLink>(cap_);
  }

private:
  Cap& cap_;
};

class SpaceMouseStyle : public ::testing::Test
{
protected:
  SpaceMouseStyle()
    : mouse(SpaceMouseSettings(), std::make_unique<CapBus>(cap))
  {
    renderer->GetActiveCamera()->SetPosition(0, 0, 0.4);
    renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0);
    renderer->GetActiveCamera()->SetViewUp(0, 1, 0);
    style->SetDefaultRenderer(renderer);
    style->SetSpaceMouse(&mouse);
    EXPECT_EQ(mouse.start(), Status::Ok);
  }
  vtkMatrix4x4* model() { return style->GetModelTransform()->GetMatrix(); }
  /// Refreshes until @p condition holds.
  bool refreshUntil(const std::function<bool()>& condition)
  {
    for (int i = 0; i < 5000 && !condition(); ++i)
    {
      style->Refresh();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return condition();
  }
  bool rests()
  {
    return refreshUntil([&] { return mouse.motion().connected && mouse.motion().resting(); });
  }

  Cap cap;
  SpaceMouse mouse;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkInteractorStyleHaptic> style;
};

} // namespace

TEST_F(SpaceMouseStyle, LeavesTheModelAloneAtRest)
{
  cap.shift[0] = 10; // in the dead zone
  ASSERT_TRUE(refreshUntil([&] { return mouse.motion().connected; }));
  const vtkMTimeType before = style->GetModelTransform()->GetMTime();
  for (int i = 0; i < 50; ++i)
  {
    style->Refresh();
  }
  EXPECT_EQ(style->GetModelTransform()->GetMTime(), before);
}

TEST_F(SpaceMouseStyle, ShiftsTheModelAsTheCapIsShiftedOnTheScreen)
{
  cap.shift[0] = 350;
  ASSERT_TRUE(refreshUntil([&] { return model()->GetElement(0, 3) > 0.002; }));
  EXPECT_EQ(model()->GetElement(1, 3), 0.0);
  cap.shift[0] = 0;
  ASSERT_TRUE(rests());
  cap.shift[2] = -350; // pulled up
  ASSERT_TRUE(refreshUntil([&] { return model()->GetElement(1, 3) > 0.002; }));
  // Seen from the right, where the screen's right is the workspace's -z.
  cap.shift[2] = 0;
  ASSERT_TRUE(rests());
  style->GetModel().reset();
  renderer->GetActiveCamera()->SetPosition(0.4, 0, 0);
  cap.shift[0] = 350;
  EXPECT_TRUE(refreshUntil([&] { return model()->GetElement(2, 3) < -0.002; }));
}

TEST_F(SpaceMouseStyle, TurnsTheModelAsTheCapIsTurned)
{
  cap.turn[0] = 350; // about x: the top comes towards the person
  ASSERT_TRUE(refreshUntil([&] { return model()->GetElement(2, 1) > 0.05; }));
  EXPECT_NEAR(model()->GetElement(0, 0), 1.0, 1e-12);
  EXPECT_NEAR(model()->Determinant(), 1.0, 1e-9);
}

TEST_F(SpaceMouseStyle, ZoomsWithTheFirstButtonAndResetsWithTheSecond)
{
  cap.buttons = 1;
  ASSERT_TRUE(refreshUntil([&] { return mouse.motion().buttons == 1; }));
  cap.shift[1] = 350; // towards the person
  ASSERT_TRUE(refreshUntil([&] { return model()->Determinant() > 1.05; }));
  EXPECT_EQ(model()->GetElement(2, 3), 0.0) << "a zoom is no shift";
  cap.shift[1] = 0;
  ASSERT_TRUE(rests());
  cap.buttons = 2;
  EXPECT_TRUE(refreshUntil([&] { return model()->Determinant() == 1.0; }));
}
