#include "CloudAppearance.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkSplatMapper.h"

#include "OffscreenWindow.h"
#include "Unit/SkipWithoutDisplay.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPropPicker.h>
#include <vtkProperty.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderedAreaPicker.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkTextActor.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace
{

constexpr int kSelectionSize = 200;
constexpr vtkIdType kColumns = 30;

enum class Cells
{
  OfOnePoint,
  Reversed,
  OneOfAll,
  None,
};

/// A wave of 30 x 30 points, 2 mm apart about the origin, 1 to 2 pixels free between their splats.
vtkSmartPointer<vtkPolyData> wave(Cells kind, bool isColored)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> lengths;
  vtkNew<vtkFloatArray> normals;
  vtkNew<vtkUnsignedCharArray> colors;
  lengths->SetName("Bandwidth");
  normals->SetName("SurfaceNormal");
  normals->SetNumberOfComponents(3);
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < kColumns * kColumns; ++i)
  {
    const double x = 0.002 * (double(i % kColumns) - 0.5 * kColumns);
    points->InsertNextPoint(x, 0.002 * (double(i / kColumns) - 0.5 * kColumns), 0.2 * x * x);
    lengths->InsertNextValue(0.0005F);
    normals->InsertNextTuple3(0, 0, 1);
    colors->InsertNextTuple3(double(8 * (i % kColumns)), double(8 * (i / kColumns)), 100);
  }
  vtkNew<vtkCellArray> vertices;
  if (kind == Cells::OneOfAll)
  {
    vertices->InsertNextCell(int(kColumns * kColumns));
  }
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    const vtkIdType point = kind == Cells::Reversed ? points->GetNumberOfPoints() - 1 - i : i;
    kind == Cells::OneOfAll ? vertices->InsertCellPoint(point)
                            : static_cast<void>(vertices->InsertNextCell(1, &point));
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->SetVerts(kind == Cells::None ? nullptr : vertices.Get());
  cloud->GetPointData()->AddArray(lengths);
  cloud->GetPointData()->AddArray(normals);
  if (isColored)
  {
    cloud->GetPointData()->SetScalars(colors);
  }
  return cloud;
}

/// A window of its own, with the actors of another where they are given.
struct SelectionWindow : pointhaptics::OffscreenWindow
{
  explicit SelectionWindow(vtkActor* actor, vtkCamera* camera = nullptr)
    : OffscreenWindow(kSelectionSize, kSelectionSize)
  {
    renderer->AddActor(actor);
    renderer->SetBackground(1, 1, 1);
    camera ? renderer->SetActiveCamera(camera) : renderer->ResetCamera();
  }

  /// Ids of points, or of cells, in a rectangle; both ends belong to it.
  std::set<vtkIdType> idsIn(unsigned first, unsigned last, int association)
  {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(renderer);
    selector->SetArea(first, first, last, last);
    selector->SetFieldAssociation(association);
    const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
    std::set<vtkIdType> ids;
    for (unsigned node = 0; node < selection->GetNumberOfNodes(); ++node)
    {
      auto* list = vtkIdTypeArray::SafeDownCast(selection->GetNode(node)->GetSelectionList());
      for (vtkIdType i = 0; list && i < list->GetNumberOfValues(); ++i)
      {
        ids.insert(list->GetValue(i));
      }
    }
    return ids;
  }
};

struct SplatActor
{
  SplatActor(vtkPolyData* input, bool surfaces, double opacity)
  {
    splats->SetInputData(input);
    splats->Settings().ambientLight = surfaces;
    splats->Settings().surfaces = surfaces;
    actor->SetMapper(splats);
    actor->GetProperty()->SetColor(0.1, 0.4, 0.7);
    actor->GetProperty()->SetOpacity(opacity);
  }

  vtkNew<vtkSplatMapper> splats;
  vtkNew<vtkActor> actor;
};

