/**
 * @class   vtkHapticChart
 * @brief   force and proxy radius over time, live beside the cloud or as a picture of a recorded trace
 *
 * Force magnitude in newtons on the left axis, beside it the ideal one where the surface is known exactly,
 * proxy radius in millimetres on the right one, time in seconds below, the last five. The chart lives in a
 * renderer of its own: give it a viewport and add it to the window. Samples may come at any rate; what is
 * drawn is the largest force and the mean radius of each of at most 600 slices of the time window, so a short
 * peak is never lost.
 *
 * Not thread safe: GUI thread only.
 * @sa vtkInteractorStyleHaptic
 */
#ifndef vtkHapticChart_h
#define vtkHapticChart_h

#include "PointHapticsInteractionModule.h" // For export macro
#include "vtkNew.h"                        // For the parts
#include "vtkObject.h"

#include <cmath> // For NAN
#include <deque> // For the samples
#include <string>

class vtkChartXY;
class vtkContextActor;
class vtkDoubleArray;
class vtkFloatArray;
class vtkRenderer;
class vtkTable;

class POINTHAPTICSINTERACTION_EXPORT vtkHapticChart : public vtkObject
{
public:
  static vtkHapticChart* New();
  vtkTypeMacro(vtkHapticChart, vtkObject);

  ///@{
  /**
   * Show or hide: hidden, the renderer draws nothing. Default: on.
   */
  void SetVisibility(bool visible);
  bool GetVisibility() const;
  ///@}

  /**
   * Names in the legend for the two forces of AddSample(), such as two methods. Default: "force (N)" and
   * "ideal force (N)".
   */
  void SetForceNames(const char* force, const char* other);

  /**
   * Light lines and texts on the dark ground of the viewer's picture; not in WriteImage(). Default: off.
   * @return whether it was the other before.
   */
  bool SetDark(bool dark);

  ///@{
  /**
   * Freeze the picture: samples that come are kept out of it until this is off again; then the chart goes on
   * with the newest. Default: off.
   */
  void SetPaused(bool paused) { this->Paused = paused; }
  bool GetPaused() const { return this->Paused; }
  ///@}

  /**
   * @param seconds time, not before the last one's; @param newtons force magnitude; @param metres proxy
   * radius; @param idealNewtons what an exact surface would answer, NaN: not known. Where another value is
   * not finite the sample is left out.
   */
  void AddSample(double seconds, double newtons, double metres, double idealNewtons = NAN);

  /**
   * Bring the chart up to date. True: it looks different now (a flat line that goes on does not).
   */
  bool Update();

  /**
   * The renderer that shows the chart. Default viewport: the whole window.
   */
  vtkRenderer* GetRenderer() { return this->Renderer; }

  /**
   * Write all samples as a PNG of @p width by @p height pixels, through a window of its own off the screen.
   * Needs a display as every VTK window does. False, with vtkErrorMacro: the file cannot be written, and
   * GetErrorMessage() says why and names the cure.
   */
  bool WriteImage(const char* fileName, int width = 1000, int height = 420);
  const std::string& GetErrorMessage() const { return this->ErrorMessage; }

protected:
  vtkHapticChart();
  ~vtkHapticChart() override;

private:
  vtkHapticChart(const vtkHapticChart&) = delete;
  void operator=(const vtkHapticChart&) = delete;

  struct Sample
  {
    double seconds;
    double newtons;
    double metres;
    double idealNewtons; // NaN: not known
  };
  void ApplyColors();
  bool Draw(double begin, double end, double zero);
  void Fill(double begin, double end, double zero);
  bool IsFlat() const;
  bool IsLow() const;
  void FitTexts();

  bool Paused = false;
  std::string ErrorMessage;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkContextActor> Actor;
  vtkNew<vtkChartXY> Chart;
  vtkNew<vtkTable> Table;
  vtkNew<vtkFloatArray> Time;
  vtkNew<vtkFloatArray> Force;
  vtkNew<vtkFloatArray> Radius;
  vtkNew<vtkFloatArray> Ideal;
  vtkNew<vtkDoubleArray> Ticks; // of the live chart: fewer texts to lay out
  std::deque<Sample> Samples;
  bool IsDark = false;
  bool WasFlat = false;
  int FittedHeight = 0; // of the renderer whose texts fit, pixels,
  int FittedDpi = 0;    // and of its window
};

#endif
