/// @file
/// The help of the options of `view` that a key does too.
#pragma once

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

/// Describes those options of @p command, which has them all, with the keys as @p bindings change the usual
/// ones: each ACTION=GESTURES, checked. May be called again with others.
void describeKeyedOptions(CLI::App& command, const std::vector<std::string>& bindings);

} // namespace pointhaptics::app
