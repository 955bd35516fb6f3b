#include "ScreenLayout.h"

#include "CloudAppearance.h"
#include "DistanceMark.h"
#include "ScreenScale.h"
#include "Unit/SkipWithoutDisplay.h"
#include "vtkHapticGauge.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProgress.h"
#include "vtkHapticSliders.h"

#include <gtest/gtest.h>

#include "vtkActor2D.h"
#include "vtkActor2DCollection.h"
#include "vtkAlgorithm.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkPropCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkScalarBarActor.h"
#include "vtkSliderRepresentation2D.h"
#include "vtkSmartPointer.h"
#include "vtkTextActor.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

using namespace pointhaptics;

namespace
{

constexpr double kPointsPerInch = 72.0;

const char* const kStatus =
  "5000000 points in 401222 active voxels\nproxy radius 0.31 mm    force 1.20 N    in contact\n"
  "servo 1000 Hz, 0 deadline misses    hand follows the mouse, touch pushes it\n"
  "1 : 12,200; 1 mm in the hand is 12 m    U: the file is in mm\nH: help";
const char* const kPanel =
  "servo loop: running, SCHED_FIFO\nrate: 1000.0 Hz\njitter: p50 0 us, p99 82 us, max 279 us\n"
  "step time: p50 1 us, p99 29 us, max 42 us\nticks: 1234567, deadline misses: 0, idle: 88\n"
  "device faults: 0, waiting: 0\nforce limit: 8 N (program)\ndevice: simulated hand";

/// A window with everything that the viewer writes over its picture.
struct Screen
{
  Screen(int width, int height, double fontScale, bool hasClasses)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(width, height);
    interactor->SetRenderWindow(window);
    renderer->SetBackground(0.3, 0.5, 0.3); // none of the colours drawn
    renderer->SetViewport(0.0, 0.24, 1.0, 1.0);
    window->AddRenderer(renderer);
    applyTextScale(window, fontScale);
    overlay->AddTo(renderer);
    progress->AddTo(renderer);
    sliders->SetInteractor(interactor);
    setUpScalarBar(bar);
    if (hasClasses)
    {
      vtkNew<vtkUnsignedCharArray> classes;
      for (const unsigned char number : { 1, 2, 3, 4, 5, 6, 9, 17 })
      {
        classes->InsertNextValue(number);
      }
      bar->SetLookupTable(vtkSmartPointer<vtkLookupTable>::Take(newClassLegend(classes)));
      bar->SetTitle("Classification\n");
    }
    else
    {
      const auto colors = vtkSmartPointer<vtkLookupTable>::Take(newCloudColorMap());
      colors->SetTableRange(-0.00077, 0.0025);
      bar->SetLookupTable(colors);
      bar->SetTitle("DistanceToSurface:x\n");
    }
    renderer->AddActor2D(bar);
    layout.setOverlay(overlay);
    layout.setSliders(sliders);
    layout.setProgress(progress);
    layout.setScalarBar({ [this](double font, double& wide, double& high)
      {
        double size[2];
        measureScalarBar(bar, font, window->GetDPI() / kPointsPerInch, size);
        wide = size[0];
        high = size[1];
        return wantsBar;
      },
      [this](const ScreenRectangle& box, double font)
      {
        bar->SetVisibility(!box.empty());
        const double edges[4] = { box.left, box.bottom, box.right, box.top };
        placeScalarBar(bar, renderer, font, window->GetDPI() / kPointsPerInch, edges);
      } });
    layout.follow(renderer);
  }
  ~Screen() { sliders->SetInteractor(nullptr); }

  void showAll(int detailLines)
  {
    overlay->SetStatus(kStatus);
    overlay->SetPanel(kPanel);
    std::string detail = "point 123456";
    for (int i = 1; i < detailLines; ++i)
    {
      detail += "\nGpsTime  411234567.123456 and more of it";
    }
    overlay->SetDetail(detail);
    sliders->SetVisibility(true);
    wantsBar = true;
  }

  std::set<std::string> names() const
  {
    std::set<std::string> found;
    for (const ScreenLayout::Place& place : layout.places())
    {
      found.insert(place.name);
    }
    return found;
  }

