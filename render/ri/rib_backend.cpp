// Writing requests, with the checks a renderer would make of their places.
#include "render/ri/rib_backend.h"

#include "render/state/interpreter.h"

#include <fmt/format.h>

#include <algorithm>

namespace render::ri {

namespace {

/// Functions that call each other have to end some time.
constexpr int kDeepest = 16;
constexpr size_t kMostCalls = 1'000'000;

/// The request that a ...End closes; kCount: the request is none.
RequestId opener(RequestId id) {
  using enum RequestId;
  switch (id) {
  case kFrameEnd: return kFrameBegin;
  case kWorldEnd: return kWorldBegin;
  case kAttributeEnd: return kAttributeBegin;
  case kTransformEnd: return kTransformBegin;
  case kSolidEnd: return kSolidBegin;
  case kObjectEnd: return kObjectBegin;
  case kMotionEnd: return kMotionBegin;
  case kArchiveEnd: return kArchiveBegin;
  case kIfEnd: return kIfBegin;
  default: return kCount;
  }
}

} // namespace

bool RibBackend::open() {
  if (writer_ || failed_) return !failed_;
  auto made = RibFile::create(output_.file, output_.gzip);
  if (!made) {
    failed_ = true;
    report(RiError::kBadFile, RIE_SEVERE, made.error());
    return false;
  }
  file_ = std::move(*made);
  writer_ = std::make_unique<RibWriter>([this](std::string_view text) { file_->write(text); },
                                        RibFormat{output_.binary, output_.precision});
  return true;
}

void RibBackend::error(const RequestCall& call, RiError kind, std::string_view text) {
  report(kind, RIE_ERROR, fmt::format("{}: {}", call.info().name, text));
}

/// Whether a block's end has its beginning. Blocks left open inside are reported; a reader closes them.
bool RibBackend::nests(const RequestCall& call) {
  if (call.info().name.ends_with("Begin")) {
    blocks_.push_back(call.id);
    return true;
  }
  RequestId begin = opener(call.id);
  if (begin == RequestId::kCount) return true;
  auto found = std::find(blocks_.rbegin(), blocks_.rend(), begin);
  if (found == blocks_.rend()) {
    error(call, RiError::kNesting,
          fmt::format("there is no open {}; the request is skipped", request_info(begin).name));
    return false;
  }
  for (auto inner = blocks_.rbegin(); inner != found; ++inner)
    error(call, RiError::kNesting, fmt::format("{} is still open", request_info(*inner).name));
  blocks_.erase(std::prev(found.base()), blocks_.end());
  return true;
}

/// Inside objects and archives anything may stand: where they are used is not known.
bool RibBackend::legal(const RequestCall& call) {
  auto open = [&](RequestId id) { return std::find(blocks_.begin(), blocks_.end(), id) != blocks_.end(); };
  if (open(RequestId::kArchiveBegin) || open(RequestId::kObjectBegin)) return true;
  bool world = open(RequestId::kWorldBegin);
  if (world ? call.info().world : call.info().outside) return true;
  if (world)
    error(call, RiError::kNotOptions, "options cannot change inside a world block; the request is skipped");
  else
    error(call, is_primitive(call.id) ? RiError::kNotPrimitives : RiError::kIllegalState,
          "this belongs between WorldBegin and WorldEnd; the request is skipped");
  return false;
}

void RibBackend::request(const RequestCall& call) {
  if (call.id == RequestId::kOption && call.text(0) == "rib") {
    std::string problem = writer_ ? "the file has been begun; \"rib\" belongs before all other requests"
                                  : set_rib_option(call, output_);
    if (!problem.empty()) error(call, writer_ ? RiError::kIllegalState : RiError::kRange, problem);
    return;
  }
  if (!legal(call) || !nests(call) || !open()) return;
  writer_->request(call);
}

void RibBackend::comment(const std::string& text) {
  if (open()) writer_->comment(text, {});
}

void RibBackend::verbatim(const std::string& rib) {
  if (open()) writer_->verbatim(rib);
}

void RibBackend::procedural(std::span<const float, 6>, std::shared_ptr<GeometryMaker> maker,
                            slvm::SourceRange) {
  RequestCall call;
  call.id = RequestId::kProcedural;
  if (!legal(call) || !open()) return;
  if (functions_ == 0) functions_called_ = 0;
  if (functions_ == kDeepest || ++functions_called_ > kMostCalls) {
    error(call, RiError::kLimit,
          fmt::format("functions make functions more than {} deep, or more than {} of them; the rest is left "
                      "out of the file",
                      kDeepest, kMostCalls));
    return;
  }
  ++functions_;
  call.id = RequestId::kAttributeBegin;
  request(call);
  maker->make(RI_INFINITY);
  call.id = RequestId::kAttributeEnd;
  request(call);
  --functions_;
}

void RibBackend::pixel_filter(RtFilterFunc, RtFloat, RtFloat) {
  report(RiError::kIncapable, RIE_ERROR,
         "PixelFilter: a file cannot keep a function; expected one of ri.h, such as RiGaussianFilter");
}

slvm::Result<Matrix4> RibBackend::to_camera(const std::string&) {
  return slvm::Error{"spaces are not known where a file is written"};
}

/// Handlers of the program's own have no name in a file.
void RibBackend::error_handler(RtErrorHandler handler) {
  constexpr std::pair<RtErrorHandler, const char*> kHandlers[] = {
      {RiErrorIgnore, "ignore"}, {RiErrorPrint, "print"}, {RiErrorAbort, "abort"}};
  for (auto [known, name] : kHandlers)
    if (known == handler) {
      RequestCall call;
      call.id = RequestId::kErrorHandler;
      Argument& a = call.arguments.emplace_back();
      a.present = true;
      a.strings = {name};
      request(call);
    }
}

void RibBackend::finish() {
  for (auto open = blocks_.rbegin(); open != blocks_.rend(); ++open)
    report(RiError::kNesting, RIE_ERROR, fmt::format("RiEnd: {} is still open", request_info(*open).name));
  blocks_.clear();
  if (!open()) return;
  if (std::string problem = file_->finish(); !problem.empty()) report(RiError::kBadFile, RIE_SEVERE, problem);
}

std::string set_rib_option(const RequestCall& call, RibOutput& output) {
  for (const Param& p : call.params) {
    std::string name = p.token.substr(p.token.find_last_of(" \t") + 1); // npos + 1 is 0
    std::string text = p.strings.empty() ? "" : p.strings[0];
    if (name == "precision" && p.numbers.size() == 1 && p.numbers[0] >= 0 && p.numbers[0] <= 17)
      output.precision = static_cast<int>(p.numbers[0]);
    else if (name == "format" && (text == "ascii" || text == "binary"))
      output.binary = text == "binary";
    else if (name == "compression" && (text == "none" || text == "gzip"))
      output.gzip = text == "gzip";
    else
      return fmt::format("\"{}\"{}: expected \"format\" (ascii, binary), \"compression\" (none, gzip) or "
                         "\"precision\" (0 to 17)",
                         name, text.empty() ? "" : fmt::format(" \"{}\"", text));
  }
  return {};
}

} // namespace render::ri
