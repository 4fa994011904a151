// .slo files: header, hash, FlatBuffer; and the conversion between the FlatBuffer and Program.
#include "slvm/format/slo.h"

#include "slvm/format/slo_generated.h"
#include "slvm/format/verify.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>

namespace slvm {
namespace {

static_assert(std::endian::native == std::endian::little, "files are little-endian and read in place");

constexpr char kMagic[7] = {'A', 'N', 'E', 'M', 'S', 'L', 'O'};
constexpr size_t kHeaderBytes = 16;

// ---- Program to FlatBuffer.

class Writer {
public:
  std::vector<std::byte> write(const Program& p) {
    auto root = shader(p);
    b_.Finish(root);
    std::vector<std::byte> out(kHeaderBytes + b_.GetSize());
    std::memcpy(out.data(), kMagic, sizeof kMagic);
    out[7] = std::byte{kSloVersion};
    std::memcpy(out.data() + kHeaderBytes, b_.GetBufferPointer(), b_.GetSize());
    uint64_t hash = hash_bytes(std::span(out).subspan(kHeaderBytes));
    std::memcpy(out.data() + 8, &hash, sizeof hash);
    return out;
  }

private:
  template <class T, class F> auto tables(const std::vector<T>& list, F&& make) {
    std::vector<decltype(make(list[0]))> offsets;
    for (const T& item : list)
      offsets.push_back(make(item));
    return b_.CreateVector(offsets);
  }
  auto strings(const std::vector<std::string>& list) { return b_.CreateVectorOfStrings(list); }

  flatbuffers::Offset<fb::Value> value(const Value& v) {
    auto numbers = b_.CreateVector(v.numbers);
    auto texts = strings(v.strings);
    return fb::CreateValue(b_, static_cast<uint8_t>(v.type), v.elements, numbers, texts);
  }
  flatbuffers::Offset<fb::Param> param(const Param& p) {
    auto name = b_.CreateString(p.name);
    auto default_value = value(p.default_value);
    auto space = b_.CreateString(p.default_space);
    return fb::CreateParam(b_, name, static_cast<uint8_t>(p.type), p.elements, p.varying, p.output,
                           p.default_known, default_value, space, p.slot, p.init);
  }
  flatbuffers::Offset<fb::Slot> slot(const Slot& s) {
    return fb::CreateSlot(b_, b_.CreateString(s.name), static_cast<uint8_t>(s.type), s.elements, s.parameter,
                          s.varying, s.stored);
  }
  flatbuffers::Offset<fb::Import> import(const Program& p, ShadeopId id) {
    const ShadeopInfo& info = p.plugins.info(id);
    auto name = b_.CreateString(std::string(info.name));
    auto signature = b_.CreateString(std::string(info.signature_text));
    const PluginShadeop* function = p.plugins.find(id);
    if (!function) return fb::CreateImport(b_, name, signature);
    auto at = std::find(libraries_.begin(), libraries_.end(), function->name().library);
    const auto library = static_cast<uint32_t>(at - libraries_.begin()) + 1;
    return fb::CreateImport(b_, name, signature, library, static_cast<uint8_t>(function->name().form));
  }
  flatbuffers::Offset<fb::Annotation> annotation(const Annotation& a) {
    auto id = b_.CreateString(a.id);
    auto text = b_.CreateString(a.text);
    return fb::CreateAnnotation(b_, id, text);
  }
  flatbuffers::Offset<fb::Facts> facts(const Program& p) {
    const Facts& f = p.facts;
    auto messages = strings(f.messages_read);
    auto textures = strings(f.texture_names);
    auto shadeop_names = strings(f.shadeops);
    auto plugins = strings(f.plugins);
    std::vector<ShadeopId> called;
    std::vector<fb::SourceCall> call_list;
    for (const SourceCall& c : f.calls) {
      auto row = std::find(called.begin(), called.end(), c.shadeop);
      call_list.emplace_back(static_cast<uint32_t>(row - called.begin()), c.file, c.line, c.column);
      if (row == called.end()) called.push_back(c.shadeop);
    }
    auto called_rows = tables(called, [&](ShadeopId id) { return import(p, id); });
    auto calls = b_.CreateVectorOfStructs(call_list);
    return fb::CreateFacts(b_, f.derivatives, f.lights, f.textures, f.rays, messages, textures, shadeop_names,
                           plugins, called_rows, calls);
  }

