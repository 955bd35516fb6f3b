/// @file
/// Classes that this program's headers name and need not know.
#pragma once

namespace CLI
{
class App;
}

class vtkPolyData;

namespace pointhaptics::app
{

class Job;

} // namespace pointhaptics::app
