// Files, archives and retained objects: reading, recording and replaying requests.
#include "render/state/interpreter.h"

#include "render/rib/content.h"
#include "render/rib/encoding.h"
#include "render/rib/gzip.h"
#include "render/rib/parser.h"
#include "render/state/search_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace render {

namespace {

constexpr int kMaxArchiveDepth = 64;
/// Bytes a compressed file may unpack to.
constexpr size_t kMaxUnpacked = size_t{1} << 30;

std::string folder_of(const std::string& name) {
  return std::filesystem::path(name).parent_path().string();
}

} // namespace

bool Interpreter::read_file(const std::string& name) {
  auto text = render::read_file(name);
  if (!text) return false;
  if (depth_ == 0) scene_folder_ = folder_of(name);
  read_text(name, std::move(*text));
  return true;
}

void Interpreter::read_text(std::string name, std::string text) {
  parse_text(std::move(name), std::move(text), true);
}

/// `keep`: the text may be shown in messages, and read again.
void Interpreter::parse_text(std::string name, std::string text, bool keep) {
  std::string problem;
  if (is_gzip(text)) {
    Unpacked unpacked = unpack_gzip(text, kMaxUnpacked);
    text = std::move(unpacked.text);
    problem = std::move(unpacked.error);
  }
  EndMarkFinder finder;
  finder.find(text);
  // Lines of an encoded file would be noise in messages.
  keep = keep && !finder.saw_encoded();
  std::string outer_folder = std::exchange(folder_, folder_of(name));
  std::string key = name;
  slvm::FileId file = sources_.add(std::move(name), keep ? std::move(text) : std::string());
  if (!problem.empty()) diagnostics_.error({file, 1, 1, 1}, problem);
  if (keep && problem.empty() && depth_ > 0) archive_files_[key] = file;
  parse_rib(keep ? sources_.text(file) : text, file, *reader_, diagnostics_);
  folder_ = outer_folder;
}

/// True when the request became part of an object or inline archive.
bool Interpreter::record(const RequestCall& call) {
  if (recording_.depth == 0) return false;
  if (call.id == recording_.begin) ++recording_.depth;
  if (call.id == recording_.end && recording_.depth == 1) return false;
  if (call.id == recording_.end) --recording_.depth;
  recording_.calls->push_back(call);
  return true;
}

bool Interpreter::nested_too_deep(const RequestCall& call) {
  if (depth_ < kMaxArchiveDepth) return false;
  error(call, fmt::format("archives and instances are nested more than {} deep", kMaxArchiveDepth));
  return true;
}

void Interpreter::replay(const RequestCall& call, const std::vector<RequestCall>& calls) {
  if (nested_too_deep(call)) return;
  ++depth_;
  for (const RequestCall& c : calls) {
    if (stopped_) break;
    request(c);
  }
  --depth_;
}

/// An inline archive: the state at the instance fills in the variables of its strings. False: there is none
/// of this name.
bool Interpreter::replay_archive(const RequestCall& call) {
  if (replay_content(call)) return true;
  auto it = archives_.find(call.text(0));
  if (it == archives_.end()) return false;
  auto calls = it->second; // may be redefined by itself
  ++inline_depth_;
  replay(call, *calls);
  --inline_depth_;
  return true;
}

bool Interpreter::replay_content(const RequestCall& call) {
  auto it = contents_.find(call.text(0));
  if (it == contents_.end()) return false;
  Content content = it->second;
  if (content.type != "application/rib") {
    warn_once(
        "content " + content.type, call.where, "rib-unsupported",
        fmt::format("archive \"{}\" holds {}, which takes a plug-in that is not there: nothing comes of it",
                    call.text(0), content.type));
  } else if (!nested_too_deep(call)) {
    ++inline_depth_;
    ++depth_;
    parse_text(fmt::format("<{}>", call.text(0)), std::move(content.data), false);
    --depth_;
    --inline_depth_;
  }
  return true;
}

