#include "IO/Vtk/ErrorCollector.h"

#include "IO/Text/TextScan.h"

namespace pointhaptics::io
{

void ErrorCollector::Execute(vtkObject*, unsigned long event, void* callData)
{
  if (event != vtkCommand::ErrorEvent || !callData || !first_.empty())
  {
    return;
  }
  // VTK's text: "ERROR: In file, line n\nvtkClass (0x...): the message\n\n".
  const std::string text = static_cast<const char*>(callData);
  const std::size_t address = text.find("): ");
  std::string message = address == std::string::npos ? text : text.substr(address + 3);
  for (char& c : message)
  {
    c = c == '\n' ? ' ' : c;
  }
  first_ = std::string(trimmed(message));
  while (!first_.empty() && first_.back() == '.')
  {
    first_.pop_back();
  }
  if (first_.empty())
  {
    first_ = "VTK reported an error without words";
  }
}

} // namespace pointhaptics::io
