/// @file
/// Reads the scans that some tasks of `pointhaptics bench` are given.
#pragma once

#include "Benchmark/Proxy/ProxyBenchmark.h"

#include <string>

namespace pointhaptics
{
namespace app
{

/// A cloud with its file's name and, of PLY files that have some, its triangles. False: @p message says why
/// the file cannot be had.
bool readScan(const std::string& fileName, bench::proxy::Scan& scan, std::string& message);

} // namespace app
} // namespace pointhaptics