  /// Pixels of the renderer that differ from its background.
  ScreenRectangle drawn()
  {
    window->Render();
    const int* size = renderer->GetSize();
    const int* origin = renderer->GetOrigin();
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetRGBACharPixelData(
      origin[0], origin[1], origin[0] + size[0] - 1, origin[1] + size[1] - 1, 0, pixels);
    ScreenRectangle box{ 1e9, 1e9, 0.0, 0.0 };
    for (int y = 0; y < size[1]; ++y)
    {
      for (int x = 0; x < size[0]; ++x)
      {
        const unsigned char* p = pixels->GetPointer(4 * (vtkIdType(y) * size[0] + x));
        if (std::abs(p[0] - 77) > 2 || std::abs(p[1] - 128) > 2 || std::abs(p[2] - 77) > 2)
        {
          box = { std::min(box.left, double(x)), std::min(box.bottom, double(y)),
            std::max(box.right, x + 1.0), std::max(box.top, y + 1.0) };
        }
      }
    }
    return box;
  }

  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkHapticOverlay> overlay;
  vtkNew<vtkHapticSliders> sliders;
  vtkNew<vtkHapticProgress> progress;
  vtkNew<vtkScalarBarActor> bar;
  bool wantsBar = false;
  ScreenLayout layout;
};

/// No two places meet, and all lie within the renderer.
void expectApart(const Screen& screen, const std::string& what)
{
  const int* size = const_cast<vtkRenderer*>(screen.renderer.Get())->GetSize();
  const std::vector<ScreenLayout::Place>& places = screen.layout.places();
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const ScreenRectangle& a = places[i].box;
    EXPECT_FALSE(a.empty()) << what << places[i].name;
    EXPECT_TRUE(a.left >= 0.0 && a.bottom >= 0.0 && a.right <= size[0] && a.top <= size[1])
      << what << places[i].name << " " << a.left << ".." << a.right << ", " << a.bottom << ".." << a.top;
    for (std::size_t j = 0; j < i; ++j)
    {
      EXPECT_FALSE(a.meets(places[j].box)) << what << places[i].name << " over " << places[j].name;
    }
  }
}

/// Draws each actor alone and expects its pixels within one place.
void expectInPlaces(Screen& screen, const std::string& what)
{
  constexpr double kSlack = 3.0; // pixels
  screen.window->Render();
  const std::vector<ScreenLayout::Place> places = screen.layout.places();
  screen.layout.follow(nullptr);
  std::vector<vtkActor2D*> shown;
  vtkActor2DCollection* actors = screen.renderer->GetActors2D();
  actors->InitTraversal();
  while (vtkActor2D* actor = actors->GetNextActor2D())
  {
    if (actor->GetVisibility())
    {
      shown.push_back(actor);
      actor->VisibilityOff();
    }
  }
  const auto isIn = [&](const ScreenRectangle& box)
  {
    return box.empty() ||
      std::any_of(places.begin(), places.end(),
        [&](const ScreenLayout::Place& place)
        {
          return box.left >= place.box.left - kSlack && box.right <= place.box.right + kSlack &&
            box.bottom >= place.box.bottom - kSlack && box.top <= place.box.top + kSlack;
        });
  };
  const auto expectIn = [&](const char* name)
  {
    const ScreenRectangle box = screen.drawn();
    EXPECT_TRUE(isIn(box)) << what << name << " draws " << box.left << ".." << box.right << ", " << box.bottom
                           << ".." << box.top;
  };
  expectIn("sliders");
  screen.sliders->SetCovered(true);
  for (vtkActor2D* actor : shown)
  {
    actor->VisibilityOn();
    expectIn(actor->GetClassName());
    actor->VisibilityOff();
  }
}

struct Size
{
  int width;
  int height;
  double fontScale;
};

constexpr Size kSizes[] = { { 640, 480, 1.0 }, { 1280, 800, 1.0 }, { 3840, 2160, 1.0 }, { 640, 480, 2.0 },
  { 1280, 800, 1.6 } };

class ScreenLayoutTest : public ::testing::Test
{
protected:
  void SetUp() override { SKIP_WITHOUT_DISPLAY(); }
};

