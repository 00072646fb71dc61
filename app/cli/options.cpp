#include "app/cli/options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

#include "app/files/paths.h"
#include "engine/core/error.h"
#include "engine/io/format.h"
#include "engine/io/pm_file.h"

namespace mesher::app {
namespace {

constexpr std::uint32_t kMaxSide = 16384;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::uint32_t parse_side(const std::string& option, const std::string& side,
                         const std::string& text) {
  const auto value = number(side);
  if (!value || *value < 1 || *value > kMaxSide || *value != std::floor(*value)) {
    throw UsageError(
        fmt::format("{}: '{}' is not N or WxH with sides from 1 to {}", option, text, kMaxSide));
  }
  return static_cast<std::uint32_t>(*value);
}

void apply_shading(render::Settings& settings, const LookOptions& look) {
  settings = look.settings;
  if (look.gouraud) settings.shading = render::Shading::gouraud;
  if (look.dark) settings.background = render::Background::dark;
  // Without surface and wireframe the picture would be empty.
  if (settings.shading == render::Shading::none) settings.wireframe = true;
}

}  // namespace

io::ReadOptions read_options(const InputOptions& input) {
  io::ReadOptions options{.crease_index_base = input.crease_index_base,
                          .keep_isolated_vertices = input.keep_isolated,
                          .weld = input.no_weld ? std::optional<double>() : input.weld_distance,
                          .keeps_scene = input.keeps_scene};
  if (input.animation) options.pose = {.animation = *input.animation, .time_s = input.time_s};
  return options;
}

void check_pose(const InputOptions& input) {
  if (!input.animation) return;
  const std::filesystem::path file = find_model(input.model);
  const io::FormatInfo* const format = io::format_of(file);
  if (io::is_pm_file(file) || (format != nullptr && !format->has_animations)) {
    throw UsageError("--animation: " + file.filename().string() + " has no animations");
  }
}

std::optional<std::vector<double>> parse_numbers(const std::string& text) {
  std::vector<double> values;
  for (const std::string& part : split(text, ',')) {
    const auto value = number(part);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

std::uint64_t parse_bytes(const std::string& option, const std::string& text) {
  constexpr std::pair<const char*, double> kUnits[] = {
      {"", 1.0},   {"B", 1.0},   {"kB", 1e3},     {"KB", 1e3},        {"MB", 1e6},
      {"GB", 1e9}, {"TB", 1e12}, {"KiB", 1024.0}, {"MiB", 1048576.0}, {"GiB", 1073741824.0}};
  const std::size_t end = text.find_first_not_of("0123456789.");
  const std::size_t unit = text.find_first_not_of(' ', end);
  const std::string word = unit == std::string::npos ? "" : text.substr(unit);
  const auto value = number(text.substr(0, end));
  for (const auto& [name, bytes] : kUnits) {
    constexpr double kMost = 1e18;
    if (word == name && value && *value * bytes >= 1.0 && *value * bytes <= kMost)
      return static_cast<std::uint64_t>(*value * bytes);
  }
  throw UsageError(fmt::format("{}: '{}' is not a size such as 512MB or 1.5GiB", option, text));
}

Size parse_size(const std::string& text, const std::string& option) {
  const std::vector<std::string> parts = split(text, 'x');
  if (parts.size() > 2) parse_side(option, "", text);
  const std::uint32_t width = parse_side(option, parts[0], text);
  return {width, parts.size() == 2 ? parse_side(option, parts[1], text) : width};
}

CameraAngles parse_camera(const std::string& text) {
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
  const std::vector<double> values = parse_numbers(text).value_or(std::vector<double>{});
  if (values.size() < 2 || values.size() > 3 ||
      (values.size() == 3 && !(values[2] >= 1e-3 && values[2] <= 1e3))) {
    throw UsageError("--camera: '" + text + "' is not YAW,PITCH or YAW,PITCH,ZOOM (0.001 to 1000)");
  }
  return {values[0] * kDegree, values[1] * kDegree, values.size() == 3 ? values[2] : 1.0};
}

void apply_look(View& view, const Box& box, const LookOptions& look) {
  apply_shading(view.settings, look);
  set_default_view(view.camera);
  double zoom = 1.0;
  if (look.view == "front") view.camera.set_view(render::View::front);
  if (look.view == "right") view.camera.set_view(render::View::right);
  if (look.view == "top") view.camera.set_view(render::View::top);
  if (!look.camera.empty()) {
    const CameraAngles angles = parse_camera(look.camera);
    view.camera.set_angles(angles.yaw_rad, angles.pitch_rad);
    zoom = angles.zoom;
  }
  view.camera.set_orthographic(look.orthographic);
  view.camera.frame(box, view.aspect());
  view.camera.zoom(zoom);
}

}  // namespace mesher::app
