// The pictures that a HapticViewer writes.
#include "HapticViewerFixture.h"

#include "../Unit/SkipWithoutDisplay.h"
#include "CommandRegistry.h"
#include "vtkDepthShadingPass.h"
#include "vtkInteractorStyleHaptic.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

using namespace pointhaptics;

namespace
{

/// Pixels with red other than what the component @p other says.
vtkIdType coloredPixels(const std::string& fileName, int other, double difference)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
  vtkIdType colored = 0;
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    colored += std::abs(pixels->GetComponent(i, 0) - pixels->GetComponent(i, other)) > difference;
  }
  return colored;
}

class HapticViewerPictures : public HapticViewerTest
{
protected:
  /// Draws @p cloud to the file @p name and counts its coloured pixels.
  vtkIdType coloredPixelsOf(vtkPolyData* cloud, const char* name)
  {
    this->save(cloud, name);
    return coloredPixels(this->path(name), 2, 10.0);
  }
};

TEST_F(HapticViewerPictures, LeavesTheBackgroundOutOfTransparentPictures)
{
  SKIP_WITHOUT_DISPLAY();
  options_.picture.background = "black";
  HapticViewer opaque(options_, observer_);
  ASSERT_TRUE(opaque.open(makeSphere())) << opaque.message();
  ASSERT_TRUE(opaque.renderToFile(this->path("opaque.png"))) << opaque.message();
  options_.picture.transparent = true;
  this->save(makeSphere(), "transparent.png");
  vtkNew<vtkPNGReader> readers[2];
  readers[0]->SetFileName(this->path("opaque.png").c_str());
  readers[1]->SetFileName(this->path("transparent.png").c_str());
  readers[0]->Update();
  readers[1]->Update();
  ASSERT_EQ(readers[0]->GetNumberOfScalarComponents(), 3);
  ASSERT_EQ(readers[1]->GetNumberOfScalarComponents(), 4);
  vtkDataArray* expected = readers[0]->GetOutput()->GetPointData()->GetScalars();
  vtkDataArray* got = readers[1]->GetOutput()->GetPointData()->GetScalars();
  ASSERT_EQ(got->GetNumberOfTuples(), expected->GetNumberOfTuples());
  vtkIdType clear = 0, solid = 0, wrong = 0;
  for (vtkIdType i = 0; i < got->GetNumberOfTuples(); ++i)
  {
    const double opacity = got->GetComponent(i, 3) / 255.0;
    clear += opacity == 0.0;
    solid += opacity == 1.0;
    for (int c = 0; c < 3; ++c) // laid on black it is the picture on black
    {
      wrong += std::abs(opacity * got->GetComponent(i, c) - expected->GetComponent(i, c)) > 2.0;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(got->GetComponent(0, 3), 0.0);
  EXPECT_GT(clear, got->GetNumberOfTuples() / 10);
  EXPECT_GT(solid, got->GetNumberOfTuples() / 10);
}

/// Points have colours, the brackets of the workspace are grey.
vtkIdType pixelsOfPoints(const std::string& fileName)
{
  return coloredPixels(fileName, 2, 40.0);
}

TEST_F(HapticViewerPictures, ShowsPointsThatLieAtOnePlace)
{
  SKIP_WITHOUT_DISPLAY();
  options_.width = 400;
  options_.height = 300;
  options_.picture.background = "black";
  const Vec3 place{ 500000.0, 4000000.0, 100.0 };
  const std::vector<std::pair<int, int>> clouds = { { 1, 0 }, { 3, 0 }, { 1000, 1 } };
  for (const auto& [equal, strays] : clouds)
  {
    SCOPED_TRACE(equal);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int i = 0; i < equal + strays; ++i)
    {
      points->InsertNextPoint(place.x + (i < equal ? 0.0 : 2.0), place.y, place.z);
    }
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    this->save(cloud.Get(), "place.png");
    const vtkIdType colored = pixelsOfPoints(this->path("place.png"));
    EXPECT_GE(colored, 40) << "a disc of eight pixels";
    EXPECT_LT(colored, 140); // with its smooth rim
  }
}

TEST_F(HapticViewerPictures, ShowsColorsWithoutAlpha)
{
  SKIP_WITHOUT_DISPLAY();
  options_.picture.background = "black";
  for (const bool felt : { false, true })
  {
    options_.felt = felt;
    const vtkSmartPointer<vtkPolyData> cloud = makeSphere();
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("rgba");
    colors->SetNumberOfComponents(4);
    for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
    {
      const unsigned char color[4] = { static_cast<unsigned char>(i % 256), 255, 255, 0 };
      colors->InsertNextTypedTuple(color);
    }
    cloud->GetPointData()->SetScalars(colors);
    this->save(cloud, "alpha.png");
    EXPECT_GT(pixelsOfPoints(this->path("alpha.png")), 5000) << "felt: " << felt;
  }
}

TEST_F(HapticViewerPictures, IsThatOfAllPointsButAFarOne)
{
  SKIP_WITHOUT_DISPLAY();
  options_.picture.background = "black";
  options_.colorBy = "height";
  vtkSmartPointer<vtkPolyData> cloud = makeSphere();
  const auto picture = [&](const char* name) { return this->coloredPixelsOf(cloud, name); };
  const vtkIdType before = picture("sphere.png");
  EXPECT_GT(before, 5000);
  EXPECT_TRUE(warnings_.empty());
  const Vec3 noData(1e9, 1e9, -1e9);
  cloud->GetPoints()->InsertNextPoint(&noData.x);
  cloud->GetPoints()->Modified();
  EXPECT_NEAR(double(picture("far.png")), double(before), 0.02 * double(before));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("1 of 20,001 points is far from all others; lattice and picture leave it out"),
    std::string::npos)
    << warnings_[0];
  options_.clip = { -2, 2, -2, 2, -2, 2 };
  EXPECT_NEAR(double(picture("clipped.png")), double(before), 0.02 * double(before));
  options_.clip = {};
  options_.fitsWorkspace = false;
  warnings_.clear();
  picture("unfitted.png");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("takes it in"), std::string::npos) << warnings_[0];
}

