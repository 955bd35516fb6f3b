/// @file
/// For tests that open a window.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

namespace trial
{

inline bool hasDisplay()
{
  const char* display = std::getenv("DISPLAY");
  return display && *display;
}

}

/// Leaves the test, or SetUp(), it is written in.
#define SKIP_WITHOUT_DISPLAY()                                                                               \
  if (!::trial::hasDisplay())                                                                                \
  GTEST_SKIP() << "no display (DISPLAY is not set); run the tests under xvfb-run"
