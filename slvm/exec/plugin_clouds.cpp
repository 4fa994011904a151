// Points that plug-ins write to files, and look up in them, one with each call.
#include "slvm/exec/plugin_call.h"
#include "slvm/exec/run.h"
#include "slvm/exec/spaces.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace slvm {
namespace {

std::optional<Type> channel_type(std::string_view name) {
  for (Type type : {Type::kFloat, Type::kColor, Type::kPoint, Type::kVector, Type::kNormal})
    if (name == type_name(type)) return type;
  return {};
}

/// The words of a token as a scene has it, "[class] type name"; the class says nothing here.
struct Token {
  std::string_view type, name;
};
Token split(std::string_view token) {
  const size_t end = token.find_last_not_of(' ');
  token = token.substr(0, end == token.npos ? 0 : end + 1);
  const size_t space = token.find_last_of(' ');
  if (space == token.npos) return {{}, token};
  std::string_view type = token.substr(0, token.find_last_not_of(' ', space) + 1);
  type.remove_prefix(type.find_last_of(' ') + 1);
  return {type, token.substr(space + 1)};
}

class CloudCall {
public:
  CloudCall(const GridCall& call, const AnemoneCloudPoint& asked) : call_(call), asked_(asked) {
    points_.file = asked.file;
  }

  /// "", or what is wrong. `found` is what the function returns.
  std::string run(bool& found) {
    PointCloudServices* clouds = call_.run.state.services.point_clouds();
    if (!clouds) return "this program has no files of points";
    if (std::string problem = read_tokens(); !problem.empty()) return problem;
    if (std::string problem = place(); !problem.empty()) return problem;
    if (asked_.write) {
      found = true;
      return clouds->bake(points_);
    }
    std::vector<char> near;
    std::string problem = clouds->look_up(points_, near);
    found = problem.empty() && near[0];
    if (found) give();
    return problem;
  }

private:
  std::string read_tokens() {
    for (int i = 0; i < asked_.tokens; ++i) {
      if (!asked_.token[i] || !asked_.value[i]) continue;
      const Token token = split(asked_.token[i]);
      if (token.name == "coordsystem") {
        if (const char* name = *static_cast<char* const*>(asked_.value[i])) space_ = name;
        continue;
      }
      const auto type = channel_type(token.type);
      if (!type)
        return fmt::format("\"{}\" needs a type in front of its name: float, color, point, vector or normal",
                           asked_.token[i]);
      CloudPoints::Channel channel{std::string(token.name), *type, {}};
      const float* value = static_cast<const float*>(asked_.value[i]);
      for (int c = 0; c < components(*type); ++c)
        channel.values[c] = {value[c]};
      points_.channels.push_back(std::move(channel));
      to_.push_back(static_cast<float*>(asked_.value[i]));
    }
    return {};
  }

  std::string place() {
    Matrix4 m;
    if (!named_space(call_.run, space_, false, m)) return fmt::format("there is no space \"{}\"", space_);
    const auto p = transform_point(m, {asked_.point[0], asked_.point[1], asked_.point[2]});
    std::array<float, 3> n{};
    if (asked_.normal) n = transform_normal(m, {asked_.normal[0], asked_.normal[1], asked_.normal[2]});
    for (size_t c = 0; c < 3; ++c) {
      points_.position[c] = {p[c]};
      points_.normal[c] = {n[c]};
    }
    points_.radius = {std::max(0.0f, asked_.radius) * std::cbrt(std::abs(determinant3(m)))};
    return {};
  }

  void give() const {
    for (size_t k = 0; k < to_.size(); ++k)
      for (int c = 0; c < components(points_.channels[k].type); ++c)
        to_[k][c] = points_.channels[k].values[c][0];
  }

  const GridCall& call_;
  const AnemoneCloudPoint& asked_;
  CloudPoints points_;
  std::string space_ = "world";
  std::vector<float*> to_; ///< where the channels' values come from, and go
};

} // namespace

int plugin_cloud_point(void* context, const AnemoneCloudPoint* asked) {
  const GridCall* call = call_of(context);
  if (!call || !asked->file || !*asked->file || !asked->point || asked->tokens < 0) return -1;
  bool found = false;
  const std::string problem = CloudCall(*call, *asked).run(found);
  if (problem.empty()) return found ? 0 : -1;
  call->run.report(call->code, MessageSeverity::kWarning,
                   fmt::format("{} of a plug-in, \"{}\": {}", asked->function, asked->file, problem), 1);
  return -1;
}

} // namespace slvm