TEST_F(ScreenLayoutTest, AllIsDrawnWhereTheLayoutSaysAndNothingOverlaps)
{
  for (const Size& size : kSizes)
  {
    for (const bool hasClasses : { false, true })
    {
      const std::string what = std::to_string(size.width) + " times " + std::to_string(size.fontScale) +
        (hasClasses ? ", classes: " : ", numbers: ");
      Screen screen(size.width, size.height, size.fontScale, hasClasses);
      screen.showAll(6);
      screen.window->Render();
      expectApart(screen, what);
      EXPECT_TRUE(screen.names().count("status") && screen.names().count("panel")) << what;
      if (size.width > 640)
      {
        EXPECT_EQ(screen.names(), (std::set<std::string>{ "status", "panel", "detail", "sliders", "bar" }))
          << what;
      }
      screen.overlay->SetHelpVisibility(true);
      screen.overlay->SetHelp("Look     left drag    rotate the view\nModel    0, Home    back to the start");
      screen.window->Render();
      EXPECT_EQ(screen.names(), std::set<std::string>{ "help" }) << what;
      screen.overlay->SetHelpVisibility(false);
      screen.progress->SetProgress("reading lucy.ply", 0.4);
      screen.window->Render();
      expectApart(screen, what + "progress: ");
      EXPECT_TRUE(screen.names().count("progress")) << what;
      Screen inPlaces(size.width, size.height, size.fontScale, hasClasses);
      inPlaces.showAll(6);
      expectInPlaces(inPlaces, what);
    }
  }
}

TEST(ScreenScale, AWindowIsNoLargerThanTheScreen)
{
  EXPECT_EQ(lengthOnScreen(1280, 640), 576);
  EXPECT_EQ(lengthOnScreen(800, 480), 432);
  EXPECT_EQ(lengthOnScreen(640, 640), 640) << "asked for the whole screen";
  EXPECT_EQ(lengthOnScreen(1280, 3840), 1280);
  EXPECT_EQ(lengthOnScreen(1280, 0), 1280) << "a screen that is not known";
}

TEST_F(ScreenLayoutTest, EveryLineOfTheHelpIsReadInASmallWindow)
{
  std::string help = "Look     left drag    rotate the view";
  for (int line = 1; line < 58; ++line)
  {
    help += "\n" + std::string(line == 40 ? "Program  " : "         ") + "key " + std::to_string(line);
  }
  Screen screen(640, 480, 1.0, false);
  screen.overlay->SetHelp(help, "H");
  screen.overlay->SetHelpVisibility(true);
  int page = 0;
  do
  {
    screen.window->Render();
    const ScreenRectangle box = screen.layout.places().at(0).box;
    EXPECT_TRUE(box.left >= 0.0 && box.bottom >= 0.0 && box.right <= 640.0 && box.top <= 365.0)
      << "page " << page;
    EXPECT_EQ(screen.overlay->GetHelpPage(), page++);
  } while (screen.overlay->ShowNextHelpPage());
  EXPECT_EQ(page, screen.overlay->GetNumberOfHelpPages());
  EXPECT_TRUE(page == 2 || page == 3) << page;
  screen.overlay->SetHelpVisibility(false);
  EXPECT_EQ(screen.overlay->GetHelpPage(), 0) << "from the first page again";
  Screen large(1280, 1000, 1.0, false);
  large.overlay->SetHelp(help, "H");
  large.overlay->SetHelpVisibility(true);
  large.window->Render();
  EXPECT_EQ(large.overlay->GetNumberOfHelpPages(), 1);
}

TEST_F(ScreenLayoutTest, TheHelpIsLargeEnoughToBeRead)
{
  std::string help;
  for (int line = 0; line < 56; ++line)
  {
    help += std::string(line % 14 == 0 ? "Show     " : "         ") +
      "Escape while a distance is shown   some keys do this, others the contrary\n";
  }
  for (const Size& size : { Size{ 800, 600, 1.0 }, Size{ 1000, 700, 1.0 }, Size{ 1280, 800, 1.0 } })
  {
    SCOPED_TRACE(size.width);
    Screen screen(size.width, size.height, 1.0, false);
    screen.overlay->SetHelp(help, "H");
    screen.overlay->SetHelpVisibility(true);
    screen.window->Render();
    const ScreenRectangle box = screen.layout.places().at(0).box;
    // In two columns where they are wide enough, else by pages.
    const int pages = screen.overlay->GetNumberOfHelpPages();
    EXPECT_EQ(pages > 1, size.width < 1000);
    const double letter = (box.right - box.left) / (pages == 1 ? 2.0 * 84.0 : 88.0);
    EXPECT_GT(letter, 5.0) << "pixels, of 9 points";
    EXPECT_LE(box.right - box.left, size.width);
  }
}

