/// @file
/// Tests that run on a machine made up by umockdev: its devices and no others are there.
#pragma once

#include <umockdev.h>

#include <gtest/gtest.h>

namespace pointhaptics
{
namespace trial
{

/// True where umockdev's library was loaded before all others, as startUnderUmockdev() sees to.
bool underUmockdev();

/// The first call of main(): starts the program again with umockdev's library before all others, which is
/// what makes the devices up. True in the program so started; false where that failed.
bool startUnderUmockdev(char* argv[]);

class UnderUmockdev : public ::testing::Test
{
protected:
  UnderUmockdev()
    : bed_(umockdev_testbed_new())
  {
  }
  ~UnderUmockdev() override { g_object_unref(bed_); }
  UMockdevTestbed* bed() const { return bed_; }

private:
  UMockdevTestbed* bed_;
};

} // namespace trial
} // namespace pointhaptics
