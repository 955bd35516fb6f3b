#include "LatticeChoice.h"

#include "Core/Base/Lattice.h"

#include "vtkPolyData.h"

#include <utility>

namespace pointhaptics
{
namespace
{

constexpr int kFinest = 4 * kDefaultLatticeDimension;
/// This many means show and feel a shape well.
constexpr vtkIdType kEnough = 30000;
/// Finer voxels that give less than this many times the means only repeat the points.
constexpr double kGain = 1.25;

} // namespace

LatticeChoice chooseLattice(
  const std::function<vtkSmartPointer<vtkPolyData>(int)>& resample, const std::function<bool()>& goesOn)
{
  LatticeChoice choice{ kDefaultLatticeDimension, resample(kDefaultLatticeDimension) };
  while (choice.dimension < kFinest && choice.means->GetNumberOfPoints() > 0 &&
    choice.means->GetNumberOfPoints() < kEnough && goesOn())
  {
    vtkSmartPointer<vtkPolyData> finer = resample(2 * choice.dimension);
    if (double(finer->GetNumberOfPoints()) < kGain * double(choice.means->GetNumberOfPoints()))
    {
      break;
    }
    choice = { 2 * choice.dimension, std::move(finer) };
  }
  return choice;
}

} // namespace pointhaptics
