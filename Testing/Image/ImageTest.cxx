// PointHapticsImageTest PICTURE -D DATA -V BASELINE.png [-T FOLDER] [--pixels N] [--mutate FAULT] [--record]
// PointHapticsImageTest PICTURE -D DATA --record-events FILE: records what is done in a window
// As VTK's own tests: -D is the folder of the data, -V the baseline, -T where a failure leaves its pictures.
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
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

using namespace pointhaptics::testing;

namespace
{

constexpr int kSkipped = 77;
/// Tolerance of numbers in the state after an interaction: metres, matrix elements.
constexpr double kSameNumber = 1e-6;

struct Arguments
{
  std::string picture;
  std::string data;
  std::string baseline;
  std::string folder = ".";
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
    else if (word == "-D" && hasValue)
    {
      arguments.data = argv[++i];
    }
    else if (word == "-V" && hasValue)
    {
      arguments.baseline = argv[++i];
    }
    else if (word == "-T" && hasValue)
    {
      arguments.folder = argv[++i];
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
  return !arguments.picture.empty() && !arguments.data.empty() &&
    arguments.baseline.empty() != arguments.events.empty() &&
    !(arguments.record && !arguments.mutation.empty());
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

/// True if both have the same words, and numbers that differ by rounding only.
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

/// Result of a comparison; all is false where there is nothing to compare.
struct Verdict
{
  bool comparable = false;
  bool tolerable = false;    ///< Few enough pixels differ visibly, and the state is the same.
  bool exactlyRight = false; ///< No pixel differs, or the baseline is another renderer's.
};

/// Beside the baseline and named after it: .renderer.txt, .state.txt.
std::string besideBaseline(const Arguments& arguments, const std::string& extension)
{
  return std::filesystem::path(arguments.baseline).replace_extension(extension).string();
}

/// Pictures that a failure leaves to look at.
struct Evidence
{
  const char* name;
  const char* extension;
  vtkImageData* image; ///< Empty: there is none.
};

std::string fileOf(const Arguments& arguments, const Evidence& evidence)
{
  const std::string fault = arguments.mutation.empty() ? "" : "." + arguments.mutation;
  return arguments.folder + "/" + arguments.picture + fault + evidence.extension;
}

void keepEvidence(const Arguments& arguments, const std::vector<Evidence>& evidence)
{
  vtksys::SystemTools::MakeDirectory(arguments.folder);
  for (const Evidence& each : evidence)
  {
    const std::string file = fileOf(arguments, each);
    if (each.image->GetNumberOfPoints() > 0)
    {
      std::printf("  %s: %s\n", writePng(file, each.image) ? each.name : "cannot write", file.c_str());
    }
  }
  if (arguments.mutation.empty())
  {
    std::printf("  if this change is meant, the same command with --record makes it the baseline\n");
  }
}

int record(const Arguments& arguments, vtkImageData* test, const std::string& renderer)
{
  std::ofstream note(besideBaseline(arguments, ".renderer.txt"));
  note << renderer;
  if (const std::string state = interactionState(); !state.empty())
  {
    std::ofstream(besideBaseline(arguments, ".state.txt")) << state;
  }
  const bool written = writePng(arguments.baseline, test) && note.good();
  std::printf("%s %s\n", written ? "recorded" : "cannot write", arguments.baseline.c_str());
  return written ? 0 : 1;
}

/// Says how the picture and the state after an interaction differ from the baseline's.
Verdict judge(const Arguments& arguments, const ImageDifference& difference, const std::string& renderer)
{
  if (!difference.sameSize)
  {
    std::printf("%s: no such baseline, or of another size\n", arguments.baseline.c_str());
    return {};
  }
  const bool isExact = contentOf(besideBaseline(arguments, ".renderer.txt")) == renderer;
  const std::string state = interactionState();
  const std::string expected = contentOf(besideBaseline(arguments, ".state.txt"));
  const bool sameAfterwards = state.empty() || sameState(state, expected);
  if (!sameAfterwards)
  {
    std::printf("the state after the interaction is\n%sinstead of\n%s", state.c_str(), expected.c_str());
  }
  std::printf("%s: %lld pixels differ visibly (at most %lld may), %lld at all%s, largest step %d of 255\n",
    arguments.picture.c_str(), difference.visible, arguments.pixels, difference.any,
    isExact ? " (none may: this is the renderer of the baseline)" : "", difference.largest);
  Verdict verdict;
  verdict.comparable = true;
  verdict.tolerable = difference.visible <= arguments.pixels && sameAfterwards;
  verdict.exactlyRight = !isExact || difference.any == 0;
  return verdict;
}

int compare(const Arguments& arguments, vtkImageData* test, const std::string& renderer)
{
  vtkNew<vtkImageData> baseline;
  vtkNew<vtkImageData> picture;
  const bool exists = readPng(arguments.baseline, baseline);
  const Verdict verdict =
    judge(arguments, exists ? compareImages(test, baseline, picture) : ImageDifference(), renderer);
  bool passed = verdict.comparable && verdict.tolerable && verdict.exactlyRight;
  if (!arguments.mutation.empty())
  {
    // The tolerance tier alone must see the fault, as it would on any other machine.
    passed = verdict.comparable && !verdict.tolerable;
    std::printf("the fault %s is %s\n", arguments.mutation.c_str(), passed ? "seen" : "NOT seen");
  }
  const std::vector<Evidence> evidence = { { "picture", ".png", test },
    { "baseline", ".baseline.png", baseline }, { "difference", ".difference.png", picture } };
  for (const Evidence& each : evidence)
  {
    vtksys::SystemTools::RemoveFile(fileOf(arguments, each)); // of an earlier failure
  }
  if (!passed)
  {
    keepEvidence(arguments, evidence);
  }
  return passed ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
  Arguments arguments;
  if (!parse(argc, argv, arguments))
  {
    std::fprintf(stderr,
      "usage: PointHapticsImageTest PICTURE -D DATA -V BASELINE.png [-T FOLDER] [--pixels N] "
      "[--mutate FAULT] [--record]\n"
      "       PointHapticsImageTest PICTURE -D DATA --record-events FILE\n");
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
  if (!buildPicture(arguments.picture, arguments.mutation, arguments.data, renderer))
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
