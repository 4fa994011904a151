// The renderer as a whole: RIB in, image files out. PUBLIC; slrender is a command line around it.
//
//   slvm::SourceManager sources;
//   slvm::Diagnostics diagnostics;
//   render::Renderer renderer(sources, diagnostics);
//   renderer.read_file("scene.rib");      // every WorldEnd renders
//   renderer.finish();
//   fputs(format_diagnostics(diagnostics, sources).c_str(), stderr);
#pragma once

#include "render/shading/shader_loader.h"
#include "render/state/options.h"
#include "slvm/support/diagnostics.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace render {

struct FrameStatistics; // render/statistics.h
struct PhotonReport;    // render/photons/photon_tracer.h
class Interpreter;      // render/state/interpreter.h

struct RendererSettings {
  int threads = 0; ///< 0: all processors
  /// Whether scenes may run the programs they name (Procedural "RunProgram"), and how long these may be
  /// silent.
  bool allow_programs = false;
  double program_seconds = 60;
  /// Folders of plug-ins that shaders may call (slvm::MachineOptions::plugin_folders). Scenes add none.
  std::vector<std::string> plugin_folders;
  /// The only folders plug-ins that make geometry are loaded from (Procedural "DynamicLoad"), and what is
  /// called in place of their functions: see Interpreter::around_plug_in.
  std::vector<std::string> procedural_folders;
  std::function<void(slvm::SourceRange procedural, const std::function<void()>& functions)> around_plug_in;
  ShaderLoader shader_loader = load_compiled_shader;
  /// Interpreter::wants_frame.
  std::function<bool(int)> wants_frame;
  /// Called with each frame's options at WorldBegin, after the file's own: command-line overrides.
  std::function<void(Options&)> override_options;
  /// Called before and during a frame with the finished fraction; never from two threads at once.
  std::function<void(double)> progress;
  /// A PNG file that shows what is finished of a frame while it is rendered (display/preview.h). Empty: none.
  std::string preview;
  /// Called before each frame is rendered and after it is written: a chance to show messages early.
  std::function<void()> flush_messages;
  /// Called after each frame with what it cost.
  std::function<void(const FrameStatistics&)> statistics;
  /// Called after each frame of photons (Hider "photon"), instead, with what became of them.
  std::function<void(const PhotonReport&)> photons;
  /// Called after each frame with what plug-ins say of themselves, lines of text, if they do.
  std::function<void(std::string_view)> plugin_statistics;
  /// Output of printf in shaders.
  std::function<void(std::string_view)> print;
};

class Renderer {
public:
  /// Both must outlive the renderer. Files read are added to `sources`; all messages go to `diagnostics`.
  Renderer(slvm::SourceManager& sources, slvm::Diagnostics& diagnostics, RendererSettings settings = {});
  ~Renderer();

  /// Reads a RIB file with the state earlier ones left. False: it cannot be read (nothing is reported).
  bool read_file(const std::string& name);
  /// The same for text at hand; `name` is what messages call it.
  void read_text(std::string name, std::string text);
  /// Reports what the files left open.
  void finish();

  /// Starting values.
  Options& options();
  /// Takes requests that do not come from a file.
  Interpreter& interpreter();
  /// The search path of a kind ("shader", "archive"...) until a file sets one, and what "@" stands for in it.
  void set_standard_path(const std::string& kind, std::vector<std::string> directories);

  /// Image files written so far.
  const std::vector<std::string>& written() const;

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace render
