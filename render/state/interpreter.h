// The graphics state machine: receives requests, keeps options, attributes and transformations, and hands
// each world block over as a Scene. One member function per request; requests.def says which are legal where.
#pragma once

#include "render/prims/motion.h"
#include "render/rib/ri_target.h"
#include "render/state/scene.h"
#include "slvm/support/diagnostics.h"

#include <functional>
#include <optional>
#include <set>

namespace render {

/// Values of each storage class a primitive takes (rib-reference: class sizes).
struct ClassSizes {
  size_t uniform = 1, varying = 4, vertex = 4, facevarying = 4;
};

/// Requests that change the current transformation.
bool is_transformation(RequestId);
/// Requests that make surfaces.
bool is_primitive(RequestId);

class Interpreter : public RiTarget {
public:
  /// Positions in diagnostics belong to `sources`, to which archives are added. `diagnostics` and `sources`
  /// must outlive the interpreter. `render_world` is called at each WorldEnd; the scene is its to keep or
  /// change.
  Interpreter(slvm::SourceManager& sources, slvm::Diagnostics& diagnostics,
              std::function<void(Scene&)> render_world);
  ~Interpreter() override;

  void request(const RequestCall& call) override;
  void unknown_request(std::string_view name, std::string_view suggestion, slvm::SourceRange where) override;

  /// Parses a file with the state as it is. False: it could not be read (reported).
  bool read_file(const std::string& name);
  /// The same for text at hand (standard input).
  void read_text(std::string name, std::string text);
  /// Reports blocks that were left open.
  void finish();

  /// The starting options; changes count until the file changes them.
  Options& options() { return options_; }
  /// Carries out a Make request with the options of the moment; "" or what is wrong.
  std::function<std::string(const RequestCall&, const Options&)> make_map;
  /// Called with the options at each WorldBegin: command-line overrides.
  std::function<void(Options&)> override_options;
  /// Directories "@" stands for in search paths, by kind of path.
  std::map<std::string, std::vector<std::string>> standard_paths;

private:
  enum class BlockKind : uint8_t { kFrame, kWorld, kAttribute, kTransform, kSolid, kMotion, kCondition };
  struct Block {
    BlockKind kind;
    slvm::SourceRange where;
    std::shared_ptr<Attributes> attributes;
    Matrix4 ctm;
    MotionMatrices motion;
    std::optional<Options> options;
  };
  /// The motion block that is open.
  struct MotionBlock {
    std::vector<float> times;
    size_t calls = 0; ///< seen so far
    RequestId kind = RequestId::kCount;
    MotionMatrices before;                      ///< the transformation at each time when the block began
    MotionMatrices transforms;                  ///< what the calls made of it
    size_t first_primitive = 0, primitives = 0; ///< of the first call
    std::vector<MotionShapes> shapes;           ///< of each of these
  };
  /// Requests kept for ObjectInstance or ArchiveInstance.
  struct Recording {
    RequestId begin = RequestId::kCount, end = RequestId::kCount;
    std::string name;
    int depth = 0;
    std::shared_ptr<std::vector<RequestCall>> calls;
  };
  using Handler = void (Interpreter::*)(const RequestCall&);
  static Handler handler(RequestId);

  // messages
  void error(const RequestCall&, std::string_view text);
  void error_at(slvm::SourceRange where, const RequestCall&, std::string_view text);
  void warn(const RequestCall&, std::string_view text);
  /// One message for each key in a run.
  void warn_once(std::string key, slvm::SourceRange where, std::string_view name, std::string text);
  bool legal(const RequestCall&);
  bool skipped(const RequestCall&);
  bool record(const RequestCall&);
  void replay(const RequestCall&, const std::vector<RequestCall>& calls);

  // blocks
  void open(const RequestCall&, BlockKind);
  bool close(const RequestCall&, BlockKind);
  void frame_begin(const RequestCall&);
  void frame_end(const RequestCall&);
  void world_begin(const RequestCall&);
  void world_end(const RequestCall&);
  void attribute_begin(const RequestCall&);
  void attribute_end(const RequestCall&);
  void transform_begin(const RequestCall&);
  void transform_end(const RequestCall&);
  void solid_begin(const RequestCall&);
  void solid_end(const RequestCall&);
  void motion_begin(const RequestCall&);
  void motion_end(const RequestCall&);
  bool moved_by_motion_block(const RequestCall&);
  void motion_transform(const RequestCall&, float time);
  void motion_shape(const RequestCall&, float time);
  void transform_request(const RequestCall&);
  void call_handler(const RequestCall&);
  MotionMatrices motion_keys() const;
  void object_begin(const RequestCall&);
  void object_instance(const RequestCall&);
  void archive_begin(const RequestCall&);
  void archive_instance(const RequestCall&);
  void read_archive(const RequestCall&);
  void recording_end(const RequestCall&);
  void if_begin(const RequestCall&);
  void else_branch(const RequestCall&);
  void if_end(const RequestCall&);
  void declare(const RequestCall&);
  void version(const RequestCall&);
  void accept(const RequestCall&);

