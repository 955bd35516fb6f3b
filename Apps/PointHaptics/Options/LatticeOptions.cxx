#include "Options/LatticeOptions.h"

#include "Options/SettingOptions.h"

#include "Core/Base/Lattice.h"
#include "IO/Info/LengthUnit.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkMatrix4x4.h>
#include <vtkMatrixToLinearTransform.h>
#include <vtkNew.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace pointhaptics::app
{
namespace
{

using Numbers = std::vector<double>;

std::vector<std::pair<std::string, double>> units()
{
  std::vector<std::pair<std::string, double>> table;
  for (const NamedUnit& unit : kLengthUnits)
  {
    const bool isKnown = !table.empty() && table.back().first == unit.name;
    isKnown ? void() : void(table.emplace_back(unit.name, unit.metres));
  }
  return table;
}

double metresPer(const std::string& unit)
{
  for (const auto& entry : units())
  {
    if (entry.first == unit)
    {
      return entry.second;
    }
  }
  return 1.0;
}

std::string checkDimensions(const Numbers& numbers)
{
  for (const double n : numbers)
  {
    if (!(n >= 1.0 && n <= double(kMaximumLatticeDimension)) || n != std::floor(n))
    {
      return fmt::format(
        "voxels on an axis out of range; give whole numbers from 1 to {}", kMaximumLatticeDimension);
    }
  }
  return {};
}

std::string checkWorkspace(const Numbers& b)
{
  return b[0] < b[1] && b[2] < b[3] && b[4] < b[5]
    ? ""
    : "a maximum is not above its minimum; give x0,x1,y0,y1,z0,z1 with x0 < x1, y0 < y1, z0 < z1";
}

std::string checkScale(const Numbers& factors)
{
  const Vec3 s{ factors[0], factors[factors.size() == 3 ? 1 : 0], factors[factors.size() == 3 ? 2 : 0] };
  return AffineTransform::scaling(s).check() == Status::Ok
    ? ""
    : "the transform is singular; give factors that are not zero";
}

std::string checkRotation(const Numbers& r)
{
  return norm(Vec3{ r[1], r[2], r[3] }) > 0.0 ? ""
                                              : "the axis has no length; give DEGREES,x,y,z with an axis";
}

AffineTransform affineFrom(const Numbers& rows)
{
  AffineTransform transform;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      transform.m[row][column] = rows[static_cast<std::size_t>(4 * row + column)];
    }
  }
  return transform;
}

std::string checkMatrix(const Numbers& m)
{
  if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0)
  {
    return "not an affine matrix; the last row must be 0,0,0,1";
  }
  return affineFrom(m).check() == Status::Ok ? "" : "the matrix is singular; give one that can be inverted";
}

} // namespace

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, std::array<std::int64_t, 3>& dimensions)
{
  const auto keep = [&dimensions](const Numbers& n)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      dimensions[axis] = static_cast<std::int64_t>(n[n.size() == 3 ? axis : 0]);
    }
  };
  return addNumbers(command, row.option, keep, { 1, 3 }, checkDimensions, row.form, row.text);
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, Bounds& box)
{
  const auto keep = [&box](const Numbers& n) { box = { { n[0], n[2], n[4] }, { n[1], n[3], n[5] } }; };
  return addNumbers(command, row.option, keep, { 6 }, checkWorkspace, row.form, row.text);
}

