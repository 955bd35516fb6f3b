#include "ScaleNote.h"

#include "Options/LatticeOptions.h"

#include <gtest/gtest.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include <string>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::app;

namespace
{

/// For a model that the options make, enlarged by @p zoom afterwards, as the fit and the window do.
std::string noteFor(const LatticeOptions& options, double zoom = 1.0)
{
  const AffineTransform transform = AffineTransform::scaling({ zoom, zoom, zoom }) * options.transform();
  vtkNew<vtkMatrix4x4> model;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      model->SetElement(row, column, transform.m[row][column]);
    }
  }
  return describeScale(model, options.unit, options.metresPerUnit());
}

LatticeOptions withUnit(const std::string& unit)
{
  LatticeOptions options;
  options.unit = unit;
  return options;
}

TEST(ScaleNote, OfEachUnitIsOneWhereTheCloudIsAsLargeAsItIs)
{
  for (const std::string unit : { "m", "cm", "mm", "um", "km", "in", "ft" })
  {
    EXPECT_EQ(noteFor(withUnit(unit)), "scale 1 (1 " + unit + " of the cloud is 1 " + unit + " in the hand)");
  }
}

TEST(ScaleNote, SaysHowLargeAZoomedUnitIs)
{
  EXPECT_EQ(noteFor(withUnit("m"), 0.52), "scale 0.52 (1 m of the cloud is 0.52 m in the hand)");
  EXPECT_EQ(noteFor(withUnit("m"), 1.8), "scale 1.8 (1 m of the cloud is 1.8 m in the hand)");
  EXPECT_EQ(noteFor(withUnit("mm"), 2.0), "scale 2 (1 mm of the cloud is 2 mm in the hand)");
  LatticeOptions halved = withUnit("in");
  halved.scale = { 0.5 };
  EXPECT_EQ(noteFor(halved), "scale 0.5 (1 in of the cloud is 0.5 in in the hand)");
}

TEST(ScaleNote, TakesAUnitInWhichTheLengthCanBeRead)
{
  // An aerial scan fitted to the workspace.
  EXPECT_EQ(noteFor(withUnit("m"), 0.000384), "scale 0.000384 (1 m of the cloud is 0.384 mm in the hand)");
  EXPECT_EQ(noteFor(withUnit("ft"), 0.01), "scale 0.01 (1 ft of the cloud is 3.05 mm in the hand)");
  EXPECT_EQ(noteFor(withUnit("km"), 3e-5), "scale 3e-05 (1 km of the cloud is 30 mm in the hand)");
  EXPECT_EQ(noteFor(withUnit("um"), 1000.0), "scale 1e+03 (1 um of the cloud is 1 mm in the hand)");
  EXPECT_EQ(noteFor(withUnit("m"), 1e-8), "scale 1e-08 (1 m of the cloud is 0.01 um in the hand)");
}

TEST(ScaleNote, OfTurnedUnevenAndMirroredModelsIsTheMeanOne)
{
  LatticeOptions options = withUnit("mm");
  options.scale = { 1.0, 2.0, -4.0 };
  options.rotate = { 30.0, 1.0, 1.0, 0.0 };
  options.translate = { 5.0, 0.0, 0.0 };
  EXPECT_EQ(noteFor(options), "scale 2 (1 mm of the cloud is 2 mm in the hand)");
}

} // namespace
