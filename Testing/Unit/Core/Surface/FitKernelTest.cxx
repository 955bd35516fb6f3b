// The loops of the fit against plain ones that add in the order that is promised, and against each other.
#include "Core/Surface/FitKernel.h"

#include "RandomClouds.h"

#include "Unit/HeldInstructionSets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>

using namespace pointhaptics;
using namespace pointhaptics::simd;

namespace
{

const std::vector<InstructionSet> kSets = heldInstructionSets();

/// Cells about a disc that sticks out of the radius 1, in an order that leaves whole groups outside.
void fill(trial::Random& random, int size, FitBlock& block)
{
  std::vector<Vec3> places;
  for (int i = 0; i < size; ++i)
  {
    places.push_back(random.inBox({ -1.3, -1.3, -0.2 }, { 1.3, 1.3, 0.2 }));
  }
  std::sort(places.begin(), places.end(), [](const Vec3& p, const Vec3& q) { return p.x < q.x; });
  block.size = size;
  for (int i = 0; i < size; ++i)
  {
    SymMat3 c;
    for (double* x : { &c.xx, &c.xy, &c.xz, &c.yy, &c.yz, &c.zz })
    {
      *x = random.uniform(-0.01, 0.01);
    }
    block.set(i, places[std::size_t(i)], 1.0 + double(random.below(9)), c);
  }
  for (int i = size; i % kFitLanes != 0; ++i)
  {
    block.clear(i);
  }
}

FitView randomView(trial::Random& random)
{
  FitView view;
  view.origin = random.inBox({ -0.2, -0.2, -0.05 }, { 0.2, 0.2, 0.05 });
  view.normal = normalized(random.inBox({ -0.2, -0.2, 1 }, { 0.2, 0.2, 1 }));
  view.a = anyPerpendicular(view.normal);
  view.b = cross(view.normal, view.a);
  view.radius = random.uniform(0.6, 1.0);
  view.blendWeight = random.uniform();
  view.gate = random.below(4) == 0 ? 0.0 : random.uniform(0.05, 0.4);
  view.twoSidedGate = random.below(3) == 0;
  for (double& bend : view.bend)
  {
    bend = random.uniform(-0.5, 0.5);
  }
  return view;
}

void fill(trial::Random& random, int size, FieldBlock& block)
{
  block.size = size;
  for (int i = 0; i < size; ++i)
  {
    const Vec3 p = random.inBox({ -1, -1, -1 }, { 1, 1, 1 });
    block.x[i] = p.x;
    block.y[i] = p.y;
    block.z[i] = p.z;
    block.present[i] = 1.0;
    for (double* values : { block.radius, block.gate, block.countRadius, block.proxyRadius, block.cubic })
    {
      values[i] = random.uniform();
    }
  }
  for (int i = size; i % kFitLanes != 0; ++i)
  {
    block.clear(i);
  }
}

/// All that a set's loops make of a block.
struct Answers
{
  FitRows rows;
  FitSums sums;
  CubicSums cubic;
  TraceSums trace;
  int within = 0;
  int indices[64];
  double swept = 0.0;
  FieldSums field;
};

struct Question
{
  FitBlock block;
  FieldBlock nodes;
  FitView view;
  TracedFit fit;
};

void answer(const FitKernels& kernels, const Question& question, Answers& answers)
{
  answers.rows.size = 0;
  kernels.appendRows(question.block, question.view, answers.rows);
  FitView coarse = question.view;
  coarse.blendWeight = 1.0 - coarse.blendWeight;
  kernels.appendRows(question.block, coarse, answers.rows);
  kernels.sumRows(answers.rows, answers.sums);
  kernels.sumCubicRows(answers.rows, answers.cubic);
  kernels.traceRows(answers.rows, question.fit, 0.1, -0.3, answers.trace);
  const int groups = (question.block.size + kFitLanes - 1) / kFitLanes * kFitLanes;
  const BallPoints points{ question.block.x, question.block.y, question.block.z, question.block.count,
    groups };
  const double radius = 0.3 * question.view.radius;
  std::fill(answers.indices, answers.indices + 64, -1);
  answers.within = kernels.pointsWithin(points, question.view.origin, radius * radius, answers.indices, 64);
  answers.swept =
    kernels.sweepBall(points, question.view.origin, question.view.normal, 2.0, radius, 1e-6 * radius);
  kernels.sumField(question.nodes, question.view.origin, question.view.radius, answers.field);
}

template <typename Sums>
bool areSameBits(const Sums& a, const Sums& b)
{
  return std::memcmp(&a, &b, sizeof(Sums)) == 0;
}

void expectSameBits(const Answers& found, const Answers& expected)
{
  ASSERT_EQ(found.rows.size, expected.rows.size);
  const auto arrays = [](const FitRows& r)
  {
    return std::vector<const double*>{ r.u, r.v, r.uu, r.uv, r.vv, r.height, r.weight, r.slopeWeight, r.e,
      r.can, r.cbn, r.count };
  };
  for (std::size_t i = 0; i < arrays(found.rows).size(); ++i)
  {
    const std::size_t bytes = sizeof(double) * std::size_t(found.rows.size);
    ASSERT_EQ(std::memcmp(arrays(found.rows)[i], arrays(expected.rows)[i], bytes), 0) << "array " << i;
  }
  ASSERT_TRUE(areSameBits(found.sums, expected.sums));
  ASSERT_TRUE(areSameBits(found.cubic, expected.cubic));
  ASSERT_TRUE(areSameBits(found.trace, expected.trace));
  ASSERT_EQ(found.within, expected.within);
  ASSERT_TRUE(std::equal(found.indices, found.indices + 64, expected.indices));
  ASSERT_EQ(found.swept, expected.swept);
  ASSERT_TRUE(areSameBits(found.field, expected.field));
}

/// The sum of term(i) for i below @p size in the order FitKernel.h promises.
template <typename Term>
double laneSum(int size, const Term& term)
{
  double v[kFitLanes] = {};
  for (int i = 0; i < size; ++i)
  {
    v[i % kFitLanes] += term(i);
  }
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

} // namespace

TEST(FitKernel, EverySetGivesTheSameBits)
{
  trial::Random random(1);
  const auto question = std::make_unique<Question>();
  const auto expected = std::make_unique<Answers>();
  const auto found = std::make_unique<Answers>();
  for (int i = 0; i < 2000; ++i)
  {
    SCOPED_TRACE(i);
    const std::size_t most = i % 20 == 0 ? FitBlock::kCapacity : 200;
    fill(random, int(random.below(most + 1)), question->block);
    fill(random, int(random.below(FieldBlock::kCapacity + 1)), question->nodes);
    question->view = randomView(random);
    for (double& k : question->fit.k)
    {
      k = random.uniform(-1, 1);
    }
    for (double& x : question->fit.row)
    {
      x = random.uniform(-1, 1);
    }
    answer(baselineFitKernels(), *question, *expected);
    for (const InstructionSet set : kSets)
    {
      answer(fitKernels(set), *question, *found);
      ASSERT_NO_FATAL_FAILURE(expectSameBits(*found, *expected)) << int(set);
    }
  }
}

TEST(FitKernel, SumsAreOfEightLanesJoinedInOneOrder)
{
  trial::Random random(2);
  const auto rows = std::make_unique<FitRows>();
  for (const int size : { 0, 8, 16, 24, 136, FitRows::kCapacity })
  {
    rows->size = size;
    for (double* values : { rows->u, rows->v, rows->uu, rows->uv, rows->vv, rows->height, rows->weight })
    {
      std::generate_n(values, size, [&] { return random.uniform(-1, 1); });
    }
    for (int i = 0; i < size; ++i)
    {
      rows->weight[i] = std::max(0.0, rows->weight[i]);
    }
    const double* const p[6] = { nullptr, rows->u, rows->v, rows->uu, rows->uv, rows->vv };
    for (const InstructionSet set : kSets)
    {
      SCOPED_TRACE(int(set));
      FitSums sums;
      fitKernels(set).sumRows(*rows, sums);
      for (int r = 0, at = 0; r < 6; ++r)
      {
        const auto wp = [&](int i) { return r == 0 ? rows->weight[i] : rows->weight[i] * p[r][i]; };
        ASSERT_EQ(sums.rhs[r], laneSum(size, [&](int i) { return wp(i) * rows->height[i]; })) << r;
        for (int c = 0; c <= r; ++c, ++at)
        {
          ASSERT_EQ(sums.a[at], laneSum(size, [&](int i) { return c == 0 ? wp(i) : wp(i) * p[c][i]; }))
            << r << ' ' << c;
        }
      }
      ASSERT_EQ(
        sums.zz, laneSum(size, [&](int i) { return rows->weight[i] * rows->height[i] * rows->height[i]; }));
      ASSERT_EQ(sums.cells, std::count_if(rows->weight, rows->weight + size, [](double w) { return w > 0; }));
    }
  }
}

TEST(FitKernel, GroupsBeyondTheRadiusAreLeftOut)
{
  const auto block = std::make_unique<FitBlock>();
  const auto rows = std::make_unique<FitRows>();
  block->size = 32;
  for (int i = 0; i < block->size; ++i)
  {
    // A group with its last cell inside, two outside, one on the edge.
    const bool inside = i == 7;
    block->set(i, Vec3(inside ? 0.5 : i < 24 ? 2.0 : 1.0, 0.0, 0.0), double(i + 1), SymMat3());
  }
  FitView view;
  view.a = { 1, 0, 0 };
  view.b = { 0, 1, 0 };
  view.normal = { 0, 0, 1 };
  view.radius = 1.0;
  for (const InstructionSet set : kSets)
  {
    rows->size = 0;
    fitKernels(set).appendRows(*block, view, *rows);
    ASSERT_EQ(rows->size, kFitLanes) << int(set);
    EXPECT_EQ(rows->count[7], 8.0);
    EXPECT_EQ(rows->weight[7], 8.0 * 0.75 * 0.75 * 0.75 * 0.75);
    EXPECT_EQ(std::count(rows->weight, rows->weight + kFitLanes, 0.0), kFitLanes - 1);
  }
}