TEST_F(HapticViewerPictures, IsThatOfTheObjectAmongStrays)
{
  SKIP_WITHOUT_DISPLAY();
  options_.picture.background = "black";
  vtkSmartPointer<vtkPolyData> cloud = makeSphere();
  const auto picture = [&](const char* name) { return this->coloredPixelsOf(cloud, name); };
  const vtkIdType before = picture("sphere.png");
  const double size = cloud->GetLength();
  for (int i = 0; i < 800; ++i) // spread over a ball by golden angles
  {
    const double r = 100.0 * size * std::cbrt((i + 0.5) / 800.0);
    const double z = std::fmod(i * 0.7548776662, 1.0) * 2.0 - 1.0;
    const double angle = i * 2.39996323;
    const double ring = std::sqrt(1.0 - z * z);
    cloud->GetPoints()->InsertNextPoint(r * ring * std::cos(angle), r * ring * std::sin(angle), r * z);
  }
  cloud->GetPoints()->Modified();
  EXPECT_NEAR(double(picture("strays.png")), double(before), 0.05 * double(before));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("of 20,800 points are far from all others"), std::string::npos) << warnings_[0];
}

#ifdef __linux__
TEST_F(HapticViewerPictures, SaysThatTheDiskIsFull)
{
  SKIP_WITHOUT_DISPLAY();
  if (!std::filesystem::is_character_file("/dev/full"))
  {
    GTEST_SKIP() << "no /dev/full on this system";
  }
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  EXPECT_FALSE(viewer.renderToFile("/dev/full"));
  EXPECT_EQ(viewer.message(),
    "/dev/full: cannot be written: No space left on device; free some space on the disk or write elsewhere");
}
#endif

