// Viewer FILE... : a window in which the clouds are seen and felt. Viewer FILE PICTURE.png: a picture of one.
#include <HapticViewer.h>

#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char* argv[])
{
  std::vector<std::string> files(argv + 1, argv + argc);
  std::string picture;
  if (files.size() == 2 && files[1].size() > 4 && files[1].substr(files[1].size() - 4) == ".png")
  {
    picture = files[1];
    files.pop_back();
  }

  pointhaptics::HapticViewerOptions options;
  options.width = 640;
  options.height = 480;
  pointhaptics::HapticViewer viewer(options);
  if (!viewer.open(files) || !(picture.empty() ? viewer.run() : viewer.renderToFile(picture)))
  {
    std::fprintf(stderr, "%s\n", viewer.message().c_str());
    return 1;
  }
  std::printf("%lld points: %s\n", static_cast<long long>(viewer.numberOfPoints()), picture.c_str());
  return 0;
}