void LatticeOptions::addTo(CLI::App& command)
{
  addSettings(command, this->voxels.lattice, kLatticeOptions, kLatticeGroup);
  CLI::Option* dims = command.get_option("--dims");
  CLI::Option* voxel = command.get_option("--voxel");
  for (CLI::Option* option : { dims, voxel })
  {
    option->each([this](const std::string&) { this->voxelsAreGiven = true; });
  }
  command.get_option("--workspace")
    ->each([this](const std::string&) { this->voxels.lattice.automaticWorkspace = false; });
  CLI::Option* scaling = addNumbers(
    command, "--scale", this->scale, { 1, 3 }, checkScale, "S|sx,sy,sz", "Scale the cloud, first of all");
  CLI::Option* rotation = addNumbers(command, "--rotate", this->rotate, { 4 }, checkRotation, "DEGREES,x,y,z",
    "Turn the cloud about an axis through the origin, after --scale");
  CLI::Option* shift = addNumbers(
    command, "--translate", this->translate, { 3 }, {}, "x,y,z", "Shift the cloud in metres, after --rotate");
  CLI::Option* affine = addNumbers(command, "--matrix", this->matrix, { 16 }, checkMatrix, "m00,m01,...,m33",
    "Affine 4x4 matrix, row by row, instead of --scale, --rotate and --translate");
  std::vector<std::string> names;
  for (const auto& entry : units())
  {
    names.push_back(entry.first);
  }
  CLI::Option* unitOption =
    addWord(command, "--unit", this->unit, names, "Unit of the file's coordinates; default m");
  voxel->excludes(dims);
  affine->excludes(scaling)->excludes(rotation)->excludes(shift);
  for (CLI::Option* option : { scaling, rotation, shift, affine, unitOption })
  {
    option->group(kLatticeGroup);
  }
}

void addPathUnits(CLI::App& command, PathUnits& pathUnits)
{
  const auto add = [&command](const char* name, const std::vector<std::pair<std::string, double>>& table,
                     double& value, const char* text)
  {
    std::vector<std::pair<std::string, int>> words;
    for (const auto& entry : table)
    {
      words.emplace_back(entry.first, int(words.size()));
    }
    addChoice(
      command, name, [&table, &value](int choice) { value = table[std::size_t(choice)].second; }, words,
      text);
  };
  static const std::vector<std::pair<std::string, double>> times = { { "s", 1.0 }, { "ms", 1e-3 },
    { "us", 1e-6 } };
  add("--path-unit", units(), pathUnits.metres, "Unit of the places in --path; default m");
  add("--path-time-unit", times, pathUnits.seconds, "Unit of the times in --path; default s");
}

UnitNames unitOptions()
{
  return { "--unit", "--path-unit", "--path-time-unit" };
}

double LatticeOptions::metresPerUnit() const
{
  return metresPer(this->unit);
}

AffineTransform LatticeOptions::transform() const
{
  const double metres = metresPer(this->unit);
  AffineTransform result = AffineTransform::scaling({ metres, metres, metres });
  if (!this->matrix.empty())
  {
    return affineFrom(this->matrix) * result;
  }
  if (this->scale.size() == 1)
  {
    result = AffineTransform::scaling({ this->scale[0], this->scale[0], this->scale[0] }) * result;
  }
  else if (this->scale.size() == 3)
  {
    result = AffineTransform::scaling({ this->scale[0], this->scale[1], this->scale[2] }) * result;
  }
  if (this->rotate.size() == 4)
  {
    result =
      AffineTransform::rotation(this->rotate[0], { this->rotate[1], this->rotate[2], this->rotate[3] }) *
      result;
  }
  if (this->translate.size() == 3)
  {
    result =
      AffineTransform::translation({ this->translate[0], this->translate[1], this->translate[2] }) * result;
  }
  return result;
}

bool LatticeOptions::hasTransform() const
{
  return !(this->scale.empty() && this->rotate.empty() && this->translate.empty() && this->matrix.empty()) ||
    this->unit != "m";
}

Bounds LatticeOptions::workspace() const
{
  return this->voxels.lattice.automaticWorkspace ? Bounds() : this->voxels.lattice.workspace;
}

void LatticeOptions::configure(vtkVoxelMeanResampler* resampler) const
{
  if (this->hasTransform())
  {
    vtkNew<vtkMatrix4x4> matrix4x4;
    setElements(matrix4x4, this->transform());
    vtkNew<vtkMatrixToLinearTransform> linear;
    linear->SetInput(matrix4x4);
    resampler->SetTransform(linear);
  }
  resampler->SetSettings(this->voxels);
}

} // namespace pointhaptics::app