void Interpreter::read_archive(const RequestCall& call) {
  no_parameters(call);
  if (replay_archive(call)) return;
  if (nested_too_deep(call)) return;
  ++depth_;
  read_archive_file(call.text(0), call.arguments[0].where, "ReadArchive");
  --depth_;
}

void Interpreter::read_archive_file(const std::string& name, slvm::SourceRange where,
                                    std::string_view request) {
  std::vector<std::string> path = full_path(options_, "archive");
  auto found = find_file(name, path);
  if (found && !found->ends_with(std::filesystem::path(name).lexically_normal().string()))
    warn_once("archive " + name, where, "rib-path",
              fmt::format("there is no \"{}\"; \"{}\" is read instead", name, *found));
  auto known = found ? archive_files_.find(*found) : archive_files_.end();
  if (known != archive_files_.end()) {
    std::string outer_folder = std::exchange(folder_, folder_of(*found));
    parse_rib(sources_.text(known->second), known->second, *reader_, diagnostics_);
    folder_ = outer_folder;
  } else if (auto text = found ? render::read_file(*found) : std::nullopt) {
    read_text(*found, std::move(*text));
  } else if (error_handler_ != ErrorHandling::kIgnore) {
    error_kind_ = RiError::kNoFile;
    diagnostics_.error(where, fmt::format("{}: no archive \"{}\" in the search path \"{}\"", request, name,
                                          fmt::join(path, ":")));
  }
}

void Interpreter::object_begin(const RequestCall& call) {
  recording_ = {
      call.id,   RequestId::kObjectEnd, call.text(0), 1, std::make_shared<std::vector<RequestCall>>(),
      call.where};
}

void Interpreter::archive_begin(const RequestCall& call) {
  recording_ = {
      call.id,   RequestId::kArchiveEnd, call.text(0), 1, std::make_shared<std::vector<RequestCall>>(),
      call.where};
  const Param* type = call.find_param("Content-Type");
  const Param* encoding = call.find_param("Content-Transfer-Encoding");
  for (const Param& p : call.params)
    if (&p != type && &p != encoding) no_parameter(call, p);
  contents_.erase(call.text(0));
  if (call.data.empty() || (type && !type->is_string()) || (encoding && !encoding->is_string())) return;
  auto data = decode_content(encoding ? encoding->strings[0] : "", call.data);
  if (data)
    contents_[call.text(0)] = {type ? type->strings[0] : "application/rib", std::move(*data)};
  else
    error_at(encoding->where, call, data.error());
}

/// ObjectEnd and ArchiveEnd.
void Interpreter::recording_end(const RequestCall& call) {
  if (recording_.depth == 0) {
    bool object = call.id == RequestId::kObjectEnd;
    error(call,
          fmt::format("there is no open {}; the request is skipped", object ? "ObjectBegin" : "ArchiveBegin"),
          RiError::kNesting);
    return;
  }
  bool object = recording_.begin == RequestId::kObjectBegin;
  (object ? objects_ : archives_)[recording_.name] = recording_.calls;
  recording_ = {};
}

void Interpreter::object_instance(const RequestCall& call) {
  auto it = objects_.find(call.text(0));
  if (it == objects_.end()) {
    error_at(call.arguments[0].where, call, fmt::format("no object \"{}\" was recorded", call.text(0)),
             RiError::kBadHandle);
    return;
  }
  auto calls = it->second;
  // What an object changes of the state must not leak to what follows.
  auto attributes = attributes_;
  Matrix4 ctm = ctm_;
  MotionMatrices motion = motion_;
  size_t first = scene_.primitives.size();
  replay(call, *calls);
  if (scene_.primitives.size() > first)
    scene_.copies.push_back({calls.get(), first, scene_.primitives.size() - first, ctm});
  attributes_ = attributes;
  ctm_ = ctm;
  motion_ = std::move(motion);
}

void Interpreter::archive_instance(const RequestCall& call) {
  no_parameters(call);
  if (!replay_archive(call))
    error_at(call.arguments[0].where, call, fmt::format("no archive \"{}\" was recorded", call.text(0)),
             RiError::kBadHandle);
}

} // namespace render
