// The graphics state machine: receives requests, keeps options, attributes and transformations, and hands
// each world block over as a Scene. One member function per request; requests.def says which are legal where.
#pragma once

#include "render/prims/class_sizes.h"
#include "render/prims/motion.h"
#include "render/rib/ri_error.h"
#include "render/rib/ri_target.h"
#include "render/state/mesh_digest.h"
#include "render/state/plug_in.h"
#include "render/state/procedural.h"
#include "render/state/program.h"
#include "render/state/scene.h"
#include "slvm/support/diagnostics.h"

#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace render {

class BlobbyGround;
struct LeftOut;
struct SubdivisionMesh;

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
  bool wants_comments() const override { return static_cast<bool>(on_comment); }
  void comment(std::string_view text, slvm::SourceRange) override { on_comment(text); }

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
  /// Whether the frame of this number is wanted; what stands in others is not carried out. Null: all are.
  std::function<bool(int)> wants_frame;
  /// Requests archives and instances may repeat in all. A few levels that each read the next one ten times
  /// are harmless; a row of levels that each read the next one twice never ends.
  size_t most_replayed = 100'000'000;
  /// Surfaces in a world: their numbers are of 32 bits.
  size_t most_primitives = std::numeric_limits<uint32_t>::max();
  /// Whether RunProgram may run what a scene names.
  bool allow_programs = false;
  /// Whether it may run what requests name that do not come from a file: those of a C program.
  bool allow_own_programs = false;
  ProgramLimits program_limits;
  /// The only folders from which DynamicLoad loads plug-ins: those the user named, never a scene's.
  std::vector<std::string> procedural_folders;
  /// Called instead of a plug-in's functions, which are its second argument: it leads what they request here.
  std::function<void(slvm::SourceRange procedural, const std::function<void()>& functions)> around_plug_in;
  /// Comments of files read from now on, without the first #.
  std::function<void(std::string_view)> on_comment;
  /// What a procedural of the scene holds, given the pixels its bound covers. Only from within render_world;
  /// from any thread, one call at a time.
  SceneContent make_content(const Procedural&, float area);
  /// Directories "@" stands for in search paths, by kind of path.
  std::map<std::string, std::vector<std::string>> standard_paths;

  // For clients that make requests without a file, such as the C interface.
  const Declarations& declarations() const { return declarations_; }
  /// Of the basis that is current.
  BasisSteps basis_steps() const { return {attributes_->ubasis.step, attributes_->vbasis.step}; }
  bool in_world() const { return in_world_; }
  /// Whether requests become part of an object or archive instead of being carried out.
  bool recording() const { return recording_.depth > 0; }
  /// To camera space; nothing when no space has this name.
  std::optional<Matrix4> find_space(const std::string& name) const;
  /// A Procedural whose geometry comes from a function. Errors are reported like those of the request.
  void procedural(std::span<const float, 6> bound, std::shared_ptr<GeometryMaker>, slvm::SourceRange where);
  /// What kind of error was reported last; kNone when none was since the last call.
  RiError take_error_kind() { return std::exchange(error_kind_, RiError::kNone); }

