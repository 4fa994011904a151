// What both forms of functions share.
#include "slvm/exec/plugin_call.h"

#include "slvm/exec/run.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace slvm {

std::vector<PluginOperand> plugin_operands(const GridCall& call) {
  const Signature& s = call.info.signature;
  std::vector<PluginOperand> list(static_cast<size_t>(s.param_count) + 1);
  size_t next = 0;
  list[0].what.type = s.result;
  list[0].what.uniform = s.uniform_result;
  if (s.result != Type::kVoid) list[0].to = &call.operands[next++];
  for (int i = 0; i < s.param_count; ++i) {
    list[static_cast<size_t>(i) + 1].what = s.param(i);
    if (s.param(i).output) list[static_cast<size_t>(i) + 1].to = &call.operands[next++];
  }
  for (int i = 0; i < s.param_count; ++i)
    list[static_cast<size_t>(i) + 1].from = &call.operands[next++];
  return list;
}

void keep_old_values(const GridCall& call, std::span<const PluginOperand> operands) {
  for (const PluginOperand& o : operands) {
    if (!o.to || o.to->array) continue; // arrays are stored to in place
    const size_t lanes = o.to->planes.step ? call.run.pitch : kMaxLanes;
    for (size_t c = 0; c < static_cast<size_t>(components(o.what.type)); ++c) {
      float* to = o.to->planes.plane(c);
      if (!o.from)
        std::fill_n(to, lanes, 0.0f); // a string: the empty one
      else if (o.from->planes.step && o.to->planes.step)
        std::memcpy(to, o.from->planes.plane(c), lanes * sizeof(float));
      else
        std::fill_n(to, lanes, o.from->planes.plane(c)[0]);
    }
  }
}

std::vector<uint32_t> active_points(const GridCall& call, std::span<const PluginOperand> operands) {
  std::vector<uint32_t> points;
  mask_for_each(call.run.mask.current(), call.run.points,
                [&](size_t point) { points.push_back(static_cast<uint32_t>(point)); });
  auto varies = [](const PluginOperand& o) {
    return (o.to && o.to->planes.step) || (o.from && o.from->planes.step);
  };
  if (!points.empty() && std::none_of(operands.begin(), operands.end(), varies))
    points.erase(points.begin() + 1, points.end());
  return points;
}

void call_plugin(const GridCall& call, HostedFunction& function) {
  const std::vector<PluginOperand> operands = plugin_operands(call);
  keep_old_values(call, operands);
  const std::vector<uint32_t> points = active_points(call, operands);
  if (points.empty()) return;
  PluginThread& thread = *call.run.state.plugins;
  std::string error = function.home->broken();
  if (error.empty()) error = thread.host().prepare(function);
  if (error.empty()) {
    std::unique_lock turn(function.home->turn, std::defer_lock);
    if (!function.entry.thread_safe) turn.lock();
    PluginContext& context = thread.context();
    context.call = &call;
    context.name = function.home->library->name();
    PluginHost::enter(*function.home, &context);
    const std::span<const PluginOperand> all(operands);
    switch (function.entry.form) {
    case PluginForm::kPointwise: error = call_by_point(call, function, all, points); break;
    case PluginForm::kGrid: error = call_by_grid(call, function, all, points); break;
    case PluginForm::kGridArray: error = call_by_grid(call, function, all.subspan(1), points); break;
    }
    PluginHost::enter(*function.home, nullptr);
    context.call = nullptr;
  }
  if (!error.empty())
    call.run.report(
        call.code, MessageSeverity::kError,
        fmt::format("'{}' of the plug-in {}: {}", call.info.name, function.home->library->name(), error),
        points.size());
}

} // namespace slvm