TEST_F(HapticViewerPictures, MakesAHandfulOfPointsLarge)
{
  SKIP_WITHOUT_DISPLAY();
  options_.width = 1000;
  options_.height = 800;
  options_.picture.background = "black";
  vtkNew<vtkPoints> points;
  constexpr int kFew = 40;
  for (int i = 0; i < kFew; ++i) // along a screw, far apart
  {
    points->InsertNextPoint(std::cos(0.7 * i), std::sin(0.7 * i), 0.1 * i);
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  this->save(cloud.Get(), "few.png");
  const vtkIdType lit = pixelsOfPoints(this->path("few.png"));
  EXPECT_GT(lit, kFew * 3.14159 * 2.5 * 2.5) << "discs of six pixels";
  EXPECT_LT(lit, kFew * 3.14159 * 4.0 * 4.0);
}

/// Pixels of the colour of a measured line, and their middle.
struct LinePixels
{
  int count = 0;
  double x = 0.0;
  double y = 0.0;
  int left = 1000000;
  int right = 0;
  int inMiddle = 0; ///< In the middle third of the columns between left and right.
};

LinePixels linePixels(const std::string& fileName)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const int* size = image->GetDimensions();
  LinePixels found;
  std::vector<int> columns;
  for (int i = 0; i < size[0] * size[1]; ++i)
  {
    vtkDataArray* pixels = image->GetPointData()->GetScalars();
    if (pixels->GetComponent(i, 0) == 255.0 && pixels->GetComponent(i, 1) == 196.0 &&
      pixels->GetComponent(i, 2) == 40.0)
    {
      ++found.count;
      found.left = std::min(found.left, i % size[0]);
      found.right = std::max(found.right, i % size[0]);
      found.x += i % size[0];
      found.y += i / size[0];
      columns.push_back(i % size[0]);
    }
  }
  const int third = (found.right - found.left) / 3;
  found.inMiddle = int(std::count_if(columns.begin(), columns.end(),
    [&](int column) { return column > found.left + third && column < found.right - third; }));
  found.x /= std::max(1, found.count);
  found.y /= std::max(1, found.count);
  return found;
}

TEST_F(HapticViewerPictures, ShowsADistanceWhereItsEndsAre)
{
  SKIP_WITHOUT_DISPLAY();
  options_.width = 400;
  options_.height = 300;
  options_.up = "z";
  options_.camera = { 0, -0.4, 0, 0, 0, 0, 0, 0, 1 };
  HapticViewer none(options_, observer_);
  ASSERT_TRUE(none.open(makeSphere())) << none.message();
  ASSERT_TRUE(none.renderToFile(this->path("none.png"))) << none.message();
  EXPECT_EQ(linePixels(this->path("none.png")).count, 0);
  EXPECT_EQ(notes_.size(), 1u);
  options_.picture.measure = { 0, 0, 0, 1, 0, 0 }; // to the right of the middle
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("right.png"))) << viewer.message();
  const LinePixels right = linePixels(this->path("right.png"));
  EXPECT_GT(right.count, 100);
  EXPECT_GE(right.inMiddle, (right.right - right.left) / 3 - 2) << "the line between the crosses";
  EXPECT_GT(right.x, 200.0 + 10.0);
  EXPECT_NEAR(right.y, 150.0, 3.0);
  ASSERT_FALSE(notes_.empty());
  EXPECT_EQ(notes_.back(), "  distance: 1.00 m; dx 1.00   dy 0.00   dz 0.00 m");
  // The line goes with the model, and tells what is true of the file.
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  viewer.style()->GetModel().scale(0.5);
  ASSERT_TRUE(viewer.renderToFile(this->path("half.png"))) << viewer.message();
  const LinePixels half = linePixels(this->path("half.png"));
  EXPECT_GT(half.count, 50);
  EXPECT_LT(half.x, right.x - 5.0);
  EXPECT_TRUE(viewer.stop());
}