TEST_F(ScreenLayoutTest, TheColoursStandAtTheEdgeWhateverTheTitle)
{
  std::array<int, 4> strips[2];
  for (int i = 0; i < 2; ++i)
  {
    Screen screen(640, 480, 1.0, false);
    screen.bar->SetTitle(i == 0 ? "Ring\n" : "DistanceToSurface (m)\n");
    screen.wantsBar = true;
    screen.window->Render();
    screen.bar->GetScalarBarRect(strips[i].data(), screen.renderer);
    EXPECT_EQ(strips[i][0] + strips[i][2], 630);
  }
  EXPECT_NEAR(strips[0][0], strips[1][0], 1);
  EXPECT_EQ(strips[0][1], strips[1][1]);
}

TEST_F(ScreenLayoutTest, WhatOneAsksForAloneIsShownInASmallWindow)
{
  for (const bool asksSliders : { false, true })
  {
    Screen screen(640, 480, 1.0, true);
    screen.overlay->SetStatus(kStatus);
    asksSliders ? screen.sliders->SetVisibility(true) : void(screen.wantsBar = true);
    screen.window->Render();
    EXPECT_EQ(screen.names(), (std::set<std::string>{ "status", asksSliders ? "sliders" : "bar" }));
    expectApart(screen, "");
  }
}

TEST_F(ScreenLayoutTest, LongLinesAreBrokenAndLongDetailsCut)
{
  Screen screen(640, 480, 1.0, false);
  screen.showAll(60);
  screen.overlay->SetStatus(
    "a file in a folder with a name that is by far too long to be read in one line of a "
    "small window: " +
    std::string(200, 'x') + ".ply: row 7 has 2 values");
  screen.window->Render();
  expectApart(screen, "");
  expectInPlaces(screen, "");
}

TEST_F(ScreenLayoutTest, TextGrowsWithTheScaleAndWithThePicture)
{
  const auto statusHeight = [](int width, int height, double fontScale)
  {
    Screen screen(width, height, fontScale, false);
    screen.overlay->SetStatus("20000 points");
    screen.window->Render();
    return screen.layout.places().front().box.height();
  };
  const double usual = statusHeight(1280, 800, 1.0);
  EXPECT_NEAR(statusHeight(1280, 800, 2.0), 2.0 * usual, 0.15 * 2.0 * usual);
  EXPECT_NEAR(statusHeight(3840, 2160, 1.0), 2.0 * usual, 0.15 * 2.0 * usual);
  EXPECT_NEAR(statusHeight(640, 480, 1.0), usual, 1.0);
}

/// At places all over the picture, under a panel too.
TEST_F(ScreenLayoutTest, TheGaugeGivesWayToTheTexts)
{
  for (const Size& size : kSizes)
  {
    Screen screen(size.width, size.height, size.fontScale, false);
    screen.overlay->SetStatus(kStatus);
    screen.overlay->SetPanel(kPanel);
    vtkNew<vtkHapticGauge> gauge;
    gauge->AddTo(screen.renderer);
    gauge->SetTaken([&screen] { return screen.layout.boxes(); });
    screen.window->Render();
    const double text = screen.layout.places().front().box.height();
    const int* all = screen.renderer->GetSize();
    for (const double x :
      size.width > 2000 ? std::vector<double>{ 0.2 } : std::vector<double>{ 0.02, 0.2, 0.5, 0.97 })
    {
      for (const double y : { 0.03, 0.4, 0.8, 0.98 })
      {
        screen.renderer->SetViewPoint(2.0 * x - 1.0, 2.0 * y - 1.0, 0.5);
        screen.renderer->ViewToWorld();
        double anchor[4];
        screen.renderer->GetWorldPoint(anchor);
        gauge->SetLeft(y > 0.5);
        gauge->Show(anchor, 5.0);
        screen.window->Render();
        const std::array<double, 4> place = gauge->GetPlace();
        const ScreenRectangle box{ place[0], place[1], place[2], place[3] };
        const std::string what =
          std::to_string(size.width) + ": " + std::to_string(x) + ", " + std::to_string(y);
        EXPECT_TRUE(box.left >= 0.0 && box.bottom >= 0.0 && box.right <= all[0] && box.top <= all[1]) << what;
        for (const ScreenLayout::Place& other : screen.layout.places())
        {
          EXPECT_FALSE(box.meets(other.box)) << what << " over " << other.name;
        }
        EXPECT_GT(box.height(), 0.3 * text) << what << ": too small to be seen";
      }
    }
  }
}

