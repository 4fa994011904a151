// Ri functions: blocks, objects, archives, conditions, declarations.
#include "render/ri/define.h"

#include <cstdio>
#include <vector>

using render::RiError;
using render::ri::Context;
using render::ri::Floats;
using render::ri::Handle;
using render::ri::LeftOut;
using render::ri::ParameterList;

namespace {

/// A condition takes no parameters; the list is there because PRMan's functions have one.
RtVoid condition(Context* context, render::RequestId id, const ParameterList& list, RtToken text) {
  if (list.count > 0)
    context->error(render::request_info(id).name, RiError::kBadToken, "a condition takes no parameters");
  context->send(id, {}, text);
}

RtArchiveHandle archive(Context* context, const ParameterList& list, RtToken name) {
  return context->send(render::RequestId::kArchiveBegin, list, name) ? const_cast<char*>(name) : nullptr;
}

} // namespace

extern "C" {

RI_PLAIN(FrameBegin, (RtInt number), number)
RI_PLAIN(FrameEnd, (void))
RI_PLAIN(WorldBegin, (void))
RI_PLAIN(WorldEnd, (void))
RI_PLAIN(AttributeBegin, (void))
RI_PLAIN(AttributeEnd, (void))
RI_PLAIN(TransformBegin, (void))
RI_PLAIN(TransformEnd, (void))
RI_PLAIN(SolidBegin, (RtToken operation), operation)
RI_PLAIN(SolidEnd, (void))

RtObjectHandle RiObjectBegin(void) {
  auto* context = render::ri::current("RiObjectBegin");
  if (!context) return nullptr;
  RtObjectHandle handle = context->next_object();
  return context->send(render::RequestId::kObjectBegin, {}, Handle{handle}) ? handle : nullptr;
}
RI_PLAIN(ObjectEnd, (void))
RtVoid RiObjectInstance(RtObjectHandle handle) {
  auto* context = render::ri::current("RiObjectInstance");
  if (!context) return;
  if (context->is_object(handle))
    context->send(render::RequestId::kObjectInstance, {}, Handle{handle});
  else
    context->error("RiObjectInstance", RiError::kBadHandle, "this is not the handle of an object");
}

RtVoid RiMotionBeginV(RtInt n, RtFloat times[]) {
  if (auto* context = render::ri::current("RiMotionBegin"))
    context->send(render::RequestId::kMotionBegin, {}, Floats{times, n});
}
RtVoid RiMotionBegin(RtInt n, ...) {
  std::vector<RtFloat> times;
  va_list arguments;
  va_start(arguments, n);
  for (RtInt i = 0; i < n; ++i)
    times.push_back(static_cast<RtFloat>(va_arg(arguments, double)));
  va_end(arguments);
  RiMotionBeginV(n, times.data());
}
RI_PLAIN(MotionEnd, (void))

RI_PAIR(RtVoid, ReadArchive, (RtToken name, RtArchiveCallback callback), callback,
        context->read_archive(name, callback, list))
RI_PAIR(RtArchiveHandle, ArchiveBegin, (RtToken name), name, archive(context, list, name))
RI_PLAIN(ArchiveEnd, (void), LeftOut{})
RI_PARAMETERS(ArchiveInstance, (RtToken name), name, name)

RtVoid RiArchiveRecord(RtToken type, char const* format, ...) {
  auto* context = render::ri::current("RiArchiveRecord");
  if (!context) return;
  if (!type || !format) {
    context->error("RiArchiveRecord", RiError::kMissingData, "a null pointer");
    return;
  }
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  int length = std::vsnprintf(nullptr, 0, format, arguments);
  std::vector<char> text(static_cast<size_t>(length > 0 ? length : 0) + 1);
  std::vsnprintf(text.data(), text.size(), format, again);
  va_end(again);
  va_end(arguments);
  context->archive_record(type, text.data());
}

RI_PAIR(RtVoid, IfBegin, (RtToken text), text, condition(context, render::RequestId::kIfBegin, list, text))
RI_PAIR(RtVoid, ElseIf, (RtToken text), text, condition(context, render::RequestId::kElseIf, list, text))
RI_PLAIN(Else, (void))
RI_PLAIN(IfEnd, (void))

RtToken RiDeclare(RtToken name, RtToken declaration) {
  if (auto* context = render::ri::current("RiDeclare"))
    context->send(render::RequestId::kDeclare, {}, name, declaration);
  return name;
}

} // extern "C"