TEST_F(HapticViewerPictures, WritesPicturesOfASizeOfTheirOwnThatShowWhatTheWindowShows)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::Simulated;
  options_.width = 400;
  options_.height = 200;
  options_.up = "z";
  options_.picture.screenshotSize = { 300, 300 };
  options_.picture.measure = { -4, 0, 0, 4, 0, 0 };
  options_.camera = { 0, -0.4, 0, 0, 0, 0, 0, 0, 1 };
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("off.png"))) << viewer.message();
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("first.png"))) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("second.png"))) << viewer.message();
  vtkNew<vtkPNGReader> readers[3];
  readers[0]->SetFileName(this->path("off.png").c_str());
  readers[1]->SetFileName(this->path("first.png").c_str());
  readers[2]->SetFileName(this->path("second.png").c_str());
  for (auto& reader : readers)
  {
    reader->Update();
    EXPECT_EQ(reader->GetOutput()->GetDimensions()[0], 300);
    EXPECT_EQ(reader->GetOutput()->GetDimensions()[1], 300);
  }
  EXPECT_EQ(viewer.renderWindow()->GetSize()[0], 400);
  // A picture as high as the window, of half its width, would end before the line does.
  const LinePixels line = linePixels(this->path("first.png"));
  EXPECT_GT(line.left, 10);
  EXPECT_LT(line.right, 290);
  EXPECT_EQ(line.count, linePixels(this->path("second.png")).count);
  EXPECT_TRUE(viewer.stop());
}

TEST_F(HapticViewerPictures, WritesPicturesFromAllAroundTheCloud)
{
  SKIP_WITHOUT_DISPLAY();
  options_.width = 300;
  options_.height = 300;
  options_.up = "z";
  options_.camera = { 0, -0.4, 0, 0, 0, 0, 0, 0, 1 };
  options_.picture.measure = { 0, 0, 0, 1, 0, 0 };
  options_.turntable = 4;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("turn.png"))) << viewer.message();
  EXPECT_FALSE(std::filesystem::exists(this->path("turn.png")));
  EXPECT_FALSE(std::filesystem::exists(this->path("turn-005.png")));
  // The line to the right of the middle points to the viewer, to the left, and away. The camera goes to the
  // right: what is there comes to the front.
  const int middles[4] = { 1, 0, -1, 0 };
  for (int i = 0; i < 4; ++i)
  {
    const LinePixels line = linePixels(this->path("turn-00" + std::to_string(i + 1) + ".png"));
    EXPECT_GT(line.count, 10) << i;
    const double aside = line.x - 150.0;
    EXPECT_EQ(aside > 10.0 ? 1 : aside < -10.0 ? -1 : 0, middles[i]) << i;
    EXPECT_NEAR(line.y, 150.0, 5.0) << i;
  }
  EXPECT_NE(notes_.front().find("turn-001.png to "), std::string::npos) << notes_.front();
  EXPECT_NE(notes_.front().find("turn-004.png (300x300)"), std::string::npos) << notes_.front();
}

TEST_F(HapticViewerPictures, FeelsOnlyWhatIsInTheClippingBox)
{
  options_.clip = { -2, 2, -2, 2, 0.5, 2 }; // a cap of a quarter of the sphere
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  EXPECT_EQ(viewer.numberOfPoints(), kPoints);
  vtkDataArray* counts = viewer.means()->GetPointData()->GetArray("VoxelPointCount");
  ASSERT_NE(counts, nullptr);
  double felt = 0.0;
  for (vtkIdType i = 0; i < counts->GetNumberOfTuples(); ++i)
  {
    felt += counts->GetComponent(i, 0);
  }
  EXPECT_EQ(felt, kPoints / 4);
  double bounds[6];
  viewer.means()->GetBounds(bounds);
  EXPECT_GT(bounds[4], 0.5 * 0.045 - 1e-6); // of a sphere of 4.5 cm
  EXPECT_NEAR(bounds[5], 0.045, 1e-3);
}