  flatbuffers::Offset<fb::Shader> shader(const Program& p) {
    auto name = b_.CreateString(p.name);
    auto source = b_.CreateString(p.source_name);
    auto annotations = tables(p.annotations, [&](const Annotation& a) { return annotation(a); });
    auto params = tables(p.params, [&](const Param& x) { return param(x); });
    libraries_ = p.plugins.libraries();
    auto fact_table = facts(p);
    auto imports = tables(p.imports, [&](ShadeopId id) { return import(p, id); });
    auto slots = tables(p.slots, [&](const Slot& s) { return slot(s); });
    auto constants = b_.CreateVector(p.constants);
    auto texts = strings(p.strings);
    std::vector<fb::StringConstant> string_list;
    for (auto [plane, text] : p.string_constants)
      string_list.emplace_back(plane, text);
    auto string_constants = b_.CreateVectorOfStructs(string_list);
    std::vector<fb::Array> array_list;
    for (const ArrayInfo& a : p.arrays)
      array_list.emplace_back(a.elements, a.index, static_cast<uint8_t>(a.type),
                              static_cast<uint8_t>(a.space));
    auto arrays = b_.CreateVectorOfStructs(array_list);
    auto code = b_.CreateVector(p.code);
    auto sections = b_.CreateVector(p.sections);
    auto files = strings(p.files);
    std::vector<fb::Line> line_list;
    for (const LineEntry& l : p.lines)
      line_list.emplace_back(l.code, l.file, l.line, l.column);
    auto lines = b_.CreateVectorOfStructs(line_list);
    auto ir = b_.CreateVector(p.ir);
    auto sources = tables(p.sources, [&](const SourceFile& s) {
      return fb::CreateSourceFile(b_, b_.CreateString(s.name), s.hash);
    });
    auto compiler = b_.CreateString(p.compiler);
    auto libraries = strings(libraries_);
    return fb::CreateShader(b_, static_cast<uint8_t>(p.kind), name, source, p.source_hash, annotations,
                            params, fact_table, imports, slots, constants, texts, string_constants, arrays,
                            p.uniform_planes, p.strip_planes, p.grid_planes, p.mask_depth, code, sections,
                            files, lines, ir, sources, compiler, libraries);
  }

