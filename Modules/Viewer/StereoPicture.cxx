#include "StereoPicture.h"

#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <iterator>

namespace pointhaptics
{
namespace
{

struct Stereo
{
  const char* name;
  int type;
};

constexpr Stereo kStereo[] = { { "none", 0 }, { kUsualStereo, VTK_STEREO_ANAGLYPH },
  { "red-blue", VTK_STEREO_RED_BLUE }, { "interlaced", VTK_STEREO_INTERLACED },
  { "checkerboard", VTK_STEREO_CHECKERBOARD }, { "side-by-side", VTK_STEREO_SPLITVIEWPORT_HORIZONTAL },
  { kQuadBuffers, VTK_STEREO_CRYSTAL_EYES } };

} // namespace

const std::vector<std::string>& stereoNames()
{
  static const std::vector<std::string> names = []
  {
    std::vector<std::string> all;
    for (const Stereo& stereo : kStereo)
    {
      all.emplace_back(stereo.name);
    }
    return all;
  }();
  return names;
}

bool applyStereo(vtkRenderWindow* window, const std::string& name)
{
  const auto* found = std::find_if(
    std::begin(kStereo), std::end(kStereo), [&name](const Stereo& each) { return each.name == name; });
  const int type = found == std::end(kStereo) ? 0 : found->type;
  const bool isPossible = type != VTK_STEREO_CRYSTAL_EYES || window->GetStereoCapableWindow();
  if (type != 0 && isPossible)
  {
    window->SetStereoType(type);
  }
  window->SetStereoRender(type != 0 && isPossible);
  return isPossible;
}

void tellStereo(vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  if (camera->GetStereo() != renderer->GetRenderWindow()->GetStereoRender())
  {
    camera->Render(renderer); // sets it, and clears what is drawn next
    camera->Modified();
  }
}

} // namespace pointhaptics
