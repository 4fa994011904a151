// Calls of functions in plug-ins: values from registers to what the two forms of functions get, and back.
#pragma once

#include "slvm/exec/grid_ops.h"
#include "slvm/exec/plugin_host.h"

namespace slvm {

/// Calls the function for the active points of the grid, or once where nothing that it reads or stores
/// varies. What goes wrong becomes a run-time message; results are then 0.
void call_plugin(const GridCall& call, HostedFunction& function);

/// What sdk/rx.h asks of the program.
const AnemonePluginServices& plugin_services();

// Parts of these services. `context`: a PluginContext; null outside of calls.
int plugin_lookup(void* context, const AnemoneLookup* lookup);
int plugin_texture_info(void* context, const char* map, const char* name, void* result, int length,
                        RxInfoType_t* type, int* count);
int plugin_cloud_point(void* context, const AnemoneCloudPoint* point);
int plugin_texels(void* context, const char* map, int channels, const int* channel, int level, int face,
                  float* result);
/// The call that is under way, or null.
const GridCall* call_of(void* context);
/// Stores the answer to a query as sdk/rx.h has it.
int give_value(const GridCall& call, const Value& value, void* result, int length, RxInfoType_t* type,
               int* count);

/// An argument as the call's operands have it: read from `from`, stored to `to`; either may be null.
struct PluginOperand {
  SignatureParam what;
  const GridOperand *from = nullptr, *to = nullptr;

  /// Whether the function sees one value for each point.
  bool varying() const {
    const GridOperand* o = to ? to : from;
    return !what.uniform && ((o && o->planes.step) || (from && from->planes.step));
  }
  uint32_t elements() const {
    const GridOperand* o = to ? to : from;
    return what.array && o ? o->planes.elements : 1;
  }
};

/// The result first (a void function's has neither side), then the parameters in order.
std::vector<PluginOperand> plugin_operands(const GridCall& call);
/// Where lanes keep what they had before: stored operands begin as what was read.
void keep_old_values(const GridCall& call, std::span<const PluginOperand> operands);
/// Points active in the call, in order: those of the mask, or (nothing varies) one.
std::vector<uint32_t> active_points(const GridCall& call, std::span<const PluginOperand> operands);

/// Form for form; an error, or "".
std::string call_by_point(const GridCall& call, HostedFunction& function,
                          std::span<const PluginOperand> operands, std::span<const uint32_t> points);
std::string call_by_grid(const GridCall& call, HostedFunction& function,
                         std::span<const PluginOperand> operands, std::span<const uint32_t> points);

} // namespace slvm