  flatbuffers::FlatBufferBuilder b_;
  std::vector<std::string> libraries_; // of the plug-ins called
};

// ---- FlatBuffer to Program. Numbers that become enums are checked here, everything else in verify_program.

bool read_type(uint8_t raw, Type& out) {
  out = static_cast<Type>(raw);
  return raw < kTypeCount;
}

std::vector<std::string>
read_strings(const flatbuffers::Vector<flatbuffers::Offset<flatbuffers::String>>* list) {
  std::vector<std::string> out;
  if (list)
    for (const auto* s : *list)
      out.push_back(s->str());
  return out;
}

template <class T> std::vector<T> read_numbers(const flatbuffers::Vector<T>* list) {
  return list ? std::vector<T>(list->begin(), list->end()) : std::vector<T>();
}

const char* read_param(const fb::Param& in, Param& out) {
  out.name = in.name()->str();
  out.elements = in.elements();
  out.varying = in.varying();
  out.output = in.output();
  out.default_known = in.default_known();
  out.default_space = in.default_space()->str();
  out.slot = in.slot();
  out.init = in.init();
  const fb::Value& v = *in.default_value();
  out.default_value.elements = v.elements();
  out.default_value.numbers = read_numbers(v.numbers());
  out.default_value.strings = read_strings(v.strings());
  if (!read_type(in.type(), out.type) || !read_type(v.type(), out.default_value.type))
    return "a parameter of no known type";
  return nullptr;
}

// The id of an import, which `plugins` takes up when it is a function of one; nullopt: there is no such.
std::optional<ShadeopId> read_import(const fb::Import& i, const fb::Shader& in, PluginShadeops& plugins) {
  if (i.plugin() == 0) {
    int id = find_shadeop(i.name()->string_view(), i.signature()->string_view());
    return id < 0 ? std::nullopt : std::optional(static_cast<ShadeopId>(id));
  }
  if (!in.plugin_libraries() || i.plugin() > in.plugin_libraries()->size() || i.form() >= kPluginFormCount)
    return std::nullopt;
  auto function = PluginShadeop::make({i.name()->str(), i.signature()->str(),
                                       in.plugin_libraries()->Get(i.plugin() - 1)->str(),
                                       static_cast<PluginForm>(i.form())});
  return function ? plugins.add(std::move(function)) : std::nullopt;
}

// Calls of built-ins that this version does not have are left out: they are for introspection only.
const char* read_calls(const fb::Facts& in, const fb::Shader& shader, Program& p) {
  std::vector<SourceCall>& out = p.facts.calls;
  if (!in.called() || !in.calls()) return nullptr;
  for (const fb::SourceCall* c : *in.calls()) {
    if (c->row() >= in.called()->size()) return "a call of no known function";
    std::optional<ShadeopId> id = read_import(*in.called()->Get(c->row()), shader, p.plugins);
    if (id) out.push_back({*id, c->file(), c->line(), c->column()});
  }
  return nullptr;
}

const char* read_shader(const fb::Shader& in, Program& p) {
  if (in.kind() >= kShaderKindCount) return "no known kind of shader";
  p.kind = static_cast<ShaderKind>(in.kind());
  p.name = in.name()->str();
  p.source_name = in.source_name()->str();
  p.source_hash = in.source_hash();
  for (const fb::Annotation* a : *in.annotations())
    p.annotations.push_back({a->id()->str(), a->text()->str()});
  for (const fb::Param* param : *in.params())
    if (const char* error = read_param(*param, p.params.emplace_back())) return error;
  const fb::Facts& f = *in.facts();
  p.facts = {f.derivatives(),
             f.lights(),
             f.textures(),
             f.rays(),
             read_strings(f.messages_read()),
             read_strings(f.texture_names()),
             read_strings(f.shadeops()),
             read_strings(f.plugins()),
             {}};
  if (const char* error = read_calls(f, in, p)) return error;
  for (const fb::Slot* s : *in.slots()) {
    Slot& slot = p.slots.emplace_back();
    slot = {s->name()->str(), Type::kFloat, s->elements(), s->parameter(), s->varying(), s->stored()};
    if (!read_type(s->type(), slot.type)) return "an external variable of no known type";
  }
  p.constants = read_numbers(in.constants());
  p.strings = read_strings(in.strings());
  for (const fb::StringConstant* s : *in.string_constants())
    p.string_constants.emplace_back(s->plane(), s->text());
  for (const fb::Array* a : *in.arrays()) {
    ArrayInfo& array = p.arrays.emplace_back();
    if (a->space() >= kSpaceCount || !read_type(a->type(), array.type)) return "an array of no known type";
    array.elements = a->elements();
    array.space = static_cast<Space>(a->space());
    array.index = a->index();
  }
  p.uniform_planes = in.uniform_planes();
  p.strip_planes = in.strip_planes();
  p.grid_planes = in.grid_planes();
  p.mask_depth = in.mask_depth();
  p.code = read_numbers(in.code());
  p.sections = read_numbers(in.sections());
  p.files = read_strings(in.files());
  for (const fb::Line* l : *in.lines())
    p.lines.push_back({l->code(), l->file(), l->line(), l->column()});
  p.ir = read_numbers(in.ir());
  if (in.sources())
    for (const fb::SourceFile* s : *in.sources())
      p.sources.push_back({s->name()->str(), s->hash()});
  if (in.compiler()) p.compiler = in.compiler()->str();
  return nullptr;
}

// What other renderers' compiled shaders begin with: better said than "bad magic".
std::string foreign_file(std::span<const std::byte> bytes) {
  std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<size_t>(bytes.size(), 256));
  if (head.starts_with("AQSIS_V") || head.find("segment Data") != head.npos) return "an Aqsis shader (.slx)";
  if (head.find("!parameters:") != head.npos || head.find("#!parameters") != head.npos)
    return "a Pixie shader (.sdr)";
  if (head.starts_with("OpenShadingLanguage")) return "an Open Shading Language shader (.oso)";
  if (head.starts_with(";") || head.find("slo") == 0) return "a shader compiled for another renderer";
  if (head.starts_with("\x7f"
                       "ELF"))
    return "a shared library (3Delight and others compile shaders to these)";
  bool text = !head.empty() && std::all_of(head.begin(), head.end(), [](char c) {
    return c == '\n' || c == '\r' || c == '\t' || (c >= 32 && c < 127);
  });
  return text ? "a text file (shader source? compile it with slc first)" : "";
}

} // namespace

