// How exact averaged point arrays are, against the long double twin.
#include "CountingArray.h"
#include "VoxelMeanAttributeOracle.h"
#include "VoxelMeanCases.h"

#include "vtkBitArray.h"
#include "vtkSOADataArrayTemplate.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

constexpr int kAccuracyPoints = 20000;

/// A cloud of kAccuracyPoints in the unit cube and a resampler of n^3 voxels for it.
class VoxelMeanAttributeAccuracy : public testing::Test
{
protected:
  VoxelMeanAttributeAccuracy() { trial::useUnitCube(resampler_, 6); }

  /// Updates; the array @p name of the output.
  vtkDataArray* averaged(const char* name)
  {
    resampler_->SetInputData(cloud_);
    resampler_->Update();
    trial::expectValid(resampler_->GetOutput());
    return resampler_->GetOutput()->GetPointData()->GetArray(name);
  }
  void expectMeans(const char* name)
  {
    vtkDataArray* out = averaged(name);
    trial::expectMeansAgree(cloud_->GetPointData()->GetArray(name), out, trial::oracleOf(resampler_, cloud_));
  }
  double drawn(double low, double high) { return trial::uniform(engine_, low, high); }

  vtkSmartPointer<vtkPolyData> cloud_ = trial::cloudOf(trial::randomPoints(kAccuracyPoints, 41));
  vtkNew<vtkVoxelMeanResampler> resampler_;
  std::mt19937_64 engine_{ 42 };
};

template <typename Array>
class VoxelMeanIntegers : public VoxelMeanAttributeAccuracy
{
};

template <typename T>
using Aos = vtkAOSDataArrayTemplate<T>;
using Integers =
  testing::Types<Aos<char>, Aos<signed char>, Aos<unsigned char>, Aos<short>, Aos<unsigned short>, Aos<int>,
    Aos<unsigned int>, Aos<long>, Aos<unsigned long>, Aos<long long>, Aos<unsigned long long>>;
TYPED_TEST_SUITE(VoxelMeanIntegers, Integers);

}

TYPED_TEST(VoxelMeanIntegers, AreRoundedToTheNearest)
{
  using Value = typename TypeParam::ValueType;
  constexpr Value lowest = std::numeric_limits<Value>::lowest();
  constexpr Value highest = std::numeric_limits<Value>::max();
  const auto bits = [this](vtkIdType, int) { return Value(this->engine_()); };
  trial::addColumns<TypeParam>(this->cloud_, "Whole range", 1, bits);
  trial::addColumns<TypeParam>(
    this->cloud_, "Largest", 2, [](vtkIdType i, int c) { return Value(highest - Value((i + c) % 3)); });
  trial::addColumns<TypeParam>(
    this->cloud_, "Smallest", 1, [](vtkIdType i, int) { return Value(lowest + Value(i % 5)); });
  trial::addColumns<TypeParam>(
    this->cloud_, "Same", 1, [](vtkIdType, int) { return Value(highest / 2 + 1); });
  this->resampler_->SetInputData(this->cloud_);
  this->resampler_->Update();
  const trial::Oracle oracle = trial::oracleOf(this->resampler_, this->cloud_);
  for (const char* name : { "Whole range", "Largest", "Smallest", "Same" })
  {
    trial::expectMeansAgree(this->cloud_->GetPointData()->GetArray(name),
      this->resampler_->GetOutput()->GetPointData()->GetArray(name), oracle);
  }
}

TEST_F(VoxelMeanAttributeAccuracy, TimesKeepTheirMicroseconds)
{
  trial::addColumns<vtkDoubleArray>(
    cloud_, "GpsTime", 1, [&](vtkIdType i, int) { return 3e8 + 1e-6 * double(i) + drawn(0, 1e-6); });
  expectMeans("GpsTime");
}

TEST_F(VoxelMeanAttributeAccuracy, ValuesOfPointsOutsideDoNotMatter)
{
  // The first half of the points is left out of the lattice, and their values are no numbers.
  resampler_->SetWorkspaceBounds(0.5, 1, 0, 1, 0, 1);
  trial::addColumns<vtkDoubleArray>(cloud_, "Heat", 1,
    [&](vtkIdType i, int)
    { return cloud_->GetPoint(i)[0] < 0.5 ? std::numeric_limits<double>::quiet_NaN() : drawn(0, 1); });
  expectMeans("Heat");
}

TEST_F(VoxelMeanAttributeAccuracy, ArraysTheDispatcherDoesNotKnow)
{
  const auto value = [&](vtkIdType i, int c) { return drawn(-1, 1) + double(c) + 1e-3 * double(i); };
  trial::addColumns<vtkSOADataArrayTemplate<float>>(cloud_, "SoaFloat", 3, value);
  trial::addColumns<vtkSOADataArrayTemplate<long long>>(
    cloud_, "SoaId", 1, [&](vtkIdType i, int) { return (std::int64_t(1) << 62) + 3 * std::int64_t(i); });
  trial::addColumns<trial::CountingArray>(cloud_, "Unknown", 2, value);
  expectMeans("SoaFloat");
  expectMeans("SoaId");
  expectMeans("Unknown");
}

TEST_F(VoxelMeanAttributeAccuracy, BitsAreRoundedToTheNearest)
{
  vtkNew<vtkBitArray> bits;
  bits->SetName("Bits");
  for (int i = 0; i < kAccuracyPoints; ++i)
  {
    bits->InsertNextValue(cloud_->GetPoint(i)[0] < 0.5 ? 1 : (i % 4 == 0));
  }
  cloud_->GetPointData()->AddArray(bits);
  resampler_->SetDimensions(2, 1, 1);
  vtkDataArray* out = averaged("Bits");
  ASSERT_NE(out, nullptr);
  ASSERT_EQ(out->GetNumberOfTuples(), 2);
  EXPECT_EQ(out->GetComponent(0, 0), 1.0);
  EXPECT_EQ(out->GetComponent(1, 0), 0.0);
}