TEST_F(HapticViewerPictures, FeelsNothingBeyondEachFaceOfTheClippingBox)
{
  const vtkSmartPointer<vtkPolyData> sphere = makeSphere();
  for (int face = 0; face < 6; ++face)
  {
    const double sign = face % 2 == 0 ? 1.0 : -1.0;
    options_.clip = { -2, 2, -2, 2, -2, 2 };
    options_.clip[std::size_t(face)] = 0.3 * sign;
    int within = 0;
    for (vtkIdType i = 0; i < kPoints; ++i)
    {
      within += sign * sphere->GetPoint(i)[face / 2] >= 0.3;
    }
    HapticViewer viewer(options_, observer_);
    ASSERT_TRUE(viewer.open(sphere)) << viewer.message();
    vtkDataArray* counts = viewer.means()->GetPointData()->GetArray("VoxelPointCount");
    double felt = 0.0;
    for (vtkIdType i = 0; i < counts->GetNumberOfTuples(); ++i)
    {
      felt += counts->GetComponent(i, 0);
    }
    EXPECT_EQ(felt, within) << "face " << face;
    EXPECT_NEAR(within, 0.35 * kPoints, 0.01 * kPoints);
  }
}

TEST_F(HapticViewerPictures, SaysWhatBoxTheCloudHasWhereTheClippingBoxHoldsNothing)
{
  options_.clip = { 5, 6, 5, 6, 5, 6 };
  options_.names.clip = "--clip";
  HapticViewer viewer(options_, observer_);
  EXPECT_FALSE(viewer.open({ this->writeCloud("plane.csv", 500) }));
  EXPECT_NE(viewer.message().find("no point lies in the box of --clip 5,6,5,6,5,6"), std::string::npos)
    << viewer.message();
  EXPECT_NE(viewer.message().find("the cloud has 0,2.49,0,0.01,0,0"), std::string::npos) << viewer.message();
}

TEST_F(HapticViewerPictures, SaysThatAllPointsAreHidden)
{
  options_.picture.hidden = { { "Height", -INFINITY, INFINITY } };
  HapticViewer viewer(options_, observer_);
  EXPECT_FALSE(viewer.open({ this->writeCloud("plane.csv", 500) }));
  EXPECT_NE(viewer.message().find("all points are hidden by"), std::string::npos) << viewer.message();
}

/// Pixels that differ from the lower left one by more than a little.
int drawnPixels(const std::string& fileName, int fromRow, int toRow)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  const int* size = reader->GetOutput()->GetDimensions();
  vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
  int drawn = 0;
  for (int i = fromRow * size[0]; i < toRow * size[0]; ++i)
  {
    drawn += std::abs(pixels->GetComponent(i, 0) - pixels->GetComponent(0, 0)) > 40.0;
  }
  return drawn;
}

TEST_F(HapticViewerPictures, DrawsOnlyWhatIsInTheClippingBox)
{
  SKIP_WITHOUT_DISPLAY();
  options_.width = 300;
  options_.height = 300;
  options_.up = "z";
  options_.camera = { 0, -0.4, 0, 0, 0, 0, 0, 0, 1 };
  HapticViewer whole(options_, observer_);
  ASSERT_TRUE(whole.open(makeSphere())) << whole.message();
  ASSERT_TRUE(whole.renderToFile(this->path("whole.png"))) << whole.message();
  EXPECT_GT(drawnPixels(this->path("whole.png"), 0, 145), 5000);
  EXPECT_GT(drawnPixels(this->path("whole.png"), 155, 300), 5000);
  // Far from the origin points are uploaded shifted.
  for (const double offset : { 0.0, 5e5 })
  {
    const vtkSmartPointer<vtkPolyData> sphere = makeSphere();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (vtkIdType i = 0; i < kPoints; ++i)
    {
      const double* p = sphere->GetPoint(i);
      points->InsertNextPoint(p[0] + offset, p[1], p[2]);
    }
    sphere->SetPoints(points);
    options_.clip = { offset - 2, offset + 2, -2, 2, 0, 2 };
    this->save(sphere, "half.png");
    EXPECT_LT(drawnPixels(this->path("half.png"), 0, 100), 300) << offset << ": more than the brackets";
    EXPECT_GT(drawnPixels(this->path("half.png"), 155, 300), 5000) << offset;
  }
}