constexpr int kPoints = vtkDataObject::FIELD_ASSOCIATION_POINTS;
constexpr int kCells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// As VTK's own mapper: a pick or a selection is seen by nobody.
TEST(SplatSelection, PicksAndSelectionsLeaveThePictureAsItWas)
{
  SKIP_WITHOUT_DISPLAY();
  for (int variant = 0; variant < 32; ++variant)
  {
    const auto kind = static_cast<Cells>(variant % 4);
    const bool isColored = (variant & 4) != 0;
    const bool surfaces = (variant & 8) != 0;
    SCOPED_TRACE(variant);
    SplatActor cloud(wave(kind, isColored), surfaces, (variant & 16) != 0 ? 0.5 : 1.0);
    SelectionWindow view(cloud.actor);
    const std::vector<unsigned char> before = view.picture();
    ASSERT_GT(std::count_if(before.begin(), before.end(), [](unsigned char c) { return c < 250; }), 5000);
    int place = 100;
    while (before[std::size_t(3 * place * (kSelectionSize + 1))] == 255)
    {
      ++place;
    }
    vtkNew<vtkPropPicker> picker;
    EXPECT_TRUE(picker->Pick(place, place, 0, view.renderer));
    EXPECT_EQ(picker->GetActor(), cloud.actor);
    EXPECT_EQ(view.picture(), before) << "after a pick";
    EXPECT_FALSE(picker->Pick(2, 2, 0, view.renderer));
    EXPECT_EQ(view.picture(), before) << "after a pick beside it";
    for (int time = 0; time < 3; ++time)
    {
      const std::set<vtkIdType> ids = view.idsIn(0, kSelectionSize - 1, kPoints);
      EXPECT_EQ(ids.size(), std::size_t(kColumns * kColumns));
      EXPECT_EQ(*ids.rbegin(), kColumns * kColumns - 1);
      EXPECT_EQ(view.idsIn(0, kSelectionSize - 1, kCells).size(),
        std::size_t(kind == Cells::None || kind == Cells::OneOfAll ? 1 : kColumns * kColumns));
      EXPECT_EQ(view.picture(), before) << "after a selection";
    }
    cloud.splats->ReleaseGraphicsResources(view.window);
    EXPECT_EQ(view.picture(), before) << "after a release";
    {
      SelectionWindow other(cloud.actor, view.renderer->GetActiveCamera());
      EXPECT_EQ(other.picture(), before) << "in two windows";
      EXPECT_EQ(view.picture(), before) << "in two windows";
      EXPECT_EQ(other.idsIn(0, kSelectionSize - 1, kPoints).size(), std::size_t(kColumns * kColumns));
    }
    EXPECT_EQ(view.picture(), before) << "after the other window";
  }
}

/// The ids are those of the input, the same as of VTK's mapper, of points and of cells.
TEST(SplatSelection, IdsAreThoseOfTheInput)
{
  SKIP_WITHOUT_DISPLAY();
  for (const Cells kind : { Cells::OfOnePoint, Cells::Reversed, Cells::OneOfAll })
  {
    SplatActor cloud(wave(kind, true), false, 1.0);
    SelectionWindow view(cloud.actor);
    vtkNew<vtkPolyDataMapper> plain;
    plain->SetInputData(cloud.splats->GetInput());
    vtkNew<vtkActor> points;
    points->SetMapper(plain);
    SelectionWindow expected(points, view.renderer->GetActiveCamera());
    for (const int association : { kPoints, kCells })
    {
      for (unsigned place = 50; place < 150; place += 10)
      {
        for (const vtkIdType id : expected.idsIn(place, place + 9, association))
        {
          EXPECT_TRUE(view.idsIn(place, place + 9, association).count(id)) << id;
        }
      }
    }
    // Parts that are not drawn are not selected, and the others keep their ids.
    cloud.splats->SetRanges({ { 10, 20 }, { 300, 310 } });
    const std::set<vtkIdType> some = view.idsIn(0, kSelectionSize - 1, kCells);
    if (kind != Cells::OneOfAll)
    {
      EXPECT_EQ(some.size(), 20u);
      EXPECT_TRUE(some.count(10) && some.count(309) && !some.count(20));
    }
    EXPECT_EQ(view.idsIn(0, kSelectionSize - 1, kPoints).size(), 20u);
  }
}

/// Two splats, one behind the other.
TEST(SplatSelection, WhatIsHiddenIsNotSelected)
{
  SKIP_WITHOUT_DISPLAY();
  for (const bool isNearFirst : { true, false })
  {
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(0, 0, isNearFirst ? 0.01 : 0.0);
    points->InsertNextPoint(0, 0, isNearFirst ? 0.0 : 0.01);
    vtkNew<vtkPolyData> two;
    two->SetPoints(points);
    SplatActor cloud(two, false, 1.0);
    cloud.splats->Settings().fixedPixels = 30;
    SelectionWindow view(cloud.actor);
    view.renderer->ResetCamera(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
    EXPECT_EQ(view.idsIn(0, kSelectionSize - 1, kPoints), std::set<vtkIdType>{ isNearFirst ? 0 : 1 });
  }
}

TEST(SplatSelection, TranslucentSplatsAreDiscsWhereDepthsArePeeled)
{
  SKIP_WITHOUT_DISPLAY();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0.01);
  points->InsertNextPoint(0, 0, 0);
  vtkNew<vtkPolyData> two;
  two->SetPoints(points);
  SplatActor cloud(two, false, 0.5);
  cloud.actor->GetProperty()->SetColor(0, 0, 0);
  cloud.actor->GetProperty()->SetLighting(false);
  cloud.splats->Settings().fixedPixels = 60;
  SelectionWindow view(cloud.actor);
  view.renderer->ResetCamera(-0.05, 0.05, -0.05, 0.05, -0.05, 0.05);
  view.renderer->SetUseDepthPeeling(true);
  view.window->SetAlphaBitPlanes(1);
  const std::vector<unsigned char> seen = view.picture();
  const auto valueAt = [&](int x, int y) { return int(seen[std::size_t(3 * (y * kSelectionSize + x))]); };
  EXPECT_NEAR(valueAt(100, 100), 64, 3) << "both are seen";
  EXPECT_EQ(valueAt(124, 124), 255) << "no corner of a square";
}

