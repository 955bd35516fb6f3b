/// @file
/// The function that libFuzzer calls.
#pragma once

#include <cstddef>

/// Aborts where a promise of the reader or the writers is broken.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size);
