#include "Guest.h"

#include <gtest/gtest.h>

#include <cstdio>

int main(int argc, char* argv[])
{
  ::testing::InitGoogleTest(&argc, argv);
  if (pointhaptics::trial::isFirstProcess())
  {
    GTEST_FLAG_SET(color, "no"); // a serial line is no terminal, whatever the kernel says
    pointhaptics::trial::liveAsFirstProcess([] { return RUN_ALL_TESTS(); });
  }
  std::fprintf(
    stderr, "these tests make devices of the kernel: run them by `ctest -L vm`, in a virtual machine\n");
  return 2;
}