/// Where only what lies over the picture is drawn again, knobs stayed where they were when their words went.
TEST_F(ScreenLayoutTest, TheKnobsOfSlidersGoWithTheirWords)
{
  Screen screen(640, 480, 1.0, false);
  screen.sliders->SetVisibility(true);
  screen.window->Render();
  screen.sliders->Place(100.0, 50.0, 300.0, 250.0);
  int parts = 0;
  // They have a renderer of their own.
  auto* own = vtkRenderer::SafeDownCast(screen.window->GetRenderers()->GetItemAsObject(1));
  ASSERT_NE(own, nullptr);
  vtkPropCollection* props = own->GetViewProps();
  props->InitTraversal();
  while (vtkProp* prop = props->GetNextProp())
  {
    vtkNew<vtkPropCollection> actors;
    if (vtkSliderRepresentation2D::SafeDownCast(prop))
    {
      prop->GetActors2D(actors);
    }
    actors->InitTraversal();
    while (vtkProp* part = actors->GetNextProp())
    {
      auto* actor = vtkActor2D::SafeDownCast(part);
      auto* mapper = actor ? vtkPolyDataMapper2D::SafeDownCast(actor->GetMapper()) : nullptr;
      if (mapper && actor->GetVisibility() && !vtkTextActor::SafeDownCast(actor))
      {
        mapper->GetInputAlgorithm()->Update();
        double box[6];
        mapper->GetInput()->GetBounds(box);
        ++parts;
        EXPECT_TRUE(box[0] >= 97.0 && box[1] <= 303.0 && box[2] >= 47.0 && box[3] <= 253.0)
          << box[0] << ".." << box[1] << ", " << box[2] << ".." << box[3];
      }
    }
  }
  EXPECT_GT(parts, 7);
}

/// An end of the normal beside the number would read like a sign.
TEST_F(ScreenLayoutTest, TheGaugeKeepsOffTheNormal)
{
  Screen screen(640, 480, 1.0, false);
  vtkNew<vtkHapticGauge> gauge;
  gauge->AddTo(screen.renderer);
  const auto worldAt = [&screen](double x, double y)
  {
    screen.renderer->SetViewPoint(
      2.0 * x / screen.renderer->GetSize()[0] - 1.0, 2.0 * y / screen.renderer->GetSize()[1] - 1.0, 0.5);
    screen.renderer->ViewToWorld();
    std::array<double, 4> place{};
    screen.renderer->GetWorldPoint(place.data());
    return place;
  };
  screen.window->Render();
  const std::array<double, 4> anchor = worldAt(300, 180);
  gauge->Show(anchor.data(), 0.5);
  screen.window->Render();
  const std::array<double, 4> usual = gauge->GetPlace();
  // Out of the anchor through the middle of the gauge, as a normal without friction, and past its lower edge.
  const double middle = 0.5 * (usual[1] + usual[3]);
  for (const double y : { middle, usual[1] - 2.0 })
  {
    const std::array<double, 4> begin = worldAt(290, y);
    const std::array<double, 4> end = worldAt(420, y);
    gauge->KeepOffLine(begin.data(), end.data());
    screen.window->Render();
    const std::array<double, 4> place = gauge->GetPlace();
    EXPECT_TRUE(place[3] < y - 2.0 || place[1] > y + 2.0 || place[2] < 288.0)
      << place[0] << ", " << place[1] << " to " << place[2] << ", " << place[3] << " about " << y;
  }
  gauge->KeepOffLine(anchor.data(), anchor.data());
  screen.window->Render();
  EXPECT_EQ(gauge->GetPlace(), usual);
}

