/// @file
/// The first process of the virtual machine: what a system would do before it starts a program.
#pragma once

#include <functional>

namespace pointhaptics
{
namespace trial
{

/// True in the first process of a machine that has just started.
bool isFirstProcess();

/// Mounts proc, sys and dev, loads every module in /modules in the order of their names, runs @p program in a
/// process of its own, prints its exit code as "vm: tests ended with N", and switches the machine off.
[[noreturn]] void liveAsFirstProcess(const std::function<int()>& program);

} // namespace trial
} // namespace pointhaptics
