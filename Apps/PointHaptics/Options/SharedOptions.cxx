#include "Options/SharedOptions.h"

#include "Options/Files.h"
#include "Options/SettingOptions.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "Core/Base/Lattice.h"
#include "IO/Info/LengthUnit.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkMatrix4x4.h>
#include <vtkMatrixToLinearTransform.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

namespace pointhaptics::app
{
namespace
{

using Numbers = std::vector<double>;

/// Adds an option for a unit of length, under any name that files have for it.
void addLengthUnit(CLI::App& command, const char* option, std::function<void(const NamedUnit&)> keep,
  const std::string& description)
{
  std::vector<std::string> names;
  for (const NamedUnit& each : kLengthUnits)
  {
    names.emplace_back(each.name);
  }
  const std::string form = fmt::format("{}", fmt::join(names, "|"));
  const auto store = [option, names = std::move(names), keep = std::move(keep)](const std::string& word)
  {
    const NamedUnit* known = findLengthUnit(word);
    keep(known ? *known : kLengthUnits[indexOfChoice(option, word, names)]);
  };
  command.add_option_function<std::string>(option, store, description)->type_name(form);
}

std::string checkDimensions(const Numbers& numbers)
{
  const auto isRight = [](double n)
  { return n >= 1.0 && n <= double(kMaximumLatticeDimension) && n == std::floor(n); };
  return std::all_of(numbers.begin(), numbers.end(), isRight)
    ? ""
    : fmt::format(
        "voxels on an axis out of range; give whole numbers from 1 to {}", kMaximumLatticeDimension);
}

std::string checkWorkspace(const Numbers& ends)
{
  return ends[0] < ends[1] && ends[2] < ends[3] && ends[4] < ends[5]
    ? ""
    : "a maximum is not above its minimum; give x0,x1,y0,y1,z0,z1 with x0 < x1, y0 < y1, z0 < z1";
}

std::string checkScale(const Numbers& s)
{
  return AffineTransform::scaling({ s.front(), s[s.size() / 2], s.back() }).check() == Status::Ok
    ? ""
    : "the transform is singular; give factors that are not zero";
}

std::string checkRotation(const Numbers& r)
{
  return norm(Vec3{ r[1], r[2], r[3] }) > 0.0 ? ""
                                              : "the axis has no length; give DEGREES,x,y,z with an axis";
}

std::string checkMatrix(const Numbers& m)
{
  if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0)
  {
    return "not an affine matrix; the last row must be 0,0,0,1";
  }
  return AffineTransform::fromRows(m.data()).check() == Status::Ok
    ? ""
    : "the matrix is singular; give one that can be inverted";
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
  return addNumbers(command, row.name, keep, { 1, 3 }, checkDimensions, row.form, row.help);
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, Bounds& box)
{
  const auto keep = [&box](const Numbers& n) { box = { { n[0], n[2], n[4] }, { n[1], n[3], n[5] } }; };
  return addNumbers(command, row.name, keep, { 6 }, checkWorkspace, row.form, row.help);
}

void LatticeOptions::addTo(CLI::App& command)
{
  addSettings(command, this->voxels.lattice, kLatticeGroup);
  CLI::Option* dims = command.get_option("--dims");
  CLI::Option* voxel = command.get_option("--voxel");
  for (CLI::Option* option : { dims, voxel })
  {
    option->each([this](const std::string&) { this->voxelsAreGiven = true; });
  }
  command.get_option("--workspace")
    ->each([this](const std::string&) { this->voxels.lattice.automaticWorkspace = false; });
  const OptionGroup group(command, kLatticeGroup);
  CLI::Option* scaling = addNumbers(
    command, "--scale", this->scale, { 1, 3 }, checkScale, "S|sx,sy,sz", "Scale the cloud, first of all");
  CLI::Option* rotation = addNumbers(command, "--rotate", this->rotate, { 4 }, checkRotation, "DEGREES,x,y,z",
    "Turn the cloud about an axis through the origin, after --scale");
  CLI::Option* shift = addNumbers(
    command, "--translate", this->translate, { 3 }, {}, "x,y,z", "Shift the cloud in metres, after --rotate");
  CLI::Option* affine = addNumbers(command, "--matrix", this->matrix, { 16 }, checkMatrix, "m00,m01,...,m33",
    "Affine 4x4 matrix, row by row, instead of --scale, --rotate and --translate");
  addUnit(command, this->unit);
  voxel->excludes(dims);
  affine->excludes(scaling)->excludes(rotation)->excludes(shift);
}

void addUnit(CLI::App& command, std::string& unit)
{
  addLengthUnit(
    command, "--unit", [&unit](const NamedUnit& each) { unit = each.name; },
    "Unit of the file's coordinates, which become metres; default m");
}

void addPathUnits(CLI::App& command, PathUnits& pathUnits)
{
  addLengthUnit(
    command, "--path-unit", [&pathUnits](const NamedUnit& each) { pathUnits.metres = each.metres; },
    "Unit of the places in --path; default m");
  addChoice(command, "--path-time-unit", pathUnits.seconds, { { "s", 1.0 }, { "ms", 1e-3 }, { "us", 1e-6 } },
    "Unit of the times in --path; default s");
}

UnitNames unitOptions()
{
  return { "--unit", "--path-unit", "--path-time-unit" };
}

double LatticeOptions::metresPerUnit() const
{
  return findLengthUnit(this->unit)->metres;
}

AffineTransform LatticeOptions::transform() const
{
  const double metres = this->metresPerUnit();
  AffineTransform result = AffineTransform::scaling({ metres, metres, metres });
  if (!this->matrix.empty())
  {
    return AffineTransform::fromRows(this->matrix.data()) * result;
  }
  const std::vector<double>& s = this->scale;
  if (!s.empty())
  {
    result = AffineTransform::scaling({ s.front(), s[s.size() / 2], s.back() }) * result;
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

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, BandwidthRule& rule)
{
  return addChoice(command, row.name, rule,
    { { "normal-reference", BandwidthRule::NormalReference },
      { "silverman-robust", BandwidthRule::SilvermanRobust }, { "scott", BandwidthRule::ScottMultivariate },
      { "silverman", BandwidthRule::SilvermanMultivariate },
      { "sheather-jones", BandwidthRule::SheatherJones } },
    row.help);
}

void BandwidthOptions::addTo(CLI::App& command)
{
  addSettings(command, this->settings, kBandwidthGroup);
  CLI::Option* nearest = command.get_option("--neighbors");
  CLI::Option* ball = command.get_option("--radius");
  nearest->each([this](const std::string&) { this->settings.fixedRadius = false; });
  ball->each([this](const std::string&) { this->settings.fixedRadius = true; });
  ball->excludes(nearest);
  // Options are processed in the order they were added: r1 is known here.
  command.get_option("--r2")->each(
    [this](const std::string& text)
    {
      double value = 0.0;
      if (parseNumber(text, value) && value < this->settings.minimumRadius)
      {
        throw CLI::ValidationError(
          fmt::format("{} is below --r1 {}; give r1 <= r2", value, this->settings.minimumRadius));
      }
    });
}

const std::vector<std::pair<std::string, ProxyMethod>>& proxyMethods()
{
  static const std::vector<std::pair<std::string, ProxyMethod>> methods = {
    { "surface-fit", ProxyMethod::SurfaceFit },
    { "sphere", ProxyMethod::Sphere },
    { "gradient-steps", ProxyMethod::GradientSteps },
  };
  return methods;
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, ProxyMethod& method)
{
  return addChoice(command, row.name, method, proxyMethods(), row.help);
}

CLI::Option* addSetting(CLI::App& command, const SettingOption& row, GradientStepsParameters& steps)
{
  return addChoice(command, row.name, steps,
    { { "tuned", GradientStepsParameters::tuned() }, { "paper", GradientStepsParameters::paper() } },
    row.help);
}

void TouchOptions::addTo(CLI::App& command)
{
  addSettings(command, this->parameters, kTouchGroup);
  addSettings(command, this->parameters.contact, kTouchGroup);
}

void TouchOptions::complete(const CLI::App& command)
{
  if (command.count("--preset") > 0 && this->parameters.method != ProxyMethod::GradientSteps)
  {
    warn("--preset has no effect on --method surface-fit; give --method gradient-steps too, or leave it out");
  }
  ContactParameters& contact = this->parameters.contact;
  if (command.count("--mu-s") == 0)
  {
    contact.staticFriction = contact.dynamicFriction;
  }
  requireUsage(contact.dynamicFriction <= contact.staticFriction, "--mu-d",
    fmt::format("{}", contact.dynamicFriction),
    fmt::format("above --mu-s {}; give mu_d <= mu_s", contact.staticFriction));
}

void checkForceLimitOfDevices(const ContactParameters& contact, const std::string& cure)
{
  const double most = ForceLimits().maximumForce;
  requireUsage(contact.forceLimit <= most, "--force-limit", fmt::format("{}", contact.forceLimit),
    fmt::format("a servo loop pushes a hand with at most {} N; give that or less{}", most, cure));
}

void setContact(nlohmann::ordered_json& settings, const ContactParameters& contact)
{
  const auto set = [&](const char* option, double member)
  {
    if (option)
    {
      nlohmann::ordered_json& setting = settings[std::string(option).substr(2)];
      setting = std::isfinite(member) ? nlohmann::ordered_json(member) : nlohmann::ordered_json("inf");
    }
  };
  std::apply([&](const auto&... member) { (set(member.option.name, contact.*(member.pointer)), ...); },
    ContactParameters::members());
}

void FalconOptions::addTo(CLI::App& command)
{
  addInput(command, "--falcon-firmware", this->firmware,
    "Firmware of the Falcon, from Novint's own driver; default: what POINTHAPTICS_FALCON_FIRMWARE names")
    ->type_name("FILE");
  addNumber(command, "--max-force", this->maximumForce, { 0.0, ForceLimits().maximumForce, true }, "N",
    "Largest force, of the Falcon and of all else that is felt, as --force-limit; default: 4 of the Falcon");
}

void FalconOptions::complete(const CLI::App& command, ContactParameters& contact) const
{
  contact.forceLimit =
    command.count("--max-force") > 0 ? std::min(contact.forceLimit, this->maximumForce) : contact.forceLimit;
}

FalconSettings FalconOptions::settings() const
{
  FalconSettings result;
  result.firmwareFile = this->firmware;
  result.limits.maximumForce = this->maximumForce;
  result.cancelled = stopIsRequested;
  return result;
}

} // namespace pointhaptics::app
