// PointHapticsImageTest PICTURE --baselines DIR [--output DIR] [--pixels N] [--mutate FAULT] [--record]
// PointHapticsImageTest PICTURE --baselines DIR --record-events FILE: records what is done in a window
// Exit code 0: as it should be; 1: not; 2: usage; 77: skipped, there is no display.
#include "ImageComparison.h"
#include "InteractionPictures.h"
#include "Pictures.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>
#include <vtksys/SystemTools.hxx>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

using namespace pointhaptics::testing;

namespace
{

constexpr int kSkipped = 77;
/// Of the state after an interaction: metres, matrix elements.
constexpr double kSameNumber = 1e-6;

struct Arguments
{
  std::string picture;
  std::string baselines;
  std::string output = ".";
  std::string mutation;
  std::string events;
  long long pixels = 0;
  bool record = false;
};

bool parse(int argc, char** argv, Arguments& arguments)
{
  for (int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    const bool hasValue = i + 1 < argc;
    if (word == "--record")
    {
      arguments.record = true;
    }
    else if (word == "--baselines" && hasValue)
    {
      arguments.baselines = argv[++i];
    }
    else if (word == "--output" && hasValue)
    {
      arguments.output = argv[++i];
    }
    else if (word == "--record-events" && hasValue)
    {
      arguments.events = argv[++i];
    }
    else if (word == "--mutate" && hasValue)
    {
      arguments.mutation = argv[++i];
    }
    else if (word == "--pixels" && hasValue)
    {
      arguments.pixels = std::atoll(argv[++i]);
    }
    else if (arguments.picture.empty() && word[0] != '-')
    {
      arguments.picture = word;
    }
    else
    {
      return false;
    }
  }
  return !arguments.picture.empty() && !arguments.baselines.empty();
}

/// The lines of the window's report that say who drew: vendor, renderer and version.
std::string rendererOf(vtkRenderWindow* window)
{
  std::istringstream report(window->ReportCapabilities());
  std::string lines;
  for (std::string line; std::getline(report, line);)
  {
    if (line.find("OpenGL vendor string") == 0 || line.find("OpenGL renderer string") == 0 ||
      line.find("OpenGL version string") == 0)
    {
      lines += line + "\n";
    }
  }
  return lines;
}

std::string contentOf(const std::string& fileName)
{
  std::ifstream file(fileName);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

/// Whether both have the same words, and numbers that differ by rounding only.
bool sameState(const std::string& test, const std::string& baseline)
{
  std::istringstream tests(test);
  std::istringstream baselines(baseline);
  std::string one;
  std::string other;
  while (tests >> one)
  {
    if (!(baselines >> other))
    {
      return false;
    }
    const bool isNumber = one.find_first_not_of("-.0123456789") == std::string::npos;
    const bool same =
      isNumber ? std::abs(std::atof(one.c_str()) - std::atof(other.c_str())) < kSameNumber : one == other;
    if (!same)
    {
      return false;
    }
  }
  return !(baselines >> other);
}

/// Three files to look at, with their paths.
void keepEvidence(
  const Arguments& arguments, vtkImageData* test, vtkImageData* baseline, vtkImageData* difference)
{
  vtksys::SystemTools::MakeDirectory(arguments.output);
  const std::string stem = arguments.output + "/" + arguments.picture;
  const std::pair<const char*, vtkImageData*> files[] = { { "test", test }, { "baseline", baseline },
    { "difference", difference } };
  for (const auto& file : files)
  {
    const std::string name = stem + "." + file.first + ".png";
    if (file.second->GetNumberOfPoints() > 0 && writePng(name, file.second))
    {
      std::printf("  %s: %s\n", file.first, name.c_str());
    }
  }
}

int record(const Arguments& arguments, vtkImageData* test, const std::string& renderer)
{
  const std::string stem = arguments.baselines + "/" + arguments.picture;
  std::ofstream note(stem + ".renderer.txt");
  note << renderer;
  if (const std::string state = interactionState(); !state.empty())
  {
    std::ofstream(stem + ".state.txt") << state;
  }
  const bool written = writePng(stem + ".png", test) && note.good();
  std::printf("%s %s.png\n", written ? "recorded" : "cannot write", stem.c_str());
  return written ? 0 : 1;
}

int compare(const Arguments& arguments, vtkImageData* test, const std::string& renderer)
{
  const std::string stem = arguments.baselines + "/" + arguments.picture;
  vtkNew<vtkImageData> baseline;
  vtkNew<vtkImageData> picture;
  const bool exists = readPng(stem + ".png", baseline);
  const ImageDifference difference = exists ? compareImages(test, baseline, picture) : ImageDifference();
  if (!difference.sameSize)
  {
    std::printf("%s.png: no such baseline, or of another size\n", stem.c_str());
    keepEvidence(arguments, test, baseline, picture);
    return 1;
  }
  const bool isExact = contentOf(stem + ".renderer.txt") == renderer;
  const std::string state = interactionState();
  const bool sameAfterwards = state.empty() || sameState(state, contentOf(stem + ".state.txt"));
  if (!sameAfterwards)
  {
    std::printf("the state after the interaction is\n%sinstead of\n%s", state.c_str(),
      contentOf(stem + ".state.txt").c_str());
  }
  const bool tolerable = difference.visible <= arguments.pixels && sameAfterwards;
  const bool exactlyRight = !isExact || difference.any == 0;
  std::printf("%s: %lld pixels differ visibly (at most %lld may), %lld at all%s, largest step %d of 255\n",
    arguments.picture.c_str(), difference.visible, arguments.pixels, difference.any,
    isExact ? " (none may: this is the renderer of the baseline)" : "", difference.largest);
  if (!arguments.mutation.empty())
  {
    // The tolerance tier alone must see the fault, as it would on any other machine.
    std::printf("the fault %s is %s\n", arguments.mutation.c_str(), tolerable ? "NOT seen" : "seen");
    return tolerable ? 1 : 0;
  }
  if (!tolerable || !exactlyRight)
  {
    keepEvidence(arguments, test, baseline, picture);
    return 1;
  }
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  if (!parse(argc, argv, arguments))
  {
    std::fprintf(stderr,
      "usage: PointHapticsImageTest PICTURE --baselines DIR [--output DIR] [--pixels N] "
      "[--mutate FAULT] [--record]\n");
    return 2;
  }
  const char* display = std::getenv("DISPLAY");
  if (!display || !*display)
  {
    std::printf("skipped: no display (DISPLAY is not set); run the tests under xvfb-run\n");
    return kSkipped;
  }
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(400, 300);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  if (!arguments.events.empty())
  {
    recordInteraction(arguments.events, renderer);
    return 0;
  }
  if (!buildPicture(arguments.picture, arguments.mutation, renderer))
  {
    std::fprintf(
      stderr, "no picture %s with the fault '%s'\n", arguments.picture.c_str(), arguments.mutation.c_str());
    return 2;
  }
  renderer->ResetCameraClippingRange();
  window->Render();
  vtkNew<vtkWindowToImageFilter> grabber;
  grabber->SetInput(window);
  grabber->ReadFrontBufferOff();
  grabber->Update();
  const std::string renderedBy = rendererOf(window);
  return arguments.record ? record(arguments, grabber->GetOutput(), renderedBy)
                          : compare(arguments, grabber->GetOutput(), renderedBy);
}
