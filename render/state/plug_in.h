// Shared libraries that make geometry: Procedural "DynamicLoad" (RISpec 3.2 leaves it to the renderer; the
// three functions are those of PRMan). A scene never chooses what is loaded: only folders the user named
// count.
//
//   RtPointer ConvertParameters(char *parameters);     // what the other two get
//   RtVoid    Subdivide(RtPointer data, RtFloat detail);
//   RtVoid    Free(RtPointer data);
#pragma once

#include "slvm/support/result.h"
#include "slvm/support/shared_library.h"

#include <memory>
#include <string>
#include <vector>

namespace render {

class PlugIn {
public:
  /// Opens the file. The error names what is missing in it.
  static slvm::Result<std::shared_ptr<PlugIn>> open(const std::string& file);

  /// ConvertParameters, Subdivide and Free, which make requests by the C interface. Empty, or what went
  /// wrong.
  std::string make(std::string parameters, float detail) const;

private:
  explicit PlugIn(std::shared_ptr<const slvm::SharedLibrary> library) : library_(std::move(library)) {}

  std::shared_ptr<const slvm::SharedLibrary> library_;
  void* (*convert_parameters_)(char*) = nullptr;
  void (*subdivide_)(void*, float) = nullptr;
  void (*free_)(void*) = nullptr;
};

/// The plug-in `name`, with or without ".so", from one of the `trusted` folders. `others`, the scene's search
/// path, only serves the message when there is none.
slvm::Result<std::shared_ptr<PlugIn>> load_plug_in(const std::string& name,
                                                   const std::vector<std::string>& trusted,
                                                   const std::vector<std::string>& others);

} // namespace render