uint64_t hash_bytes(std::span<const std::byte> bytes) {
  uint64_t h = 0xcbf29ce484222325ull;
  for (std::byte b : bytes)
    h = (h ^ static_cast<uint64_t>(b)) * 0x100000001b3ull;
  return h;
}

std::vector<std::byte> write_slo(const Program& program) {
  return Writer().write(program);
}

Result<Program> read_slo(std::span<const std::byte> bytes) {
  if (bytes.size() < sizeof kMagic || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0) {
    std::string foreign = foreign_file(bytes);
    return Error{foreign.empty() ? "not an Anemone .slo file" : "not an Anemone .slo file but " + foreign};
  }
  if (bytes.size() < kHeaderBytes) return Error{"truncated: the header is incomplete"};
  auto version = static_cast<uint8_t>(bytes[7]);
  if (version != kSloVersion)
    return Error{fmt::format(
        "made for version {} of the format, this program reads version {}: compile the shader again", version,
        kSloVersion)};
  uint64_t hash;
  std::memcpy(&hash, bytes.data() + 8, sizeof hash);
  std::span<const std::byte> payload = bytes.subspan(kHeaderBytes);
  if (hash != hash_bytes(payload))
    return Error{"damaged: the contents do not match their checksum (truncated or altered)"};
  // FlatBuffers wants its data aligned; a span of a file need not be.
  if (payload.empty()) return Error{"damaged: the container is empty"};
  std::vector<uint64_t> aligned((payload.size() + 7) / 8);
  std::memcpy(aligned.data(), payload.data(), payload.size());
  const auto* data = reinterpret_cast<const uint8_t*>(aligned.data());
  flatbuffers::Verifier verifier(data, payload.size(), 64, 50'000'000);
  if (!verifier.VerifyBuffer<fb::Shader>(nullptr)) return Error{"damaged: the container is not well-formed"};
  const auto* root = flatbuffers::GetRoot<fb::Shader>(data);
  Program program;
  for (const fb::Import* i : *root->imports()) {
    std::optional<ShadeopId> id = read_import(*i, *root, program.plugins);
    if (!id && i->plugin())
      return Error{fmt::format("damaged: the plug-in function '{}' has no proper signature or library",
                               i->name()->string_view())};
    if (!id)
      return Error{fmt::format("uses the built-in '{}' with signature '{}', which this version does not have",
                               i->name()->string_view(), i->signature()->string_view())};
    program.imports.push_back(*id);
  }
  if (const char* error = read_shader(*root, program)) return Error{fmt::format("damaged: {}", error)};
  if (std::string error = verify_program(program); !error.empty()) return Error{"damaged: " + error};
  return program;
}

} // namespace slvm