private:
  enum class BlockKind : uint8_t { kFrame, kWorld, kAttribute, kTransform, kSolid, kMotion, kCondition };
  struct Block {
    BlockKind kind;
    slvm::SourceRange where;
    std::shared_ptr<Attributes> attributes;
    Matrix4 ctm;
    MotionMatrices motion;
    std::optional<Options> options;
    SolidPlace solid;
    // of conditions
    bool taken = false;       ///< one of its branches was
    bool last_branch = false; ///< Else has been seen
  };
  /// The motion block that is open.
  struct MotionBlock {
    std::vector<float> times;
    size_t calls = 0; ///< seen so far
    RequestId kind = RequestId::kCount;
    MotionMatrices before;     ///< the transformation at each time when the block began
    MotionMatrices transforms; ///< what the calls made of it
    size_t first_primitive = 0;
    std::vector<TimedValue<PrimitiveList>> shapes; ///< what the calls made, the first time from there on
  };
  /// Requests kept for ObjectInstance or ArchiveInstance.
  struct Recording {
    RequestId begin = RequestId::kCount, end = RequestId::kCount;
    std::string name;
    int depth = 0;
    std::shared_ptr<std::vector<RequestCall>> calls;
    slvm::SourceRange where;
  };
  using Handler = void (Interpreter::*)(const RequestCall&);
  static Handler handler(RequestId);

  // messages
  void error(const RequestCall&, std::string_view text, RiError kind = RiError::kConsistency);
  void error_at(slvm::SourceRange where, const RequestCall&, std::string_view text,
                RiError kind = RiError::kConsistency);
  void warn(const RequestCall&, std::string_view text);
  void warn_at(slvm::SourceRange, const RequestCall&, std::string_view text);
  /// One message for each key in a run.
  void warn_once(std::string key, slvm::SourceRange where, std::string_view name, std::string text);
  /// The value of a named parameter, checked. Nothing (reported): it cannot be used.
  std::optional<std::pair<std::string, slvm::Value>> named_value_of(const RequestCall&,
                                                                    std::string_view category, const Param&);
  /// Where a named value stands: the request whose table has it, the category there.
  struct ParameterPlace {
    RequestId table;
    std::string_view category;
    slvm::SourceRange where;
  };
  /// Says what a parameter lacks, once for each. False, with a message: its type is wrong.
  bool check_parameter(const RequestCall&, const ParameterPlace&, const std::string& name,
                       const slvm::Value&);
  void unknown_parameter(const ParameterPlace&, const std::string& name);
  /// Of a request that takes a parameter list and knows no names in it.
  void no_parameters(const RequestCall&);
  void no_parameter(const RequestCall&, const Param&);
  bool legal(const RequestCall&);
  bool skipped(const RequestCall&);
  bool in_unwanted_frame(const RequestCall&);
  bool record(const RequestCall&);
  void carry_out(const RequestCall&);
  bool stopped(const RequestCall&);
  bool nested_too_deep(const RequestCall&);
  void replay(const RequestCall&, const std::vector<RequestCall>& calls);
  bool replay_archive(const RequestCall&);
  bool replay_content(const RequestCall&);
  /// A copy whose strings hold the values of state variables; nothing when there are none in it.
  std::optional<RequestCall> substitute(const RequestCall&);
  std::optional<slvm::Value> state_variable(std::string_view name) const;
  bool condition_holds(const RequestCall&);

  // blocks
  void open(const RequestCall&, BlockKind);
  bool close(const RequestCall&, BlockKind);
  void frame_begin(const RequestCall&);
  void frame_end(const RequestCall&);
  /// The folders to look in, also those no search path names.
  std::vector<std::string> full_path(const Options&, const std::string& kind) const;
  void world_begin(const RequestCall&);
  void world_end(const RequestCall&);
  void attribute_begin(const RequestCall&);
  void attribute_end(const RequestCall&);
  void transform_begin(const RequestCall&);
  void transform_end(const RequestCall&);
  void solid_begin(const RequestCall&);
  void solid_end(const RequestCall&);
  void call_in_operation(const RequestCall&);
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
  void parse_text(std::string name, std::string text, bool keep);
  void read_archive_file(const std::string& name, slvm::SourceRange where, std::string_view request);
  void recording_end(const RequestCall&);
  void if_begin(const RequestCall&);
  void else_branch(const RequestCall&);
  void if_end(const RequestCall&);
  void declare(const RequestCall&);
  void version(const RequestCall&);
  void error_handler(const RequestCall&);
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
  void hider_parameter(const RequestCall&, const std::string& name, const slvm::Value& value);
  void depth_filter(const RequestCall&, const std::string& name);
  void option(const RequestCall&);
  void relative_detail(const RequestCall&);
  void search_path(const std::string& kind, const slvm::Value& value);
  void limit(const std::string& name, const slvm::Value& value);
  void make_request(const RequestCall&);

  // attributes
  void attribute(const RequestCall&);
  void attribute_parameter(const RequestCall&, const Param&, const std::string& name,
                           const slvm::Value& value);
  void dice_parameter(const std::string& name, float value);
  void geometric_approximation(const RequestCall&);
  void detail(const RequestCall&);
  void detail_range(const RequestCall&);
  void measure_detail();
  /// Whether the level of detail leaves anything of what follows.
  bool out_of_detail() const;
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

  // geometry
  void quadric(const RequestCall&);
  void polygon(const RequestCall&);
  void points_polygons(const RequestCall&);
  /// Adds what make() gives (null: nothing, reported), or what it gave for the same request before.
  void add_mesh(const RequestCall&, const std::function<std::shared_ptr<const Pieces>()>& make);
  /// Class sizes under the current basis. Nothing, with a message: the counts contradict each other.
  std::optional<ClassSizes> sizes_of(const RequestCall&);
  void patch(const RequestCall&);
  void geometry(const RequestCall&);
  void subdivision_mesh(const RequestCall&);
  bool subdivision_tags(const RequestCall&, size_t points, SubdivisionMesh&);
  void nu_patch(const RequestCall&);
  void curves(const RequestCall&);
  void points(const RequestCall&);
  void blobby(const RequestCall&);
  std::shared_ptr<const BlobbyGround> blobby_ground(const RequestCall&, int string);
  void trim_curve(const RequestCall&);
  /// Types and checks of the variables of a primitive; those with errors are left out.
  std::vector<TypedParam> primitive_vars(const RequestCall&, const ClassSizes&);
  /// `all_finite`: else points that are not finite may be among them.
  bool take_positions(const RequestCall&, std::vector<TypedParam>& vars, std::vector<Vec3>& P,
                      bool all_finite = true);
  void say_left_out(const RequestCall&, int argument, std::string_view element, const LeftOut&);
  std::shared_ptr<const PrimitiveState> primitive_state();
  /// Farthest a displacement moves a point, in camera space.
  float displacement_bound_of(const Attributes& attributes, const Matrix4& object_to_camera) const;
  void add_patch(std::shared_ptr<const Geometry>, std::span<const TypedParam> vars);

  // procedurals
  void procedural(const RequestCall&);
  void complete_early();
  void run(const Procedural&, float area);
  void run_program(const Procedural&, float area);
  void run_plug_in(const Procedural&, float area);
  void run_fragment(const Procedural&);
  Procedural* keep_procedural(const RequestCall&, std::span<const float> bound, slvm::SourceRange where);
  slvm::Result<std::unique_ptr<Program>> start_program(const Procedural&);
  void report(const Procedural&, std::string_view text);
  bool never_ends(const Procedural&, const std::string& what);

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
  SolidPlace solid_; ///< the innermost solid block
  std::vector<Block> blocks_;
  std::map<std::string, std::shared_ptr<const ShaderRequest>> lights_;
  std::map<std::string, Matrix4> spaces_;
  std::map<std::string, std::shared_ptr<std::vector<RequestCall>>> objects_, archives_;
  Recording recording_;
  /// Inline archives whose content came as data.
  struct Content {
    std::string type, data;
  };
  std::map<std::string, Content> contents_;
  Scene scene_;
  /// Meshes as long as they are in use, by what their requests say: instances share them.
  std::map<MeshDigest, std::weak_ptr<const Pieces>> meshes_;
  /// By name; null: it failed. What procedurals hold of a plug-in is gone before the plug-in is.
  std::map<std::string, std::shared_ptr<PlugIn>> plug_ins_;
  size_t procedurals_ = 0;                   ///< seen so far in the world block
  size_t repetitions_ = 0;                   ///< of them, carried out that came out of the same
  std::set<std::string> endless_;            ///< those that do not end by themselves
  std::shared_ptr<const Ancestry> ancestry_; ///< of what the procedural being carried out makes
  std::map<std::string, std::unique_ptr<Program>> programs_; ///< by command; null: it failed
  int procedural_depth_ = 0; ///< of the procedural being carried out; 0: none is
  bool in_world_ = false;
  int skip_depth_ = 0;   ///< > 0: in a branch that is not taken, so many conditions deep
  int depth_ = 0;        ///< of archives and instances
  int inline_depth_ = 0; ///< of inline archives among them
  size_t replayed_ = 0;  ///< requests that came from archives and instances
  bool stopped_ = false; ///< what follows is not carried out
  std::optional<slvm::SourceRange> unwanted_frame_; ///< where the frame begins that is left out
  enum class ErrorHandling : uint8_t { kIgnore, kPrint, kAbort };
  ErrorHandling error_handler_ = ErrorHandling::kPrint;
  RiError error_kind_ = RiError::kNone;
  RiTarget* reader_ = this;  ///< who gets the requests of texts
  std::string scene_folder_; ///< of the file given by the user
  std::string folder_;       ///< of the file being read
  /// Archives read so far, so that one read often is kept once. Encoded ones are not in it.
  std::map<std::string, slvm::FileId> archive_files_;
};

} // namespace render