/// In the blue of the clipping box's lines.
int bluePixels(const std::string& fileName)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  vtkDataArray* pixels = reader->GetOutput()->GetPointData()->GetScalars();
  int blue = 0;
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    blue += pixels->GetComponent(i, 2) - pixels->GetComponent(i, 0) > 100.0;
  }
  return blue;
}

TEST_F(HapticViewerPictures, LeavesTheHandlesOfTheClippingBoxOutOfTheFigure)
{
  SKIP_WITHOUT_DISPLAY();
  options_.device = HapticViewerDevice::None;
  options_.width = options_.height = 300;
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  const auto blueAfter = [&](const char* command)
  {
    EXPECT_TRUE(viewer.style()->GetCommands().run(command));
    EXPECT_TRUE(viewer.renderToFile(this->path("box.png"))) << viewer.message();
    return bluePixels(this->path("box.png"));
  };
  EXPECT_TRUE(viewer.style()->GetCommands().run("background"));
  const int shown = blueAfter("clip-box");
  EXPECT_GT(shown, 100);
  EXPECT_LT(blueAfter("figure"), 20);
  EXPECT_GT(blueAfter("clip-box"), 100) << "who asks for it in the figure sees it";
  EXPECT_TRUE(viewer.style()->GetCommands().run("clip-box"));
  EXPECT_EQ(blueAfter("figure"), shown) << "it comes back";
  EXPECT_TRUE(viewer.stop());
}

/// Number of pixels that only one eye sees in an anaglyph of a grey cloud.
vtkIdType pixelsOfOneEye(const std::string& fileName)
{
  return coloredPixels(fileName, 1, 60.0);
}

TEST_F(HapticViewerPictures, ShowsEachEyeItsPicture)
{
  SKIP_WITHOUT_DISPLAY();
  options_.width = 300;
  options_.height = 300;
  options_.colorBy = "Height";
  options_.picture.colorMap = "greys";
  options_.device = HapticViewerDevice::None;
  HapticViewer plain(options_, observer_);
  ASSERT_TRUE(plain.open(makeSphere())) << plain.message();
  ASSERT_TRUE(plain.renderToFile(this->path("plain.png"))) << plain.message();
  EXPECT_LT(pixelsOfOneEye(this->path("plain.png")), 20);
  options_.picture.stereo = "anaglyph";
  HapticViewer viewer(options_, observer_);
  ASSERT_TRUE(viewer.open(makeSphere())) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("anaglyph.png"))) << viewer.message();
  const vtkIdType colored = pixelsOfOneEye(this->path("anaglyph.png"));
  EXPECT_GT(colored, 200);
  // In a window the pictures at rest are kept, one for each eye.
  viewer.renderWindow()->SetOffScreenRendering(1);
  ASSERT_TRUE(viewer.start()) << viewer.message();
  ASSERT_TRUE(viewer.renderToFile(this->path("window.png"))) << viewer.message();
  vtkDepthShadingPass* shading = vtkDepthShadingPass::GetPassOf(viewer.renderer());
  const vtkTypeUInt64 pictures = shading->GetNumberOfPictures();
  ASSERT_TRUE(viewer.renderToFile(this->path("again.png"))) << viewer.message();
  EXPECT_EQ(shading->GetNumberOfPictures(), pictures);
  EXPECT_TRUE(shading->GetBlendsSplats());
  EXPECT_EQ(pixelsOfOneEye(this->path("again.png")), pixelsOfOneEye(this->path("window.png")));
  EXPECT_TRUE(viewer.style()->GetCommands().run("stereo"));
  EXPECT_EQ(notes_.back(), "stereo: none");
  ASSERT_TRUE(viewer.renderToFile(this->path("one.png"))) << viewer.message();
  EXPECT_LT(pixelsOfOneEye(this->path("one.png")), colored / 4);
  EXPECT_TRUE(viewer.style()->GetCommands().run("stereo"));
  EXPECT_EQ(notes_.back(), "stereo: anaglyph");
  EXPECT_TRUE(viewer.stop());
}

} // namespace
