#include "ModelTransform.h"

#include <gtest/gtest.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include <cmath>

using pointhaptics::ModelTransform;
using pointhaptics::Vec3;

namespace
{

Vec3 mapped(const ModelTransform& model, const Vec3& point)
{
  Vec3 result;
  model.transform()->TransformPoint(&point.x, &result.x);
  return result;
}

} // namespace

TEST(ModelTransform, RotatesAndScalesAboutTheCentreOfTheWorkspace)
{
  ModelTransform model;
  const double bounds[6] = { 0.0, 0.2, 0.0, 0.1, 0.0, 0.1 };
  model.setWorkspaceBounds(bounds);
  EXPECT_EQ(model.edge(), 0.2);
  model.rotate(90.0, { 0.0, 0.0, 1.0 });
  EXPECT_LT(norm(mapped(model, { 0.1, 0.05, 0.05 }) - Vec3(0.1, 0.05, 0.05)), 1e-15);
  EXPECT_LT(norm(mapped(model, { 0.2, 0.05, 0.05 }) - Vec3(0.1, 0.15, 0.05)), 1e-15);
  model.scale(3.0);
  EXPECT_LT(norm(mapped(model, { 0.2, 0.05, 0.05 }) - Vec3(0.1, 0.35, 0.05)), 1e-15);
  model.translate({ 1.0, 2.0, 3.0 });
  EXPECT_LT(norm(mapped(model, { 0.1, 0.05, 0.05 }) - Vec3(1.1, 2.05, 3.05)), 1e-15);
}

TEST(ModelTransform, ReportsEachChangeAndNothingElse)
{
  ModelTransform model;
  int changes = 0;
  model.setObserver([&changes] { ++changes; });
  model.rotate(NAN, { 1, 0, 0 });
  model.rotate(10.0, { 0, 0, 0 });
  model.translate({ NAN, 0, 0 });
  model.scale(0.0);
  EXPECT_FALSE(model.undo());
  vtkNew<vtkMatrix4x4> matrix;
  model.adoptMatrix(matrix);
  EXPECT_EQ(changes, 0);
  model.translate({ 0.01, 0, 0 });
  model.reset();
  EXPECT_TRUE(model.undo());
  model.setMatrix(matrix);
  EXPECT_EQ(changes, 4);
}

TEST(ModelTransform, TakesBackAGestureAsAWholeAndOverlappingOnesTogether)
{
  ModelTransform model;
  const auto x = [&model] { return mapped(model, Vec3()).x; };
  model.translate({ 0.1, 0, 0 });
  model.beginGesture();
  model.translate({ 0.1, 0, 0 });
  model.beginGesture();
  model.translate({ 0.1, 0, 0 });
  model.endGesture();
  model.translate({ 0.1, 0, 0 });
  model.endGesture();
  model.translate({ 0.1, 0, 0 });
  EXPECT_DOUBLE_EQ(x(), 0.5);
  EXPECT_TRUE(model.undo());
  EXPECT_DOUBLE_EQ(x(), 0.4);
  EXPECT_TRUE(model.undo());
  EXPECT_DOUBLE_EQ(x(), 0.1);
  model.beginGesture();
  model.endGesture();
  EXPECT_TRUE(model.undo());
  EXPECT_FALSE(model.undo());
}

TEST(ModelTransform, KeepsTheLastHundredChanges)
{
  ModelTransform model;
  for (int i = 0; i < 150; ++i)
  {
    model.translate({ 0.01, 0, 0 });
  }
  int undone = 0;
  while (model.undo())
  {
    ++undone;
  }
  EXPECT_EQ(undone, 100);
  EXPECT_NEAR(mapped(model, Vec3()).x, 0.5, 1e-12);
}
