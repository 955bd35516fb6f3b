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

/// Calls counted in this thread since its first Watch.
long count();
/// Name of the first function counted in this thread; null before.
const char* firstFunction();

} // namespace countedcalls