  // options
  void format(const RequestCall&);
  void frame_aspect_ratio(const RequestCall&);
  void screen_window(const RequestCall&);
  void crop_window(const RequestCall&);
  void projection(const RequestCall&);
  void clipping(const RequestCall&);
  void clipping_plane(const RequestCall&);
  void shutter(const RequestCall&);
  void pixel_samples(const RequestCall&);
  void pixel_filter(const RequestCall&);
  void exposure(const RequestCall&);
  void imager(const RequestCall&);
  void quantize(const RequestCall&);
  void display(const RequestCall&);
  void display_channel(const RequestCall&);
  void depth_of_field(const RequestCall&);
  void hider(const RequestCall&);
  bool hider_parameter(const RequestCall&, const std::string& name, const slvm::Value& value);
  void option(const RequestCall&);
  void search_path(const RequestCall&);
  void limits(const RequestCall&);
  void make_request(const RequestCall&);

  // attributes
  void attribute(const RequestCall&);
  void displacement_bound(const RequestCall&);
  void color(const RequestCall&);
  void opacity(const RequestCall&);
  void texture_coordinates(const RequestCall&);
  void light_source(const RequestCall&);
  void illuminate(const RequestCall&);
  void shader(const RequestCall&);
  void shading_rate(const RequestCall&);
  void shading_interpolation(const RequestCall&);
  void matte(const RequestCall&);
  void orientation(const RequestCall&);
  void reverse_orientation(const RequestCall&);
  void sides(const RequestCall&);
  void basis(const RequestCall&);
  std::shared_ptr<ShaderRequest> make_shader(const RequestCall&);
  Attributes& edit();

  // transformations
  void identity(const RequestCall&);
  void transform(const RequestCall&);
  void concat_transform(const RequestCall&);
  void perspective(const RequestCall&);
  void translate(const RequestCall&);
  void rotate(const RequestCall&);
  void scale(const RequestCall&);
  void skew(const RequestCall&);
  void coordinate_system(const RequestCall&);
  void scoped_coordinate_system(const RequestCall&);
  void coord_sys_transform(const RequestCall&);
  std::optional<Matrix4> find_space(const std::string& name) const;

  // geometry
  void quadric(const RequestCall&);
  void polygon(const RequestCall&);
  void points_polygons(const RequestCall&);
  void patch(const RequestCall&);
  /// Types and checks of the variables of a primitive; those with errors are left out.
  std::vector<TypedParam> primitive_vars(const RequestCall&, const ClassSizes&);
  bool take_positions(const RequestCall&, std::vector<TypedParam>& vars, std::vector<Vec3>& P);
  std::shared_ptr<const PrimitiveState> primitive_state();
  void add_patch(std::shared_ptr<const Geometry>, std::span<const TypedParam> vars);

  slvm::SourceManager& sources_;
  slvm::Diagnostics& diagnostics_;
  std::function<void(Scene&)> render_world_;
  Declarations declarations_;
  std::set<std::string> warned_;

  Options options_;
  std::shared_ptr<Attributes> attributes_;
  Matrix4 ctm_;                 ///< to camera, when the shutter opens
  MotionMatrices motion_;       ///< the same at the times of motion blocks; empty: it stands still
  MotionMatrices world_motion_; ///< world to camera of a moving camera
  std::optional<MotionBlock> in_motion_;
  std::vector<Block> blocks_;
  std::map<std::string, std::shared_ptr<const ShaderRequest>> lights_;
  std::map<std::string, Matrix4> spaces_;
  std::map<std::string, std::shared_ptr<std::vector<RequestCall>>> objects_, archives_;
  Recording recording_;
  Scene scene_;
  bool in_world_ = false;
  int skip_depth_ = 0; ///< > 0: in a branch that is not taken, so many conditions deep
  int depth_ = 0;      ///< of archives and instances
};

} // namespace render
