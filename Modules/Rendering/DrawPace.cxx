#include "DrawPace.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtk_glew.h"

#include <limits>
#include <string>

namespace pointhaptics
{
namespace
{

constexpr GLuint64 kLongestWait = 1'000'000'000; // ns

/// True if points are drawn by Mesa on the processor.
bool drawsInSoftware()
{
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string name = text ? text : "";
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

} // namespace

DrawPace& DrawPace::of(vtkOpenGLRenderWindow* window)
{
  static DrawPace pace;
  pace.follow(window);
  return pace;
}

void DrawPace::follow(vtkOpenGLRenderWindow* window)
{
  if (window_ != window)
  {
    window_ = window;
    isNeeded_ = drawsInSoftware();
    drawn_ = 0;
    underWay_.clear(); // they belong to the other context, and end with it
  }
}

std::int64_t DrawPace::room() const
{
  return isNeeded_ ? kStep - drawn_ : std::numeric_limits<std::int64_t>::max();
}

void DrawPace::add(std::int64_t points)
{
  drawn_ += points;
  if (!isNeeded_ || drawn_ < kStep)
  {
    return;
  }
  drawn_ = 0;
  ++steps_;
  underWay_.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  glFlush();
  while (underWay_.size() > kAhead)
  {
    glClientWaitSync(underWay_.front(), GL_SYNC_FLUSH_COMMANDS_BIT, kLongestWait);
    glDeleteSync(underWay_.front());
    underWay_.pop_front();
  }
}

} // namespace pointhaptics