/// vtkMapper::SetSelection shows what is selected.
TEST(SplatSelection, SelectedPointsAreShownInTheirColor)
{
  SKIP_WITHOUT_DISPLAY();
  SplatActor cloud(wave(Cells::OfOnePoint, false), false, 1.0);
  SelectionWindow view(cloud.actor);
  const std::vector<unsigned char> before = view.picture();
  vtkNew<vtkIdTypeArray> ids;
  ids->InsertNextValue(kColumns * kColumns / 2);
  vtkNew<vtkSelectionNode> node;
  node->SetFieldType(vtkSelectionNode::POINT);
  node->SetContentType(vtkSelectionNode::INDICES);
  node->SetSelectionList(ids);
  vtkNew<vtkSelection> selection;
  selection->AddNode(node);
  cloud.splats->SetSelection(selection);
  const std::vector<unsigned char> after = view.picture();
  std::size_t red = 0;
  for (std::size_t i = 0; i < after.size(); i += 3)
  {
    red += after[i] > 250 && after[i + 1] == 0 && after[i + 2] == 0;
  }
  EXPECT_GT(red, 5u);
  EXPECT_LT(red, 60u);
  EXPECT_EQ(view.picture(), after);
}

/// Key P of VTK's styles, on the cloud and beside it.
TEST(SplatSelection, KeyOfTheStylesLeavesThePictureAsItWas)
{
  SKIP_WITHOUT_DISPLAY();
  vtkNew<vtkInteractorStyleTrackballCamera> usual;
  vtkNew<vtkInteractorStyleHaptic> haptic;
  for (vtkInteractorStyle* style :
    { static_cast<vtkInteractorStyle*>(usual), static_cast<vtkInteractorStyle*>(haptic) })
  {
    SplatActor cloud(wave(Cells::OfOnePoint, true), false, 1.0);
    SelectionWindow view(cloud.actor);
    vtkNew<vtkRenderWindowInteractor> interactor;
    interactor->SetRenderWindow(view.window);
    interactor->SetInteractorStyle(style);
    interactor->Initialize();
    const std::vector<unsigned char> before = view.picture();
    for (const int place : { 100, 3, 100 })
    {
      interactor->SetEventInformation(place, place, 0, 0, 'p', 1, "p");
      interactor->InvokeEvent(vtkCommand::KeyPressEvent);
      interactor->InvokeEvent(vtkCommand::CharEvent);
      style->HighlightProp(nullptr); // the box about what was picked
      EXPECT_EQ(view.picture(), before) << style->GetClassName() << " at " << place;
    }
    interactor->SetInteractorStyle(nullptr);
  }
}

/// A renderer with a pass leaves the drawing of ids to the pass.
TEST(SplatSelection, PicksAndSelectionsFindSplatsThatAreShadedByDepth)
{
  SKIP_WITHOUT_DISPLAY();
  SplatActor cloud(wave(Cells::OfOnePoint, false), false, 1.0);
  SelectionWindow plain(cloud.actor);
  plain.window->Render();
  const std::set<vtkIdType> ids = plain.idsIn(90, 120, kPoints);
  ASSERT_GT(ids.size(), 10u);
  SelectionWindow view(cloud.actor, plain.renderer->GetActiveCamera());
  pointhaptics::applyDepthShading(view.renderer);
  vtkNew<vtkTextActor> text; // is drawn after the shading, and is not picked
  text->SetInput("over");
  text->SetPosition(90, 90);
  text->PickableOff();
  view.renderer->AddActor(text);
  const std::vector<unsigned char> before = view.picture();
  for (int time = 0; time < 2; ++time)
  {
    EXPECT_EQ(view.idsIn(90, 120, kPoints), ids);
    EXPECT_EQ(view.picture(), before) << "after a selection";
    vtkNew<vtkRenderedAreaPicker> picker;
    EXPECT_TRUE(picker->AreaPick(90, 90, 120, 120, view.renderer));
    EXPECT_EQ(picker->GetActor(), cloud.actor);
    EXPECT_EQ(view.picture(), before) << "after a pick";
  }
}

} // namespace
