/// @file
/// Counts what a real-time thread must not call: allocation, release of memory, locks, output.
#pragma once

namespace countedcalls
{

/// While one lives, every such call of its own thread is counted; other threads are left alone.
class Watch
{
public:
  Watch();
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
};

/// While one lives, nothing of its own thread is counted: for parts of a test that stand for hardware.
class Pause
{
public:
  Pause();
  ~Pause();
  Pause(const Pause&) = delete;
  Pause& operator=(const Pause&) = delete;

private:
  int watches_;
};

/// Calls counted in this thread since its first Watch.
long count();
/// Name of the first function counted in this thread; null before.
const char* firstFunction();

} // namespace countedcalls
