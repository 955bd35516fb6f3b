#include "View/ViewSettings.h"

#include "Options/SharedOptions.h"

#include "HapticViewerOptions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

using namespace pointhaptics;
using namespace pointhaptics::app;

namespace
{

/// Reads the settings back as --config does.
LatticeOptions readBack(const nlohmann::ordered_json& settings)
{
  LatticeOptions options;
  options.unit = settings.value("unit", "m");
  options.matrix = settings.at("matrix").get<std::vector<double>>();
  const auto w = settings.at("workspace").get<std::vector<double>>();
  options.voxels.lattice.workspace = { { w[0], w[2], w[4] }, { w[1], w[3], w[5] } };
  options.voxels.lattice.automaticWorkspace = false;
  return options;
}

TEST(ViewSettings, KeepTheUnitOfTheFileBesideTheModelMatrix)
{
  const double elements[16] = { 0, -0.004, 0, 0.01, 0.004, 0, 0, 0.02, 0, 0, 0.004, -0.03, 0, 0, 0, 1 };
  const double workspace[6] = { -0.05, 0.05, -0.04, 0.04, -0.03, 0.03 };
  HapticViewerState state;
  std::copy(std::begin(elements), std::end(elements), state.modelToWorkspace.begin());
  std::copy(std::begin(workspace), std::end(workspace), state.workspace.begin());
  state.axes = true;
  for (const std::string unit : { "m", "mm", "in" })
  {
    nlohmann::ordered_json settings = { { "unit", unit }, { "scale", "4" }, { "axes", true } };
    LatticeOptions given;
    given.unit = unit;
    setState(settings, state, given.metresPerUnit());
    EXPECT_EQ(settings.count("scale"), 0u);
    EXPECT_EQ(settings["axes"], true);
    const LatticeOptions again = readBack(settings);
    EXPECT_EQ(again.metresPerUnit(), given.metresPerUnit()) << unit;
    const AffineTransform transform = again.transform();
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        EXPECT_NEAR(transform.m[row][column], elements[4 * row + column], 1e-17) << unit;
      }
      EXPECT_EQ(again.workspace().minimum[row], workspace[2 * row]);
    }
  }
}

} // namespace