/// Words of a measured distance, which would stand in the middle of what is taken.
TEST_F(ScreenLayoutTest, TheWordsOfADistanceGiveWay)
{
  Screen screen(640, 480, 1.0, false);
  DistanceMark mark;
  mark.addTo(screen.renderer);
  screen.window->Render();
  screen.renderer->SetViewPoint(0.0, 0.0, 0.5);
  screen.renderer->ViewToWorld();
  double middle[4];
  screen.renderer->GetWorldPoint(middle);
  mark.setPlaces({ { middle[0] - 0.01, middle[1], middle[2] }, { middle[0] + 0.01, middle[1], middle[2] } });
  mark.setWords({ "1.23 m", "x 1 m" });
  const int* size = screen.renderer->GetSize();
  const std::array<double, 4> taken = { 220.0, 0.5 * size[1] - 60.0, 420.0, 0.5 * size[1] + 60.0 };
  const auto drawnIn = [&screen](const std::array<double, 4>& box)
  {
    screen.window->Render();
    const int* corner = screen.renderer->GetOrigin();
    vtkNew<vtkUnsignedCharArray> pixels;
    screen.window->GetPixelData(
      int(box[0]), corner[1] + int(box[1]), int(box[2]), corner[1] + int(box[3]), 0, pixels);
    int plates = 0; // light, where the words stand
    for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
    {
      plates += pixels->GetTypedComponent(i, 0) > 150 && pixels->GetTypedComponent(i, 2) > 150;
    }
    return plates;
  };
  EXPECT_GT(drawnIn(taken), 100);
  mark.setTaken([taken] { return std::vector<std::array<double, 4>>{ taken }; });
  EXPECT_EQ(drawnIn(taken), 0);
  EXPECT_GT(drawnIn({ 0.0, 0.0, double(size[0] - 1), double(size[1] - 1) }), 100) << "they stand elsewhere";
}

TEST(ScreenScale, TakesTheDotsThatTheDesktopSays)
{
  EXPECT_EQ(dotsPerInchOf("*background: white\nXft.antialias:\t1\nXft.dpi:\t192\nXft.hinting:\t1\n"), 192.0);
  EXPECT_EQ(dotsPerInchOf("Xft.dpi: 120.5"), 120.5);
  EXPECT_EQ(dotsPerInchOf("Xft.dpi:\tmany"), 0.0);
  EXPECT_EQ(dotsPerInchOf("Xft.antialias: 1"), 0.0);
  EXPECT_EQ(dotsPerInchOf(nullptr), 0.0);
}

TEST(ScreenScale, GoesByTheLinesOfAScreenWhoseDotsNobodySays)
{
  EXPECT_EQ(scaleOfScreen(600, 600), 1.0);
  EXPECT_EQ(scaleOfScreen(1200, 1200), 1.0);
  EXPECT_NEAR(scaleOfScreen(1440, 1440), 4.0 / 3.0, 1e-12);
  EXPECT_EQ(scaleOfScreen(2160, 2160), 2.0);
  EXPECT_EQ(scaleOfScreen(2160, 480), 1.0) << "no room for larger ones";
  EXPECT_NEAR(scaleOfScreen(2160, 800), 4.0 / 3.0, 1e-12);
}

TEST_F(ScreenLayoutTest, ASmallWindowIsThePicturesFirst)
{
  Screen screen(360, 300, 1.0, false);
  for (const std::string more : { "", "\na\nb", "\na\nb\nc\nd\ne\nf\ng\nh\ni\nj\nk\nl" })
  {
    screen.overlay->SetStatus(kStatus + more);
    screen.window->Render();
    const double height = screen.renderer->GetSize()[1];
    ASSERT_EQ(screen.layout.places().front().name, "status");
    EXPECT_LT(screen.layout.places().front().box.height(), 0.42 * height);
  }
}

TEST_F(ScreenLayoutTest, ACutStatusNamesTheKeyOfTheHelp)
{
  Screen screen(360, 300, 1.0, false);
  screen.overlay->SetStatus(kStatus);
  double size[2];
  screen.overlay->MeasureBlock(vtkHapticOverlay::StatusBlock, 8, 300.0, 3, size);
  auto* text = vtkTextActor::SafeDownCast(screen.renderer->GetActors2D()->GetItemAsObject(0));
  EXPECT_STREQ(text->GetInput(), "5000000 points in 401222 active voxels\n...\nH: help");
}

} // namespace
