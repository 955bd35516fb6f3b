#include "ScaleNote.h"
#include "PolyDataAccess.h"

#include "Options/SharedOptions.h"

#include <gtest/gtest.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include <string>

using namespace pointhaptics;
using namespace pointhaptics::app;

namespace
{

/// For a model that the options make, enlarged by @p zoom afterwards, as the fit and the window do.
std::string noteFor(const LatticeOptions& options, double zoom = 1.0)
{
  vtkNew<vtkMatrix4x4> model;
  setElements(model, AffineTransform::scaling({ zoom, zoom, zoom }) * options.transform());
  return describeScale(model, options.unit, options.metresPerUnit());
}

LatticeOptions withUnit(const std::string& unit)
{
  LatticeOptions options;
  options.unit = unit;
  return options;
}

TEST(ScaleNote, OfEachUnitIsOneToOneWhereTheCloudIsAsLargeAsItIs)
{
  for (const std::string unit : { "m", "cm", "mm", "um", "km", "in", "ft" })
  {
    EXPECT_EQ(noteFor(withUnit(unit)), "1 : 1, as large as it is");
  }
}

TEST(ScaleNote, SaysTheScaleAsAMapDoes)
{
  EXPECT_EQ(noteFor(withUnit("m"), 1.0 / 12204.0), "1 : 12,200; 1 mm in the hand is 12 m");
  EXPECT_EQ(noteFor(withUnit("m"), 0.45), "1 : 2.22; 1 mm in the hand is 2.2 mm");
  EXPECT_EQ(noteFor(withUnit("mm"), 2.0), "2 : 1; 1 mm in the hand is 0.5 mm");
  LatticeOptions halved = withUnit("in");
  halved.scale = { 0.5 };
  EXPECT_EQ(noteFor(halved), "1 : 2; 1 mm in the hand is 2 mm");
}

TEST(ScaleNote, TakesAUnitInWhichTheLengthCanBeRead)
{
  // An aerial scan fitted to the workspace.
  EXPECT_EQ(noteFor(withUnit("m"), 0.000384), "1 : 2,600; 1 mm in the hand is 2.6 m");
  EXPECT_EQ(noteFor(withUnit("ft"), 0.000384), "1 : 2,600; 1 mm in the hand is 8.5 ft");
  EXPECT_EQ(noteFor(withUnit("km"), 3e-5), "1 : 33,300; 1 mm in the hand is 33 m");
  EXPECT_EQ(noteFor(withUnit("um"), 1000.0), "1,000 : 1; 1 mm in the hand is 1 um");
  EXPECT_EQ(noteFor(withUnit("m"), 1e-8), "1 : 100,000,000; 1 mm in the hand is 100 km");
}

TEST(ScaleNote, OfTurnedUnevenAndMirroredModelsIsTheMeanOne)
{
  LatticeOptions options = withUnit("mm");
  options.scale = { 1.0, 2.0, -4.0 };
  options.rotate = { 30.0, 1.0, 1.0, 0.0 };
  options.translate = { 5.0, 0.0, 0.0 };
  EXPECT_EQ(noteFor(options), "2 : 1; 1 mm in the hand is 0.5 mm");
}

} // namespace
